#pragma once

#include <cstdint>
#include <string>

#include "mesh/obj_loader.hpp"
#include "scene/scene.hpp"

namespace nook {

/// Triangles of a scene's instances: each mesh file once, and each time it is placed.
struct InstanceCounts {
  std::uint64_t stored = 0, placed = 0;
};

/// Below this number of triangles, rays find their way through copies faster and the memory is no matter.
inline constexpr std::uint64_t fewest_triangles_for_trees = 1u << 20;

/// Why instances are copies of their meshes rather than trees in place; "" if they are trees. Automatic:
/// trees for at least fewest_triangles_for_trees triangles of which half or more are repeated, and no effect
/// that needs copies (SSAO, occluders = "self").
std::string reason_for_copies(const Scene& scene, Instancing instancing, const InstanceCounts& counts);

/// Everything that the scene's rays may meet, as one mesh: its mesh files, the instances of them, and the
/// ground. A file is read once. Instances are copies with triangles of their own or, as `instancing` has it,
/// TriangleMesh::instances: what reads the triangles themselves (a bake, SSAO) asks for copies, rays
/// for Scene::instancing. Throws Error(scene).
TriangleMesh load_scene_mesh(const Scene& scene, const MeshAttributes& attributes = {},
                             Instancing instancing = Instancing::copies);

}  // namespace nook
