#include "mesh/obj_piece.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "mesh/words.hpp"

namespace nook {
namespace {

// Reads `count` numbers; "" or what is wrong. More may follow: weights, colors.
std::string read_numbers(std::string_view text, double* values, int count, int fewest) {
  for (int i = 0; i < count; ++i) {
    const std::string_view word = next_word(text);
    if (word.empty()) {
      if (i >= fewest) return "";
      return fmt::format("{} numbers, expected {}", i, fewest);
    }
    if (!read_number(word, values[i])) return fmt::format("'{}' is not a number", word.substr(0, 40));
  }
  return "";
}

// The 0-based index that `digits` stand for: 1-based or, if negative, back from the last one above. "" or
// what is wrong.
std::string read_index(std::string_view digits, std::size_t above, std::size_t all, const char* kind,
                       std::uint32_t& index) {
  const std::string_view shown = digits.substr(0, 40);
  if (digits.starts_with('+') && !digits.starts_with("+-")) digits.remove_prefix(1);
  std::int64_t value = 0;
  const auto [end, code] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (code == std::errc::invalid_argument || end != digits.data() + digits.size())
    return fmt::format("face index '{}' is not an integer", shown);
  const bool back = value < 0, beyond = code == std::errc::result_out_of_range;
  const std::size_t limit = back ? above : all;
  if (value == 0 || beyond || std::size_t(back ? -value : value) > limit)
    return fmt::format("face index {} is out of range ({} {}{})", shown, limit, kind, back ? " so far" : "");
  index = std::uint32_t(back ? above - std::size_t(-value) : std::size_t(value) - 1);
  return "";
}

class Reader {
 public:
  Reader(ObjPiece& piece, const ObjCounts& all, const MeshAttributes& want, PolygonMesh& mesh)
      : piece_(piece), all_(all), want_(want), mesh_(mesh), so_far_(piece.before) {}

  // "" or what is wrong with the statement.
  std::string read(std::string_view statement, std::size_t line) {
    std::string_view rest;
    double v[3] = {};
    std::string fault;
    switch (obj_keyword(statement, rest)) {
      case ObjKeyword::position:
        fault = read_numbers(rest, v, 3, 3);
        mesh_.positions[so_far_.positions++] = dvec3(v[0], v[1], v[2]);
        return fault;
      case ObjKeyword::normal:
        return normal(rest);
      case ObjKeyword::uv:
        return uv(rest, line);
      case ObjKeyword::face:
        return face(rest, line);
      case ObjKeyword::group:
        change(ObjPiece::Change::Kind::group, rest, line);
        return "";
      case ObjKeyword::object:
        change(ObjPiece::Change::Kind::object, rest, line);
        return "";
      case ObjKeyword::material:
        change(ObjPiece::Change::Kind::material, rest, line);
        return "";
      case ObjKeyword::library:
        change(ObjPiece::Change::Kind::library, rest, line);
        return "";
      case ObjKeyword::other:
        return "";
    }
    return "";
  }

 private:
  void change(ObjPiece::Change::Kind kind, std::string_view rest, std::size_t line) {
    piece_.changes.push_back(
        {kind, piece_.block.face_sizes.size(), piece_.before.lines + line, std::string(trimmed(rest))});
  }

  // Normals and texture coordinates that nothing reads stop nothing.
  std::string normal(std::string_view rest) {
    const std::size_t index = so_far_.normals++;
    if (!want_.normals) return "";
    double v[3] = {};
    const std::string fault = read_numbers(rest, v, 3, 3);
    mesh_.normals[index] = vec3(v[0], v[1], v[2]);
    return fault;
  }

  std::string uv(std::string_view rest, std::size_t line) {
    const std::size_t index = so_far_.uvs++;
    if (!want_.uvs) return "";
    double v[2] = {};
    if (!read_numbers(rest, v, 2, 1).empty()) v[0] = std::nan("");
    mesh_.uvs[index] = vec2(v[0], v[1]);
    if (!std::isfinite(mesh_.uvs[index].x) || !std::isfinite(mesh_.uvs[index].y))
      if (piece_.odd_uvs++ == 0) piece_.odd_uv_line = piece_.before.lines + line;
    return "";
  }

  // "7", "7/2", "7/2/7", "7//7"; and "7/", "7//", "7/2/", "7/0/0", as some programs write what is left out.
  std::string corner(std::string_view word) {
    std::uint32_t index[3] = {FaceBlock::none, FaceBlock::none, FaceBlock::none};
    const std::size_t above[3] = {so_far_.positions, so_far_.uvs, so_far_.normals};
    const std::size_t limits[3] = {all_.positions, all_.uvs, all_.normals};
    static constexpr const char* kinds[3] = {"positions", "texture coordinates", "normals"};
    std::string_view left = word;
    if (std::count(word.begin(), word.end(), '/') > 2)
      return fmt::format("a face's corner '{}' has more than three indices", word.substr(0, 40));
    for (std::size_t part = 0;; ++part) {
      const std::size_t slash = std::min(left.find('/'), left.size());
      const std::string_view digits = left.substr(0, slash);
      if (part == 0 || (!digits.empty() && digits != "0"))
        if (std::string fault = read_index(digits, above[part], limits[part], kinds[part], index[part]);
            !fault.empty())
          return fault;
      if (slash == left.size()) break;
      left.remove_prefix(slash + 1);
    }
    FaceBlock& block = piece_.block;
    block.positions.push_back(index[0]);
    if (want_.uvs) block.uvs.push_back(index[1]);
    if (want_.normals) block.normals.push_back(index[2]);
    return "";
  }

  std::string face(std::string_view rest, std::size_t line) {
    FaceBlock& block = piece_.block;
    const std::size_t first = block.positions.size();
    for (std::string_view word = next_word(rest); !word.empty(); word = next_word(rest))
      if (std::string fault = corner(word); !fault.empty()) return fault;
    const std::size_t size = block.positions.size() - first;
    if (size < 3) {
      block.positions.resize(first);
      if (want_.uvs) block.uvs.resize(first);
      if (want_.normals) block.normals.resize(first);
      return "";
    }
    block.face_sizes.push_back(std::uint32_t(size));
    if (size > 3) block.places.push_back(std::uint32_t(piece_.before.lines + line));
    return "";
  }

  ObjPiece& piece_;
  const ObjCounts& all_;
  const MeshAttributes& want_;
  PolygonMesh& mesh_;
  ObjCounts so_far_;  // in the whole text
};

}  // namespace

void read_obj_piece(ObjPiece& piece, const ObjCounts& all, const MeshAttributes& want, PolygonMesh& mesh) {
  FaceBlock& block = piece.block;
  block.positions.reserve(3 * piece.counts.faces);
  if (want.uvs) block.uvs.reserve(3 * piece.counts.faces);
  if (want.normals) block.normals.reserve(3 * piece.counts.faces);
  block.face_sizes.reserve(piece.counts.faces);
  Reader reader(piece, all, want, mesh);
  for_each_statement(piece.text, [&](std::string_view statement, std::size_t line) {
    const std::string fault = reader.read(statement, line);
    if (fault.empty()) return true;
    piece.fault = fault;
    piece.fault_line = piece.before.lines + line;
    return false;
  });
}

}  // namespace nook
