#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace nook {

/// What tinyobjloader does not tell of an OBJ text: it reads a number that it cannot parse as 0.
struct ObjScan {
  std::vector<std::uint32_t> non_finite_positions;  ///< 0-based `v` lines with "nan" or "inf" in them
  std::vector<std::uint32_t> non_finite_normals;    ///< 0-based `vn` lines likewise
};

/// Throws Error(scene) "<name>:<line>: ..." at a `v` or `vn` line that holds something other than numbers.
ObjScan scan_obj(std::string_view text, const std::string& name);

/// "<name>:<line>: face index 9 is out of range (8 positions so far)" for the first face whose position, uv
/// or normal index names nothing defined above it; "" if there is none.
std::string find_bad_face(std::string_view text, const std::string& name);

}  // namespace nook
