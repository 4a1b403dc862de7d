#include "plan/cut_outs.hpp"

#include <algorithm>

#include "mesh/opacity_maps.hpp"

namespace nook {
CutOuts make_cut_outs(const TriangleMesh& mesh) {
  CutOuts made;
  for (const OpacityMap& map : mesh.opacity_maps) {
    made.maps.push_back({nook_uint(made.opacity.size()), map.width, map.height, map.lookup.clamp});
    made.opacity.insert(made.opacity.end(), map.opacity.begin(), map.opacity.end());
  }
  std::vector<nook_uint> map_of_material;
  for (const Material& material : mesh.materials)
    map_of_material.push_back(index_of_map(mesh, material).value_or(NO_OPACITY_MAP));
  made.triangles.resize(mesh.triangles.size());
  for (std::size_t t = 0; t < made.triangles.size(); ++t) {
    CutTriangle& triangle = made.triangles[t];
    triangle.map = NO_OPACITY_MAP;
    if (mesh.triangle_uvs.empty() || mesh.triangle_material[t] >= map_of_material.size()) continue;
    const auto& corners = mesh.triangle_uvs[t];
    if (std::any_of(corners.begin(), corners.end(), [&](std::uint32_t i) { return i >= mesh.uvs.size(); }))
      continue;
    triangle.map = map_of_material[mesh.triangle_material[t]];
    const MapLookup& lookup = mesh.materials[mesh.triangle_material[t]].map;
    for (std::size_t k = 0; k < 3; ++k) {
      const vec2 uv = mesh.uvs[corners[k]] * lookup.scale + lookup.offset;
      for (int axis = 0; axis < 2; ++axis) triangle.uv[k][axis] = uv[axis];
    }
  }
  return made;
}

}  // namespace nook
