#include "mesh/obj_scan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstring>

#include "base/error.hpp"

namespace nook {
namespace {

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r';
}

// Calls visit(line, number) for each line, leading blanks removed.
template <class Visit>
void for_each_line(std::string_view text, Visit visit) {
  std::size_t number = 0;
  while (!text.empty()) {
    const void* end = std::memchr(text.data(), '\n', text.size());
    const std::size_t length = end ? std::size_t(static_cast<const char*>(end) - text.data()) : text.size();
    std::string_view line = text.substr(0, length);
    text.remove_prefix(end ? length + 1 : length);
    ++number;
    while (!line.empty() && is_blank(line.front())) line.remove_prefix(1);
    visit(line, number);
  }
}

std::string_view next_word(std::string_view& line) {
  while (!line.empty() && is_blank(line.front())) line.remove_prefix(1);
  std::size_t length = 0;
  while (length < line.size() && !is_blank(line[length])) ++length;
  const std::string_view word = line.substr(0, length);
  line.remove_prefix(length);
  return word;
}

// True if a word of the line is nan or inf; throws if one is no number at all.
bool has_non_finite(std::string_view values, const std::string& name, std::size_t number) {
  bool letters = false, in_word = false;
  unsigned numbers = 0;
  for (char c : values) {
    if (c == '#') break;
    letters |= (c >= 'A' && c != 'e' && c != 'E');
    numbers += !in_word && !is_blank(c);
    in_word = !is_blank(c);
  }
  if (numbers < 3)
    throw Error(ExitCode::scene, fmt::format("{}:{}: {} numbers, expected 3", name, number, numbers));
  if (!letters) return false;
  bool non_finite = false;
  for (std::string_view word = next_word(values); !word.empty() && word[0] != '#'; word = next_word(values)) {
    const std::string_view digits = word[0] == '+' ? word.substr(1) : word;
    double value = 0;
    const auto [end, code] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (code == std::errc::invalid_argument || end != digits.data() + digits.size())
      throw Error(ExitCode::scene,
                  fmt::format("{}:{}: '{}' is not a number", name, number, word.substr(0, 40)));
    non_finite |= !(value - value == 0) || code == std::errc::result_out_of_range;
  }
  return non_finite;
}

struct Counts {
  std::int64_t positions = 0, uvs = 0, normals = 0;
};

// One "7/2/7" of a face; what is wrong with it, or "".
std::string check_corner(std::string_view word, const Counts& counts) {
  const std::int64_t limits[3] = {counts.positions, counts.uvs, counts.normals};
  static constexpr const char* kinds[3] = {"positions", "texture coordinates", "normals"};
  for (int part = 0; part < 3 && !word.empty(); ++part) {
    const std::size_t slash = word.find('/');
    const std::string_view digits = word.substr(0, slash);
    word = slash == std::string_view::npos ? std::string_view() : word.substr(slash + 1);
    if (digits.empty()) continue;
    std::int64_t index = 0;
    const auto [end, code] = std::from_chars(digits.data(), digits.data() + digits.size(), index);
    if (code != std::errc() || end != digits.data() + digits.size())
      return fmt::format("face index '{}' is not an integer", digits.substr(0, 40));
    if (index == 0 || index > limits[part] || -index > limits[part])
      return fmt::format("face index {} is out of range ({} {} so far)", index, limits[part], kinds[part]);
  }
  return "";
}

// tinyobjloader reads an index beyond 32 bits as another.
void check_digits(std::string_view face, const std::string& name, std::size_t number) {
  std::size_t digits = 0;
  for (std::size_t i = 0; i < face.size() && face[i] != '#'; ++i) {
    digits = face[i] >= '0' && face[i] <= '9' ? digits + 1 : 0;
    if (digits < 10) continue;
    const std::string_view rest = face.substr(i + 1 - digits);
    const std::size_t end = std::min<std::size_t>(rest.find_first_not_of("0123456789"), 40);
    throw Error(ExitCode::scene,
                fmt::format("{}:{}: face index {} is out of range", name, number, rest.substr(0, end)));
  }
}

}  // namespace

ObjScan scan_obj(std::string_view text, const std::string& name) {
  ObjScan scan;
  std::uint32_t positions = 0, normals = 0;
  for_each_line(text, [&](std::string_view line, std::size_t number) {
    if (line.size() > 1 && line[0] == 'f' && is_blank(line[1])) check_digits(line.substr(1), name, number);
    if (line.size() < 2 || line[0] != 'v') return;
    if (is_blank(line[1])) {
      if (has_non_finite(line.substr(1), name, number)) scan.non_finite_positions.push_back(positions);
      ++positions;
    } else if (line[1] == 'n' && line.size() > 2 && is_blank(line[2])) {
      if (has_non_finite(line.substr(2), name, number)) scan.non_finite_normals.push_back(normals);
      ++normals;
    }
  });
  return scan;
}

std::string find_bad_face(std::string_view text, const std::string& name) {
  Counts counts;
  std::string found;
  for_each_line(text, [&](std::string_view line, std::size_t number) {
    if (!found.empty() || line.size() < 2) return;
    if (line[0] == 'v') {
      counts.positions += is_blank(line[1]);
      counts.uvs += line[1] == 't';
      counts.normals += line[1] == 'n';
    } else if (line[0] == 'f' && is_blank(line[1])) {
      line.remove_prefix(1);
      for (std::string_view word = next_word(line); !word.empty() && found.empty() && word[0] != '#';
           word = next_word(line))
        if (const std::string wrong = check_corner(word, counts); !wrong.empty())
          found = fmt::format("{}:{}: {}", name, number, wrong);
    }
  });
  return found;
}

}  // namespace nook
