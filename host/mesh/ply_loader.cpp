#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <sstream>

#include "base/error.hpp"
#include "base/input_file.hpp"
#include "mesh/corner_order.hpp"
#include "mesh/ply.hpp"

namespace nook {
namespace {

// PLY's types under both of their names; the index is the type's number below.
constexpr std::array<std::array<std::string_view, 2>, 8> type_names = {{{"char", "int8"},
                                                                        {"uchar", "uint8"},
                                                                        {"short", "int16"},
                                                                        {"ushort", "uint16"},
                                                                        {"int", "int32"},
                                                                        {"uint", "uint32"},
                                                                        {"float", "float32"},
                                                                        {"double", "float64"}}};
constexpr std::size_t type_bytes[] = {1, 1, 2, 2, 4, 4, 4, 8};

struct Property {
  std::string name;
  int type = 0;
  int count_type = -1;  // of a list; -1: a single value
};

struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;
};

class PlyFile {
 public:
  explicit PlyFile(const std::filesystem::path& path) : name_(path.string()) {
    size_of_input(path);
    std::ifstream in(path, std::ios::binary);
    text_.assign(std::istreambuf_iterator<char>(in), {});
    if (!in && text_.empty()) throw Error(ExitCode::scene, name_ + ": cannot be read");
    read_header();
  }

  const std::vector<Element>& elements() const { return elements_; }
  std::size_t bytes_left() const { return text_.size() - at_; }
  bool binary() const { return binary_; }

  [[noreturn]] void fail(const std::string& what) const {
    throw Error(ExitCode::scene, line_ ? fmt::format("{}:{}: {}", name_, line_, what)
                                       : fmt::format("{}: byte {}: {}", name_, at_, what));
  }

  double value(int type) { return binary_ ? binary_value(type) : word_value(); }

 private:
  std::string line() {
    const std::size_t end = text_.find('\n', at_);
    if (end == std::string::npos) fail("the header has no end_header");
    std::string found = text_.substr(at_, end - at_);
    at_ = end + 1;
    ++line_;
    if (!found.empty() && found.back() == '\r') found.pop_back();
    return found;
  }

  int type_of(const std::string& word) {
    for (std::size_t t = 0; t < type_names.size(); ++t)
      if (word == type_names[t][0] || word == type_names[t][1]) return int(t);
    fail(fmt::format("unknown type '{}'", word.substr(0, 40)));
  }

  void read_header() {
    if (line() != "ply") fail("not a PLY file");
    for (std::string text = line(); text != "end_header"; text = line()) {
      std::istringstream words(text);
      std::string word;
      words >> word;
      if (word == "format") {
        words >> word;
        if (word != "ascii" && word != "binary_little_endian")
          fail(
              fmt::format("format '{}' is not supported: ascii or binary_little_endian", word.substr(0, 40)));
        binary_ = word != "ascii";
        known_format_ = true;
      } else if (word == "element") {
        Element& element = elements_.emplace_back();
        std::string count;
        words >> element.name >> count;
        const auto [end, code] = std::from_chars(count.data(), count.data() + count.size(), element.count);
        if (code != std::errc() || end != count.data() + count.size() || element.count > 0xfffffff0u)
          fail("an element needs a name and a count");
      } else if (word == "property") {
        if (elements_.empty()) fail("a property before any element");
        Property property;
        words >> word;
        if (word == "list") {
          words >> word;
          property.count_type = type_of(word);
          words >> word;
        }
        property.type = type_of(word);
        words >> property.name;
        elements_.back().properties.push_back(property);
      } else if (word != "comment" && word != "obj_info" && !word.empty()) {
        fail(fmt::format("unknown header line '{}'", text.substr(0, 40)));
      }
    }
    if (!known_format_) fail("the header has no format");
    if (binary_) line_ = 0;
  }

  double binary_value(int type) {
    const std::size_t bytes = type_bytes[type];
    if (bytes > bytes_left()) fail("the file ends too early");
    const char* from = text_.data() + at_;
    at_ += bytes;
    const auto as = [&](auto number) {
      std::memcpy(&number, from, sizeof number);
      return double(number);
    };
    switch (type) {
      case 0:
        return as(std::int8_t());
      case 1:
        return as(std::uint8_t());
      case 2:
        return as(std::int16_t());
      case 3:
        return as(std::uint16_t());
      case 4:
        return as(std::int32_t());
      case 5:
        return as(std::uint32_t());
      case 6:
        return as(float());
      default:
        return as(double());
    }
  }

  double word_value() {
    const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; };
    if (line_start_) {
      ++line_;
      line_start_ = false;
    }
    while (at_ < text_.size() && blank(text_[at_])) line_ += text_[at_++] == '\n';
    std::size_t end = at_;
    while (end < text_.size() && !blank(text_[end])) ++end;
    if (end == at_) fail("the file ends too early");
    double number = 0;
    const auto [stop, code] = std::from_chars(text_.data() + at_, text_.data() + end, number);
    if (code != std::errc() || stop != text_.data() + end)
      fail(fmt::format("'{}' is not a number", text_.substr(at_, std::min<std::size_t>(end - at_, 40))));
    at_ = end;
    return number;
  }

  std::string name_, text_;
  std::size_t at_ = 0, line_ = 0;
  bool binary_ = false, known_format_ = false, line_start_ = true;
  std::vector<Element> elements_;
};

