// nook_bench_micro: warps and samplers by themselves, with Google Benchmark. On the device through kernels
// that run many of them (kernels/micro.cl), on the host as the tests have them: warps from their formulas in
// double precision, samplers as kernels/sample/sampler.cl compiled as C++.
#include <benchmark/benchmark.h>

#include "base/embedded_file.hpp"
#include "device/kernel_source.hpp"
#include "device/program_cache.hpp"
#include "support/samplers_on_host.hpp"
#include "support/warp_oracle.hpp"

namespace nook::bench {

namespace micro_kernels {
extern const EmbeddedFile files[];
}

namespace {

constexpr cl_uint repeats = 256;
constexpr std::size_t work_items = 4096;
constexpr const char* warp_names[] = {"disk", "sphere", "hemisphere", "cosine", "cosine_power"};
constexpr const char* sampler_names[] = {"independent", "stratified", "halton", "sobol", "zorder"};
constexpr float exponent = 30;

const Device& device() {
  static const Device made(select_device(""));
  return made;
}

void on_device(benchmark::State& state, const char* kernel_name, const char* macro, int value,
               float argument) {
  const BuiltProgram program =
      build_program(device(), flatten_kernel(micro_kernels::files[0].path, micro_kernels::files[0].text),
                    BuildOptions().define(macro, value));
  const ClKernel kernel = program.kernel(kernel_name);
  const ClBuffer out = device().buffer(work_items * sizeof(float));
  const cl_mem memory = out.get();
  check_opencl(opencl().clSetKernelArg(kernel.get(), 0, sizeof repeats, &repeats), "clSetKernelArg");
  check_opencl(opencl().clSetKernelArg(kernel.get(), 1, sizeof argument, &argument), "clSetKernelArg");
  check_opencl(opencl().clSetKernelArg(kernel.get(), 2, sizeof memory, &memory), "clSetKernelArg");
  const auto run = [&] {
    check_opencl(opencl().clEnqueueNDRangeKernel(device().queue(), kernel.get(), 1, nullptr, &work_items,
                                                 nullptr, 0, nullptr, nullptr),
                 "clEnqueueNDRangeKernel");
    device().finish();
  };
  run();  // compiles
  for (auto _ : state) run();
  state.SetItemsProcessed(state.iterations() * std::int64_t(work_items) * repeats);
}

std::vector<glm::dvec2> points() {
  std::vector<glm::dvec2> made;
  for (int i = 0; i < 1024; ++i) made.emplace_back((i + 0.5) / 1024, std::fmod(0.6180339887498949 * i, 1.0));
  return made;
}

void host_warp(benchmark::State& state, Warp warp) {
  const std::vector<glm::dvec2> u = points();
  for (auto _ : state)
    for (const glm::dvec2& point : u) benchmark::DoNotOptimize(test::oracle_direction(warp, point, exponent));
  state.SetItemsProcessed(state.iterations() * std::int64_t(u.size()));
}

void host_pdf(benchmark::State& state, Warp warp) {
  std::vector<dvec3> directions;
  for (const glm::dvec2& u : points()) directions.push_back(test::oracle_direction(warp, u, exponent));
  for (auto _ : state)
    for (const dvec3& w : directions) benchmark::DoNotOptimize(test::oracle_pdf(warp, w, exponent));
  state.SetItemsProcessed(state.iterations() * std::int64_t(directions.size()));
}

void host_sampler(benchmark::State& state, Sampler sampler) {
  EstimatorParams p{};
  p.total_samples = 16;
  p.total_directions = repeats;
  p.width = 1024;
  for (auto _ : state)
    for (std::uint32_t i = 0; i < repeats; ++i)
      benchmark::DoNotOptimize(test::host_sample_direction(sampler, 77, 3, i, p));
  state.SetItemsProcessed(state.iterations() * std::int64_t(repeats));
}

void register_all() {
  using benchmark::RegisterBenchmark;
  const auto add = [](const std::string& name, auto function) {
    RegisterBenchmark(name.c_str(), function)->UseRealTime();
  };
  add("device/points_alone",
      [](benchmark::State& s) { on_device(s, "points_alone", "MICRO_WARP", 0, exponent); });
  for (int w = 0; w < 5; ++w) {
    const std::string name = warp_names[w];
    for (const char* kernel : {"warp_map", "warp_map_inverse", "warp_map_pdf"})
      add("device/" + std::string(kernel) + "/" + name,
          [=](benchmark::State& s) { on_device(s, kernel, "MICRO_WARP", w, exponent); });
    add("host/oracle_direction/" + name, [=](benchmark::State& s) { host_warp(s, Warp(w)); });
    add("host/oracle_pdf/" + name, [=](benchmark::State& s) { host_pdf(s, Warp(w)); });
  }
  for (int i = 0; i < 5; ++i) {
    const std::string name = sampler_names[i];
    add("device/sample_direction/" + name,
        [=](benchmark::State& s) { on_device(s, "sampler_directions", "SAMPLER", i, 1); });
    add("host/sample_direction/" + name, [=](benchmark::State& s) { host_sampler(s, Sampler(i)); });
  }
}

}  // namespace
}  // namespace nook::bench

int main(int argc, char** argv) {
  nook::bench::register_all();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
