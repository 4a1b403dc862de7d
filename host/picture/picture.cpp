#include "picture/picture.hpp"

#include <array>
#include <cstdio>
#include <limits>

#include "base/error.hpp"
#include "film/bent_cone.hpp"
#include "scene/names.hpp"

namespace nook {
namespace {

template <class Get>
void add_plane(std::vector<Channel>& channels, const std::string& name, std::size_t count, Get get) {
  std::vector<decltype(get(std::size_t()))> values(count);
  for (std::size_t i = 0; i < count; ++i) values[i] = get(i);
  channels.push_back({name, std::move(values)});
}

void add_vector(std::vector<Channel>& channels, const std::string& layer,
                std::span<const SurfacePoint> surface, vec3 (*get)(const SurfacePoint&)) {
  static constexpr const char* axes[] = {".X", ".Y", ".Z"};
  for (int axis = 0; axis < 3; ++axis)
    add_plane(channels, layer + axes[axis], surface.size(),
              [&](std::size_t i) { return surface[i].flags & SURFACE_HIT ? get(surface[i])[axis] : 0.0f; });
}

void add_bent(std::vector<Channel>& channels, const std::string& layer, const Film& film) {
  std::vector<BentCone> cones(film.pixels());
  for (std::size_t i = 0; i < cones.size(); ++i) cones[i] = bent_cone(film, i);
  static constexpr const char* axes[] = {"X", "Y", "Z"};
  for (int axis = 0; axis < 3; ++axis)
    add_plane(channels, layer + axes[axis], cones.size(),
              [&](std::size_t i) { return cones[i].direction[axis]; });
  add_plane(channels, layer + "cone", cones.size(), [&](std::size_t i) { return cones[i].half_angle; });
}

// Sets what the names ask for; returns the first name that is no channel's, or "".
std::string request_channels(const std::vector<std::string>& names, AovRequest& request) {
  static constexpr std::pair<std::string_view, bool AovRequest::*> known[] = {
      {"normal", &AovRequest::normal},   {"position", &AovRequest::position},
      {"depth", &AovRequest::depth},     {"variance", &AovRequest::variance},
      {"samples", &AovRequest::samples}, {"alpha", &AovRequest::alpha}};
  for (const std::string& name : names) {
    const auto member = value_of<bool AovRequest::*>(known, name);
    if (!member) return name.empty() ? "''" : name;
    request.*(*member) = true;
  }
  return "";
}

}  // namespace

AovRequest parse_aovs(const std::vector<std::string>& names) {
  AovRequest request;
  if (const std::string unknown = request_channels(names, request); !unknown.empty())
    throw Error(ErrorKind::usage, "--aov: unknown channel '" + unknown +
                                      "', known: normal, position, depth, variance, samples, alpha");
  return request;
}

std::vector<std::string> layer_names(const Plan& plan) {
  std::vector<std::string> names;
  for (const EffectPlan& effect : plan.effects) names.push_back(effect.layer);
  return names;
}

std::vector<Channel> surface_channels(const Plan& plan, const AovRequest& aovs,
                                      std::span<const SurfacePoint> surface) {
  std::vector<Channel> channels;
  const vec3 forward(plan.camera.forward[0], plan.camera.forward[1], plan.camera.forward[2]);
  if (aovs.normal)
    add_vector(channels, "N", surface,
               [](const SurfacePoint& p) { return vec3(p.normal[0], p.normal[1], p.normal[2]); });
  if (aovs.position)
    add_vector(channels, "P", surface,
               [](const SurfacePoint& p) { return vec3(p.origin[0], p.origin[1], p.origin[2]); });
  if (aovs.depth)
    add_plane(channels, "Z", surface.size(), [&](std::size_t i) {
      const SurfacePoint& p = surface[i];
      const vec3 direction(-p.view[0], -p.view[1], -p.view[2]);
      return p.flags & SURFACE_HIT ? p.distance * glm::dot(direction, forward)
                                   : std::numeric_limits<float>::infinity();
    });
  return channels;
}

Channel preview_ground(const Plan& plan, std::span<const SurfacePoint> surface) {
  std::vector<float> ground;
  ground.reserve(surface.size());
  for (const SurfacePoint& point : surface)
    ground.push_back(point.flags & SURFACE_HIT && point.triangle >= *plan.preview_ground ? 1.0f : 0.0f);
  return {ground_plane, std::move(ground)};
}

Image make_picture(const FilmPart& part) {
  AovRequest aovs;
  if (!request_channels(part.aovs, aovs).empty())
    throw Error(ErrorKind::scene, "a part asks for a channel that nook does not know");
  Image image;
  image.width = part.films.front().width;
  image.height = part.films.front().height;
  for (std::size_t i = 0; i < part.films.front().pixels(); ++i)
    image.coverage.push_back(float(part.films.front().coverage(i)));
  for (std::size_t e = 0; e < part.films.size(); ++e) {
    const Film& film = part.films[e];
    const std::string& layer = part.layers[e];
    if (!film.extra.empty()) add_bent(image.channels, layer, film);
    std::vector<float> value(film.pixels());
    for (std::size_t i = 0; i < value.size(); ++i) value[i] = float(film.value(i));
    if (!film.extra.empty())
      image.channels.push_back({layer + "AO", std::move(value)});
    else
      for (const char* channel : {"R", "G", "B"}) image.channels.push_back({layer + channel, value});
    if (e == 0 && aovs.alpha)
      add_plane(image.channels, "A", film.pixels(), [&](std::size_t i) { return float(film.coverage(i)); });
    const std::string of_effect = layer.empty() ? "AO." : layer;
    if (aovs.variance)
      add_plane(image.channels, of_effect + "variance", film.pixels(),
                [&](std::size_t i) { return float(film.variance(i)); });
    if (aovs.samples)
      add_plane(image.channels, of_effect + "samples", film.pixels(),
                [&](std::size_t i) { return film.replicates[i] * film.per_replicate; });
  }
  for (const Channel& channel : part.surface)
    if (channel.name == ground_plane)
      image.ground = std::get<std::vector<float>>(channel.values);
    else
      image.channels.push_back(channel);
  // A main layer with a name of its own: its first three channels are an occlusion three times, or a
  // direction.
  if (!image.find("R"))
    for (std::size_t i = 0; i < 3; ++i) {
      auto values = image.channels[i].values;
      image.channels.push_back({std::array{"R", "G", "B"}[i], std::move(values)});
    }
  image.metadata = {part.metadata.begin(), part.metadata.end()};
  return image;
}

namespace {

void place(Image& image, int x0, int y0, int full_width, int full_height) {
  if (image.width == full_width && image.height == full_height) return;
  image.x0 = x0;
  image.y0 = y0;
  image.full_width = full_width;
  image.full_height = full_height;
}

}  // namespace

void place_crop(Image& image, const Plan& plan) {
  place(image, plan.window.x0, plan.window.y0, plan.width, plan.height);
}

void place_crop(Image& image, const FilmPart::Texts& identity) {
  int x0 = 0, x1 = 0, y0 = 0, y1 = 0, width = image.width, height = image.height;
  for (const auto& [name, text] : identity) {
    if (name == "size") std::sscanf(text.c_str(), "%dx%d", &width, &height);
    if (name == "crop") std::sscanf(text.c_str(), "%d,%d,%d,%d", &x0, &x1, &y0, &y1);
  }
  // A damaged part may say anything.
  if (x0 < 0 || y0 < 0 || x1 - x0 != image.width || y1 - y0 != image.height || x1 > width || y1 > height)
    return;
  place(image, x0, y0, width, height);
}

}  // namespace nook
