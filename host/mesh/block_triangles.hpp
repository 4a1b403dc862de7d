#pragma once

#include <cstdint>
#include <vector>

#include "mesh/face_cut.hpp"
#include "mesh/polygon_mesh.hpp"
#include "mesh/triangle_mesh.hpp"

namespace nook {

/// Faces whose outline crosses itself: the first one's place in the file, and how many.
struct CrossedFaces {
  std::uint32_t first_place = 0;
  std::uint64_t faces = 0;
};

/// A block's faces as triangles. Their indices are those of `mesh`, whose positions, normals and uvs are
/// there; the cuts are made at the polygons' positions, in doubles.
class BlockTriangles {
 public:
  BlockTriangles(const PolygonMesh& polygons, const TriangleMesh& mesh, const MeshAttributes& want)
      : polygons_(polygons), mesh_(mesh), want_(want) {}

  /// A mesh that has the arrays of triangles alone. Adds to `crossed`.
  TriangleMesh of(const FaceBlock& block, CrossedFaces& crossed);

 private:
  bool cut(const FaceBlock& block, std::size_t first, std::uint32_t size);
  void add(TriangleMesh& part, const FaceBlock& block, std::size_t first,
           const FaceCutter::Triangle& triangle, const FaceBlock::Run& run) const;
  std::uint32_t normal_of(const FaceBlock& block, std::size_t corner) const;
  std::uint32_t uv_of(const FaceBlock& block, std::size_t corner) const;

  const PolygonMesh& polygons_;
  const TriangleMesh& mesh_;
  const MeshAttributes& want_;
  FaceCutter cutter_;
  std::vector<dvec3> corners_;
  std::vector<FaceCutter::Triangle> triangles_;
};

}  // namespace nook
