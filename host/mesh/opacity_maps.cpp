#include "mesh/opacity_maps.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "image/png.hpp"

namespace nook {
namespace {

// base + gain * texel, limited to 0 to 1.
void adjust(std::vector<std::uint8_t>& texels, const MapLookup& lookup) {
  if (lookup.base == 0 && lookup.gain == 1) return;
  std::array<std::uint8_t, 256> of{};
  for (std::size_t i = 0; i < of.size(); ++i) {
    const double value = lookup.base + lookup.gain * (double(i) / 255);
    of[i] = std::uint8_t(std::lround(255 * std::clamp(value, 0.0, 1.0)));
  }
  for (std::uint8_t& texel : texels) texel = of[texel];
}

}  // namespace

std::optional<std::uint32_t> index_of_map(const TriangleMesh& mesh, const Material& material) {
  const auto found =
      std::find_if(mesh.opacity_maps.begin(), mesh.opacity_maps.end(), [&](const OpacityMap& map) {
        const MapLookup &made = map.lookup, &wanted = material.map;
        return map.file == material.opacity_map && made.channel == wanted.channel &&
               made.base == wanted.base && made.gain == wanted.gain && made.clamp == wanted.clamp;
      });
  if (found == mesh.opacity_maps.end()) return std::nullopt;
  return std::uint32_t(found - mesh.opacity_maps.begin());
}

void load_opacity_maps(TriangleMesh& mesh) {
  for (const Material& material : mesh.materials)
    if (!material.opacity_map.empty() && !index_of_map(mesh, material)) {
      GrayImage image = read_png_opacity(material.opacity_map, material.map.channel);
      adjust(image.values, material.map);
      mesh.opacity_maps.push_back(
          {material.opacity_map, image.width, image.height, std::move(image.values), material.map});
    }
}

}  // namespace nook
