#pragma once

#include <cstring>
#include <string>
#include <string_view>

#include "mesh/ply_header.hpp"

namespace nook {

/// The values behind a PLY file's header, one after the other.
class PlyBody {
 public:
  PlyBody(std::string_view text, const PlyHeader& header, std::string name)
      : begin_(text.data()),
        at_(text.data() + header.bytes),
        end_(text.data() + text.size()),
        format_(header.format),
        line_(header.lines + 1),
        name_(std::move(name)) {}

  bool is_text() const { return format_ == PlyHeader::Format::ascii; }
  /// A value takes a byte at least, in text two.
  std::size_t most_values_left() const { return std::size_t(end_ - at_) / (is_text() ? 2 : 1) + 1; }
  std::size_t line() const { return line_; }  ///< of the next value, in text

  /// "FILE:LINE: what", of a binary file "FILE: byte PLACE: what".
  [[noreturn]] void fail(const std::string& what) const;

  double value(PlyType type) {
    if (is_text()) return word();
    if (std::size_t(end_ - at_) < size_of(type)) fail("the file ends too early");
    switch (type) {
      case PlyType::i8:
        return take<std::int8_t>();
      case PlyType::u8:
        return take<std::uint8_t>();
      case PlyType::i16:
        return take<std::int16_t>();
      case PlyType::u16:
        return take<std::uint16_t>();
      case PlyType::i32:
        return take<std::int32_t>();
      case PlyType::u32:
        return take<std::uint32_t>();
      case PlyType::i64:
        return double(take<std::int64_t>());
      case PlyType::u64:
        return double(take<std::uint64_t>());
      case PlyType::f32:
        return take<float>();
      default:
        return take<double>();
    }
  }

  /// How many values follow in a list.
  std::size_t list_size(PlyType count_type);

  /// Goes to the next value's line, so that line() is right.
  void skip_blanks() {
    while (is_text() && at_ != end_ && is_white(*at_)) line_ += is_line_end(at_++);
  }

 private:
  static bool is_white(char c) {
    return c == ' ' || c == '\n' || c == '\r' || c == '\t' || c == '\v' || c == '\f';
  }
  bool is_line_end(const char* c) const {
    return *c == '\n' || (*c == '\r' && (c + 1 == end_ || c[1] != '\n'));
  }

  template <class T>
  T take() {
    char bytes[sizeof(T)];
    std::memcpy(bytes, at_, sizeof(T));
    if (format_ == PlyHeader::Format::big_endian)
      for (std::size_t i = 0; i < sizeof(T) / 2; ++i) std::swap(bytes[i], bytes[sizeof(T) - 1 - i]);
    at_ += sizeof(T);
    T number;
    std::memcpy(&number, bytes, sizeof(T));
    return number;
  }

  double word();

  const char *begin_, *at_, *end_;
  PlyHeader::Format format_;
  std::size_t line_;
  std::string name_;
};

}  // namespace nook
