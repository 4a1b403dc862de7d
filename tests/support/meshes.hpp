#pragma once

#include "mesh/triangle_mesh.hpp"

namespace nook::test {

/// Meshes made in a test. Quads are a, b, c, d in order around the edge, counter-clockwise seen from their
/// front.
void add_quad(TriangleMesh& mesh, const vec3& a, const vec3& b, const vec3& c, const vec3& d);

/// The axis-aligned box, faces outwards (or inwards).
void add_box(TriangleMesh& mesh, const vec3& lo, const vec3& hi, bool inwards = false);

/// A floor z = 0 with a wall, a tall and a low box on it: contacts, corners, slits, open sky. Extent about 4.
TriangleMesh courtyard();

}  // namespace nook::test
