#include "render/texture_bake.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <variant>

#include "base/counted.hpp"
#include "base/error.hpp"
#include "base/memory.hpp"
#include "picture/picture.hpp"
#include "render/bake.hpp"

namespace nook {
namespace {

// The estimates of the covered texels, at their places in the whole texture.
Film spread(const Film& estimates, const TexturePoints& texels) {
  Film film(texels.size, texels.size, estimates.sum_scale, estimates.square_scale, estimates.per_replicate,
            estimates.extra.size());
  film.settings = estimates.settings;
  for (std::size_t i = 0; i < texels.texels.size(); ++i) {
    const std::size_t texel = texels.texels[i];
    film.sum[texel] = estimates.sum[i];
    film.sum_square[texel] = estimates.sum_square[i];
    film.replicates[texel] = estimates.replicates[i];
    film.camera_samples[texel] = estimates.camera_samples[i];
    film.hits[texel] = estimates.hits[i];
    for (std::size_t plane = 0; plane < film.extra.size(); ++plane)
      film.extra[plane][texel] = estimates.extra[plane][i];
  }
  return film;
}

void add_vectors(const std::string& layer, const std::vector<vec3>& values, const TexturePoints& texels,
                 std::vector<Channel>& channels) {
  static constexpr const char* axes[] = {".X", ".Y", ".Z"};
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<float> plane(std::size_t(texels.size) * std::size_t(texels.size));
    for (std::size_t i = 0; i < values.size(); ++i) plane[texels.texels[i]] = values[i][axis];
    channels.push_back({layer + axes[axis], std::move(plane)});
  }
}

// Every channel but A goes on beyond what is covered.
void dilate(Image& image, const std::vector<std::uint32_t>& source) {
  for (Channel& channel : image.channels) {
    if (channel.name == "A") continue;
    std::visit(
        [&](auto& values) {
          const auto before = values;
          for (std::size_t i = 0; i < values.size(); ++i)
            if (source[i] != no_texel) values[i] = before[source[i]];
        },
        channel.values);
  }
}

}  // namespace

void check_texture(const TextureRequest& request, const Scene& scene) {
  const AovRequest asked = parse_aovs(request.aovs);
  if (asked.depth || asked.alpha)
    throw Error(ErrorKind::usage,
                "--aov: a texture has normal, position, variance and samples, and A always");
  const auto texels = std::uint64_t(request.size) * std::uint64_t(request.size);
  check_memory(texels * (180 + 140 * scene.effects.size() + 24 * request.aovs.size()),
               fmt::format("a texture of {}x{} texels", request.size, request.size),
               "choose a smaller --size");
}

TexturePoints texels_of(const SceneRenderer& renderer, const TextureRequest& request, RunObserver& observer) {
  try {
    TexturePoints made = texture_points(renderer.mesh(), request.size);
    if (made.overlapping)
      observer.warn(fmt::format("{} in more than one triangle, the first of the mesh has them",
                                counted(made.overlapping, "texel lies", "texels lie")));
    if (made.without_uv)
      observer.warn(fmt::format("{} no texture coordinates, and no texel",
                                counted(made.without_uv, "triangle has", "triangles have")));
    return made;
  } catch (const Error& e) {
    throw Error(e.kind(), Place{renderer.scene().mesh_file.string()}, e.what());
  }
}

Image bake_texture(SceneRenderer& renderer, const TexturePoints& texels, const TextureRequest& request,
                   RunObserver* observer) {
  const Plan& plan = renderer.plan();
  const AovRequest asked = parse_aovs(request.aovs);
  FilmPart part;
  part.layers = layer_names(plan);
  part.aovs = request.aovs;
  part.aovs.push_back("alpha");
  for (const Film& film : bake_at(renderer, texels.points, observer))
    part.films.push_back(spread(film, texels));
  if (asked.normal) add_vectors("N", texels.normals, texels, part.surface);
  std::vector<vec3> positions = texels.positions;
  for (vec3& p : positions) p = vec3(plan.frame.to_file(dvec3(p)));
  if (asked.position) add_vectors("P", positions, texels, part.surface);
  Image image = make_picture(part);
  dilate(image, dilation_sources(texels.texels, texels.size, request.dilation));
  return image;
}

}  // namespace nook
