#include "render/cut_outs.hpp"

#include <algorithm>

#include "image/png.hpp"

namespace nook {
namespace {

nook_uint index_of_map(const TriangleMesh& mesh, const std::string& file) {
  const auto found = std::find_if(mesh.opacity_maps.begin(), mesh.opacity_maps.end(),
                                  [&](const OpacityMap& map) { return map.file == file; });
  return found == mesh.opacity_maps.end() ? NO_OPACITY_MAP : nook_uint(found - mesh.opacity_maps.begin());
}

}  // namespace

CutOuts make_cut_outs(const TriangleMesh& mesh) {
  CutOuts made;
  for (const OpacityMap& map : mesh.opacity_maps) {
    made.maps.push_back({nook_uint(made.opacity.size()), map.width, map.height, 0});
    made.opacity.insert(made.opacity.end(), map.opacity.begin(), map.opacity.end());
  }
  std::vector<nook_uint> map_of_material;
  for (const Material& material : mesh.materials)
    map_of_material.push_back(index_of_map(mesh, material.opacity_map));
  made.triangles.resize(mesh.triangles.size());
  for (std::size_t t = 0; t < made.triangles.size(); ++t) {
    CutTriangle& triangle = made.triangles[t];
    triangle.map = NO_OPACITY_MAP;
    if (mesh.triangle_uvs.empty() || mesh.triangle_material[t] >= map_of_material.size()) continue;
    const auto& corners = mesh.triangle_uvs[t];
    if (std::any_of(corners.begin(), corners.end(), [&](std::uint32_t i) { return i >= mesh.uvs.size(); }))
      continue;
    triangle.map = map_of_material[mesh.triangle_material[t]];
    for (std::size_t k = 0; k < 3; ++k)
      for (int axis = 0; axis < 2; ++axis) triangle.uv[k][axis] = mesh.uvs[corners[k]][axis];
  }
  return made;
}

void load_opacity_maps(TriangleMesh& mesh) {
  for (const Material& material : mesh.materials)
    if (!material.opacity_map.empty() && index_of_map(mesh, material.opacity_map) == NO_OPACITY_MAP) {
      GrayImage image = read_png_opacity(material.opacity_map);
      mesh.opacity_maps.push_back({material.opacity_map, image.width, image.height, std::move(image.values)});
    }
}

}  // namespace nook
