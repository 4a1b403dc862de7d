#include "mesh/opacity_maps.hpp"

#include <algorithm>
#include <utility>

#include "image/png.hpp"

namespace nook {

std::optional<std::uint32_t> index_of_map(const TriangleMesh& mesh, const std::string& file) {
  const auto found = std::find_if(mesh.opacity_maps.begin(), mesh.opacity_maps.end(),
                                  [&](const OpacityMap& map) { return map.file == file; });
  if (found == mesh.opacity_maps.end()) return std::nullopt;
  return std::uint32_t(found - mesh.opacity_maps.begin());
}

void load_opacity_maps(TriangleMesh& mesh) {
  for (const Material& material : mesh.materials)
    if (!material.opacity_map.empty() && !index_of_map(mesh, material.opacity_map)) {
      GrayImage image = read_png_opacity(material.opacity_map);
      mesh.opacity_maps.push_back({material.opacity_map, image.width, image.height, std::move(image.values)});
    }
}

}  // namespace nook
