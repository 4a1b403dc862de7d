#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/large_vector.hpp"
#include "mesh/triangle_mesh.hpp"

namespace nook {

/// Faces as a file has them, in its order: those that one thread read.
///
///     std::size_t c = 0;  // the first corner of a face
///     for (std::uint32_t size : block.face_sizes) {
///       for (std::size_t k = c; k < c + size; ++k) use(positions[block.positions[k]]);
///       c += size;
///     }
struct FaceBlock {
  static constexpr std::uint32_t none = 0xffffffffu;

  std::vector<std::uint32_t> positions;     ///< a corner each: index into PolygonMesh::positions
  std::vector<std::uint32_t> uvs, normals;  ///< a corner each: index or `none`; or empty: see PolygonMesh
  std::vector<std::uint32_t> face_sizes;    ///< corners of each face, at least 3
  std::vector<std::uint32_t> places;        ///< of each face of more than 3 corners: PolygonMesh::place

  /// What the faces from `first_face` to the next run's belong to. Runs begin at face 0.
  struct Run {
    std::size_t first_face = 0;
    std::uint32_t group = 0, material = TriangleMesh::no_material;
  };
  std::vector<Run> runs;
};

/// What the readers of mesh files make: polygons whose corners are the file's, in double precision. From here
/// on, formats are forgotten (triangulate.hpp).
struct PolygonMesh {
  std::string name;                    ///< the file's, for messages
  std::string_view place = "";         ///< "": FaceBlock::places are lines; " face ": faces; from 1
  LargeVector<dvec3> positions;        ///< as the file has them; some may be NaN or infinite
  std::vector<vec3> normals;           ///< of any length, 0, or not finite
  std::vector<vec2> uvs;               ///< some may be NaN
  bool vertices_have_normals = false;  ///< a corner's normal has its position's index
  bool vertices_have_uvs = false;      ///< likewise its uv
  std::vector<FaceBlock> blocks;
  std::vector<Material> materials;
  std::vector<std::string> groups;
  std::vector<std::vector<std::string>> group_names;  ///< TriangleMesh::group_names
  std::vector<std::string> warnings;                  ///< TriangleMesh::Report::warnings
};

}  // namespace nook
