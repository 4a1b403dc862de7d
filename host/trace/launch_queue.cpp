// Launches what launches.cpp has cut, and adds what comes back to the films.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "device/kernel_call.hpp"
#include "plan/kernel_arguments.hpp"
#include "trace/launch.hpp"

namespace nook {
namespace {

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

EstimatorParams OcclusionTracer::params_for(const EffectPlan& effect, const Launch& launch) const {
  EstimatorParams params{};
  params.samples = launch.samples;
  params.directions = launch.directions;
  params.total_samples = plan_.spp;
  params.total_directions = launch.total_directions;
  params.seed = plan_.seed;
  params.width = launch.points ? 0 : nook_uint(plan_.width);
  params.max_distance = float(plan_.frame.from_file(double(effect.max_distance)));
  params.exponent = effect.effect.exponent;
  params.min_distance = float(plan_.frame.from_file(double(effect.effect.min_distance)));
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
void OcclusionTracer::enqueue(const KernelCall& call, std::size_t count, ClEvent* event) {
  const bool cpu = device_.info().is_cpu();
  const std::size_t local = cpu ? 1 : 64;
  const std::size_t global =
      cpu ? std::max<std::size_t>(count, 1 << 16) : (count + local - 1) / local * local;
  call.run(device_, global, local, event);
  ++counters_.launches;
}

// Where rays go through the tree in streams of 32, the rays of neighbouring pixels fill one together.
cl_uint OcclusionTracer::tasks_sharing_a_stream(std::uint64_t rays_of_task) const {
  return traversal_ == Traversal::scalar ? 1 : cl_uint(std::max<std::uint64_t>(1, 32 / rays_of_task));
}

TreeArguments OcclusionTracer::arguments_of(const Tree& tree) const {
  return {tree.nodes.get(),    tree.leaves.get(), cut_triangles_.get(),
          opacity_maps_.get(), opacity_.get(),    tree.instances.get()};
}

void OcclusionTracer::launch_primary(const EstimatorParams& params, const ClBuffer& tasks, cl_uint count,
                                     cl_mem points, ClEvent* event) {
  PrimaryArguments arguments;
  arguments.positions = positions_.get();
  arguments.triangles = triangles_.get();
  arguments.normals = normals_.get();
  arguments.triangle_normals = triangle_normals_.get();
  arguments.triangle_materials = triangle_materials_.get();
  arguments.camera = plan_.camera;
  arguments.p = params;
  arguments.tasks = tasks.get();
  arguments.task_count = count;
  arguments.tasks_per_item = tasks_sharing_a_stream(params.samples);
  arguments.points = points;
  KernelCall call(primary_);
  add_arguments(call, plan_, arguments_of(trees_.front()));
  add_arguments(call, arguments);
  enqueue(call, (count + arguments.tasks_per_item - 1) / arguments.tasks_per_item, event);
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
    const EffectPlan& effect = plan_.effects[e];
    OcclusionArguments arguments;
    arguments.p = params_for(effect, launch);
    arguments.tasks = slot.tasks.get();
    arguments.task_count = count;
    arguments.tasks_per_item = tasks_per_item;
    arguments.points = points;
    arguments.results = slot.results[e].get();
    arguments.exponents = exponents_.get();
    arguments.positions = positions_.get();
    arguments.triangles = triangles_.get();
    arguments.camera = plan_.camera;
    arguments.bent = slot.extra[e].get();
    arguments.receivers = receivers_[e].get();
    arguments.triangle_groups = triangle_groups_.get();
    arguments.first_of_group = first_of_group_.get();
    arguments.point_set = point_set_.get();
    KernelCall call(effects_[e]);
    add_arguments(call, plan_,
                  arguments_of(effect.effect.only_self ? trees_of_groups_ : trees_[effect.tree]));
    add_arguments(call, arguments);
    enqueue(call, (count + tasks_per_item - 1) / tasks_per_item, &slot.kernels.emplace_back());
    slot.host_results[e].resize(count);
  }
  check_opencl(opencl().clFlush(device_.queue()), "the device failed");
  slot.busy = true;
}

void OcclusionTracer::harvest(Slot& slot, std::span<Film> films) {
  const Launch& launch = slot.launch;
  for (std::size_t e = 0; e < effects_.size(); ++e) {
    auto& results = slot.host_results[e];
    read_buffer(device_, slot.results[e], results.data(), results.size() * sizeof(TaskResult));
    const std::size_t planes = plan_.effects[e].extra_planes();
    auto& extra = slot.host_extra[e];
    extra.resize(results.size() * planes);
    if (planes) read_buffer(device_, slot.extra[e], extra.data(), extra.size() * sizeof(std::uint64_t));
    Film& film = films[e];
    for (std::size_t t = 0; t < results.size(); ++t) {
      const Task& task = launch.tasks[t];
      const std::size_t i = launch.points
                                ? task.point + launch.point_count * (std::max(1u, task.first_sample) - 1)
                                : plan_.film_index(task.pixel);
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
    read_buffer(device_, out, points.data() + begin, count * sizeof(SurfacePoint));
    counters_.camera_rays += count;
  }
  return points;
}

}  // namespace nook
