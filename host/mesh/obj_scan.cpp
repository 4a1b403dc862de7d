#include "mesh/obj_scan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstring>

namespace nook {
namespace {

bool is_blank(char c) {
  return c == ' ' || c == '\t';
}

// Calls visit(line) for each line, leading blanks removed, until one is answered with false.
template <class Visit>
void for_each_line(std::string_view text, Visit visit) {
  while (!text.empty()) {
    const void* newline = std::memchr(text.data(), '\n', text.size());
    std::size_t end = newline ? std::size_t(static_cast<const char*>(newline) - text.data()) : text.size();
    std::size_t next = std::min(end + 1, text.size());
    if (const void* early = std::memchr(text.data(), '\r', end)) {
      const std::size_t at = std::size_t(static_cast<const char*>(early) - text.data());
      if (at + 1 != end) next = at + 1;
      end = at;
    }
    std::string_view line = text.substr(0, end);
    text.remove_prefix(next);
    while (!line.empty() && is_blank(line.front())) line.remove_prefix(1);
    if (!visit(line)) return;
  }
}

std::string_view next_word(std::string_view& line) {
  while (!line.empty() && is_blank(line.front())) line.remove_prefix(1);
  std::size_t length = 0;
  while (length < line.size() && !is_blank(line[length])) ++length;
  const std::string_view word = line.substr(0, length);
  line.remove_prefix(length);
  return !word.empty() && word[0] == '#' ? std::string_view() : word;
}

enum class Kind { position, uv, normal, face, other };

// What tinyobjloader takes the line for, and what follows its keyword.
Kind kind_of(std::string_view line, std::string_view& rest) {
  if (line.size() < 2 || (line[0] != 'v' && line[0] != 'f')) return Kind::other;
  if (is_blank(line[1])) {
    rest = line.substr(1);
    return line[0] == 'v' ? Kind::position : Kind::face;
  }
  if (line[0] == 'f' || line.size() < 3 || !is_blank(line[2])) return Kind::other;
  rest = line.substr(2);
  return line[1] == 'n' ? Kind::normal : line[1] == 't' ? Kind::uv : Kind::other;
}

// The three numbers of a position or normal.
struct Numbers {
  bool non_finite = false;
  std::string fault;
};

Numbers check_words(std::string_view values) {
  Numbers numbers;
  for (std::string_view word = next_word(values); !word.empty(); word = next_word(values)) {
    const std::string_view digits = word[0] == '+' ? word.substr(1) : word;
    double value = 0;
    const auto [end, code] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (code == std::errc::invalid_argument || end != digits.data() + digits.size())
      numbers.fault = fmt::format("'{}' is not a number", word.substr(0, 40));
    numbers.non_finite |= !(value - value == 0) || code == std::errc::result_out_of_range;
  }
  return numbers;
}

Numbers check_numbers(std::string_view values) {
  bool letters = false, in_word = false;
  unsigned words = 0;
  for (char c : values) {
    if (c == '#') break;
    letters |= (c >= 'A' && c != 'e' && c != 'E');
    words += !in_word && !is_blank(c);
    in_word = !is_blank(c);
  }
  if (words < 3) return {.fault = fmt::format("{} numbers, expected 3", words)};
  return letters ? check_words(values) : Numbers{};
}

// Whether a face's corners are up to three integers each, none of them 0 or beyond 32 bits, with slashes
// between them, the second of three possibly left out. tinyobjloader takes what it cannot read for a 0, that
// for an index left out, and behind a last slash the next corner's.
bool corners_readable(std::string_view face) {
  unsigned slashes = 0, digits = 0;
  bool in_word = false, sign = false, zero = true;
  const auto integer_ends = [&](bool may_be_none) {
    const bool good = digits ? !zero && digits < 10 : may_be_none && !sign;
    digits = 0, sign = false, zero = true;
    return good;
  };
  for (char c : face) {
    if (c == '#' && !in_word) break;
    if (c >= '0' && c <= '9') {
      ++digits;
      zero = zero && c == '0';
      in_word = true;
    } else if (is_blank(c)) {
      if (in_word && !integer_ends(false)) return false;
      in_word = false;
      slashes = 0;
    } else if (c == '/') {
      if (!in_word || ++slashes > 2 || !integer_ends(slashes > 1)) return false;
    } else if ((c == '-' || c == '+') && digits == 0 && !sign) {
      sign = in_word = true;
    } else {
      return false;
    }
  }
  return !in_word || integer_ends(false);
}

// One "7/2/7" of a face; what is wrong with it, or "".
std::string corner_fault(std::string_view word, const ObjCounts& so_far, const ObjCounts& all) {
  const std::size_t above[3] = {so_far.positions, so_far.uvs, so_far.normals};
  const std::size_t limits[3] = {all.positions, all.uvs, all.normals};
  static constexpr const char* kinds[3] = {"positions", "texture coordinates", "normals"};
  if (word.ends_with('/')) return fmt::format("a face's corner '{}' ends in a slash", word.substr(0, 40));
  if (std::count(word.begin(), word.end(), '/') > 2)
    return fmt::format("a face's corner '{}' has more than three indices", word.substr(0, 40));
  for (int part = 0; part < 3; ++part) {
    const std::size_t slash = word.find('/');
    std::string_view digits = word.substr(0, slash);
    word = slash == std::string_view::npos ? std::string_view() : word.substr(slash + 1);
    if (digits.empty() && part > 0) continue;
    const std::string_view shown = digits.substr(0, 40);
    if (digits.starts_with('+')) digits.remove_prefix(1);
    std::int64_t index = 0;
    const auto [end, code] = std::from_chars(digits.data(), digits.data() + digits.size(), index);
    if (code == std::errc::invalid_argument || end != digits.data() + digits.size())
      return fmt::format("face index '{}' is not an integer", shown);
    const bool back = index < 0, beyond = code == std::errc::result_out_of_range;
    const std::size_t limit = back ? above[part] : limits[part];
    if (index == 0 || beyond || std::size_t(back ? -index : index) > limit)
      return fmt::format("face index {} is out of range ({} {}{})", shown, limit, kinds[part],
                         back ? " so far" : "");
  }
  return "";
}

std::string face_fault(std::string_view face, const ObjCounts& so_far, const ObjCounts& all) {
  for (std::string_view word = next_word(face); !word.empty(); word = next_word(face))
    if (const std::string fault = corner_fault(word, so_far, all); !fault.empty()) return fault;
  return "";
}

}  // namespace

ObjScan scan_obj(std::string_view piece) {
  ObjScan scan;
  ObjCounts& counts = scan.counts;
  for_each_line(piece, [&](std::string_view line) {
    std::string_view rest;
    const Kind kind = kind_of(line, rest);
    if (kind == Kind::face) {
      ++counts.faces;
      scan.readable = scan.readable && corners_readable(rest);
    } else if (kind == Kind::uv) {
      ++counts.uvs;
    } else if (kind != Kind::other) {
      const Numbers numbers = check_numbers(rest);
      scan.readable = scan.readable && numbers.fault.empty();
      const bool normal = kind == Kind::normal;
      if (numbers.non_finite)
        (normal ? scan.non_finite_normals : scan.non_finite_positions)
            .push_back(std::uint32_t(normal ? counts.normals : counts.positions));
      ++(normal ? counts.normals : counts.positions);
    }
    return true;
  });
  return scan;
}

std::vector<std::string_view> obj_pieces(std::string_view text, std::size_t bytes) {
  std::vector<std::string_view> pieces;
  while (!text.empty()) {
    const std::size_t end = text.size() > bytes ? text.find('\n', bytes) : std::string_view::npos;
    pieces.push_back(text.substr(0, end == std::string_view::npos ? end : end + 1));
    text.remove_prefix(pieces.back().size());
  }
  return pieces;
}

std::string first_obj_fault(std::string_view text, const std::string& name) {
  const ObjCounts all = scan_obj(text).counts;
  ObjCounts so_far;
  std::size_t number = 0;
  std::string fault;
  for_each_line(text, [&](std::string_view line) {
    ++number;
    std::string_view rest;
    const Kind kind = kind_of(line, rest);
    if (kind == Kind::face) fault = face_fault(rest, so_far, all);
    if (kind == Kind::position || kind == Kind::normal) fault = check_numbers(rest).fault;
    so_far.positions += kind == Kind::position;
    so_far.normals += kind == Kind::normal;
    so_far.uvs += kind == Kind::uv;
    return fault.empty();
  });
  return fault.empty() ? "" : fmt::format("{}:{}: {}", name, number, fault);
}

}  // namespace nook
