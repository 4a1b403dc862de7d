#pragma once

#include <functional>

#include "mesh/triangle_mesh.hpp"

namespace nook::test {

/// Meshes made in a test. Quads are a, b, c, d in order around the edge, counter-clockwise seen from their
/// front.
void add_quad(TriangleMesh& mesh, const vec3& a, const vec3& b, const vec3& c, const vec3& d);

/// The parallelogram p, p+u, p+u+v, p+v; its normal is along cross(u, v).
void add_quad(TriangleMesh& mesh, const vec3& p, const vec3& u, const vec3& v);

/// The axis-aligned box, faces outwards (or inwards).
void add_box(TriangleMesh& mesh, const vec3& lo, const vec3& hi, bool inwards = false);

/// A floor z = 0 with a wall, a tall and a low box on it: contacts, corners, slits, open sky. Extent about 4.
TriangleMesh courtyard();

void add_triangle(TriangleMesh& mesh, const vec3& a, const vec3& b, const vec3& c);

/// Two triangles a, b, c and a, c, d with corners of their own; bounds are left to with_bounds().
void add_square(TriangleMesh& mesh, const vec3& a, const vec3& b, const vec3& c, const vec3& d);

/// A closed sphere of n x 2n facets (4 n (n - 1) triangles) with shared vertices, facing outwards; radius(i,
/// j) of each vertex, i from pole to pole.
void add_sphere(TriangleMesh& mesh, const dvec3& center, unsigned n,
                const std::function<double(unsigned, unsigned)>& radius);

/// [-1,1]^3, each face of n x n squares that face inwards: its walls lie exactly in node planes.
TriangleMesh closed_box(unsigned n);

}  // namespace nook::test