void read_vertices(PlyFile& file, const Element& element, TriangleMesh& mesh, std::vector<vec3>& normals) {
  static constexpr std::string_view names[] = {"x", "y", "z", "nx", "ny", "nz"};
  std::array<int, 6> place;
  place.fill(-1);
  for (std::size_t p = 0; p < element.properties.size(); ++p)
    for (std::size_t n = 0; n < 6; ++n)
      if (element.properties[p].name == names[n] && element.properties[p].count_type < 0) place[n] = int(p);
  if (place[0] < 0 || place[1] < 0 || place[2] < 0) file.fail("vertices need the properties x, y and z");
  const bool with_normals = place[3] >= 0 && place[4] >= 0 && place[5] >= 0;
  // No count is believed that the file cannot hold: a value takes a byte at least, in text two.
  if (element.count > file.bytes_left() / (file.binary() ? 1 : 2))
    file.fail(fmt::format("{} vertices are more than the file holds", element.count));
  std::vector<double> row(element.properties.size());
  for (std::uint64_t i = 0; i < element.count; ++i) {
    for (std::size_t p = 0; p < row.size(); ++p) {
      const Property& property = element.properties[p];
      row[p] = file.value(property.count_type < 0 ? property.type : property.count_type);
      if (property.count_type >= 0)
        for (double rest = row[p]; rest >= 1; --rest) file.value(property.type);
    }
    const auto triple = [&](std::size_t n) {
      return vec3(float(row[std::size_t(place[n])]), float(row[std::size_t(place[n + 1])]),
                  float(row[std::size_t(place[n + 2])]));
    };
    mesh.positions.push_back(triple(0));
    if (with_normals) normals.push_back(triple(3));
  }
}

// Polygons of three corners and more, as fans; corners are checked once all vertices are known.
void read_faces(PlyFile& file, const Element& element, std::vector<std::array<std::uint32_t, 3>>& triangles) {
  const auto is_indices = [](const Property& p) {
    return p.count_type >= 0 && (p.name == "vertex_indices" || p.name == "vertex_index");
  };
  for (std::uint64_t i = 0; i < element.count && !element.properties.empty(); ++i) {
    std::vector<std::uint32_t> corners;
    for (const Property& property : element.properties) {
      const double count = property.count_type < 0 ? 1 : file.value(property.count_type);
      if (!(count >= 0 && count <= double(file.bytes_left())))
        file.fail(fmt::format("a list of {} values is more than the file holds", count));
      for (double k = 0; k < count; ++k) {
        const double value = file.value(property.type);
        if (!is_indices(property)) continue;
        if (!(value >= 0 && value < 4294967295.0))
          file.fail(fmt::format("vertex index {} is out of range", value));
        corners.push_back(std::uint32_t(value));
      }
    }
    for (std::size_t k = 2; k < corners.size(); ++k)
      triangles.push_back({corners[0], corners[k - 1], corners[k]});
  }
}

void skip(PlyFile& file, const Element& element) {
  for (std::uint64_t i = 0; i < element.count && !element.properties.empty(); ++i)
    for (const Property& property : element.properties) {
      double count = property.count_type < 0 ? 1 : file.value(property.count_type);
      for (; count >= 1; --count) file.value(property.type);
    }
}

void add_triangle(const PlyFile& file, const std::array<std::uint32_t, 3>& triangle,
                  const std::vector<vec3>& normals, TriangleMesh& mesh) {
  ++mesh.report.triangles_read;
  std::array<std::uint32_t, 3> corner_normals{};
  for (std::size_t k = 0; k < 3; ++k) {
    if (triangle[k] >= mesh.positions.size())
      file.fail(
          fmt::format("vertex index {} is out of range ({} vertices)", triangle[k], mesh.positions.size()));
    if (!finite(mesh.positions[triangle[k]])) {
      ++mesh.report.non_finite_dropped;
      return;
    }
    const bool usable = !normals.empty() && mesh.normals[triangle[k]] != vec3(0);
    corner_normals[k] = usable ? triangle[k] : TriangleMesh::no_normal;
    if (!normals.empty() && !usable) ++mesh.report.normals_replaced;
  }
  mesh.triangles.push_back(triangle);
  if (!normals.empty()) mesh.triangle_normals.push_back(corner_normals);
  for (const std::uint32_t index : triangle) mesh.bounds.add(mesh.positions[index]);
}

}  // namespace

TriangleMesh load_ply(const std::filesystem::path& path, const MeshAttributes& attributes) {
  PlyFile file(path);
  TriangleMesh mesh;
  std::vector<vec3> normals;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (const Element& element : file.elements()) {
    if (element.name == "vertex")
      read_vertices(file, element, mesh, normals);
    else if (element.name == "face")
      read_faces(file, element, triangles);
    else
      skip(file, element);
  }
  if (!attributes.normals) normals.clear();
  for (const vec3& n : normals) {
    const double length = glm::length(dvec3(n));
    const bool usable = std::isfinite(length) && length > 1e-30;
    if (usable && std::abs(length - 1) > 1e-3) ++mesh.report.normals_normalised;
    mesh.normals.push_back(usable ? vec3(dvec3(n) / length) : vec3(0));
  }
  for (const auto& triangle : triangles) add_triangle(file, triangle, normals, mesh);
  if (mesh.report.normals_replaced == 3 * mesh.triangles.size()) {
    mesh.normals.clear();
    mesh.triangle_normals.clear();
    mesh.report.normals_replaced = 0;
  }
  if (mesh.triangles.empty()) throw Error(ExitCode::scene, path.string() + ": the mesh has no triangles");
  if (attributes.groups) {
    mesh.groups = {path.stem().string()};
    mesh.triangle_group.assign(mesh.triangles.size(), 0);
  }
  end_with_longest_edges(mesh);
  return mesh;
}

TriangleMesh load_mesh(const std::filesystem::path& path, const MeshAttributes& attributes) {
  const std::string extension = path.extension().string();
  return extension == ".ply" || extension == ".PLY" ? load_ply(path, attributes) : load_obj(path, attributes);
}

}  // namespace nook
