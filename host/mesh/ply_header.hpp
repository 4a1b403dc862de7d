#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace nook {

enum class PlyType : std::uint8_t { i8, u8, i16, u16, i32, u32, i64, u64, f32, f64 };

/// Bytes of a value in a binary file.
constexpr std::size_t size_of(PlyType type) {
  constexpr std::size_t sizes[] = {1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
  return sizes[std::size_t(type)];
}

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::f32;
  bool is_list = false;
  PlyType count_type = PlyType::u8;  ///< of a list
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;

  /// Index of the property of this name that is (not) a list; -1 if there is none.
  int find(std::string_view property, bool is_list) const;
};

/// The header of a PLY file (Turk 1994).
struct PlyHeader {
  enum class Format { ascii, little_endian, big_endian } format = Format::ascii;
  std::vector<PlyElement> elements;
  std::size_t bytes = 0;  ///< where the body begins
  std::size_t lines = 0;
};

/// Lines end with "\n", "\r\n" or, if the first one does, "\r"; blanks at their ends mean nothing. Throws
/// Error(scene) "NAME:LINE: ...".
PlyHeader read_ply_header(std::string_view text, const std::string& name);

}  // namespace nook
