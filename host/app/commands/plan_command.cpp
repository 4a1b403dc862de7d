// nook plan SCENE: what a render of the scene will do, what it leaves out, and why. Renders nothing and opens
// no device.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/commands.hpp"
#include "app/options/loading.hpp"
#include "app/options/scene_options.hpp"
#include "base/counted.hpp"
#include "bvh/bvh.hpp"
#include "plan/kernel_arguments.hpp"
#include "plan/plan_report.hpp"
#include "scene/effect_keys.hpp"
#include "scene/names.hpp"

namespace nook {
namespace {

struct PlanOptions {
  SceneOptions scene;
  bool json = false;
};

std::string layer_text(const LayerPlan& layer) {
  if (layer.prefix.empty()) return "R,G,B";
  if (layer.kind == EffectKind::bent) return layer.prefix + "X,Y,Z,cone,AO";
  return layer.prefix + (layer.kind == EffectKind::depth ? "Z" : is_surface(layer.kind) ? "X,Y,Z" : "R,G,B");
}

void print_layers(const Plan& plan) {
  fmt::print("\nLayers\n");
  auto traced = plan.effects.begin();
  for (const LayerPlan& layer : plan.layers) {
    const bool settings = layer.kind != EffectKind::ssao && !is_surface(layer.kind);
    fmt::print("  {:<24} {:<9} {}\n", layer_text(layer), name_of(layer.kind),
               settings ? settings_text((traced++)->resolved()) : "");
  }
}

void print_table(const Scene& scene, const Plan& plan, const TriangleMesh& mesh, const PlanReport& report) {
  const std::string rays = plan.effects.empty()
                               ? ""
                               : fmt::format("{} a pixel, {} each, ", counted(plan.spp, "camera ray"),
                                             counted(plan.directions, "direction"));
  fmt::print("{}: {}x{} pixels, {}{}\n", scene.file.string(), plan.window.width(), plan.window.height(), rays,
             counted(mesh.scene_triangles(), "triangle"));
  fmt::print("\nPicture\n");
  for (const auto& [name, text] : report.picture) fmt::print("  {:<16} {}\n", name, text);
  print_layers(plan);
  fmt::print("\nPasses\n");
  for (const PassReport& pass : report.passes)
    fmt::print("  {:<16} {}{}\n", pass.name, pass.what,
               pass.rays ? fmt::format(", {}{}", pass.name == "occlusion" ? "at most " : "",
                                       counted(pass.rays, "ray"))
                         : "");
  if (!report.kernels.empty()) fmt::print("\nKernels\n");
  for (const KernelPlan& kernel : report.kernels)
    fmt::print("  {:<20} {}\n  {:<20} takes {}\n", kernel.file, kernel.options.text(), "",
               fmt::join(argument_names(plan, kernel.entry), ", "));
  if (!report.buffers.empty()) fmt::print("\nUploaded\n");
  std::uint64_t sum = 0;
  for (const BufferReport& buffer : report.buffers) {
    fmt::print("  {:<20} {:>14} bytes\n", buffer.name, grouped(buffer.bytes));
    sum += buffer.bytes;
  }
  if (sum) fmt::print("  {:<20} {:>14} bytes\n", "together", grouped(sum));
  fmt::print("\nLibraries\n");
  for (const std::string& library : report.libraries) fmt::print("  {}\n", library);
  fmt::print("\nLeft out\n");
  for (const std::string& what : report.left_out) fmt::print("  {}\n", what);
}

void print_json(const Plan& plan, const TriangleMesh& mesh, const PlanReport& report) {
  nlohmann::json json = {{"width", plan.window.width()},        {"height", plan.window.height()},
                         {"triangles", mesh.scene_triangles()}, {"libraries", report.libraries},
                         {"left_out", report.left_out},         {"kernels", nlohmann::json::array()},
                         {"buffers", nlohmann::json::array()}};
  if (!plan.effects.empty()) {
    json["spp"] = plan.spp;
    json["directions"] = plan.directions;
  }
  for (const auto& [name, text] : report.picture) json["picture"][name] = text;
  auto traced = plan.effects.begin();
  for (const LayerPlan& layer : plan.layers) {
    nlohmann::json entry = {{"channels", layer_text(layer)}, {"type", name_of(layer.kind)}};
    if (layer.kind != EffectKind::ssao && !is_surface(layer.kind))
      entry["settings"] = settings_text((traced++)->resolved());
    json["layers"].push_back(entry);
  }
  for (const PassReport& pass : report.passes)
    json["passes"].push_back({{"name", pass.name}, {"what", pass.what}, {"rays_at_most", pass.rays}});
  for (const KernelPlan& kernel : report.kernels)
    json["kernels"].push_back({{"file", kernel.file},
                               {"options", kernel.options.text()},
                               {"arguments", argument_names(plan, kernel.entry)}});
  for (const BufferReport& buffer : report.buffers)
    json["buffers"].push_back({{"name", buffer.name}, {"bytes", buffer.bytes}});
  fmt::print("{}\n", json.dump(2));
}

int show_plan(const PlanOptions& options) {
  const Scene scene = options.scene.load();
  options.scene.check_applicable(scene);
  const TriangleMesh mesh = load_and_warn(scene, needed_attributes(scene), scene.instancing);
  const Plan plan = make_plan(scene, mesh);
  std::optional<Bvh> bvh;
  if (plan.needs_opencl()) bvh = build_bvh(mesh);  // of 16 children a node: no device is asked
  const PlanReport report = report_plan(scene, plan, mesh, bvh ? &*bvh : nullptr);
  if (options.json)
    print_json(plan, mesh, report);
  else
    print_table(scene, plan, mesh, report);
  return 0;
}

}  // namespace

void add_plan_command(CLI::App& app, Command& chosen) {
  auto options = std::make_shared<PlanOptions>();
  CLI::App* command =
      app.add_subcommand("plan", "Say what a render of a scene will do, what it leaves out, and why");
  options->scene.add_to(*command);
  options->scene.add_background_to(*command);
  command->add_flag("--json", options->json, "As JSON");
  command->callback([options, &chosen] { chosen = [options] { return show_plan(*options); }; });
}

}  // namespace nook
