// nook bake SCENE: AO and bent normals at the mesh's vertices, as properties of a PLY file (--to vertices),
// or at the texels that its texture coordinates reach (--to texture).
#include <fmt/format.h>

#include <algorithm>

#include "app/commands.hpp"
#include "app/commands/bake_texture.hpp"
#include "app/interrupt.hpp"
#include "app/options/loading.hpp"
#include "app/options/render_options.hpp"
#include "app/options/scene_options.hpp"
#include "app/progress.hpp"
#include "base/counted.hpp"
#include "base/error.hpp"
#include "base/to_stderr.hpp"
#include "film/bent_cone.hpp"
#include "mesh/ply.hpp"
#include "points/vertex_points.hpp"
#include "render/scene_renderer.hpp"

namespace nook {
namespace {

struct BakeOptions {
  SceneOptions scene;
  DeviceOptions device;
  std::string to = "vertices";
  TextureOptions texture;
  std::filesystem::path output;
};

// The effects that need no viewer, all of a vertex's samples as directions from it.
Scene bake_scene(const BakeOptions& options) {
  Scene scene = options.scene.load();
  std::erase_if(scene.effects,
                [](const Effect& e) { return e.kind != EffectKind::ao && e.kind != EffectKind::bent; });
  if (scene.effects.empty())
    throw Error(ErrorKind::scene, Place{scene.file.string()}, "a bake needs an effect of type ao or bent");
  options.scene.check_applicable(scene);
  const std::uint64_t directions = std::uint64_t(scene.spp) * scene.directions;
  if (directions > 1u << 26)
    throw Error(ErrorKind::scene, Place{scene.file.string()},
                fmt::format("spp x directions is {}, at most {} for a bake", directions, 1u << 26));
  scene.directions = std::uint32_t(directions);
  scene.spp = 1;
  scene.denoise = false;
  scene.crop.reset();
  return scene;
}

std::vector<VertexProperty> properties_of(const EffectPlan& effect, const Film& film) {
  const std::string name = effect.label();
  std::vector<VertexProperty> made;
  const auto add = [&](const std::string& property, auto get) {
    std::vector<float> values(film.pixels());
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = get(i);
    made.push_back({property, std::move(values)});
  };
  if (effect.effect.kind != EffectKind::bent) {
    add(name, [&](std::size_t i) { return float(film.value(i)); });
    return made;
  }
  static constexpr const char* axes[] = {"_x", "_y", "_z"};
  for (int axis = 0; axis < 3; ++axis)
    add(name + axes[axis], [&](std::size_t i) { return bent_cone(film, i).direction[axis]; });
  add(name + "_cone", [&](std::size_t i) { return bent_cone(film, i).half_angle; });
  add(name + "_ao", [&](std::size_t i) { return float(film.value(i)); });
  return made;
}

void write_vertices(const std::filesystem::path& output, SceneRenderer& renderer, RunObserver& observer) {
  const TriangleMesh& mesh = renderer.mesh();
  const Plan& plan = renderer.plan();
  const std::vector<vec3> normals = position_normals(mesh);
  const std::vector<Film> films = renderer.estimate(vertex_points(mesh, normals), plan.directions, &observer);
  std::vector<VertexProperty> properties;
  for (std::size_t e = 0; e < films.size(); ++e)
    for (VertexProperty& property : properties_of(plan.effects[e], films[e]))
      properties.push_back(std::move(property));
  write_ply(output, mesh, normals, properties);
  to_stderr("{}: {}, {} each\n", output.string(), counted(mesh.positions.size(), "vertex", "vertices"),
            counted(plan.directions, "direction"));
}

int bake(const BakeOptions& options) {
  const bool to_texture = options.to == "texture";
  const Scene scene = bake_scene(options);
  keep_inputs(scene, options.output);
  if (!to_texture && (options.texture.size || options.texture.dilation || !options.texture.aovs.empty()))
    throw Error(ErrorKind::usage, "--size, --dilation, --aov: are of textures; they need --to texture");
  static constexpr std::string_view written[] = {".ply"};
  if (!to_texture) check_extension(options.output, written);
  if (to_texture) check_texture_options(options.texture, scene, options.output);
  MeshAttributes attributes = needed_attributes(scene);
  attributes.uvs = attributes.uvs || to_texture;
  options.device.prepare();
  SceneRendererOptions made;
  made.threads = options.device.threads;
  made.attributes = attributes;
  made.instancing = Instancing::copies;
  SceneRenderer renderer(
      scene, [&] { return options.device.open(); }, std::move(made));
  const TriangleMesh& mesh = renderer.mesh();
  warn_of(scene, mesh, Viewer::none);
  const Plan& plan = renderer.plan();
  for (const EffectPlan& effect : plan.effects)
    if (effect.effect.view_space || effect.effect.side == Side::viewer)
      throw Error(ErrorKind::scene, Place{scene.file.string()},
                  fmt::format("a bake has no viewer: {}",
                              effect.effect.view_space ? "space = \"view\"" : "side = \"viewer\""));
  const TexturePoints texels = to_texture ? points_of_texture(options.texture, scene, mesh) : TexturePoints{};
  const double points = double(to_texture ? texels.points.size() : mesh.positions.size());
  renderer.expect_rays(points * plan.directions * double(plan.effects.size()));
  renderer.tracer();
  catch_interrupts();
  TerminalObserver observer(ProgressMode::none);
  if (to_texture)
    write_texture(options.texture, texels, renderer, observer, options.output);
  else
    write_vertices(options.output, renderer, observer);
  renderer.tracer().store_programs();
  return 0;
}

}  // namespace

void add_bake_command(CLI::App& app, Command& chosen) {
  auto options = std::make_shared<BakeOptions>();
  CLI::App* command = app.add_subcommand(
      "bake", "Write AO and bent normals at the mesh's vertices into a PLY file, or into a texture");
  // The film of the scene is not what is baked.
  options->scene.add_to(*command, ambient_kinds,
                        {"--size", "--crop", "--view", "--margin", "--up", "--ground"});
  options->device.add_to(*command);
  command->add_option("--to", options->to, "vertices or texture")
      ->check(CLI::IsMember({"vertices", "texture"}));
  options->texture.add_to(*command);
  command->add_option("-o,--output", options->output, "PLY file; with --to texture an EXR or PNG file")
      ->required();
  command->callback([options, &chosen] { chosen = [options] { return bake(*options); }; });
}

}  // namespace nook
