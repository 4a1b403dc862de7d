// nook study SCENE: what accuracy costs in time, measured; JSON, CSV and a page.
#include <fmt/format.h>
#include <limits>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "app/commands.hpp"
#include "app/commands/study_reference.hpp"
#include "app/interrupt.hpp"
#include "app/options/loading.hpp"
#include "app/options/scene_options.hpp"
#include "base/counted.hpp"
#include "base/error.hpp"
#include "base/to_stderr.hpp"
#include "base/version.hpp"
#include "image/exr.hpp"
#include "mesh/mesh_analysis.hpp"
#include "render/scene_renderer.hpp"
#include "report/study_page.hpp"
#include "scene/effect_keys.hpp"
#include "scene/names.hpp"
#include "scene/scene_writer.hpp"

namespace nook {
namespace {

namespace fs = std::filesystem;

struct StudyOptions {
  SceneOptions scene;
  DeviceOptions device;
  fs::path folder, reference;
  std::optional<fs::path> chart_js;
  double budget = 120;
  std::vector<std::string> samplers, samplings;
  std::uint32_t max_spp = 1024;
  bool gallery = true, no_plots = false, quiet = false;
};

// The budget's parts. Loading and building come out of what the runs have.
constexpr double reference_share = 0.18, gallery_share = 0.22, runs_share = 0.5;

template <class T>
std::vector<T> chosen(const char* flag, const std::vector<std::string>& words, NameTable<T> names) {
  std::vector<T> values;
  for (const std::string& word : words) {
    const auto value = value_of(names, word);
    if (!value) throw Error(ExitCode::usage, fmt::format("{}: unknown value '{}'", flag, word));
    values.push_back(*value);
  }
  return values;
}

StudyChoice choice_of(const StudyOptions& options, const Effect& effect) {
  StudyChoice choice;
  choice.samplers = chosen<Sampler>("--samplers", options.samplers, sampler_names);
  choice.samplings = chosen<Sampling>("--samplings", options.samplings, sampling_names);
  choice.max_spp = options.max_spp;
  const std::vector<Sampling> possible = samplings_of(effect);
  for (const Sampling sampling : choice.samplings)
    if (std::find(possible.begin(), possible.end(), sampling) == possible.end())
      throw Error(ExitCode::usage,
                  fmt::format("--samplings: {} {}", name_of(sampling),
                              effect.kind != EffectKind::ro &&
                                      (sampling == Sampling::lobe || sampling == Sampling::mixture)
                                  ? "needs an RO scene"
                                  : "does not go with the effect's other keys"));
  return choice;
}

// A size of about `pixels` with the scene's aspect, never more than the scene's own.
std::pair<int, int> size_of(const Scene& scene, double pixels) {
  const double scale = std::min(1.0, std::sqrt(pixels / (double(scene.width) * scene.height)));
  return {std::max(8, int(std::lround(scene.width * scale))),
          std::max(8, int(std::lround(scene.height * scale)))};
}

std::string distance_text(const EffectPlan& effect) {
  return std::isinf(effect.max_distance) ? "unlimited"
                                         : fmt::format("{:.6g} world units", effect.max_distance);
}

StudyFacts facts_of(const StudyOptions& options, const Scene& scene, const StudyScene& study,
                    const TriangleMesh& mesh, const DeviceInfo& device) {
  const Effect& effect = study.effect().effect;
  std::string command = fmt::format("nook study {} --budget {} --seed {}", options.scene.scene.string(),
                                    options.budget, scene.seed);
  if (!options.samplers.empty()) command += fmt::format(" --samplers {}", fmt::join(options.samplers, ","));
  if (!options.samplings.empty())
    command += fmt::format(" --samplings {}", fmt::join(options.samplings, ","));
  if (options.scene.size) command += " --size " + *options.scene.size;
  return {{"scene", options.scene.scene.filename().string()},
          {"effect", fmt::format("{}: {}", study.effect().label(), settings_text(study.effect().resolved()))},
          {"size", fmt::format("{}x{}", study.width(), study.height())},
          {"screen-space radius", std::isinf(study.effect().max_distance) || effect.kind == EffectKind::ro
                                      ? "no screen-space methods: the effect has no radius"
                                      : distance_text(study.effect())},
          {"triangles", std::to_string(mesh.triangles.size())},
          {"device", device.name},
          {"driver", device.platform_name + " " + device.driver},
          {"command", command},
          {"seeds", fmt::format("run r of a point has seed {} + r", scene.seed + 1)},
          {"nook", std::string(version)},
          {"scene hash", scene_hash(scene)},
          {"mesh hash", mesh_hash(mesh)}};
}

int study(const StudyOptions& options) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  const auto elapsed = [&] { return std::chrono::duration<double>(Clock::now() - start).count(); };
  const auto say = [&](const std::string& text) {
    if (!options.quiet) to_stderr("{:6.1f} s  {}\n", elapsed(), text);
  };
  const Scene scene = options.scene.load();
  Scene studied = scene;
  studied.effects.resize(1);
  options.scene.check_applicable(studied);
  const PlotLibrary library = options.no_plots ? PlotLibrary{} : load_plot_library(options.chart_js);
  if (!options.no_plots && library.script.empty())
    to_stderr("warning: tables instead of plots on the page: Debian's libjs-chart.js is not installed\n");
  const StudyChoice choice = choice_of(options, scene.effects.front());
  const fs::path folder =
      options.folder.empty() ? fs::path(options.scene.scene.stem().string() + "_study") : options.folder;
  std::error_code code;
  fs::create_directories(folder, code);
  if (!fs::is_directory(folder, code))
    throw Error(ExitCode::output, fmt::format("{}: cannot make the folder", folder.string()));

