#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "mesh/triangle_mesh.hpp"
#include "render/picture.hpp"
#include "scene/scene.hpp"

namespace nook {

struct SsaoRun {
  std::filesystem::path scene_file, output, stats;  ///< stats: empty for none
  AovRequest aovs;
  std::vector<std::string> aov_names;
  std::string made_of;   ///< the hash of the mesh of a picture that is made again; empty: of any
  unsigned frames = 1;   ///< drawn, for timing
  unsigned threads = 0;  ///< that draw; 0: all
  bool png = true, quiet = false;
};

/// True if all that the scene asks for is SSAO: nothing of OpenCL is loaded then, and no tree is built.
bool is_ssao_alone(const Scene& scene);

/// Renders such a scene to its files; returns the exit code. `mesh` is loaded if it is empty.
int render_ssao(const Scene& scene, const SsaoRun& run, std::optional<TriangleMesh>& mesh);

}  // namespace nook
