#include "picture/surface_layers.hpp"

#include <algorithm>
#include <limits>

namespace nook {
namespace {

// The components of a layer at each point: X, Y, Z, or one Z for a depth.
std::vector<std::vector<float>> components(const Plan& plan, EffectKind kind,
                                           std::span<const SurfacePoint> surface) {
  const bool depth = kind == EffectKind::depth;
  const float background = depth ? std::numeric_limits<float>::infinity() : 0.0f;
  std::vector<std::vector<float>> planes(depth ? 1 : 3, std::vector<float>(surface.size(), background));
  const float* f = plan.camera.forward;
  for (std::size_t i = 0; i < surface.size(); ++i) {
    const SurfacePoint& p = surface[i];
    if (!(p.flags & SURFACE_HIT)) continue;
    if (depth) {
      const float z = -p.distance * (p.view[0] * f[0] + p.view[1] * f[1] + p.view[2] * f[2]);
      planes[0][i] = float(plan.frame.to_file(double(z)));
    }
    const dvec3 position = plan.frame.to_file(dvec3(p.origin[0], p.origin[1], p.origin[2]));
    for (std::size_t axis = 0; !depth && axis < 3; ++axis)
      planes[axis][i] = kind == EffectKind::normal ? p.normal[axis] : float(position[int(axis)]);
  }
  return planes;
}

// A channel that an AOV has made already is the same.
void add(std::vector<Channel>& channels, const std::string& name, const std::vector<float>& values) {
  const bool known =
      std::any_of(channels.begin(), channels.end(), [&](const Channel& c) { return c.name == name; });
  if (!known) channels.push_back({name, values});
}

}  // namespace

void add_surface_layers(const Plan& plan, std::span<const SurfacePoint> surface,
                        std::vector<Channel>& channels) {
  for (std::size_t l = 0; l < plan.layers.size(); ++l) {
    const LayerPlan& layer = plan.layers[l];
    if (!is_surface(layer.kind)) continue;
    const auto planes = components(plan, layer.kind, surface);
    static constexpr const char* axes[] = {"X", "Y", "Z"};
    static constexpr const char* colors[] = {"R", "G", "B"};
    for (std::size_t i = 0; i < 3; ++i) {
      const bool own_channel = planes.size() == 3 || i == 2;
      if (own_channel && !(layer.prefix.empty() && planes.size() == 3))
        add(channels, layer.prefix + axes[i], planes[i % planes.size()]);
      if (layer.main) add(channels, colors[i], planes[i % planes.size()]);
    }
  }
}

}  // namespace nook
