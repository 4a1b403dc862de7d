// nook bake SCENE: AO and bent normals at the mesh's vertices or at its triangles' corners, as properties of
// a PLY file (--to vertices, --to corners), or at the texels that its texture coordinates reach (--to
// texture).
#include <fmt/format.h>

#include <optional>

#include "app/commands.hpp"
#include "app/interrupt.hpp"
#include "app/options/loading.hpp"
#include "app/options/render_options.hpp"
#include "app/options/scene_options.hpp"
#include "app/progress.hpp"
#include "base/counted.hpp"
#include "base/error.hpp"
#include "base/to_stderr.hpp"
#include "image/exr.hpp"
#include "image/png.hpp"
#include "points/corner_points.hpp"
#include "render/bake.hpp"
#include "render/texture_bake.hpp"

namespace nook {
namespace {

struct BakeOptions {
  SceneOptions scene;
  DeviceOptions device;
  std::string to = "vertices";
  std::optional<int> size, dilation;
  std::vector<std::string> aovs;
  std::filesystem::path output;

  bool to_texture() const { return to == "texture"; }
  bool to_png() const { return output.extension() == ".png"; }
  TextureRequest texture() const {
    TextureRequest request;
    request.size = size.value_or(request.size);
    request.dilation = dilation.value_or(request.dilation);
    request.aovs = aovs;
    return request;
  }
};

// Before anything is loaded: the output's format, what a PNG cannot hold, memory.
void check_texture_options(const BakeOptions& options, const Scene& scene) {
  const Place place{options.output.string()};
  check_texture(options.texture(), scene);
  if (!options.to_png() && options.output.extension() != ".exr")
    throw Error(ErrorKind::usage, place, "a texture is an .exr or a .png file");
  if (options.to_png() && scene.effects.front().kind == EffectKind::bent)
    throw Error(ErrorKind::usage, place, "a PNG holds no directions; name an .exr file");
  if (options.to_png() && (scene.effects.size() > 1 || !options.aovs.empty()))
    throw Error(ErrorKind::usage, place, "a PNG holds one effect; name an .exr file for more");
}

void write_texture(const BakeOptions& options, const TexturePoints& texels, SceneRenderer& renderer,
                   RunObserver& observer) {
  const Image image = bake_texture(renderer, texels, options.texture(), &observer);
  if (options.to_png())
    write_png(options.output, image);
  else
    write_exr(options.output, image);
  to_stderr("{}: {} of {} covered, {} each\n", options.output.string(), texels.texels.size(),
            counted(std::size_t(texels.size) * std::size_t(texels.size), "texel"),
            counted(renderer.plan().directions, "direction"));
}

void write_vertices(const BakeOptions& options, SceneRenderer& renderer, RunObserver& observer) {
  const TriangleMesh& mesh = renderer.mesh();
  const bool corners = options.to == "corners";
  const MeshBake baked = corners ? bake_corners(renderer, &observer) : bake_vertices(renderer, &observer);
  write_ply(options.output, corners ? corner_mesh(mesh) : mesh, baked.normals, baked.properties);
  to_stderr(
      "{}: {}, {} each\n", options.output.string(),
      corners ? counted(baked.normals.size(), "corner") : counted(baked.normals.size(), "vertex", "vertices"),
      counted(renderer.plan().directions, "direction"));
}

int bake(const BakeOptions& options) {
  const bool to_texture = options.to_texture();
  const Scene scene = scene_to_bake(options.scene.load());
  options.scene.check_applicable(scene);
  keep_inputs(scene, options.output);
  if (!to_texture && (options.size || options.dilation || !options.aovs.empty()))
    throw Error(ErrorKind::usage, "--size, --dilation, --aov: are of textures; they need --to texture");
  static constexpr std::string_view written[] = {".ply"};
  if (!to_texture) check_extension(options.output, written);
  if (to_texture) check_texture_options(options, scene);
  options.device.prepare();
  SceneRendererOptions made;
  made.threads = options.device.threads;
  made.attributes = baked_attributes(scene, to_texture);
  made.instancing = Instancing::copies;
  SceneRenderer renderer(
      scene, [&] { return options.device.open(); }, std::move(made));
  warn_of(scene, renderer.mesh(), Viewer::none);
  TerminalObserver observer(ProgressMode::none);
  const TexturePoints texels =
      to_texture ? texels_of(renderer, options.texture(), observer) : TexturePoints{};
  catch_interrupts();
  if (to_texture)
    write_texture(options, texels, renderer, observer);
  else
    write_vertices(options, renderer, observer);
  renderer.tracer().store_programs();
  return 0;
}

}  // namespace

void add_bake_command(CLI::App& app, Command& chosen) {
  auto options = std::make_shared<BakeOptions>();
  CLI::App* command = app.add_subcommand(
      "bake",
      "Write AO and bent normals at the mesh's vertices or corners into a PLY file, or into a texture");
  // The film of the scene is not what is baked.
  options->scene.add_to(*command, ambient_kinds,
                        {"--size", "--crop", "--view", "--margin", "--up", "--ground"});
  options->device.add_to(*command);
  command->add_option("--to", options->to, "vertices, corners (of the triangles) or texture")
      ->check(CLI::IsMember({"vertices", "corners", "texture"}));
  command->add_option("--size", options->size, "With --to texture: texels on a side; default 1024")
      ->check(CLI::Range(1, 16384));
  command
      ->add_option("--dilation", options->dilation,
                   "With --to texture: rings of texels that continue the edges; default 8")
      ->check(CLI::Range(0, 1024));
  command
      ->add_option("--aov", options->aovs,
                   "With --to texture: more channels: normal,position,variance,samples")
      ->delimiter(',');
  command->add_option("-o,--output", options->output, "PLY file; with --to texture an EXR or PNG file")
      ->required();
  command->callback([options, &chosen] { chosen = [options] { return bake(*options); }; });
}

}  // namespace nook
