// nook_bench effects: the time of each effect and setting over that of plain AO, in rounds that take turns;
// and that what is switched off costs nothing.
#include "effects.hpp"

#include <algorithm>
#include <cstdio>
#include <functional>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "bench/support/interval.hpp"
#include "bench/support/record.hpp"
#include "bench/support/stopwatch.hpp"
#include "picture/denoise_picture.hpp"
#include "picture/picture.hpp"
#include "picture/surface_layers.hpp"
#include "points/texture_points.hpp"
#include "render/scene_renderer.hpp"
#include "scene/scene_toml.hpp"

namespace nook::bench {
namespace {

struct Settings {
  int width = 320, height = 240, spp = 16, rounds = 15;
  bool check = false;
  std::vector<std::string> cases;
  std::string output;
};

struct Case {
  std::string name;
  std::string scene;  // of scenes/, without .toml
  std::function<void(Scene&)> change;
  enum class What { picture, denoised, texture } what = What::picture;
  bool control = false;  // both sides are the same programs: what the ratio must be is known
};

std::vector<Case> all_cases() {
  const auto first = [](auto change) { return [change](Scene& scene) { change(scene.effects.front()); }; };
  const auto falloff = [&](Falloff kind) { return first([kind](Effect& e) { e.falloff = kind; }); };
  const std::string box = "cbox_ao_cosine", plants = "effects/cutouts";
  return {
      {"plain AO again", box, [](Scene&) {}, Case::What::picture, true},
      {"every setting named, at its default", box,
       [](Scene& scene) {
         scene.cutouts = true;  // no material has a map
         scene.denoise = false;
         Effect& e = scene.effects.front();
         e.falloff = Falloff::none;
         e.min_distance = 0;
         e.cone_angle = 90;
         e.side = Side::normal;
         e.only_self = false;
         scene.instancing = Instancing::automatic;
       },
       Case::What::picture, true},
      {"falloff linear", box, falloff(Falloff::linear)},
      {"falloff smooth", box, falloff(Falloff::smooth)},
      {"falloff exponential", box, falloff(Falloff::exponential)},
      {"min_distance", box, first([](Effect& e) { e.min_distance = 0.1f; })},
      {"cone_angle 30", box, first([](Effect& e) { e.cone_angle = 30; })},
      {"side inside", box, first([](Effect& e) { e.side = Side::inside; })},
      {"side viewer", box, first([](Effect& e) { e.side = Side::viewer; })},
      {"occluders: two groups", box, first([](Effect& e) {
         e.occluders = {"sphere_left", "sphere_right"};
       })},
      {"receivers: two groups", box, first([](Effect& e) {
         e.receivers = {"sphere_left", "sphere_right"};
       })},
      {"occluders self", box, first([](Effect& e) { e.only_self = true; })},
      {"bent", box, first([](Effect& e) { e.kind = EffectKind::bent; })},
      {"bent, view space", box, first([](Effect& e) { e.kind = EffectKind::bent, e.view_space = true; })},
      {"ro, exponent 30", box,
       first([](Effect& e) { e.kind = EffectKind::ro, e.sampling = Sampling::lobe; })},
      {"ro, exponent of the material", box, first([](Effect& e) {
         e.kind = EffectKind::ro, e.sampling = Sampling::lobe, e.exponent_of_material = true;
       })},
      {"normal, position and depth beside it", box,
       [](Scene& scene) {
         for (const EffectKind kind : {EffectKind::normal, EffectKind::position, EffectKind::depth}) {
           Effect surface;
           surface.kind = kind;
           scene.effects.push_back(surface);
         }
       }},
      {"instances as trees, against copies", "effects/instances",
       [](Scene& scene) { scene.instancing = Instancing::tree; }},
      {"ground", box, [](Scene& scene) { scene.ground.emplace(); }},
      {"cut-outs", plants, [](Scene& scene) { scene.cutouts = true; }},
      {"denoise", box, [](Scene& scene) { scene.denoise = true; }, Case::What::denoised},
      {"texture bake, by the ray", "effects/bake", [](Scene&) {}, Case::What::texture},
  };
}

// One scene ready to run, again and again.
class Run {
 public:
  Run(const Scene& scene, Case::What what)
      : what_(what),
        renderer_(
            scene, [] { return Device(select_device("cpu")); }, options_of(scene, what)),
        tracer_(renderer_.tracer()),
        pixels_(pixels_in_order(plan().window, plan().width)) {
    if (what == Case::What::texture) texels_ = texture_points(renderer_.mesh(), 128);
    tracer_.store_programs();
  }

  struct Cost {
    double seconds = 0;
    std::uint64_t rays = 0;
  };
  Cost once() {
    const std::uint64_t before = tracer_.counters().occlusion_rays;
    const Stopwatch watch = started();
    if (what_ == Case::What::texture)
      tracer_.estimate_all(texels_.points, 64);
    else
      picture();
    return {watch.seconds(), tracer_.counters().occlusion_rays - before};
  }

 private:
  static SceneRendererOptions options_of(const Scene& scene, Case::What what) {
    SceneRendererOptions options;
    options.attributes = attributes_of(scene, what);
    return options;
  }
  static MeshAttributes attributes_of(const Scene& scene, Case::What what) {
    MeshAttributes attributes = needed_attributes(scene);
    attributes.uvs = attributes.uvs || what == Case::What::texture;
    return attributes;
  }

