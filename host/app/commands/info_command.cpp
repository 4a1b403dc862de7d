// nook info SCENE: what is in the mesh, and what the scene's numbers and the flags resolve to.
#include <fmt/format.h>

#include <cmath>

#include "app/commands.hpp"
#include "app/options/loading.hpp"
#include "app/options/scene_options.hpp"
#include "base/counted.hpp"
#include "report/scene_info.hpp"

namespace nook {
namespace {

struct InfoOptions {
  SceneOptions scene;
  bool json = false;
};

void print_mesh(const SceneInfo& info) {
  for (const std::string& file : info.meshes) fmt::print("mesh              {}\n", file);
  fmt::print("triangles         {}\n", info.triangles);
  if (info.instances)
    fmt::print("instances         {} of {}, which have {}\n", info.instances,
               counted(info.models, "mesh", "meshes"), counted(info.model_triangles, "triangle"));
  fmt::print("positions         {}\n", info.positions);
  fmt::print("groups, materials {}, {}\n", info.groups, info.materials);
  fmt::print("bounds            ({:g}, {:g}, {:g}) to ({:g}, {:g}, {:g})\n", info.lo.x, info.lo.y, info.lo.z,
             info.hi.x, info.hi.y, info.hi.z);
  fmt::print("bounding sphere   center ({:g}, {:g}, {:g}), radius {:g}\n", info.center.x, info.center.y,
             info.center.z, info.radius);
  if (info.frame != Frame())
    fmt::print("computed          about ({}, {}, {}), in units of 2^{}\n", info.frame.center.x,
               info.frame.center.y, info.frame.center.z, info.frame.exponent);
  fmt::print("vertex normals    {}\n",
             info.has_normals ? fmt::format("{} ({} corners without, {} not of unit length)", info.normals,
                                            info.corners_without_normal, info.normals_normalised)
                              : "none: geometric normals are used");
  fmt::print("zero-area         {}\n", info.zero_area);
  fmt::print("duplicates        {}\n", info.duplicates);
  fmt::print("NaN or infinite   {} dropped\n", counted(info.non_finite_dropped, "triangle"));
}

void print_picture(const SceneInfo& info) {
  for (const SceneInfo::EffectInfo& effect : info.effects)
    if (effect.traced)
      fmt::print("distance limit    {} for {} ({})\n",
                 std::isinf(effect.max_distance) ? "none" : fmt::format("{:g}", effect.max_distance),
                 effect.name, effect.limit_from);
  fmt::print("picture           {}x{}, pixels {} <= x < {}, {} <= y < {}\n", info.width, info.height,
             info.window.x0, info.window.x1, info.window.y0, info.window.y1);
  const std::string rays = counted(info.camera_rays, "camera ray");
  if (info.sampled)
    fmt::print("samples           {} a pixel, {} of a camera ray, {} from seed {}\n",
               info.targets ? "at most " + rays : rays,
               info.chooses_directions ? "as many directions as a pilot chooses"
                                       : counted(info.directions, "direction"),
               info.sampler, info.seed);
  for (const SceneInfo::EffectInfo& effect : info.effects)
    fmt::print("effect            {}: {}\n", effect.name, effect.settings);
}

int print_info(const InfoOptions& options) {
  const Scene scene = options.scene.load();
  options.scene.check_applicable(scene);
  const TriangleMesh mesh = load_and_warn(
      scene, {.normals = true, .uvs = true, .materials = true, .groups = true}, scene.instancing);
  const SceneInfo info = scene_info(scene, mesh, scene.stop.any() && !options.scene.has("--spp"));
  if (options.json) {
    fmt::print("{}\n", info_json(info));
    return 0;
  }
  print_mesh(info);
  print_picture(info);
  return 0;
}

}  // namespace

void add_info_command(CLI::App& app, Command& chosen) {
  auto options = std::make_shared<InfoOptions>();
  CLI::App* command = app.add_subcommand("info", "Describe a scene's mesh and what its numbers resolve to");
  options->scene.add_to(*command, all_kinds, {"--view", "--margin", "--up", "--ground"});
  command->add_flag("--json", options->json, "As JSON");
  command->callback([options, &chosen] { chosen = [options] { return print_info(*options); }; });
}

}  // namespace nook
