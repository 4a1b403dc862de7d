#pragma once

#include <filesystem>

#include "mesh/triangle_mesh.hpp"

namespace nook {

/// Whether the name is that of a mesh in a format that nook reads: .obj, .ply, .stl, each also with .gz
/// behind it, in any case.
bool is_mesh(const std::filesystem::path& path);

/// Whether the name is that of a file of geometry in a format that nook does not read, as far as they are
/// known.
bool is_unread_mesh(const std::filesystem::path& path);

/// Whether the name ends in .gz, in any case.
bool is_compressed(const std::filesystem::path& path);

/// Reads the mesh by the reader of its name's format: load_obj(), load_ply(), load_stl(). Throws Error(scene)
/// "cube.fbx: not a format that nook reads (OBJ, PLY, STL)" for other names, and what those throw.
TriangleMesh load_mesh(const std::filesystem::path& path, const MeshAttributes& attributes = {});

/// Throws what load_mesh throws for a name of another format; "PATH: no such file" first.
[[noreturn]] void refuse_format(const std::filesystem::path& path);

}  // namespace nook
