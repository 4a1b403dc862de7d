#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "base/pending_file.hpp"
#include "mesh/ply.hpp"

namespace nook {
namespace {

// Everything that nook runs on is little-endian.
template <class T>
void append(std::string& out, const T& value) {
  char bytes[sizeof(T)];
  std::memcpy(bytes, &value, sizeof(T));
  out.append(bytes, sizeof(T));
}

// Whether a float holds every position of the file: not where the mesh lies in map coordinates.
bool floats_hold(const TriangleMesh& mesh) {
  return std::all_of(mesh.positions.begin(), mesh.positions.end(), [&](const vec3& position) {
    const dvec3 p = mesh.frame.to_file(dvec3(position));
    return dvec3(vec3(p)) == p || !(p == p);
  });
}

}  // namespace

void write_ply(const std::filesystem::path& path, const TriangleMesh& mesh, std::span<const vec3> normals,
               std::span<const VertexProperty> properties) {
  std::string out =
      fmt::format("ply\nformat binary_little_endian 1.0\nelement vertex {}\n", mesh.positions.size());
  const bool floats = floats_hold(mesh);
  for (const char* name : {"x", "y", "z"})
    out += fmt::format("property {} {}\n", floats ? "float" : "double", name);
  for (const char* name : {"nx", "ny", "nz"}) out += fmt::format("property float {}\n", name);
  for (const VertexProperty& property : properties) out += fmt::format("property float {}\n", property.name);
  out += fmt::format("element face {}\nproperty list uchar uint vertex_indices\nend_header\n",
                     mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const dvec3 position = mesh.frame.to_file(dvec3(mesh.positions[i]));
    if (floats)
      append(out, vec3(position));
    else
      append(out, position);
    append(out, normals[i]);
    for (const VertexProperty& property : properties) append(out, property.values[i]);
  }
  for (const auto& triangle : mesh.triangles) {
    append(out, std::uint8_t(3));
    append(out, triangle);
  }
  PendingFile file(path);
  file.write(out.data(), out.size());
  file.commit();
}

}  // namespace nook
