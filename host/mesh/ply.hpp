#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "mesh/triangle_mesh.hpp"

namespace nook {

/// A number for each position of a mesh: a property of PLY's vertices.
struct VertexProperty {
  std::string name;
  std::vector<float> values;
};

/// Reads a PLY file, ASCII or binary of either byte order: vertices x, y, z and, all three, nx, ny, nz;
/// texture coordinates (s t, u v, texture_u texture_v) of vertices, or of corners (a face's list texcoord);
/// faces as a list vertex_indices (or vertex_index), and strips of triangles (tristrips). Its one group has
/// the file's name. What else it holds is skipped. Throws Error(scene) with one line that says where.
TriangleMesh load_ply(const std::filesystem::path& path, const MeshAttributes& attributes = {});

/// Writes positions, `normals` (one each), `properties` and triangles as a binary little-endian PLY file
/// (temporary name and rename). Positions are in the file's coordinates again, as doubles where a float does
/// not hold one of them. Throws Error(output).
void write_ply(const std::filesystem::path& path, const TriangleMesh& mesh, std::span<const vec3> normals,
               std::span<const VertexProperty> properties);

}  // namespace nook
