#include "trace/occlusion_tracer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/error.hpp"
#include "trace/launch.hpp"

namespace nook {
namespace {

template <class T>
void set_arg(cl_kernel kernel, cl_uint& index, const T& value) {
  check_opencl(opencl().clSetKernelArg(kernel, index++, sizeof(T), &value), "cannot set a kernel argument");
}

void set_arg(cl_kernel kernel, cl_uint& index, const ClBuffer& buffer) {
  const cl_mem memory = buffer.get();
  set_arg(kernel, index, memory);
}

Traversal chosen(const Device& device, Traversal traversal) {
  if (traversal != Traversal::automatic) return traversal;
  return device.info().is_cpu() ? Traversal::stream : Traversal::scalar;
}

BuildOptions options_of(const KernelPlan& kernel, Traversal traversal, unsigned width) {
  BuildOptions options = kernel.options;
  if (width != 16) options.define("BVH_WIDTH", width);
  if (traversal == Traversal::scalar) options.define("TRAVERSAL_SCALAR", 1);
  if (traversal == Traversal::portable) options.define("TRAVERSAL_PORTABLE", 1);
  return options;
}

// What a finished kernel took; 0 where the device keeps no time.
double seconds_of(const ClEvent& kernel) {
  cl_ulong start = 0, end = 0;
  const auto get = opencl().clGetEventProfilingInfo;
  if (get(kernel.get(), CL_PROFILING_COMMAND_START, sizeof start, &start, nullptr) != CL_SUCCESS ||
      get(kernel.get(), CL_PROFILING_COMMAND_END, sizeof end, &end, nullptr) != CL_SUCCESS || end < start)
    return 0;
  return 1e-9 * double(end - start);
}

}  // namespace

struct OcclusionTracer::Slot {
  Launch launch;
  ClBuffer tasks, points;
  std::size_t task_capacity = 0, point_capacity = 0;
  std::vector<ClBuffer> results;
  std::vector<std::vector<TaskResult>> host_results;
  std::vector<ClEvent> kernels;  // launched and not yet added to the counters
  std::vector<ClBuffer> extra;   // by effect; of those without extra sums, one unused byte
  std::vector<std::vector<std::uint64_t>> host_extra;
  bool busy = false;
};

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

void OcclusionTracer::set_tree(cl_kernel kernel, cl_uint& arg, const Tree& tree) const {
  set_arg(kernel, arg, tree.nodes);
  set_arg(kernel, arg, tree.leaves);
  if (plan_.cutouts)
    for (const ClBuffer* buffer : {&cut_triangles_, &opacity_maps_, &opacity_}) set_arg(kernel, arg, *buffer);
  if (plan_.instances) set_arg(kernel, arg, tree.instances);
}

ClKernel OcclusionTracer::kernel(const KernelPlan& kernel) const {
  return programs_.at(kernel.file + options_of(kernel, traversal_, width_).text())
      .kernel(kernel.entry.c_str());
}

EstimatorParams OcclusionTracer::params_for(const EffectPlan& effect, const Launch& launch) const {
  EstimatorParams params{};
  params.samples = launch.samples;
  params.directions = launch.directions;
  params.total_samples = plan_.spp;
  params.total_directions = launch.total_directions;
  params.seed = plan_.seed;
  params.width = launch.points ? 0 : nook_uint(plan_.width);
  params.max_distance = effect.max_distance;
  params.exponent = effect.effect.exponent;
  params.min_distance = effect.effect.min_distance;
  const double half_angle = double(effect.effect.cone_angle) * std::numbers::pi / 180;
  params.cone_sine = float(std::sin(half_angle));
  params.cone_cosine = float(std::cos(half_angle));
  params.sum_scale = effect.sum_scale;
  params.square_scale = effect.square_scale;
  return params;
}

// One work-item a work-group on CPUs: the streams are the vectors there, and PoCL's work-item loops would
// split them. Below 2^16 work-groups PoCL would compile a version of the kernel that its binaries lack; the
// kernels return at once from work-items behind the last task.
void OcclusionTracer::enqueue(cl_kernel kernel, std::size_t count, ClEvent* event) {
  const bool cpu = device_.info().is_cpu();
  const std::size_t local = cpu ? 1 : 64;
  const std::size_t global =
      cpu ? std::max<std::size_t>(count, 1 << 16) : (count + local - 1) / local * local;
  cl_event raw = nullptr;
  check_opencl(opencl().clEnqueueNDRangeKernel(device_.queue(), kernel, 1, nullptr, &global, &local, 0,
                                               nullptr, event ? &raw : nullptr),
               "cannot launch a kernel");
  if (event) *event = ClEvent(raw);
  ++counters_.launches;
}

// Where rays go through the tree in streams of 32, the rays of neighbouring pixels fill one together.
cl_uint OcclusionTracer::tasks_sharing_a_stream(std::uint64_t rays_of_task) const {
  return traversal_ == Traversal::scalar ? 1 : cl_uint(std::max<std::uint64_t>(1, 32 / rays_of_task));
}

void OcclusionTracer::launch_primary(const EstimatorParams& params, const ClBuffer& tasks, cl_uint count,
                                     cl_mem points, ClEvent* event) {
  const cl_uint tasks_per_item = tasks_sharing_a_stream(params.samples);
  const cl_kernel kernel = primary_.get();
  cl_uint arg = 0;
  set_tree(kernel, arg, trees_.front());
  for (const ClBuffer* buffer :
       {&positions_, &triangles_, &normals_, &triangle_normals_, &triangle_materials_})
    set_arg(kernel, arg, *buffer);
  set_arg(kernel, arg, plan_.camera);
  set_arg(kernel, arg, params);
  set_arg(kernel, arg, tasks);
  set_arg(kernel, arg, count);
  set_arg(kernel, arg, tasks_per_item);
  set_arg(kernel, arg, points);
  enqueue(kernel, (count + tasks_per_item - 1) / tasks_per_item, event);
}

void OcclusionTracer::submit(Slot& slot) {
  Launch& launch = slot.launch;
  const auto count = cl_uint(launch.tasks.size());
  if (slot.task_capacity < count) {
    slot.task_capacity = count;
    slot.tasks = device_.buffer(count * sizeof(Task), CL_MEM_READ_ONLY);
    slot.results.clear();
    slot.extra.clear();
    for (const EffectPlan& effect : plan_.effects) {
      slot.results.push_back(device_.buffer(count * sizeof(TaskResult)));
      slot.extra.push_back(device_.buffer(count * effect.extra_planes() * sizeof(std::uint64_t)));
    }
  }
  check_opencl(opencl().clEnqueueWriteBuffer(device_.queue(), slot.tasks.get(), CL_FALSE, 0,
                                             count * sizeof(Task), launch.tasks.data(), 0, nullptr, nullptr),
               "cannot send tasks");
  cl_mem points = launch.points;
  if (!points) {
    const std::size_t needed = std::size_t(count) * launch.samples;
    if (slot.point_capacity < needed) {
      slot.point_capacity = needed;
      slot.points = device_.buffer(needed * sizeof(SurfacePoint));
    }
    points = slot.points.get();
    launch_primary(params_for(EffectPlan{}, launch), slot.tasks, count, points, &slot.kernels.emplace_back());
  }
  slot.host_results.resize(effects_.size());
  slot.host_extra.resize(effects_.size());
  const cl_uint tasks_per_item = tasks_sharing_a_stream(std::uint64_t(launch.samples) * launch.directions);
  for (std::size_t e = 0; e < effects_.size(); ++e) {
    const cl_kernel kernel = effects_[e].get();
    cl_uint arg = 0;
    const EffectPlan& effect = plan_.effects[e];
    set_tree(kernel, arg, effect.effect.only_self ? trees_of_groups_ : trees_[effect.tree]);
    set_arg(kernel, arg, params_for(effect, launch));
    set_arg(kernel, arg, slot.tasks);
    set_arg(kernel, arg, count);
    set_arg(kernel, arg, tasks_per_item);
    set_arg(kernel, arg, points);
    set_arg(kernel, arg, slot.results[e]);
    for (const ClBuffer* buffer : {&exponents_, &positions_, &triangles_}) set_arg(kernel, arg, *buffer);
    set_arg(kernel, arg, plan_.camera);
    set_arg(kernel, arg, slot.extra[e]);
    for (const ClBuffer* buffer : {&receivers_[e], &triangle_groups_, &first_of_group_})
      set_arg(kernel, arg, *buffer);
    enqueue(kernel, (count + tasks_per_item - 1) / tasks_per_item, &slot.kernels.emplace_back());
    slot.host_results[e].resize(count);
  }
  check_opencl(opencl().clFlush(device_.queue()), "the device failed");
  slot.busy = true;
}

void OcclusionTracer::harvest(Slot& slot, std::span<Film> films) {
  const Launch& launch = slot.launch;
  for (std::size_t e = 0; e < effects_.size(); ++e) {
    auto& results = slot.host_results[e];
    check_opencl(opencl().clEnqueueReadBuffer(device_.queue(), slot.results[e].get(), CL_TRUE, 0,
                                              results.size() * sizeof(TaskResult), results.data(), 0, nullptr,
                                              nullptr),
                 "the device failed");
    const std::size_t planes = plan_.effects[e].extra_planes();
    auto& extra = slot.host_extra[e];
    extra.resize(results.size() * planes);
    if (planes)
      check_opencl(opencl().clEnqueueReadBuffer(device_.queue(), slot.extra[e].get(), CL_TRUE, 0,
                                                extra.size() * sizeof(std::uint64_t), extra.data(), 0,
                                                nullptr, nullptr),
                   "the device failed");
    Film& film = films[e];
    for (std::size_t t = 0; t < results.size(); ++t) {
      const std::size_t i = launch.points ? launch.tasks[t].pixel : plan_.film_index(launch.tasks[t].pixel);
      film.sum[i] += results[t].sum;
      film.sum_square[i] += results[t].sum_square;
      film.replicates[i] += plan_.replicate_directions ? launch.samples * launch.directions : launch.samples;
      if (launch.first_directions) {
        film.camera_samples[i] += launch.samples;
        film.hits[i] += results[t].hits;
      }
      if (free_plane_ && *free_plane_ < film.kept.size()) film.kept[*free_plane_][i] += results[t].free;
      for (std::size_t plane = 0; plane < planes; ++plane) film.extra[plane][i] += extra[planes * t + plane];
      counters_.occlusion_rays += results[t].rays;
      counters_.effect_rays[e] += results[t].rays;
      counters_.rejected += results[t].rejected;
    }
  }
  if (!launch.points) counters_.camera_rays += launch.tasks.size() * std::uint64_t(launch.samples);
  for (const ClEvent& kernel : slot.kernels) counters_.device_seconds += seconds_of(kernel);
  slot.kernels.clear();
  slot.busy = false;
}

// Two launches are under way at any time: the device works on one while the host adds up the other.
bool OcclusionTracer::run(const NextLaunch& next, std::span<Film> films, const Progress& progress) {
  std::array<Slot, 2> slots;
  // Commands still under way read the slots' memory, also when an exception leaves.
  const struct Drain {
    cl_command_queue queue;
    ~Drain() { opencl().clFinish(queue); }
  } drain{device_.queue()};
  bool more = true, stopped = false;
  for (std::size_t turn = 0; more || slots[turn % 2].busy || slots[(turn + 1) % 2].busy; ++turn) {
    Slot& slot = slots[turn % 2];
    if (slot.busy) {
      harvest(slot, films);
      if (progress && !progress(slot.launch.finished) && more) {
        more = false;
        stopped = true;
      }
    }
    slot.launch.tasks.clear();
    slot.launch.finished.clear();
    if (more && (more = next(slot.launch))) submit(slot);
  }
  return !stopped;
}

std::vector<Film> OcclusionTracer::make_films() const {
  std::vector<Film> films;
  for (const EffectPlan& effect : plan_.effects)
    films.emplace_back(plan_.window.width(), plan_.window.height(), effect.sum_scale, effect.square_scale,
                       plan_.replicate_directions ? 1 : plan_.directions, effect.extra_planes());
  return films;
}

std::vector<SurfacePoint> OcclusionTracer::surface_points(std::span<const std::uint32_t> pixels) {
  std::vector<SurfacePoint> points(pixels.size());
  std::vector<Task> tasks;
  const Launch one;
  EstimatorParams params = params_for(EffectPlan{}, one);
  params.total_samples = 1;  // the pixel's centre
  for (std::size_t begin = 0; begin < pixels.size(); begin += points_per_launch) {
    const std::size_t count = std::min<std::size_t>(points_per_launch, pixels.size() - begin);
    tasks.clear();
    for (std::size_t i = 0; i < count; ++i) tasks.push_back({pixels[begin + i], 0, 0, nook_uint(i)});
    const ClBuffer task_buffer = device_.input(tasks);
    const ClBuffer out = device_.buffer(count * sizeof(SurfacePoint));
    launch_primary(params, task_buffer, cl_uint(count), out.get());
    check_opencl(
        opencl().clEnqueueReadBuffer(device_.queue(), out.get(), CL_TRUE, 0, count * sizeof(SurfacePoint),
                                     points.data() + begin, 0, nullptr, nullptr),
        "the device failed");
    counters_.camera_rays += count;
  }
  return points;
}

}  // namespace nook
