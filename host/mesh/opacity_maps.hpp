#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "mesh/triangle_mesh.hpp"

namespace nook {

/// Reads the maps that materials name (Material::opacity_map) into mesh.opacity_maps, each once. Without any,
/// the mesh is left as it was. Throws Error(scene).
void load_opacity_maps(TriangleMesh& mesh);

/// Where in mesh.opacity_maps the file's map is; unset if it is not there.
std::optional<std::uint32_t> index_of_map(const TriangleMesh& mesh, const std::string& file);

}  // namespace nook
