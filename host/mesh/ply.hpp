#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "mesh/obj_loader.hpp"
#include "mesh/triangle_mesh.hpp"

namespace nook {

/// A number for each position of a mesh: a property of PLY's vertices.
struct VertexProperty {
  std::string name;
  std::vector<float> values;
};

/// Reads a PLY file, ASCII or binary little-endian: vertices x, y, z and, all three, nx, ny, nz; faces as a
/// list vertex_indices (or vertex_index), polygons as fans. Its one group has the file's name. What else it
/// holds is skipped. Throws Error(scene) with one line that says where.
TriangleMesh load_ply(const std::filesystem::path& path, const MeshAttributes& attributes = {});

/// Writes positions, `normals` (one each), `properties` and triangles as a binary little-endian PLY file
/// (temporary name and rename). Throws Error(output).
void write_ply(const std::filesystem::path& path, const TriangleMesh& mesh, std::span<const vec3> normals,
               std::span<const VertexProperty> properties);

/// load_ply() for a name that ends in .ply, load_obj() otherwise.
TriangleMesh load_mesh(const std::filesystem::path& path, const MeshAttributes& attributes = {});

}  // namespace nook
