// nook plan SCENE: what a render of the scene will do, what it leaves out, and why. Renders nothing, and
// opens a device only for the pilot of a scene that leaves its directions open.
#include <fmt/format.h>

#include "adaptive/directions.hpp"
#include "app/commands.hpp"
#include "app/options/loading.hpp"
#include "app/options/scene_options.hpp"
#include "base/counted.hpp"
#include "bvh/bvh.hpp"
#include "plan/kernel_arguments.hpp"
#include "plan/plan_report.hpp"
#include "report/plan_json.hpp"
#include "scene/effect_keys.hpp"
#include "scene/names.hpp"

namespace nook {
namespace {

struct PlanOptions {
  SceneOptions scene;
  DeviceOptions device;
  bool json = false;
};

void print_layers(const Plan& plan) {
  fmt::print("\nLayers\n");
  auto traced = plan.effects.begin();
  for (const LayerPlan& layer : plan.layers) {
    const bool settings = layer.kind != EffectKind::ssao && !is_surface(layer.kind);
    fmt::print("  {:<24} {:<9} {}\n", channels_text(layer), name_of(layer.kind),
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

int show_plan(const PlanOptions& options) {
  const Scene scene = options.scene.load();
  options.scene.check_applicable(scene);
  const TriangleMesh mesh = load_and_warn(scene, needed_attributes(scene), scene.instancing);
  Plan plan = make_plan(scene, mesh);
  std::optional<Bvh> bvh;
  if (plan.needs_opencl()) bvh = build_bvh(mesh);  // of 16 children a node: no device is asked
  std::string chosen;
  if (plan.choose_directions && bvh) {
    options.device.prepare();
    const Device device = options.device.open();
    OcclusionTracer tracer(device, plan, mesh, *bvh);
    const DirectionChoice choice = choose_directions(tracer, plan, scene.stop.error);
    tracer.store_programs();
    plan.directions = choice.directions;
    chosen = why(choice);
  }
  PlanReport report = report_plan(scene, plan, mesh, bvh ? &*bvh : nullptr);
  if (!chosen.empty()) report.picture.emplace_back("directions", chosen);
  if (options.json)
    fmt::print("{}\n", plan_json(plan, mesh, report));
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
  options->device.add_to(*command);
  command->add_flag("--json", options->json, "As JSON");
  command->callback([options, &chosen] { chosen = [options] { return show_plan(*options); }; });
}

}  // namespace nook
