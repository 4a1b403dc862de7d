#include "scene/toml_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <string_view>

#include "base/error.hpp"
#include "base/input_file.hpp"

namespace nook {
namespace {

// Where a comment or string that starts at `at` ends (one past its last character); `at` itself if none does.
std::size_t past_comment_or_string(std::string_view text, std::size_t at) {
  const auto end_of = [&](std::size_t found, std::size_t length) {
    return found == std::string_view::npos ? text.size() : found + length;
  };
  if (text[at] == '#') return end_of(text.find('\n', at), 0);
  if (text[at] != '"' && text[at] != '\'') return at;
  const char quote = text[at];
  const std::string three(3, quote);
  const bool many_lines = text.substr(at, 3) == three;
  for (std::size_t i = at + (many_lines ? 3 : 1); i < text.size(); ++i) {
    if (quote == '"' && text[i] == '\\')
      ++i;
    else if (many_lines ? text.substr(i, 3) == three : text[i] == quote)
      return i + (many_lines ? 3 : 1);
    else if (!many_lines && text[i] == '\n')
      return i;  // not closed: the parser says so
  }
  return text.size();
}

// The first character that is nested too deep; npos: none is. The dots of "a.b.c" nest as brackets do.
std::size_t too_deep(std::string_view text) {
  int open = 0, dots = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (const std::size_t end = past_comment_or_string(text, i); end > i) {
      i = end - 1;
      continue;
    }
    switch (text[i]) {
      case '[':
      case '{':
        ++open;
        dots = 0;
        break;
      case ']':
      case '}':
        open = std::max(0, open - 1);
        break;
      case '.':
        ++dots;
        break;
      case '=':
      case ',':
      case '\n':
        dots = 0;
        break;
      default:
        break;
    }
    if (open > deepest_nesting || dots >= deepest_nesting) return i;
  }
  return std::string_view::npos;
}

}  // namespace

void check_toml_text(const std::string& text, const std::filesystem::path& file) {
  if (text.size() > largest_scene_file)
    throw Error(ErrorKind::scene, Place{file.string()}, "too large for a scene file (over 16 MiB)");
  const std::size_t at = too_deep(text);
  if (at == std::string::npos) return;
  const auto row = 1 + std::count(text.begin(), text.begin() + std::ptrdiff_t(at), '\n');
  const std::size_t line = at == 0 ? std::string::npos : text.rfind('\n', at - 1);
  throw Error(ErrorKind::scene,
              Place{file.string(), std::uint64_t(row), line == std::string::npos ? at + 1 : at - line},
              fmt::format("nested deeper than {} arrays, tables or parts of a key", deepest_nesting));
}

std::string read_toml_text(const std::filesystem::path& path) {
  // One byte more than is allowed tells, and a file may grow while it is read.
  const std::uint64_t size = std::min(size_of_input(path), largest_scene_file) + 1;
  std::ifstream in(path, std::ios::binary);
  std::string text(size, '\0');
  in.read(text.data(), std::streamsize(size));
  if (!in.is_open() || in.bad()) throw Error(ErrorKind::scene, Place{path.string()}, "cannot be read");
  text.resize(std::size_t(in.gcount()));
  check_toml_text(text, path);
  return text;
}

}  // namespace nook
