#include "picture/denoise_picture.hpp"

#include <algorithm>

#include "image/denoise.hpp"

namespace nook {
namespace {

struct GuidePlanes {
  std::vector<float> normal[3], position[3];
};

GuidePlanes planes_of(std::span<const SurfacePoint> surface) {
  GuidePlanes planes;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    planes.normal[axis].assign(surface.size(), 0);
    planes.position[axis].assign(surface.size(), 0);
    for (std::size_t i = 0; i < surface.size(); ++i) {
      if (!(surface[i].flags & SURFACE_HIT)) continue;
      planes.normal[axis][i] = surface[i].normal[axis];
      planes.position[axis][i] = surface[i].origin[axis];
    }
  }
  return planes;
}

// The channels that hold an effect's value; those of a named main layer are R, G, B too.
std::vector<std::string> channels_of(const EffectPlan& effect, bool main) {
  if (effect.effect.kind == EffectKind::bent) return {effect.layer + "AO"};
  std::vector<std::string> names;
  for (const char* channel : {"R", "G", "B"}) {
    names.push_back(effect.layer + channel);
    if (main && !effect.layer.empty()) names.push_back(channel);
  }
  return names;
}

std::vector<float>* values_of(Image& image, const std::string& name) {
  const auto found = std::find_if(image.channels.begin(), image.channels.end(),
                                  [&](const Channel& channel) { return channel.name == name; });
  return found == image.channels.end() ? nullptr : std::get_if<std::vector<float>>(&found->values);
}

DenoiseGuides guides_of(const GuidePlanes& planes, int width, int height) {
  return {width,
          height,
          {planes.normal[0], planes.normal[1], planes.normal[2]},
          {planes.position[0], planes.position[1], planes.position[2]}};
}

std::vector<float> filtered(const DenoiseGuides& guides, const Film& film, const std::vector<float>& values) {
  std::vector<float> of_surface(values.size()), variance(values.size());
  const auto share = [&](std::size_t i) {
    const double coverage = film.coverage(i);
    return coverage > 0 ? coverage : 1.0;
  };
  for (std::size_t i = 0; i < values.size(); ++i) {
    of_surface[i] = float(values[i] / share(i));
    variance[i] = float(film.variance(i) / (share(i) * share(i)));
  }
  std::vector<float> made = denoise(guides, of_surface, variance);
  for (std::size_t i = 0; i < made.size(); ++i)
    made[i] = made[i] == of_surface[i] ? values[i] : float(made[i] * share(i));
  return made;
}

}  // namespace

void denoise_picture(const Plan& plan, std::span<const Film> films, std::span<const SurfacePoint> surface,
                     Image& image) {
  const GuidePlanes planes = planes_of(surface);
  const DenoiseGuides guides = guides_of(planes, image.width, image.height);
  auto layer = plan.layers.begin();
  for (std::size_t e = 0; e < plan.effects.size(); ++e, ++layer) {
    layer = std::find_if(layer, plan.layers.end(), [](const LayerPlan& l) { return is_traced(l.kind); });
    const std::vector<std::string> names = channels_of(plan.effects[e], layer->main);
    const std::vector<float> made = filtered(guides, films[e], *values_of(image, names.front()));
    for (const std::string& name : names)
      if (std::vector<float>* values = values_of(image, name)) *values = made;
  }
}

std::vector<float> denoised_values(const Film& film, std::span<const SurfacePoint> surface) {
  const GuidePlanes planes = planes_of(surface);
  std::vector<float> values(film.pixels());
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = float(film.value(i));
  return filtered(guides_of(planes, film.width, film.height), film, values);
}

}  // namespace nook
