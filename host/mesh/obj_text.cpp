#include "mesh/obj_text.hpp"

namespace nook {

ObjKeyword obj_keyword(std::string_view statement, std::string_view& rest) {
  std::size_t length = 0;
  while (length < statement.size() && !is_blank(statement[length])) ++length;
  rest = statement.substr(length);
  const std::string_view word = statement.substr(0, length);
  if (word.size() == 1) switch (word[0]) {
      case 'v':
        return ObjKeyword::position;
      case 'f':
        return ObjKeyword::face;
      case 'g':
        return ObjKeyword::group;
      case 'o':
        return ObjKeyword::object;
      default:
        return ObjKeyword::other;
    }
  if (word == "vt") return ObjKeyword::uv;
  if (word == "vn") return ObjKeyword::normal;
  if (word == "usemtl") return ObjKeyword::material;
  return word == "mtllib" ? ObjKeyword::library : ObjKeyword::other;
}

bool goes_on(std::string_view line) {
  const std::size_t size = line.size();
  while (!line.empty() && is_blank(line.back())) line.remove_suffix(1);
  if (line.empty() || line.back() != '\\') return false;
  if (line.size() < size && line.size() > 1 && !is_blank(line[line.size() - 2])) return false;
  for (std::size_t i = 0; i < line.size(); ++i)
    if (line[i] == '#' && (i == 0 || is_blank(line[i - 1]))) return false;
  return true;
}

ObjCounts count_obj(std::string_view piece) {
  ObjCounts counts;
  counts.lines = for_each_statement(piece, [&](std::string_view statement, std::size_t) {
    if (statement[0] != 'v' && statement[0] != 'f') return true;
    std::string_view rest;
    const ObjKeyword keyword = obj_keyword(statement, rest);
    counts.positions += keyword == ObjKeyword::position;
    counts.uvs += keyword == ObjKeyword::uv;
    counts.normals += keyword == ObjKeyword::normal;
    counts.faces += keyword == ObjKeyword::face;
    return true;
  });
  return counts;
}

std::vector<std::string_view> obj_pieces(std::string_view text, std::size_t bytes) {
  std::vector<std::string_view> pieces;
  const auto continues = [&](std::size_t newline) {
    if (newline > 0 && text[newline - 1] == '\r') --newline;
    while (newline > 0 && is_blank(text[newline - 1])) --newline;
    return newline > 0 && text[newline - 1] == '\\';
  };
  while (!text.empty()) {
    std::size_t end = text.size() > bytes ? text.find('\n', bytes) : std::string_view::npos;
    while (end != std::string_view::npos && continues(end)) end = text.find('\n', end + 1);
    pieces.push_back(text.substr(0, end == std::string_view::npos ? end : end + 1));
    text.remove_prefix(pieces.back().size());
  }
  return pieces;
}

}  // namespace nook
