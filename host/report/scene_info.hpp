#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mesh/triangle_mesh.hpp"
#include "scene/scene.hpp"

namespace nook {

/// What is in a scene's mesh, and what the scene's numbers resolve to: `nook info`. Lengths are world units.
struct SceneInfo {
  /// An effect of the scene; the distance limit is infinity without one, and of traced effects alone.
  struct EffectInfo {
    std::string name, type, settings;
    float max_distance = 0;
    std::string limit_from;  ///< what decided it: "auto", "3 x radius", "compat = tinyrender"
    bool traced = true;
  };
  std::vector<std::string> meshes;  ///< files, each once
  std::uint64_t triangles = 0, positions = 0, groups = 0, materials = 0;
  std::uint64_t instances = 0, models = 0, model_triangles = 0;  ///< 0: the mesh has no instances
  dvec3 lo{0}, hi{0}, center{0};
  double radius = 0;
  Frame frame;
  bool has_normals = false;
  std::uint64_t normals = 0, corners_without_normal = 0, normals_normalised = 0;
  std::uint64_t zero_area = 0, duplicates = 0, non_finite_dropped = 0;
  int width = 0, height = 0;
  PixelRect window;
  bool sampled = false;  ///< some effect is traced, and the following means something
  bool targets = false;  ///< camera_rays is the most that an error or time limit may take
  std::uint32_t camera_rays = 1, directions = 1, seed = 0;
  bool chooses_directions = false;
  std::string sampler;
  std::vector<EffectInfo> effects;
};

/// `mesh` as loaded with normals, uvs, materials and groups. `targets`: the scene's error or time decides.
SceneInfo scene_info(const Scene& scene, const TriangleMesh& mesh, bool targets);

/// One JSON object of it: what `nook info --json` prints.
std::string info_json(const SceneInfo& info);

}  // namespace nook
