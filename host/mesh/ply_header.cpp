#include "mesh/ply_header.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>

#include "base/error.hpp"
#include "mesh/words.hpp"

namespace nook {
namespace {

// PLY's types under all of their names, in the order of PlyType.
constexpr std::array<std::array<std::string_view, 2>, 10> type_names = {{{"char", "int8"},
                                                                         {"uchar", "uint8"},
                                                                         {"short", "int16"},
                                                                         {"ushort", "uint16"},
                                                                         {"int", "int32"},
                                                                         {"uint", "uint32"},
                                                                         {"int64", "long"},
                                                                         {"uint64", "ulong"},
                                                                         {"float", "float32"},
                                                                         {"double", "float64"}}};

class HeaderReader {
 public:
  HeaderReader(std::string_view text, const std::string& name) : text_(text), name_(name) {
    const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
    line_end_ = text.substr(end).starts_with('\r') && !text.substr(end).starts_with("\r\n") ? '\r' : '\n';
  }

  PlyHeader read() {
    if (line() != "ply") fail("not a PLY file");
    bool known_format = false;
    for (std::string_view text = line(); text != "end_header"; text = line()) {
      const std::string_view whole = text, word = next_word(text);
      if (word == "format") {
        header_.format = format(next_word(text));
        known_format = true;
      } else if (word == "element") {
        element(text);
      } else if (word == "property") {
        property(text);
      } else if (word != "comment" && word != "obj_info" && !word.empty()) {
        fail(fmt::format("unknown header line '{}'", shown(whole)));
      }
    }
    if (!known_format) fail("the header has no format");
    return std::move(header_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw Error(ErrorKind::scene, Place{name_, header_.lines}, what);
  }

  // Of a line: it may hold the other kind of line end.
  static std::string_view shown(std::string_view text) {
    return text.substr(0, std::min<std::size_t>(40, text.find_first_of("\r\n")));
  }

  std::string_view line() {
    const std::size_t end = text_.find(line_end_, header_.bytes);
    if (end == std::string_view::npos) fail("the header has no end_header");
    std::string_view found = text_.substr(header_.bytes, end - header_.bytes);
    header_.bytes = end + 1;
    ++header_.lines;
    if (found.ends_with('\r')) found.remove_suffix(1);
    return trimmed(found);
  }

  PlyHeader::Format format(std::string_view word) const {
    if (word == "ascii") return PlyHeader::Format::ascii;
    if (word == "binary_little_endian") return PlyHeader::Format::little_endian;
    if (word == "binary_big_endian") return PlyHeader::Format::big_endian;
    fail(fmt::format("format '{}' is not ascii, binary_little_endian or binary_big_endian", shown(word)));
  }

  PlyType type(std::string_view word) const {
    for (std::size_t t = 0; t < type_names.size(); ++t)
      if (word == type_names[t][0] || word == type_names[t][1]) return PlyType(t);
    fail(fmt::format("unknown type '{}'", shown(word)));
  }

  void element(std::string_view text) {
    PlyElement& element = header_.elements.emplace_back();
    element.name = lower(next_word(text));
    const std::string_view count = next_word(text);
    const auto [end, code] = std::from_chars(count.data(), count.data() + count.size(), element.count);
    if (code != std::errc() || end != count.data() + count.size() || element.count > 0xfffffff0u)
      fail("an element needs a name and a count");
  }

  void property(std::string_view text) {
    if (header_.elements.empty()) fail("a property before any element");
    PlyProperty property;
    std::string_view word = next_word(text);
    property.is_list = word == "list";
    if (property.is_list) {
      property.count_type = type(next_word(text));
      if (property.count_type >= PlyType::f32) fail("a list's count is not an integer");
      word = next_word(text);
    }
    property.type = type(word);
    property.name = lower(next_word(text));
    header_.elements.back().properties.push_back(property);
  }

  std::string_view text_;
  const std::string& name_;
  char line_end_ = '\n';
  PlyHeader header_;
};

}  // namespace

int PlyElement::find(std::string_view property, bool is_list) const {
  for (std::size_t p = 0; p < properties.size(); ++p)
    if (properties[p].name == property && properties[p].is_list == is_list) return int(p);
  return -1;
}

PlyHeader read_ply_header(std::string_view text, const std::string& name) {
  return HeaderReader(text, name).read();
}

}  // namespace nook
