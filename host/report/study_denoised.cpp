// The denoised picture as a method of a study: what its bias buys.
#include <algorithm>
#include <chrono>
#include <numeric>

#include "picture/denoise_picture.hpp"
#include "report/study_methods.hpp"
#include "scene/effect_keys.hpp"
#include "scene/names.hpp"
#include "trace/occlusion_tracer.hpp"

namespace nook {
namespace {

using Clock = std::chrono::steady_clock;

double rays_of(const RenderCounters& counters) {
  return double(counters.camera_rays + counters.occlusion_rays);
}

}  // namespace

// The time counted is that of the samples, of the surface under the pixels and of the filter.
StudyMethod StudyScene::denoised(std::uint32_t max_spp) const {
  const Sampling sampling = samplings_of(plan_.effects.front().effect).front();
  StudyMethod method;
  method.sampling = name_of(sampling);
  method.sampler = name_of(Sampler::sobol);
  method.name = "denoised " + method.sampling + " " + method.sampler;
  // With fewer samples the variance that steers the filter is not known.
  for (std::uint32_t spp = 4; spp <= std::min(max_spp, 256u); spp *= 4) method.levels.push_back(spp);
  struct Prepared {
    Plan plan;
    std::unique_ptr<OcclusionTracer> tracer;
  };
  const auto program = std::make_shared<Prepared>(Prepared{plan_with(sampling, Sampler::sobol, 1), nullptr});
  program->plan.effects.resize(1);
  method.render = [this, program](double level, std::uint32_t seed) {
    Plan& plan = program->plan;
    if (!program->tracer) program->tracer = std::make_unique<OcclusionTracer>(device_, plan, mesh_, bvh_);
    OcclusionTracer& tracer = *program->tracer;
    const auto spp = std::uint32_t(level);
    const RenderCounters before = tracer.counters();
    std::vector<std::uint32_t> rows(std::size_t(plan.width) * std::size_t(plan.height));
    std::iota(rows.begin(), rows.end(), 0u);
    const Clock::time_point start = Clock::now();
    std::vector<Film> films = tracer.make_films();
    tracer.set_samples(spp, seed);
    tracer.accumulate(pixels_in_order(plan.window, plan.width), {0, spp}, films);
    StudyPicture picture;
    picture.image = denoised_values(films.front(), tracer.surface_points(rows));
    picture.wall_seconds = std::chrono::duration<double>(Clock::now() - start).count();
    picture.device_seconds = tracer.counters().device_seconds - before.device_seconds;
    picture.rays = rays_of(tracer.counters()) - rays_of(before);
    return picture;
  };
  return method;
}

}  // namespace nook