  options.device.prepare();
  SceneRendererOptions prepared;
  prepared.threads = options.device.threads;
  prepared.instancing = Instancing::copies;
  SceneRenderer renderer(
      scene, [&] { return options.device.open(); }, std::move(prepared));
  renderer.expect_rays(std::numeric_limits<double>::infinity());  // a study's are many
  const TriangleMesh& mesh = renderer.mesh();
  warn_of(mesh);
  const Device& device = renderer.device();
  const Bvh& bvh = renderer.tree();
  catch_interrupts();

  // As many pixels as the budget can afford; the size of an earlier study in the folder, so that it can go
  // on.
  const StudyScene pilot(device, scene, mesh, bvh, size_of(scene, 20000).first, size_of(scene, 20000).second);
  const double rate = pilot.samples_per_second();
  std::pair<int, int> size{scene.width, scene.height};
  const fs::path json = folder / "study.json", reference_file = folder / "reference.exr";
  const std::vector<std::string> identity = {"scene",  "effect", "size",       "device",
                                             "driver", "nook",   "scene hash", "mesh hash"};
  if (!options.scene.size) {
    StudyChoice counted = choice;
    counted.predictions = counted.ssao = false;
    size = size_of(scene, std::max(2000.0, rate * options.budget * runs_share /
                                               samples_per_pixel(pilot.methods(counted))));
    if (fs::exists(json, code) && fs::exists(reference_file, code)) {
      const Image before = read_exr(reference_file);
      size = {before.width, before.height};
    }
  }
  const StudyScene at_size(device, scene, mesh, bvh, size.first, size.second);
  const StudyFacts facts = facts_of(options, scene, at_size, mesh, device.info());
  say(fmt::format("{} {}x{}, {:.2f} million camera samples a second", name_of(at_size.effect().effect.kind),
                  size.first, size.second, rate * 1e-6));
  std::string cache_key;
  for (const auto& [name, text] : facts)
    if (std::find(identity.begin(), identity.end(), name) != identity.end())
      cache_key += name + "=" + text + ";";
  StudyReference reference =
      options.reference.empty()
          ? cached_reference(at_size, reference_file, cache_key, reference_share * options.budget)
          : given_reference(options.reference, size.first, size.second);
  say(fmt::format("reference: {}", reference.description));

