#pragma once

#include "mesh/triangle_mesh.hpp"

namespace nook::test {

/// Every generator leaves bounds to this.
TriangleMesh with_bounds(TriangleMesh mesh);

/// A unit sphere (64 x 128 facets) with centre (0,1,0) on a floor y = 0 of half width 100, times `scale`,
/// then moved.
TriangleMesh sphere_on_floor(float scale, vec3 offset);

/// Half planes from the z axis: y = 0, x > 0, and the same turned up by `angle`; squares of side `extent`.
TriangleMesh wedge(float angle, float extent);

/// The floor y = 0, |x|, |z| <= scale, of slivers 1e5 times longer than wide, each also turned over, doubled,
/// and with triangles without area between them.
TriangleMesh bad_floor(float scale);

/// A closed star about the origin: a sphere of n x 2n facets whose vertices lie at radius 1 and `inner` in
/// turn.
TriangleMesh spiky_star(unsigned n, float inner);

/// y = 0, |x|, |z| <= half, facing up.
TriangleMesh square(float half);

TriangleMesh single_triangle();

/// square(half) whose vertex normals lean by `angle` from the geometric normal.
TriangleMesh leaning_square(float half, double angle);

/// A unit sphere of n x 2n facets with the sphere's own normals at its vertices.
TriangleMesh smooth_sphere(unsigned n);

/// Triangle i has size 2^-i and lies at 2^-i (1,1,1).
TriangleMesh shrinking_triangles(int count);

}  // namespace nook::test
