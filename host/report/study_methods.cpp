#include "report/study_methods.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "adaptive/adaptive.hpp"
#include "base/error.hpp"
#include "scene/effect_keys.hpp"
#include "scene/names.hpp"
#include "ssao/ssao.hpp"
#include "trace/occlusion_tracer.hpp"

namespace nook {
namespace {

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

std::uint64_t rays(const RenderCounters& c) {
  return c.camera_rays + c.occlusion_rays;
}

Scene studied(const Scene& scene, int width, int height) {
  Scene made = scene;
  made.width = width;
  made.height = height;
  made.crop.reset();
  const auto occlusion = std::find_if(made.effects.begin(), made.effects.end(), [](const Effect& e) {
    return e.kind == EffectKind::ao || e.kind == EffectKind::ro || e.kind == EffectKind::ssao;
  });
  if (occlusion == made.effects.end())
    throw Error(ErrorKind::scene, Place{scene.file.string()}, "a study needs a scene of type ao, ro or ssao");
  Effect effect = *occlusion;
  if (effect.kind == EffectKind::ssao) {
    effect.kind = EffectKind::ao;
    effect.sampling = Sampling::cosine;
    effect.max_distance = effect.ssao.radius > 0
                              ? DistanceLimit{DistanceLimit::Kind::value, effect.ssao.radius}
                              : DistanceLimit{};
  }
  effect.name.clear();
  made.effects = {effect};
  made.realtime = false;
  made.directions = 1;
  made.spp = 2;
  return made;
}

}  // namespace

// A method's kernels, built before its first run: a study that is interrupted, or only counts its methods,
// need not build what it does not use.
struct StudyScene::Program {
  Plan plan;
  std::unique_ptr<OcclusionTracer> tracer;
  std::vector<std::uint32_t> order;

