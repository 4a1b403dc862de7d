#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "kernels/shared/cut_out.h"
#include "mesh/triangle_mesh.hpp"

namespace nook {

/// Opacity maps and the triangles in them, as the kernels read them. A triangle without texture coordinates
/// is opaque.
struct CutOuts {
  std::vector<CutTriangle> triangles;  ///< by triangle
  std::vector<OpacityMapPlace> maps;
  std::vector<std::uint8_t> opacity;  ///< all maps' texels
};
CutOuts make_cut_outs(const TriangleMesh& mesh);

}  // namespace nook
