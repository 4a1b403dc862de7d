#include "app/commands/study_job.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "app/commands/study_reference.hpp"
#include "app/interrupt.hpp"
#include "app/options/loading.hpp"
#include "base/counted.hpp"
#include "base/error.hpp"
#include "base/to_stderr.hpp"
#include "base/version.hpp"
#include "image/exr.hpp"
#include "mesh/mesh_analysis.hpp"
#include "scene/effect_keys.hpp"
#include "scene/names.hpp"
#include "scene/scene_writer.hpp"

namespace nook {
namespace {

// The budget's parts. Loading and building come out of what the runs have.
constexpr double reference_share = 0.18, gallery_share = 0.22, runs_share = 0.5;

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

StudyChoice choice_of(const StudyOptions& options, const Effect& effect) {
  StudyChoice choice;
  choice.samplers = chosen<Sampler>("--samplers", options.samplers, sampler_names);
  choice.samplings = chosen<Sampling>("--samplings", options.samplings, sampling_names);
  choice.max_spp = options.max_spp;
  const std::vector<Sampling> possible = samplings_of(effect);
  for (const Sampling sampling : choice.samplings)
    if (std::find(possible.begin(), possible.end(), sampling) == possible.end())
      throw Error(ErrorKind::usage,
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
                                      : fmt::format("{:.6g} world units", study.effect().max_distance)},
          {"triangles", std::to_string(mesh.triangles.size())},
          {"device", device.name},
          {"driver", device.platform_name + " " + device.driver},
          {"command", command},
          {"seeds", fmt::format("run r of a point has seed {} + r", scene.seed + 1)},
          {"nook", std::string(version)},
          {"scene hash", scene_hash(scene)},
          {"mesh hash", mesh_hash(mesh)}};
}

// The facts by which a study, and its reference, are known to be the same.
const std::vector<std::string> identity = {"scene",  "effect", "size",       "device",
                                           "driver", "nook",   "scene hash", "mesh hash"};

}  // namespace

StudyJob::StudyJob(const StudyOptions& options) : options_(options), scene_(options.scene.load()) {
  Scene studied = scene_;
  studied.effects.resize(1);
  options.scene.check_applicable(studied);
  if (!options.no_plots) library_ = load_plot_library(options.chart_js);
  if (!options.no_plots && library_.script.empty())
    to_stderr("warning: tables instead of plots on the page: Debian's libjs-chart.js is not installed\n");
  choice_ = choice_of(options, scene_.effects.front());
  folder_ = options.folder;
  if (folder_.empty()) folder_ = options.scene.scene.stem().string() + "_study";
  std::error_code code;
  std::filesystem::create_directories(folder_, code);
  if (!std::filesystem::is_directory(folder_, code))
    throw Error(ErrorKind::output, Place{folder_.string()}, "cannot make the folder");
  json_ = folder_ / "study.json";
  reference_file_ = folder_ / "reference.exr";
}

double StudyJob::elapsed() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

void StudyJob::say(const std::string& text) const {
  if (!options_.quiet) to_stderr("{:6.1f} s  {}\n", elapsed(), text);
}

StudyScene StudyJob::scene_of(std::pair<int, int> size) {
  return {renderer_->device(), scene_, renderer_->mesh(), renderer_->tree(), size.first, size.second};
}

// As many pixels as the budget can afford; the size of an earlier study in the folder, so that it can go on.
std::pair<int, int> StudyJob::affordable_size(double samples_per_second) {
  if (options_.scene.size) return {scene_.width, scene_.height};
  std::error_code code;
  if (std::filesystem::exists(json_, code) && std::filesystem::exists(reference_file_, code)) {
    const Image before = read_exr(reference_file_);
    return {before.width, before.height};
  }
  StudyChoice counted = choice_;
  counted.predictions = counted.ssao = false;
  const double samples = samples_per_second * options_.budget * runs_share;
  const StudyScene pilot = scene_of(size_of(scene_, 20000));
  return size_of(scene_, std::max(2000.0, samples / samples_per_pixel(pilot.methods(counted))));
}