  OcclusionTracer& get(const StudyScene& scene) {
    if (!tracer) {
      tracer = std::make_unique<OcclusionTracer>(scene.device_, plan, scene.mesh_, scene.bvh_);
      order = pixels_in_order(plan.window, plan.width);
      std::vector<Film> warm = tracer->make_films();  // the first launch loads the program's code
      tracer->accumulate(std::span(order).first(1), {0, 1}, warm);
      tracer->store_programs();
    }
    return *tracer;
  }
};

StudyScene::StudyScene(const Device& device, const Scene& scene, const TriangleMesh& mesh, const Bvh& bvh,
                       int width, int height)
    : device_(device),
      scene_(studied(scene, width, height)),
      mesh_(mesh),
      bvh_(bvh),
      plan_(make_plan(scene_, mesh)) {}

Plan StudyScene::plan_with(Sampling sampling, Sampler sampler, std::uint32_t directions) const {
  Scene scene = scene_;
  scene.effects.front().sampling = sampling;
  scene.sampler = sampler;
  scene.directions = directions;
  scene.direction_choice = Scene::DirectionChoice::given;
  return make_plan(scene, mesh_);
}

StudyMethod StudyScene::ray_traced(Sampling sampling, Sampler sampler, std::uint32_t directions,
                                   std::uint32_t max_spp) const {
  StudyMethod method;
  method.sampling = name_of(sampling);
  method.sampler = name_of(sampler);
  method.directions = directions;
  method.name =
      method.sampling + " " + method.sampler + (directions > 1 ? fmt::format(" x{}", directions) : "");
  for (std::uint32_t spp = 1; spp <= max_spp && spp * directions <= std::max(1024u, max_spp); spp *= 2)
    method.levels.push_back(spp);
  const auto program = std::make_shared<Program>(Program{plan_with(sampling, sampler, directions), {}, {}});
  method.render = [this, program](double level, std::uint32_t seed) {
    OcclusionTracer& tracer = program->get(*this);
    const std::vector<std::uint32_t>& order = program->order;
    const auto spp = std::uint32_t(level);
    const RenderCounters before = tracer.counters();
    const Clock::time_point start = Clock::now();
    std::vector<Film> films = tracer.make_films();
    tracer.set_samples(spp, seed);
    tracer.accumulate(order, {0, spp}, films);
    const Film& film = films.front();
    StudyPicture picture;
    picture.image.resize(film.pixels());
    for (std::size_t i = 0; i < film.pixels(); ++i) picture.image[i] = float(film.value(i));
    picture.wall_seconds = seconds_since(start);
    picture.device_seconds = tracer.counters().device_seconds - before.device_seconds;
    picture.rays = rays(tracer.counters()) - rays(before);
    if (spp > 1) {
      picture.variance.resize(film.pixels());
      for (std::size_t i = 0; i < film.pixels(); ++i) picture.variance[i] = float(film.variance(i));
    }
    return picture;
  };
  return method;
}

StudyMethod StudyScene::adaptive(Sampler sampler) const {
  StudyMethod method;
  const Sampling sampling = samplings_of(plan_.effects.front().effect).front();
  method.name = std::string("adaptive ") + std::string(name_of(sampler));
  method.family = StudyMethod::Family::adaptive;
  method.sampling = name_of(sampling);
  method.sampler = name_of(sampler);
  method.levels =
      sampler == Sampler::independent ? std::vector{.1, .05, .02, .01} : std::vector{.02, .01, .005};
  const Plan plan =
      AdaptiveRender::plan_for(plan_with(sampling, sampler, 1), {.error = method.levels.back()});
  const auto program = std::make_shared<Program>(Program{plan, {}, {}});
  method.render = [this, program](double level, std::uint32_t seed) {
    OcclusionTracer& tracer = program->get(*this);
    const RenderCounters before = tracer.counters();
    const Clock::time_point start = Clock::now();
    Plan seeded = program->plan;
    seeded.seed = seed;
    tracer.set_samples(seeded.spp, seed);
    AdaptiveResult result = AdaptiveRender(tracer, seeded, {.error = level}).run();
    StudyPicture picture;
    picture.wall_seconds = seconds_since(start);
    picture.device_seconds = tracer.counters().device_seconds - before.device_seconds;
    picture.rays = rays(tracer.counters()) - rays(before);
    picture.image = std::move(result.effects.front().value);
    picture.variance = std::move(result.effects.front().variance);
    picture.samples = std::move(result.effects.front().samples);
    return picture;
  };
  return method;
}

StudyMethod StudyScene::screen_space(SsaoSettings::Method kind,
                                     std::optional<SsaoSettings::Quality> quality) const {
  StudyMethod method;
  method.name = fmt::format("ssao {}{}", name_of(kind), quality ? fmt::format(" {}", name_of(*quality)) : "");
  method.family = StudyMethod::Family::ssao;
  method.random = false;
  method.levels = {4, 8, 16, 32};
  if (quality) method.levels = {32};
  SsaoSettings settings;
  settings.method = kind;
  settings.quality = quality;
  settings.radius = plan_.effects.front().max_distance;
  const auto renderer = std::make_shared<SsaoRenderer>(mesh_);
  renderer->render(scene_.camera, settings, scene_.width, scene_.height);  // compiles the shaders
  method.render = [renderer, settings, scene = scene_](double level, std::uint32_t) {
    SsaoSettings now = settings;
    now.samples = int(level);
    const Clock::time_point start = Clock::now();
    SsaoFrame frame = renderer->render(scene.camera, now, scene.width, scene.height);
    StudyPicture picture;
    picture.wall_seconds = seconds_since(start);
    picture.image = std::move(frame.occlusion);
    return picture;
  };
  return method;
}

std::vector<StudyMethod> StudyScene::methods(const StudyChoice& choice, std::string* warning) const {
  const EffectPlan& effect = plan_.effects.front();
  const bool ro = effect.effect.kind == EffectKind::ro;
  std::vector<Sampling> all_samplings = samplings_of(effect.effect);
  all_samplings.resize(std::min<std::size_t>(3, all_samplings.size()));  // RO: none worse than the cosine
  const std::vector<Sampler> all_samplers = {Sampler::independent, Sampler::stratified, Sampler::halton,
                                             Sampler::sobol, Sampler::zorder};
  const bool chosen = !choice.samplings.empty() || !choice.samplers.empty();
  std::vector<StudyMethod> methods;
  for (const Sampling sampling : choice.samplings.empty() ? all_samplings : choice.samplings)
    for (const Sampler sampler : choice.samplers.empty() ? all_samplers : choice.samplers) {
      // By default every sampler with the best distribution, and every distribution with two samplers.
      if (!chosen && sampling != all_samplings.front() && sampler != Sampler::independent &&
          sampler != Sampler::sobol)
        continue;
      methods.push_back(ray_traced(sampling, sampler, 1, choice.max_spp));
    }
  if (!chosen) methods.push_back(ray_traced(all_samplings.front(), Sampler::sobol, 16, choice.max_spp));
  if (choice.predictions) predict(methods);
  if (!chosen) methods.push_back(denoised(choice.max_spp));
  if (choice.adaptive)
    for (const Sampler sampler : {Sampler::independent, Sampler::sobol}) methods.push_back(adaptive(sampler));
  if (choice.ssao && !ro && std::isfinite(effect.max_distance) && !scene_.automatic_camera) {
    using Quality = SsaoSettings::Quality;
    try {
      for (const auto kind :
           {SsaoSettings::Method::point, SsaoSettings::Method::gtao, SsaoSettings::Method::march})
        methods.push_back(screen_space(kind, std::nullopt));
      for (const auto quality : {Quality::draft, Quality::real_time, Quality::accurate})
        methods.push_back(screen_space(SsaoSettings::Method::march, quality));
    } catch (const Error& e) {
      if (e.kind() != ErrorKind::device) throw;
      if (warning) *warning = fmt::format("the study goes without SSAO: {}", e.what());
    }
  }
  return methods;
}

}  // namespace nook
