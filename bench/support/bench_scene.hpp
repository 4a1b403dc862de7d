#pragma once

#include <string>
#include <vector>

#include "mesh/triangle_mesh.hpp"

namespace nook::bench {

/// A mesh and where to look at it from.
struct BenchScene {
  std::string name;
  TriangleMesh mesh;
  vec3 eye, at;
  float fov;  ///< vertical, degrees
};

/// `bunny` (glmark2-data's, subdivided to 1.1 million triangles, on a plane; argument: subdivisions, 2),
/// `room` (closed, full of finely tessellated objects, 1 million triangles), `cornell` (36 triangles),
/// `knot:N` (a knotted tube of about N triangles above a floor),
/// `spaceship` (scenes/generated/spaceship.obj), or the path of an OBJ file, framed.
/// Throws Error(scene).
BenchScene bench_scene(const std::string& name);

}  // namespace nook::bench
