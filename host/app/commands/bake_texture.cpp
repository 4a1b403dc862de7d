// nook bake SCENE --to texture -o ao.exr: AO and bent normals at the texels of a mesh with texture
// coordinates.
#include "app/commands/bake_texture.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/counted.hpp"
#include "base/error.hpp"
#include "base/memory.hpp"
#include "base/to_stderr.hpp"
#include "image/exr.hpp"
#include "image/png.hpp"
#include "picture/picture.hpp"

namespace nook {
namespace {

constexpr int default_size = 1024;

bool is_png(const std::filesystem::path& file) {
  return file.extension() == ".png";
}

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

void TextureOptions::add_to(CLI::App& command) {
  command.add_option("--size", size, "With --to texture: texels on a side; default 1024")
      ->check(CLI::Range(1, 16384));
  command
      .add_option("--dilation", dilation,
                  "With --to texture: rings of texels that continue the edges; default 8")
      ->check(CLI::Range(0, 1024));
  command.add_option("--aov", aovs, "With --to texture: more channels: normal,position,variance,samples")
      ->delimiter(',');
}

void check_texture_options(const TextureOptions& options, const Scene& scene,
                           const std::filesystem::path& output) {
  const AovRequest asked = parse_aovs(options.aovs);
  if (asked.depth || asked.alpha)
    throw Error(ErrorKind::usage,
                "--aov: a texture has normal, position, variance and samples, and A always");
  if (!is_png(output) && output.extension() != ".exr")
    throw Error(ErrorKind::usage, Place{output.string()}, "a texture is an .exr or a .png file");
  if (is_png(output) && scene.effects.front().kind == EffectKind::bent)
    throw Error(ErrorKind::usage, Place{output.string()}, "a PNG holds no directions; name an .exr file");
  if (is_png(output) && (scene.effects.size() > 1 || !options.aovs.empty()))
    throw Error(ErrorKind::usage, Place{output.string()},
                "a PNG holds one effect; name an .exr file for more");
  const int size = options.size.value_or(default_size);
  const auto texels = std::uint64_t(size) * std::uint64_t(size);
  check_memory(texels * (180 + 140 * scene.effects.size() + 24 * options.aovs.size()),
               fmt::format("a texture of {}x{} texels", size, size), "choose a smaller --size");
}

TexturePoints points_of_texture(const TextureOptions& options, const Scene& scene, const TriangleMesh& mesh) {
  try {
    TexturePoints made = texture_points(mesh, options.size.value_or(default_size));
    if (made.overlapping)
      to_stderr("warning: {} in more than one triangle, the first of the mesh has them\n",
                counted(made.overlapping, "texel lies", "texels lie"));
    if (made.without_uv)
      to_stderr("warning: {} no texture coordinates, and no texel\n",
                counted(made.without_uv, "triangle has", "triangles have"));
    return made;
  } catch (const Error& e) {
    throw Error(e.kind(), Place{scene.mesh_file.string()}, e.what());
  }
}

void write_texture(const TextureOptions& options, const TexturePoints& texels, SceneRenderer& renderer,
                   RunObserver& observer, const std::filesystem::path& output) {
  const Plan& plan = renderer.plan();
  const std::vector<Film> films = renderer.estimate(texels.points, plan.directions, &observer);
  const AovRequest asked = parse_aovs(options.aovs);
  FilmPart part;
  part.layers = layer_names(plan);
  part.aovs = options.aovs;
  part.aovs.push_back("alpha");
  for (const Film& film : films) part.films.push_back(spread(film, texels));
  if (asked.normal) add_vectors("N", texels.normals, texels, part.surface);
  std::vector<vec3> positions = texels.positions;
  for (vec3& p : positions) p = vec3(plan.frame.to_file(dvec3(p)));
  if (asked.position) add_vectors("P", positions, texels, part.surface);
  Image image = make_picture(part);
  dilate(image, dilation_sources(texels.texels, texels.size, options.dilation.value_or(8)));
  if (is_png(output))
    write_png(output, image);
  else
    write_exr(output, image);
  to_stderr("{}: {} of {} covered, {} each\n", output.string(), texels.texels.size(),
            counted(std::size_t(texels.size) * std::size_t(texels.size), "texel"),
            counted(plan.directions, "direction"));
}

}  // namespace nook
