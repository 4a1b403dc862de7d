#pragma once

#include <cstddef>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/words.hpp"

namespace nook {

/// How many lines there are, in all and of each kind: `v`, `vt`, `vn`, `f`.
struct ObjCounts {
  std::size_t lines = 0, positions = 0, uvs = 0, normals = 0, faces = 0;
};

/// What a line is, by its first word.
enum class ObjKeyword { position, uv, normal, face, group, object, material, library, other };

/// `statement` begins with its keyword; `rest` is what follows that.
ObjKeyword obj_keyword(std::string_view statement, std::string_view& rest);

/// Whether the statement goes on in the next line: it ends in a backslash that is in no comment. Blanks may
/// stand behind it if one stands before it.
bool goes_on(std::string_view line);

/// Calls visit(statement, line) for each line that is not blank: leading blanks removed, what "\" continues
/// joined (by a blank). Lines are numbered from 1; one ends with "\n", "\r\n" or "\r". Stops when visit
/// answers false. Returns the number of lines.
template <class Visit>
std::size_t for_each_statement(std::string_view text, const Visit& visit) {
  const char *at = text.data(), *end = at + text.size(), *newline = at;
  const auto find = [&](const char* from, const char* to, char c) {
    const void* found = std::memchr(from, c, std::size_t(to - from));
    return found ? static_cast<const char*>(found) : to;
  };
  std::size_t line = 0;
  const auto next_line = [&] {
    if (newline <= at) newline = *at == '\n' ? at : find(at, end, '\n');
    const char* stop = find(at, newline, '\r');
    const char* next = stop == newline || stop + 1 == newline ? newline : stop;
    const std::string_view found(at, std::size_t(stop - at));
    at = next == end ? end : next + 1;
    ++line;
    return found;
  };
  std::string joined;
  while (at != end) {
    std::string_view statement = next_line();
    const std::size_t first = line;
    while (!statement.empty() && is_blank(statement.front())) statement.remove_prefix(1);
    const char last = statement.empty() ? '\0' : statement.back();
    if ((last == '\\' || is_blank(last)) && goes_on(statement)) {
      joined = statement;
      for (std::string_view part = statement; goes_on(part); joined += part) {
        joined.erase(joined.rfind('\\'));
        joined += ' ';
        part = at == end ? std::string_view() : next_line();
      }
      statement = joined;
    }
    if (!statement.empty() && !visit(statement, first)) break;
  }
  return line;
}

ObjCounts count_obj(std::string_view piece);

/// The text in pieces of some `bytes` that end with a "\n" (or the text) that ends a statement, in order.
std::vector<std::string_view> obj_pieces(std::string_view text, std::size_t bytes);

}  // namespace nook
