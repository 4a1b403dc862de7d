#pragma once

#include <cstdint>
#include <optional>

#include "mesh/triangle_mesh.hpp"

namespace nook {

/// Reads the maps that materials name (Material::opacity_map) into mesh.opacity_maps, each once for each way
/// in which it is looked up (MapLookup: channel, base and gain, clamp). Without any, the mesh is left as it
/// was. Throws Error(scene).
void load_opacity_maps(TriangleMesh& mesh);

/// Where in mesh.opacity_maps the map is that the material looks up; unset if it is not there.
std::optional<std::uint32_t> index_of_map(const TriangleMesh& mesh, const Material& material);

}  // namespace nook