StudyReference StudyJob::reference_for(const StudyScene& study, const StudyFacts& facts) const {
  if (!options_.reference.empty()) return given_reference(options_.reference, study.width(), study.height());
  std::string key;
  for (const auto& [name, text] : facts)
    if (std::find(identity.begin(), identity.end(), name) != identity.end()) key += name + "=" + text + ";";
  return cached_reference(study, reference_file_, key, reference_share * options_.budget);
}

void StudyJob::make_runs(Study& made, const StudyFacts& facts) const {
  made.resume(read_study_points(json_, facts, identity));
  say(fmt::format("{}, {:.0f} % of their runs are there", counted(made.methods().size(), "method"),
                  100 * made.progress()));
  double last_saved = elapsed(), last_said = elapsed();
  const bool finished = made.run([&](const Study& s) {
    if (elapsed() - last_saved > 10) {
      write_study_json(json_, s, facts);
      last_saved = elapsed();
    }
    if (elapsed() - last_said > 5) {
      say(fmt::format("{:.0f} % of the runs", 100 * s.progress()));
      last_said = elapsed();
    }
    return !interrupted();
  });
  write_study_json(json_, made, facts);
  write_study_csv(folder_ / "study.csv", made);
  if (!finished)
    throw Error(ErrorKind::interrupted,
                fmt::format("interrupted; the same command goes on from {}", json_.string()));
  say(fmt::format("{:.0f} % of the runs", 100 * made.progress()));
  if (const std::size_t missing = made.methods_without_runs())
    to_stderr(
        "warning: the budget of {} s ended before {} of {} methods had a run (building their kernels "
        "counts); the same command goes on from {}\n",
        options_.budget, missing, made.methods().size(), json_.string());
}

Gallery StudyJob::gallery(double samples_per_second) {
  Gallery gallery;
  if (!options_.gallery) return gallery;
  const double share = std::max(0.1, std::min(gallery_share * options_.budget, options_.budget - elapsed()));
  const auto size = size_of(scene_, std::clamp(samples_per_second * share / 3500, 2000.0, 480.0 * 360.0));
  std::tie(gallery.width, gallery.height) = size;
  gallery.pictures = make_gallery(scene_of(size), share, scene_.seed + 1);
  say(fmt::format("pictures of {}x{}", gallery.width, gallery.height));
  return gallery;
}

void StudyJob::run() {
  options_.device.prepare();
  SceneRendererOptions prepared;
  prepared.threads = options_.device.threads;
  prepared.instancing = Instancing::copies;
  renderer_.emplace(
      scene_, [this] { return options_.device.open(); }, std::move(prepared));
  renderer_->expect_rays(std::numeric_limits<double>::infinity());  // a study's are many
  warn_of(scene_, renderer_->mesh(), Viewer::camera);
  catch_interrupts();

  const double rate = scene_of(size_of(scene_, 20000)).samples_per_second();
  const std::pair<int, int> size = affordable_size(rate);
  const StudyScene study = scene_of(size);
  const StudyFacts facts = facts_of(options_, scene_, study, renderer_->mesh(), renderer_->device().info());
  say(fmt::format("{} {}x{}, {:.2f} million camera samples a second", name_of(study.effect().effect.kind),
                  size.first, size.second, rate * 1e-6));
  StudyReference reference = reference_for(study, facts);
  say(fmt::format("reference: {}", reference.description));

  std::string left_out;
  std::vector<StudyMethod> methods = study.methods(choice_, &left_out);
  if (!left_out.empty()) to_stderr("warning: {}\n", left_out);
  const double seconds = std::max(0.1, (1 - gallery_share) * options_.budget - elapsed());
  Study made(std::move(methods), std::move(reference), {.seconds = seconds, .seed = scene_.seed + 1});
  make_runs(made, facts);

  const Gallery pictures = gallery(rate);
  const std::filesystem::path page = folder_ / "index.html";
  write_study_page(page, made, facts, pictures,
                   warp_patterns(renderer_->device(), study.effect().effect.exponent), library_);
  say(page.string());
  // Pictures of a size that means something, and a run of each method at least, take what they take.
  if (elapsed() > 1.25 * options_.budget + 1)
    to_stderr(
        "warning: the study took {:.0f} s, more than its budget of {} s: the reference, building the kernels "
        "of {}, a run of each and the page's pictures take no less here\n",
        elapsed(), options_.budget, counted(made.methods().size(), "method"));
}

}  // namespace nook