  std::string left_out;
  std::vector<StudyMethod> methods = at_size.methods(choice, &left_out);
  if (!left_out.empty()) to_stderr("warning: {}\n", left_out);
  Study made(
      std::move(methods), std::move(reference),
      {.seconds = std::max(0.1, (1 - gallery_share) * options.budget - elapsed()), .seed = scene.seed + 1});
  made.resume(read_study_points(json, facts, identity));
  say(fmt::format("{}, {:.0f} % of their runs are there", counted(made.methods().size(), "method"),
                  100 * made.progress()));
  double last_saved = elapsed(), last_said = elapsed();
  const bool finished = made.run([&](const Study& s) {
    if (elapsed() - last_saved > 10) {
      write_study_json(json, s, facts);
      last_saved = elapsed();
    }
    if (elapsed() - last_said > 5) {
      say(fmt::format("{:.0f} % of the runs", 100 * s.progress()));
      last_said = elapsed();
    }
    return !interrupted();
  });
  write_study_json(json, made, facts);
  write_study_csv(folder / "study.csv", made);
  if (!finished)
    throw Error(ExitCode::interrupted,
                fmt::format("interrupted; the same command goes on from {}", json.string()));
  say(fmt::format("{:.0f} % of the runs", 100 * made.progress()));
  if (const std::size_t missing = made.methods_without_runs())
    to_stderr(
        "warning: the budget of {} s ended before {} of {} methods had a run (building their kernels "
        "counts); the same command goes on from {}\n",
        options.budget, missing, made.methods().size(), json.string());

  Gallery gallery;
  if (options.gallery) {
    const double share = std::max(0.1, std::min(gallery_share * options.budget, options.budget - elapsed()));
    std::tie(gallery.width, gallery.height) =
        size_of(scene, std::clamp(rate * share / 3500, 2000.0, 480.0 * 360.0));
    const StudyScene picture(device, scene, mesh, bvh, gallery.width, gallery.height);
    gallery.pictures = make_gallery(picture, share, scene.seed + 1);
    say(fmt::format("pictures of {}x{}", gallery.width, gallery.height));
  }
  const float exponent = at_size.effect().effect.exponent;
  const fs::path page = folder / "index.html";
  write_study_page(page, made, facts, gallery, warp_patterns(device, exponent), library);
  say(fmt::format("{}", page.string()));
  // Pictures of a size that means something, and a run of each method at least, take what they take.
  if (elapsed() > 1.25 * options.budget + 1)
    to_stderr(
        "warning: the study took {:.0f} s, more than its budget of {} s: the reference, building the kernels "
        "of {}, a run of each and the page's pictures take no less here\n",
        elapsed(), options.budget, counted(made.methods().size(), "method"));
  return 0;
}

}  // namespace

void add_study_command(CLI::App& app, Command& chosen_command) {
  auto options = std::make_shared<StudyOptions>();
  CLI::App* command = app.add_subcommand(
      "study", "Measure what accuracy costs in time; writes study.json, study.csv and index.html");
  // It has its own samplers, distributions, methods and numbers of samples, and studies whole pictures.
  options->scene.add_to(
      *command, all_kinds,
      {"--spp", "--directions", "--sampling", "--sampler", "--method", "--quality", "--crop"});
  options->device.add_to(*command);
  command->add_option("-o,--output", options->folder,
                      "Folder; default: SCENE_study here. A study that is there goes on");
  command->add_option("--budget", options->budget, "Seconds, about; default 120")
      ->check(CLI::Range(1.0, 1e6));
  command->add_option("--samplers", options->samplers, "Point sequences to compare; default: all")
      ->delimiter(',');
  command->add_option("--samplings", options->samplings, "Distributions to compare; default: all")
      ->delimiter(',');
  command->add_option("--max-spp", options->max_spp, "Largest number of camera rays a pixel; default 1024")
      ->check(CLI::Range(1, 1 << 20));
  command->add_option("--reference", options->reference,
                      "EXR to measure errors against (R, and AO.variance if there is one)");
  command->add_flag("--gallery,!--no-gallery", options->gallery, "Pictures on the page; on by default");
  CLI::Option* no_plots =
      command->add_flag("--no-plots", options->no_plots, "Tables instead of plots on the page");
  command
      ->add_option(
          "--chart-js", options->chart_js,
          fmt::format("Chart.js 3 for the page's plots; default: {}, if it is there", debian_chart_js))
      ->excludes(no_plots);
  command->add_flag("--quiet", options->quiet, "Say nothing but errors");
  command->callback([options, &chosen_command] { chosen_command = [options] { return study(*options); }; });
}

}  // namespace nook
