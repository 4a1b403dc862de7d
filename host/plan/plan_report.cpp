#include "plan/plan_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_set>

#include "base/counted.hpp"
#include "kernels/shared/task.h"
#include "plan/cut_outs.hpp"
#include "plan/scene_camera.hpp"
#include "plan/scene_ground.hpp"
#include "plan/surface_sets.hpp"
#include "scene/names.hpp"

namespace nook {
namespace {

std::string point_text(const dvec3& p) {
  return fmt::format("({:.7g}, {:.7g}, {:.7g})", p.x, p.y, p.z);
}

std::string framing_text(const Scene& scene) {
  const std::string name = to_string(scene.view);
  const std::string angles =
      fmt::format("azimuth {:g}, elevation {:g} degrees", scene.view.azimuth, scene.view.elevation);
  return fmt::format("{}, up {}, free on each side: {:g} % of the picture",
                     name.find(',') == name.npos ? fmt::format("{} ({})", name, angles) : angles,
                     point_text(dvec3(scene.camera.up)), 100 * double(scene.margin));
}

std::string ground_text(const TriangleMesh& mesh) {
  const std::optional<Ground> ground = settled_ground(mesh);
  if (!ground) return "left out: " + mesh.why_no_ground;
  return fmt::format("at {} = {:.7g}, {:.7g} world units to each side, facing {}",
                     "xyz"[number_of(*ground->up)], *ground -> height, *ground -> reach,
                     name_of(*ground->up));
}

void add_picture(const Scene& scene, const TriangleMesh& mesh, PlanReport& report) {
  const auto say = [&](std::string name, std::string text) {
    report.picture.emplace_back(std::move(name), std::move(text));
  };
  const Camera camera = resolve_camera(scene, mesh);
  if (scene.automatic_camera) say("view", framing_text(scene));
  say("camera", fmt::format("eye {}, at {}, up {}, fov {:g} degrees", point_text(camera.eye),
                            point_text(camera.at), point_text(dvec3(camera.up)), camera.fov));
  say("ground", scene.ground ? ground_text(mesh) : "none");
  say("background", to_string(scene.background) + ", in the PNG");
}

template <class Vector>
std::uint64_t bytes_of(const Vector& values) {
  return values.size() * sizeof(values[0]);
}

void add_passes(const Plan& plan, const TriangleMesh& mesh, PlanReport& report) {
  if (plan.needs_opencl())
    report.passes.push_back({"tree",
                             plan.instances
                                 ? fmt::format("over {}, {} in all, and one for each of {}, {}",
                                               counted(mesh.instances.size(), "instance"),
                                               counted(mesh.scene_triangles(), "triangle"),
                                               counted(mesh.models.size(), "mesh", "meshes"),
                                               counted(mesh.triangles.size(), "triangle"))
                                 : fmt::format("over {}", counted(mesh.triangles.size(), "triangle")),
                             0});
  for (const auto& set : plan.occluder_sets)
    report.passes.push_back(
        {"tree", fmt::format("over {}, a set of occluders", counted(set.size(), "triangle")), 0});
  if (plan.only_self())
    report.passes.push_back(
        {"trees", fmt::format("one for each of {}", counted(mesh.groups.size(), "group")), 0});
  const std::uint64_t pixels = std::uint64_t(plan.window.width()) * std::uint64_t(plan.window.height());
  if (!plan.effects.empty())
    report.passes.push_back(
        {"primary",
         fmt::format("camera rays to surface points, for {}",
                     plan.effects.size() == 1 ? "one effect"
                                              : fmt::format("{} effects together", plan.effects.size())),
         pixels * plan.spp});
  for (const EffectPlan& effect : plan.effects)
    report.passes.push_back({"occlusion",
                             fmt::format("{} into {}", name_of(effect.effect.kind),
                                         effect.layer.empty() ? "R,G,B" : effect.layer + "*"),
                             pixels * plan.spp * plan.directions});
  if (plan.surface) report.passes.push_back({"surface", "the surface at the pixels' centres", pixels});
  if (plan.denoise) report.passes.push_back({"denoise", "what was traced, on the host", 0});
  for (std::size_t i = 0; i < plan.ssao.size(); ++i)
    report.passes.push_back({"ssao", std::string(name_of(plan.ssao[i].method)), 0});
}

void add_kernels(const Plan& plan, PlanReport& report) {
  if (!plan.needs_opencl()) return;
  report.kernels.push_back(primary_kernel(plan));
  std::unordered_set<std::string> known;
  for (const EffectPlan& effect : plan.effects) {
    KernelPlan kernel = occlusion_kernel(plan, effect);
    if (known.insert(kernel.file + kernel.options.text()).second) report.kernels.push_back(std::move(kernel));
  }
}

void add_buffers(const Plan& plan, const TriangleMesh& mesh, const Bvh& bvh, PlanReport& report) {
  report.buffers = {{"tree nodes", bvh.node_bytes()},
                    {"tree leaves", bytes_of(bvh.leaves)},
                    {"positions", bytes_of(mesh.positions)},
                    {"triangles", bytes_of(mesh.triangles)}};
  if (plan.instances) report.buffers.push_back({"instances", bytes_of(bvh.instances)});
  if (plan.vertex_normals) {
    report.buffers.push_back({"normals", bytes_of(mesh.normals)});
    report.buffers.push_back({"triangle normals", bytes_of(mesh.triangle_normals)});
  }
  for (const auto& set : plan.occluder_sets)
    report.buffers.push_back({"tree of a set", build_bvh(mesh, set, {.width = bvh.width()}).bytes()});
  if (plan.only_self()) {
    const GroupTrees groups = build_group_trees(mesh, bvh.width());
    report.buffers.push_back({"trees of groups", groups.trees.bytes()});
    report.buffers.push_back({"groups", bytes_of(groups.first) + bytes_of(mesh.triangle_group)});
  }
  for (const EffectPlan& effect : plan.effects)
    if (!effect.receivers.empty()) report.buffers.push_back({"receivers", bytes_of(effect.receivers)});
  if (plan.cutouts) {
    const CutOuts cut_outs = make_cut_outs(mesh);
    report.buffers.push_back({"cut-out triangles", bytes_of(cut_outs.triangles)});
    report.buffers.push_back({"opacity maps", bytes_of(cut_outs.maps) + bytes_of(cut_outs.opacity)});
  }
  if (plan.surface)
    report.buffers.push_back({"surface tasks", std::uint64_t(plan.window.width()) *
                                                   std::uint64_t(plan.window.height()) * sizeof(Task)});
  if (plan.materials) {
    report.buffers.push_back({"triangle materials", bytes_of(mesh.triangle_material)});
    report.buffers.push_back({"exponents", bytes_of(plan.exponents)});
  }
}

void add_left_out_rays(const Plan& plan, const TriangleMesh& mesh, PlanReport& report) {
  auto out = [&](std::string why) { report.left_out.push_back(std::move(why)); };
  if (plan.effects.empty()) return;
  out("no occlusion rays where a camera ray hits nothing");
  for (const EffectPlan& effect : plan.effects)
    if (effect.reach)
      out(fmt::format("no rays from points with nothing within {:.9g} of them ({})", effect.max_distance,
                      effect.label()));
  const bool below = std::any_of(plan.effects.begin(), plan.effects.end(), [](const EffectPlan& e) {
    return e.effect.kind == EffectKind::ro || e.effect.sampling == Sampling::sphere;
  });
  if (below) out("no ray for a direction under the horizon of the shading normal");
  for (std::size_t m = 0; m < plan.exponents.size(); ++m)
    if (plan.exponents[m] < 0)
      out(fmt::format("no RO rays for material {}: no lobe", mesh.materials[m].name));
}

void add_left_out(const Scene& scene, const Plan& plan, const TriangleMesh& mesh, PlanReport& report) {
  auto out = [&](std::string why) { report.left_out.push_back(std::move(why)); };
  const MeshAttributes read = needed_attributes(scene, plan.surface);
  if (!plan.needs_opencl()) out("no OpenCL, no kernels, no tree: only SSAO is asked for");
  if (plan.needs_opencl() && plan.effects.empty()) out("no occlusion rays: no effect asks for any");
  if (plan.ssao.empty()) out("no OpenGL: no SSAO is asked for");
  if (!read.normals) out("no vertex normals: no effect reads them");
  if (read.normals && !mesh.has_normals()) out("no vertex normals: the mesh has none");
  if (!read.uvs) out("no texture coordinates: no effect reads them");
  if (!read.materials) out("no materials: no effect reads them");
  if (!read.groups) out("no groups: no effect reads them");
  if (plan.needs_opencl() && !scene.cutouts) out("no cut-outs: the scene does not ask for them (cutouts)");
  if (scene.cutouts && !plan.cutouts)
    out("no cut-outs, no texture is read: no material has an opacity map (map_d)");
  if (plan.cutouts && !plan.ssao.empty()) out("SSAO draws triangles whole: no cut-outs there");
  if (!plan.effects.empty() && !plan.denoise) out("no denoiser: the scene does not ask for it");
  if (plan.instances) out("no copies of instances: a ray goes through the trees of their meshes");
  if (plan.needs_opencl() && !mesh.why_copies.empty())
    out("no tree over instances, they are copies: " + mesh.why_copies);
  add_left_out_rays(plan, mesh, report);
}

}  // namespace

PlanReport report_plan(const Scene& scene, const Plan& plan, const TriangleMesh& mesh, const Bvh* bvh) {
  PlanReport report;
  add_picture(scene, mesh, report);
  add_passes(plan, mesh, report);
  add_kernels(plan, report);
  if (bvh) add_buffers(plan, mesh, *bvh, report);
  if (plan.needs_opencl()) report.libraries.push_back("OpenCL loader and the chosen device's driver");
  if (!plan.ssao.empty()) report.libraries.push_back("OSMesa");
  add_left_out(scene, plan, mesh, report);
  return report;
}

}  // namespace nook
