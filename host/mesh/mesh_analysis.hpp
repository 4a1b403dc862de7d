#pragma once

#include <cstdint>
#include <string>

#include "mesh/triangle_mesh.hpp"

namespace nook {

/// What `nook info` says of a mesh beyond the loader's report.
struct MeshAnalysis {
  std::uint64_t zero_area = 0;  ///< triangles that no ray can hit
  std::uint64_t duplicates =
      0;  ///< triangles on the same three positions (by value, in any order) as an earlier one
};

MeshAnalysis analyse(const TriangleMesh& mesh);

/// 128 bits over everything that decides the picture: positions, normals, indices, materials, groups, opacity
/// maps. 32 hexadecimal digits.
std::string mesh_hash(const TriangleMesh& mesh);

}  // namespace nook
