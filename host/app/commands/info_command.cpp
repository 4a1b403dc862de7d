// nook info SCENE: what is in the mesh, and what the scene's numbers and the flags resolve to.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/commands.hpp"
#include "app/options/loading.hpp"
#include "app/options/scene_options.hpp"
#include "base/counted.hpp"
#include "mesh/mesh_analysis.hpp"
#include "plan/plan.hpp"
#include "scene/effect_keys.hpp"
#include "scene/layer_names.hpp"
#include "scene/names.hpp"

namespace nook {
namespace {

void print_picture(const Scene& scene, bool spp_given) {
  const PixelRect window = scene.crop.value_or(PixelRect{0, 0, scene.width, scene.height});
  fmt::print("picture           {}x{}, pixels {} <= x < {}, {} <= y < {}\n", scene.width, scene.height,
             window.x0, window.x1, window.y0, window.y1);
  const bool sampled = std::any_of(scene.effects.begin(), scene.effects.end(),
                                   [](const Effect& effect) { return is_traced(effect.kind); });
  if (sampled)
    fmt::print("samples           {}, {} of a camera ray, {} from seed {}\n",
               scene.stop.any() && !spp_given
                   ? fmt::format("at most {} a pixel", counted(scene.stop.max_spp, "camera ray"))
                   : fmt::format("{} a pixel", counted(scene.spp, "camera ray")),
               counted(scene.directions, "direction"), name_of(scene.sampler), scene.seed);
  const std::vector<std::string> prefixes = layer_prefixes(scene);
  for (std::size_t e = 0; e < scene.effects.size(); ++e)
    fmt::print("effect            {}: {}\n", effect_label(scene.effects[e].kind, prefixes[e]),
               settings_text(scene.effects[e]));
}

// Each file once, in the scene's order.
std::vector<std::filesystem::path> mesh_files(const Scene& scene) {
  if (scene.instances.empty()) return {scene.mesh_file};
  std::vector<std::filesystem::path> files;
  for (const Instance& instance : scene.instances)
    if (std::find(files.begin(), files.end(), instance.mesh_file) == files.end())
      files.push_back(instance.mesh_file);
  return files;
}

int print_info(const SceneOptions& options) {
  const Scene scene = options.load();
  options.check_applicable(scene);
  const TriangleMesh mesh = load_and_warn(
      scene, {.normals = true, .uvs = true, .materials = true, .groups = true}, scene.instancing);
  const MeshAnalysis analysis = analyse(mesh);
  const dvec3 lo = mesh.frame.to_file(dvec3(mesh.bounds.lo)), hi = mesh.frame.to_file(dvec3(mesh.bounds.hi)),
              center = mesh.frame.to_file(dvec3(mesh.bounds.center()));
  for (const std::filesystem::path& file : mesh_files(scene))
    fmt::print("mesh              {}\n", file.string());
  fmt::print("triangles         {}\n", mesh.scene_triangles());
  if (!mesh.instances.empty())
    fmt::print("instances         {} of {}, which have {}\n", mesh.instances.size(),
               counted(mesh.models.size(), "mesh", "meshes"), counted(mesh.triangles.size(), "triangle"));
  fmt::print("positions         {}\n", mesh.positions.size());
  fmt::print("groups, materials {}, {}\n", mesh.groups.size(), mesh.materials.size());
  fmt::print("bounds            ({:g}, {:g}, {:g}) to ({:g}, {:g}, {:g})\n", lo.x, lo.y, lo.z, hi.x, hi.y,
             hi.z);
  fmt::print("bounding sphere   center ({:g}, {:g}, {:g}), radius {:g}\n", center.x, center.y, center.z,
             mesh.frame.to_file(double(mesh.bounds.bounding_radius())));
  if (mesh.frame != Frame())
    fmt::print("computed          about ({}, {}, {}), in units of 2^{}\n", mesh.frame.center.x,
               mesh.frame.center.y, mesh.frame.center.z, mesh.frame.exponent);
  fmt::print("vertex normals    {}\n",
             mesh.has_normals()
                 ? fmt::format("{} ({} corners without, {} not of unit length)", mesh.normals.size(),
                               mesh.report.normals_replaced, mesh.report.normals_normalised)
                 : "none: geometric normals are used");
  fmt::print("zero-area         {}\n", analysis.zero_area);
  fmt::print("duplicates        {}\n", analysis.duplicates);
  fmt::print("NaN or infinite   {} dropped\n", counted(mesh.report.non_finite_dropped, "triangle"));
  const std::vector<std::string> prefixes = layer_prefixes(scene);
  for (std::size_t e = 0; e < scene.effects.size(); ++e) {
    const Effect& effect = scene.effects[e];
    if (!is_traced(effect.kind)) continue;
    const float limit = resolve_distance(effect, subject_radius(mesh), scene.compat_tinyrender);
    fmt::print("distance limit    {} for {} ({})\n", std::isinf(limit) ? "none" : fmt::format("{:g}", limit),
               effect_label(effect.kind, prefixes[e]),
               effect.max_distance.kind == DistanceLimit::Kind::automatic && scene.compat_tinyrender
                   ? "compat = tinyrender"
                   : to_string(effect.max_distance));
  }
  print_picture(scene, options.has("--spp"));
  return 0;
}

}  // namespace

void add_info_command(CLI::App& app, Command& chosen) {
  auto options = std::make_shared<SceneOptions>();
  CLI::App* command = app.add_subcommand("info", "Describe a scene's mesh and what its numbers resolve to");
  options->add_to(*command, all_kinds, {"--view", "--margin", "--up", "--ground"});
  command->callback([options, &chosen] { chosen = [options] { return print_info(*options); }; });
}

}  // namespace nook
