#include "trace/occlusion_tracer.hpp"

#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "base/error.hpp"

namespace nook {
namespace {

// NOOK_TRAVERSAL: for measurements.
std::optional<Traversal> traversal_of_environment() {
  const char* name = std::getenv("NOOK_TRAVERSAL");
  if (!name || !*name) return std::nullopt;
  static constexpr std::pair<std::string_view, Traversal> known[] = {
      {"stream", Traversal::stream}, {"portable", Traversal::portable}, {"scalar", Traversal::scalar}};
  for (const auto& [word, traversal] : known)
    if (name == word) return traversal;
  throw Error(ErrorKind::usage,
              std::string("NOOK_TRAVERSAL is '") + name + "'; it must be stream, portable or scalar");
}

Traversal chosen(const Device& device, Traversal traversal) {
  if (traversal != Traversal::automatic) return traversal;
  if (const auto named = traversal_of_environment()) return *named;
  return device.info().is_cpu() ? Traversal::stream : Traversal::scalar;
}

BuildOptions options_of(const KernelPlan& kernel, Traversal traversal, unsigned width) {
  BuildOptions options = kernel.options;
  if (width != 16) options.define("BVH_WIDTH", width);
  if (traversal == Traversal::scalar) options.define("TRAVERSAL_SCALAR", 1);
  if (traversal == Traversal::portable) options.define("TRAVERSAL_PORTABLE", 1);
  return options;
}

}  // namespace

template <class T>
ClBuffer OcclusionTracer::optional(bool wanted, const std::vector<T>& data) const {
  return wanted ? device_.input(data) : device_.buffer(0, CL_MEM_READ_ONLY);
}

OcclusionTracer::OcclusionTracer(const Device& device, const Plan& plan, const TriangleMesh& mesh,
                                 const Bvh& bvh, const KernelSource& source, Traversal traversal,
                                 Programs programs)
    : device_(device),
      plan_(plan),
      traversal_(chosen(device, traversal)),
      width_(bvh.width()),
      positions_(device.input(mesh.positions)),
      triangles_(device.input(mesh.triangles)),
      programs_(programs.empty() ? build_programs(device, plan, width_, source, traversal)
                                 : std::move(programs)) {
  normals_ = optional(plan_.vertex_normals, mesh.normals);
  triangle_normals_ = optional(plan_.vertex_normals, mesh.triangle_normals);
  triangle_materials_ = optional(plan_.materials, mesh.triangle_material);
  point_set_ = optional(!plan_.point_set.empty(), plan_.point_set);
  exponents_ = optional(!plan_.exponents.empty(), plan_.exponents);
  trees_.push_back(upload(bvh));
  upload_sets(mesh);
  if (plan_.cutouts) {
    cut_outs_ = make_cut_outs(mesh);
    cut_triangles_ = device.input(cut_outs_.triangles);
    opacity_maps_ = device.input(cut_outs_.maps);
    opacity_ = device.input(cut_outs_.opacity);
  }
  for (const auto& [key, program] : programs_) {
    build_seconds_ += program.seconds;
    all_from_cache_ = all_from_cache_ && program.from_cache;
  }
  primary_ = kernel(primary_kernel(plan_));
  for (const EffectPlan& effect : plan_.effects) effects_.push_back(kernel(occlusion_kernel(plan_, effect)));
  counters_.effect_rays.resize(effects_.size());
}

OcclusionTracer::Programs OcclusionTracer::build_programs(const Device& device, const Plan& plan,
                                                          unsigned width, const KernelSource& source,
                                                          Traversal traversal) {
  Programs programs;
  const auto add = [&](const KernelPlan& kernel) {
    const BuildOptions options = options_of(kernel, chosen(device, traversal), width);
    const auto [place, fresh] = programs.try_emplace(kernel.file + options.text());
    if (fresh) place->second = build_program(device, source(kernel.file), options);
  };
  add(primary_kernel(plan));
  for (const EffectPlan& effect : plan.effects) add(occlusion_kernel(plan, effect));
  return programs;
}

OcclusionTracer::Tree OcclusionTracer::upload(const Bvh& bvh) const {
  return {device_.input(bvh.nodes), device_.input(bvh.leaves),
          plan_.instances ? device_.input(bvh.instances) : ClBuffer{}};
}

void OcclusionTracer::upload_sets(const TriangleMesh& mesh) {
  set_trees_.reserve(plan_.occluder_sets.size());
  for (const std::vector<std::uint32_t>& set : plan_.occluder_sets)
    trees_.push_back(upload(set_trees_.emplace_back(build_bvh(mesh, set, {.width = width_}))));
  const bool self = plan_.only_self();
  if (self) {
    group_trees_ = build_group_trees(mesh, width_);
    trees_of_groups_ = upload(group_trees_.trees);
  }
  triangle_groups_ = optional(self, mesh.triangle_group);
  first_of_group_ = optional(self, group_trees_.first);
  for (const EffectPlan& effect : plan_.effects)
    receivers_.push_back(optional(!effect.receivers.empty(), effect.receivers));
}

ClKernel OcclusionTracer::kernel(const KernelPlan& kernel) const {
  return programs_.at(kernel.file + options_of(kernel, traversal_, width_).text())
      .kernel(kernel.entry.c_str());
}

std::vector<Film> OcclusionTracer::make_films() const {
  std::vector<Film> films;
  for (const EffectPlan& effect : plan_.effects)
    films.emplace_back(plan_.window.width(), plan_.window.height(), effect.sum_scale, effect.square_scale,
                       plan_.replicate_directions ? 1 : plan_.directions, effect.extra_planes());
  for (std::size_t e = 0; e < films.size(); ++e) films[e].settings = plan_.effects[e].settings();
  return films;
}

}  // namespace nook
