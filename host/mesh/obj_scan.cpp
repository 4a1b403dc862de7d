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

// Calls visit(line) for each line, leading blanks removed, until one is answered with false. A line ends with
// "\n", "\r\n" or "\r", as tinyobjloader has it.
template <class Visit>
void for_each_line(std::string_view text, Visit visit) {
  const char *at = text.data(), *end = at + text.size(), *newline = at;
  const auto find = [&](const char* from, const char* to, char c) {
    const void* found = std::memchr(from, c, std::size_t(to - from));
    return found ? static_cast<const char*>(found) : to;
  };
  if (at != end) newline = find(at, end, '\n');
  while (at != end) {
    if (newline < at) newline = find(at, end, '\n');
    const char* stop = find(at, newline, '\r');
    const char* next = stop == newline || stop + 1 == newline ? newline : stop;
    const char* begin = at;
    at = next == end ? end : next + 1;
    while (begin != stop && is_blank(*begin)) ++begin;
    if (!visit(std::string_view(begin, std::size_t(stop - begin)))) return;
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

constexpr std::string_view library_keyword = "mtllib";

enum class Kind { position, uv, normal, face, library, other };

// What tinyobjloader takes the line for, and what follows its keyword.
Kind kind_of(std::string_view line, std::string_view& rest) {
  if (line.starts_with(library_keyword) && line.size() > library_keyword.size() &&
      is_blank(line[library_keyword.size()])) {
    rest = line.substr(library_keyword.size());
    return Kind::library;
  }
  if (line.size() < 2 || (line[0] != 'v' && line[0] != 'f')) return Kind::other;
  if (is_blank(line[1])) {
    rest = line.substr(1);
    return line[0] == 'v' ? Kind::position : Kind::face;
  }
  if (line[0] == 'f' || line.size() < 3 || !is_blank(line[2])) return Kind::other;
  rest = line.substr(2);
  return line[1] == 'n' ? Kind::normal : line[1] == 't' ? Kind::uv : Kind::other;
}

// The grammar of a number that tinyobjloader reads as it stands: [+-] (digits [. [digits]] | . digits)
// [(e|E) [+-] digits]. `odd` is anything else: nan, inf, or no number.
enum State : std::uint8_t { blank, sign, whole, first_dot, fraction, e, e_sign, exponent, odd };

State after(State state, char c) {
  if (c >= '0' && c <= '9') {
    if (state <= whole) return whole;
    if (state == first_dot || state == fraction) return fraction;
    return state == odd ? odd : exponent;
  }
  if (c == '+' || c == '-') return state == blank ? sign : state == e ? e_sign : odd;
  if (c == '.') return state == whole ? fraction : state <= sign ? first_dot : odd;
  if (c == 'e' || c == 'E') return state == whole || state == fraction ? e : odd;
  return odd;
}

bool is_number(State state) {
  return state == whole || state == fraction || state == exponent;
}

// What a position's or normal's line holds.
struct Verdict {
  unsigned words = 0;
  bool all_numbers = true;  // by the grammar above
  bool non_finite = false;
  std::string_view wrong;  // the first word that is no number, nan or inf
};

Verdict judge_numbers(std::string_view values) {
  Verdict verdict;
  State state = blank;
  for (const char c : values) {
    if (is_blank(c)) {
      verdict.all_numbers &= state == blank || is_number(state);
      state = blank;
    } else {
      if (state == blank && c == '#') break;
      verdict.words += state == blank;
      state = after(state, c);
    }
  }
  verdict.all_numbers &= state == blank || is_number(state);
  if (verdict.all_numbers) return verdict;
  for (std::string_view word = next_word(values); !word.empty(); word = next_word(values)) {
    const std::string_view digits = word[0] == '+' ? word.substr(1) : word;
    double value = 0;
    const auto [end, code] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (code == std::errc::invalid_argument || end != digits.data() + digits.size()) {
      verdict.wrong = word;
      return verdict;
    }
    verdict.non_finite |= !(value - value == 0) || code == std::errc::result_out_of_range;
  }
  return verdict;
}

bool readable(const Verdict& verdict) {
  return verdict.words >= 3 && verdict.wrong.empty();
}

std::string fault_of(const Verdict& verdict) {
  if (readable(verdict)) return "";
  if (verdict.words < 3) return fmt::format("{} numbers, expected 3", verdict.words);
  return fmt::format("'{}' is not a number", verdict.wrong.substr(0, 40));
}

// Whether a face's corners are up to three integers each, none of them 0 or beyond 32 bits, with slashes
// between them, the second of three possibly left out. tinyobjloader takes what it cannot read for a 0, that
// for an index left out, and behind a last slash the next corner's.
bool corners_readable(std::string_view face) {
  unsigned slashes = 0, significant = 0;
  bool in_word = false, sign = false, digits = false;
  const auto index_ends = [&](bool may_be_none) {
    const bool good = digits ? significant > 0 && significant < 10 : may_be_none && !sign;
    significant = 0;
    digits = sign = false;
    return good;
  };
  for (const char c : face) {
    if (c == '#' && !in_word) break;
    if (c >= '0' && c <= '9') {
      significant += c != '0' || significant > 0;
      digits = in_word = true;
    } else if (is_blank(c)) {
      if (in_word && !index_ends(false)) return false;
      in_word = false;
      slashes = 0;
    } else if (c == '/') {
      if (!in_word || ++slashes > 2 || !index_ends(slashes > 1)) return false;
    } else if ((c == '-' || c == '+') && !digits && !sign) {
      sign = in_word = true;
    } else {
      return false;
    }
  }
  return !in_word || index_ends(false);
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
    if (digits.starts_with('+') && !digits.starts_with("+-")) digits.remove_prefix(1);
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
  const std::string_view whole_face = face;
  for (std::string_view word = next_word(face); !word.empty(); word = next_word(face))
    if (std::string fault = corner_fault(word, so_far, all); !fault.empty()) return fault;
  return corners_readable(whole_face) ? "" : "a face cannot be read";
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
    } else if (kind == Kind::library) {
      scan.libraries.emplace_back(rest);
    } else if (kind != Kind::other) {
      const Verdict verdict = judge_numbers(rest);
      scan.readable = scan.readable && readable(verdict);
      const bool normal = kind == Kind::normal;
      if (verdict.non_finite)
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
    if (kind == Kind::position || kind == Kind::normal) fault = fault_of(judge_numbers(rest));
    so_far.positions += kind == Kind::position;
    so_far.normals += kind == Kind::normal;
    so_far.uvs += kind == Kind::uv;
    return fault.empty();
  });
  return fault.empty() ? "" : fmt::format("{}:{}: {}", name, number, fault);
}

}  // namespace nook