  void picture() {
    FilmPart part;
    part.films = tracer_.make_films();
    part.layers = layer_names(plan());
    tracer_.accumulate(pixels_, {0, plan().spp}, part.films);
    Image image = make_picture(part);
    if (!plan().surface) return;
    std::vector<std::uint32_t> row_major(pixels_);
    std::sort(row_major.begin(), row_major.end());
    const std::vector<SurfacePoint> surface = tracer_.surface_points(row_major);
    add_surface_layers(plan(), surface, image.channels);
    if (what_ == Case::What::denoised) denoise_picture(plan(), part.films, surface, image);
  }

  const Plan& plan() const { return renderer_.plan(); }

  Case::What what_;
  SceneRenderer renderer_;
  OcclusionTracer& tracer_;
  std::vector<std::uint32_t> pixels_;
  TexturePoints texels_;
};

Scene scene_of(const Settings& settings, const std::string& name) {
  Scene scene = load_scene(std::string(NOOK_SOURCE_DIR) + "/scenes/" + name + ".toml");
  scene.width = settings.width;
  scene.height = settings.height;
  scene.spp = std::uint32_t(settings.spp);
  scene.cutouts = false;
  Effect& effect = scene.effects.front();
  effect.max_distance = {DistanceLimit::Kind::value, 1.0f};
  effect.side = Side::normal;
  return scene;
}

void measure(const Settings& settings, const Case& one) {
  Scene scene = scene_of(settings, one.scene);
  Run plain(scene, Case::What::picture);
  one.change(scene);
  Run changed(scene, one.what);
  plain.once();
  changed.once();
  std::vector<double> ratios;
  Run::Cost a, b;
  // The controls, which must be 1.00 ± 0.02, take more rounds.
  const int rounds = one.control ? 4 * settings.rounds : settings.rounds;
  for (int round = 0; round < rounds; ++round) {
    // Plain, changed, changed, plain, or the other way round, so that a drift of the machine cancels.
    Run& outer = round % 2 ? changed : plain;
    Run& inner = round % 2 ? plain : changed;
    Run::Cost first = outer.once(), second = inner.once(), third = inner.once(), fourth = outer.once();
    a = round % 2 ? second : first;
    b = round % 2 ? first : second;
    const double out = first.seconds + fourth.seconds, in = second.seconds + third.seconds;
    double ratio = round % 2 ? out / in : in / out;
    if (one.what == Case::What::texture) ratio *= double(a.rays) / double(b.rays);
    ratios.push_back(ratio);
  }
  const auto [least, greatest] = std::minmax_element(ratios.begin(), ratios.end());
  const auto [low, high] = interval_of_median(ratios);
  std::printf("| %s | %.3f [%.3f, %.3f] | %.2f |\n", one.name.c_str(), median(ratios), low, high,
              double(b.rays) / double(a.rays));
  std::fflush(stdout);
  append_record(settings.output, {{"bench", "effects"},
                                  {"case", one.name},
                                  {"scene", one.scene},
                                  {"width", settings.width},
                                  {"height", settings.height},
                                  {"spp", settings.spp},
                                  {"rounds", rounds},
                                  {"cpu_time", measured == Stopwatch::Of::threads},
                                  {"ratio", median(ratios)},
                                  {"interval", {low, high}},
                                  {"least", *least},
                                  {"greatest", *greatest},
                                  {"rays", b.rays},
                                  {"rays_of_plain", a.rays}});
  if (settings.check && one.control && !(low >= 0.98 && high <= 1.02))
    throw Error(ErrorKind::internal,
                one.name + ": what is switched off takes time, or the machine is too busy to tell");
}

void run(const Settings& settings) {
  std::printf("| against plain AO | time | rays |\n|---|---|---|\n");
  bool any = false;
  for (const Case& one : all_cases()) {
    const bool asked =
        settings.cases.empty() ||
        std::any_of(settings.cases.begin(), settings.cases.end(),
                    [&](const std::string& part) { return one.name.find(part) != std::string::npos; });
    if (!asked) continue;
    any = true;
    measure(settings, one);
  }
  if (!any) throw Error(ErrorKind::usage, "--cases: no case has such a name");
}

}  // namespace

void add_effects(CLI::App& app) {
  auto settings = std::make_shared<Settings>();
  CLI::App* command = app.add_subcommand("effects", "Each effect and setting against plain AO");
  command->add_option("--width", settings->width, "Pixels");
  command->add_option("--height", settings->height, "Pixels");
  command->add_option("--spp", settings->spp, "Camera rays a pixel, one direction each");
  command
      ->add_option("--rounds", settings->rounds,
                   "Rounds of two runs of each side; four times as many for the controls")
      ->check(CLI::Range(1, 1000));
  command->add_option("--cases", settings->cases, "Pieces of cases' names; default: all")->delimiter(',');
  command->add_flag("--check", settings->check,
                    "Fail unless the 95 % intervals of the first two cases lie within 1.00 +- 0.02");
  command->add_option("--output", settings->output, "Append one JSON line a case to this file");
  command->add_flag_callback(
      "--cpu-time", [] { measured = Stopwatch::Of::threads; },
      "CPU seconds of the process instead of the wall clock's");
  command->callback([settings] { run(*settings); });
}

}  // namespace nook::bench
