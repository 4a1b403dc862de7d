#pragma once

#include <span>
#include <vector>

#include "mesh/ply.hpp"
#include "render/scene_renderer.hpp"
#include "scene/scene.hpp"

namespace nook {

/// The scene as it is baked: its effects that need no viewer (ao, bent), all of a point's samples as
/// directions from it. Throws Error(scene) if there is none, or one needs a viewer all the same.
Scene scene_to_bake(Scene scene);

/// What a bake reads of mesh files, as copies where the scene has instances.
MeshAttributes baked_attributes(const Scene& scene, bool to_texture);

/// The plan's effects at given points, of a scene_to_bake(). Throws Error(device),
/// Error(interrupted).
std::vector<Film> bake_at(SceneRenderer& renderer, std::span<const SurfacePoint> points,
                          RunObserver* observer = nullptr);

/// What is baked onto a mesh: a number for each vertex, or for each corner of its triangles.
struct MeshBake {
  std::vector<vec3> normals;  ///< that it was estimated about; 0 where there is nothing to estimate
  /// Of each effect NAME, or for bent normals NAME_x, NAME_y, NAME_z, NAME_cone (degrees), NAME_ao.
  std::vector<VertexProperty> properties;
};

/// At the mesh's vertices (vertex_points()), or at its triangles' corners (corner_points()). Throw as
/// bake_at().
MeshBake bake_vertices(SceneRenderer& renderer, RunObserver* observer = nullptr);
MeshBake bake_corners(SceneRenderer& renderer, RunObserver* observer = nullptr);

}  // namespace nook
