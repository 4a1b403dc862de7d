#include "points/corner_points.hpp"

#include "points/outside.hpp"
#include "points/triangle_point.hpp"

namespace nook {

CornerPoints corner_points(const TriangleMesh& mesh) {
  CornerPoints made;
  std::vector<dvec3> centroids;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const bool flat = face_normal(mesh, t) == dvec3(0);
    for (int k = 0; k < 3; ++k) {
      dvec3 weights(0);
      weights[k] = 1;
      const TrianglePoint corner = flat ? TrianglePoint{} : triangle_point(mesh, t, weights);
      made.normals.push_back(corner.normal);
      made.points.push_back(corner.point);
      centroids.push_back(corner.centroid);
    }
  }
  move_outside(made.points, mesh, centroids);
  return made;
}

TriangleMesh corner_mesh(const TriangleMesh& mesh) {
  TriangleMesh made;
  made.frame = mesh.frame;
  for (const auto& triangle : mesh.triangles) {
    const auto first = std::uint32_t(made.positions.size());
    made.triangles.push_back({first, first + 1, first + 2});
    for (const std::uint32_t corner : triangle) made.positions.push_back(mesh.positions[corner]);
  }
  return made;
}

}  // namespace nook
