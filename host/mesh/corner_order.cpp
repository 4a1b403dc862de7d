#include "mesh/corner_order.hpp"

#include <algorithm>

namespace nook {
namespace {

// The corner behind the longest edge; of equally long ones the last, so that what has no longest edge stays.
int first_corner(const vec3& a, const vec3& b, const vec3& c) {
  const auto length2 = [](const vec3& from, const vec3& to) { return glm::dot(to - from, to - from); };
  const float ab = length2(a, b), bc = length2(b, c), ca = length2(c, a);
  if (ab > bc && ab > ca) return 1;
  return bc > ca ? 2 : 0;
}

}  // namespace

void end_with_longest_edges(TriangleMesh& mesh) {
  end_with_longest_edges(mesh, mesh.positions);
}

void end_with_longest_edges(TriangleMesh& mesh, const std::vector<vec3>& positions) {
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& t = mesh.triangles[i];
    const int first = first_corner(positions[t[0]], positions[t[1]], positions[t[2]]);
    if (first == 0) continue;
    for (auto* corners : {&mesh.triangles, &mesh.triangle_normals, &mesh.triangle_uvs})
      if (!corners->empty())
        std::rotate((*corners)[i].begin(), (*corners)[i].begin() + first, (*corners)[i].end());
  }
}

}  // namespace nook
