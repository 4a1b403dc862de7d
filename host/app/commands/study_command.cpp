// nook study SCENE: what accuracy costs in time, measured; JSON, CSV and a page.
#include <fmt/format.h>

#include <limits>
#include <optional>

#include "app/commands.hpp"
#include "app/interrupt.hpp"
#include "app/options/loading.hpp"
#include "app/options/scene_options.hpp"
#include "app/progress.hpp"
#include "base/error.hpp"
#include "base/to_stderr.hpp"
#include "report/study_job.hpp"
#include "scene/names.hpp"

namespace nook {
namespace {

struct StudyOptions {
  SceneOptions scene;
  DeviceOptions device;
  std::filesystem::path folder, reference;
  std::optional<std::filesystem::path> chart_js;
  double budget = 120;
  std::vector<std::string> samplers, samplings;
  std::uint32_t max_spp = 1024;
  bool gallery = true, no_plots = false, quiet = false;
};

template <class T>
std::vector<T> chosen(const char* flag, const std::vector<std::string>& words, NameTable<T> names) {
  std::vector<T> values;
  for (const std::string& word : words) {
    const auto value = value_of(names, word);
    if (!value) throw Error(ErrorKind::usage, fmt::format("{}: unknown value '{}'", flag, word));
    values.push_back(*value);
  }
  return values;
}

std::string command_of(const StudyOptions& options, const Scene& scene) {
  std::string command = fmt::format("nook study {} --budget {} --seed {}", options.scene.scene.string(),
                                    options.budget, scene.seed);
  if (!options.samplers.empty()) command += fmt::format(" --samplers {}", fmt::join(options.samplers, ","));
  if (!options.samplings.empty())
    command += fmt::format(" --samplings {}", fmt::join(options.samplings, ","));
  if (options.scene.size) command += " --size " + *options.scene.size;
  return command;
}

StudyRequest request_of(const StudyOptions& options, const Scene& scene) {
  StudyRequest request;
  request.budget = options.budget;
  if (!options.no_plots) request.library = load_plot_library(options.chart_js);
  if (!options.no_plots && request.library.script.empty())
    to_stderr("warning: tables instead of plots on the page: Debian's libjs-chart.js is not installed\n");
  request.choice.samplers = chosen<Sampler>("--samplers", options.samplers, sampler_names);
  request.choice.samplings = chosen<Sampling>("--samplings", options.samplings, sampling_names);
  request.choice.max_spp = options.max_spp;
  check_choice(request.choice, scene.effects.front());
  request.own_size = options.scene.size.has_value();
  request.name = options.scene.scene.filename().string();
  request.command = command_of(options, scene);
  request.folder = options.folder;
  if (request.folder.empty()) request.folder = options.scene.scene.stem().string() + "_study";
  request.reference = options.reference;
  request.gallery = options.gallery;
  if (!options.quiet) request.say = [](const std::string& text) { to_stderr("{}\n", text); };
  return request;
}

int study(const StudyOptions& options) {
  const Scene scene = options.scene.load();
  Scene studied = scene;
  studied.effects.resize(1);
  options.scene.check_applicable(studied);
  StudyJob job(request_of(options, scene));
  options.device.prepare();
  SceneRendererOptions prepared;
  prepared.threads = options.device.threads;
  prepared.instancing = Instancing::copies;
  SceneRenderer renderer(
      scene, [&] { return options.device.open(); }, std::move(prepared));
  renderer.expect_rays(std::numeric_limits<double>::infinity());  // a study's are many
  warn_of(scene, renderer.mesh(), Viewer::camera);
  catch_interrupts();
  TerminalObserver observer(ProgressMode::none);
  job.run(renderer, observer);
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
