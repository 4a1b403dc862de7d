#pragma once

#include <string>

#include "bench/support/bench_scene.hpp"

namespace nook::bench {

/// A positions-and-faces OBJ file. Throws Error(output).
void write_obj(const std::string& path, const TriangleMesh& mesh);

/// How a scene is rendered: AO by cosine-distributed directions without a limit.
struct PictureSettings {
  unsigned resolution = 1024;  ///< pixels a side
  unsigned spp = 1, directions = 16;
};

/// A scene file that renders `mesh_file` from the bench scene's camera. Throws Error(output).
void write_scene(const std::string& path, const std::string& mesh_file, const BenchScene& scene,
                 const PictureSettings& picture);

}  // namespace nook::bench
