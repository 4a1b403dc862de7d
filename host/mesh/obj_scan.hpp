#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace nook {

/// How many lines of each kind.
struct ObjCounts {
  std::size_t positions = 0, uvs = 0, normals = 0, faces = 0;  ///< `v`, `vt`, `vn`, `f`
};

/// What must be known of a piece of an OBJ text before tinyobjloader reads it, or what it does not tell: it
/// reads a number that it cannot parse as 0.
struct ObjScan {
  ObjCounts counts;
  std::vector<std::uint32_t> non_finite_positions;  ///< 0-based `v` lines of the piece with "nan" or "inf"
  std::vector<std::uint32_t> non_finite_normals;    ///< 0-based `vn` lines likewise
  std::vector<std::string> libraries;               ///< what follows `mtllib`, line by line
  bool readable = true;  ///< false: a `v`, `vn` or `f` line holds something other than its numbers
};

/// Lines end where tinyobjloader ends them: with "\n", "\r\n" or "\r".
ObjScan scan_obj(std::string_view piece);

/// The text in pieces of some `bytes` that end with a "\n" (or the text), in order.
std::vector<std::string_view> obj_pieces(std::string_view text, std::size_t bytes);

/// "<name>:<line>: face index 9 is out of range (8 positions)" for the first line of a whole text that holds
/// something other than its numbers, or a face index that names nothing; "" if there is none.
std::string first_obj_fault(std::string_view text, const std::string& name);

}  // namespace nook
