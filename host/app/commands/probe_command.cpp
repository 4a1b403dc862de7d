// nook probe SCENE --points FILE.csv: AO or RO at given points, as CSV on stdout.
#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <iostream>
#include <limits>

#include "app/commands.hpp"
#include "app/commands/render_report.hpp"
#include "app/options/loading.hpp"
#include "app/options/scene_options.hpp"
#include "base/error.hpp"
#include "base/to_stderr.hpp"
#include "plan/proportions.hpp"
#include "points/outside.hpp"
#include "points/points.hpp"
#include "render/point_estimates.hpp"
#include "render/point_scene.hpp"
#include "render/scene_renderer.hpp"
#include "scene/names.hpp"

namespace nook {
namespace {

struct ProbeOptions {
  SceneOptions scene;
  DeviceOptions device;
  std::filesystem::path points;
  std::string effect;
  std::uint32_t samples = 1024;
};

Scene probe_scene(const ProbeOptions& options) {
  const auto asked = value_of<EffectKind>(effect_names, options.effect);
  Scene scene = options.scene.load([&](Scene& loaded) {
    const EffectKind kind = asked.value_or(loaded.effects.front().kind);
    if (kind != EffectKind::ao && kind != EffectKind::ro)
      throw Error(ErrorKind::usage, "--effect: a probe needs ao or ro");
    choose_effect_at_points(asked, loaded);
  });
  options.scene.check_applicable(scene);
  return scene_at_points(std::move(scene), options.samples);
}

int probe(const ProbeOptions& options) {
  const Scene scene = probe_scene(options);
  MeshAttributes attributes = needed_attributes(scene);
  attributes.normals = false;
  options.device.prepare();
  SceneRendererOptions made;
  made.threads = options.device.threads;
  made.attributes = attributes;
  SceneRenderer renderer(
      scene, [&] { return options.device.open(); }, std::move(made));
  warn_of(scene, renderer.mesh(), Viewer::none);
  const bool needs_view = scene.effects.front().kind == EffectKind::ro;
  const Frame& frame = renderer.mesh().frame;
  std::vector<SurfacePoint> points = options.points == "-"
                                         ? read_points(std::cin, "standard input", needs_view, frame)
                                         : load_points(options.points, needs_view, frame);
  const std::string far = far_points_warning(
      scene, renderer.mesh(), points, options.points == "-" ? "standard input" : options.points.string());
  if (!far.empty()) to_stderr("warning: {}\n", far);
  move_outside(points, renderer.mesh());
  renderer.expect_rays(double(points.size()) * options.samples);
  const Film film = std::move(renderer.estimate(points, options.samples).front());
  fmt::print("value,standard_error,samples\n");
  for (std::size_t i = 0; i < film.pixels(); ++i)
    fmt::print("{:.9g},{:.9g},{}\n", film.value(i),
               standard_error(film, i, renderer.plan().effects[0].weight_bound),
               film.replicates[i] * film.per_replicate);
  warn_of_rejected(renderer.tracer().counters().rejected);
  renderer.tracer().store_programs();
  return 0;
}

}  // namespace

void add_probe_command(CLI::App& app, Command& chosen) {
  auto options = std::make_shared<ProbeOptions>();
  CLI::App* command =
      app.add_subcommand("probe", "Estimate AO or RO at the points of a CSV file; CSV on stdout");
  options->scene.add_to(
      *command, {EffectKind::ao, EffectKind::ro},
      {"--spp", "--directions", "--size", "--crop", "--view", "--margin", "--up", "--ground"});
  options->device.add_to(*command);
  command
      ->add_option(
          "--points", options->points,
          "CSV rows px,py,pz,nx,ny,nz[,vx,vy,vz]; v: direction to the viewer (RO); -: standard input")
      ->required();
  command->add_option("--effect", options->effect, "ao or ro; default: the scene's")
      ->check(CLI::IsMember({"ao", "ro"}));
  command->add_option("--samples", options->samples, "Directions at each point")
      ->check(CLI::Range(1, 1 << 30));
  command->callback([options, &chosen] { chosen = [options] { return probe(*options); }; });
}

}  // namespace nook
