#include "report/study_job.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/counted.hpp"
#include "base/error.hpp"
#include "base/version.hpp"
#include "image/exr.hpp"
#include "mesh/mesh_analysis.hpp"
#include "report/reference_file.hpp"
#include "scene/effect_keys.hpp"
#include "scene/names.hpp"
#include "scene/scene_writer.hpp"

namespace nook {
namespace {

// The budget's parts. Loading and building come out of what the runs have.
constexpr double reference_share = 0.18, gallery_share = 0.22, runs_share = 0.5;

// A size of about `pixels` with the scene's aspect, never more than the scene's own.
std::pair<int, int> size_of(const Scene& scene, double pixels) {
  const double scale = std::min(1.0, std::sqrt(pixels / (double(scene.width) * scene.height)));
  return {std::max(8, int(std::lround(scene.width * scale))),
          std::max(8, int(std::lround(scene.height * scale)))};
}

StudyFacts facts_of(const StudyRequest& request, SceneRenderer& renderer, const StudyScene& study) {
  const Effect& effect = study.effect().effect;
  const DeviceInfo& device = renderer.device().info();
  return {{"scene", request.name},
          {"effect", fmt::format("{}: {}", study.effect().label(), settings_text(study.effect().resolved()))},
          {"size", fmt::format("{}x{}", study.width(), study.height())},
          {"screen-space radius", std::isinf(study.effect().max_distance) || effect.kind == EffectKind::ro
                                      ? "no screen-space methods: the effect has no radius"
                                      : fmt::format("{:.6g} world units", study.effect().max_distance)},
          {"triangles", std::to_string(renderer.mesh().triangles.size())},
          {"device", device.name},
          {"driver", device.platform_name + " " + device.driver},
          {"command", request.command},
          {"seeds", fmt::format("run r of a point has seed {} + r", renderer.scene().seed + 1)},
          {"nook", std::string(version)},
          {"scene hash", scene_hash(renderer.scene())},
          {"mesh hash", mesh_hash(renderer.mesh())}};
}

// The facts by which a study, and its reference, are known to be the same.
const std::vector<std::string> identity = {"scene",  "effect", "size",       "device",
                                           "driver", "nook",   "scene hash", "mesh hash"};

}  // namespace

void check_choice(const StudyChoice& choice, const Effect& effect) {
  const std::vector<Sampling> possible = samplings_of(effect);
  for (const Sampling sampling : choice.samplings)
    if (std::find(possible.begin(), possible.end(), sampling) == possible.end())
      throw Error(ErrorKind::usage,
                  fmt::format("--samplings: {} {}", name_of(sampling),
                              effect.kind != EffectKind::ro &&
                                      (sampling == Sampling::lobe || sampling == Sampling::mixture)
                                  ? "needs an RO scene"
                                  : "does not go with the effect's other keys"));
}

StudyJob::StudyJob(StudyRequest request) : request_(std::move(request)) {
  const std::filesystem::path& folder = request_.folder;
  if (folder.empty()) return;
  std::error_code code;
  std::filesystem::create_directories(folder, code);
  if (!std::filesystem::is_directory(folder, code))
    throw Error(ErrorKind::output, Place{folder.string()}, "cannot make the folder");
  json_ = folder / "study.json";
  reference_file_ = folder / "reference.exr";
}

double StudyJob::elapsed() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

void StudyJob::say(const std::string& text) const {
  if (request_.say) request_.say(fmt::format("{:6.1f} s  {}", elapsed(), text));
}

StudyScene StudyJob::scene_of(std::pair<int, int> size) const {
  return {renderer_->device(), renderer_->scene(), renderer_->mesh(),
          renderer_->tree(),   size.first,         size.second};
}

// As many pixels as the budget can afford; the size of an earlier study in the folder, so that it can go on.
std::pair<int, int> StudyJob::affordable_size(double samples_per_second) const {
  const Scene& scene = renderer_->scene();
  if (request_.own_size) return {scene.width, scene.height};
  std::error_code code;
  if (std::filesystem::exists(json_, code) && std::filesystem::exists(reference_file_, code)) {
    const Image before = read_exr(reference_file_);
    return {before.width, before.height};
  }
  StudyChoice counted = request_.choice;
  counted.predictions = counted.ssao = false;
  const double samples = samples_per_second * request_.budget * runs_share;
  const StudyScene pilot = scene_of(size_of(scene, 20000));
  return size_of(scene, std::max(2000.0, samples / samples_per_pixel(pilot.methods(counted))));
}

StudyReference StudyJob::reference_for(const StudyScene& study, const StudyFacts& facts) const {
  if (!request_.reference.empty()) return given_reference(request_.reference, study.width(), study.height());
  const double seconds = reference_share * request_.budget;
  if (reference_file_.empty()) return study.reference(seconds);
  std::string key;
  for (const auto& [name, text] : facts)
    if (std::find(identity.begin(), identity.end(), name) != identity.end()) key += name + "=" + text + ";";
  return cached_reference(study, reference_file_, key, seconds);
}

void StudyJob::keep(const Study& made, const StudyFacts& facts) const {
  if (!json_.empty()) write_study_json(json_, made, facts);
}

void StudyJob::make_runs(Study& made, const StudyFacts& facts, RunObserver& observer) const {
  if (!json_.empty()) made.resume(read_study_points(json_, facts, identity));
  say(fmt::format("{}, {:.0f} % of their runs are there", counted(made.methods().size(), "method"),
                  100 * made.progress()));
  double last_saved = elapsed(), last_said = elapsed();
  RunProgress now;
  for (const StudyPoint& point : made.points()) now.total += point.wanted;
  const bool finished = made.run([&](const Study& s) {
    if (elapsed() - last_saved > 10) {
      keep(s, facts);
      last_saved = elapsed();
    }
    if (elapsed() - last_said > 5) {
      say(fmt::format("{:.0f} % of the runs", 100 * s.progress()));
      last_said = elapsed();
    }
    now.samples = std::uint64_t(s.progress() * double(now.total));
    observer.progress(now);
    return !observer.cancelled();
  });
  observer.end();
  keep(made, facts);
  if (!request_.folder.empty()) write_study_csv(request_.folder / "study.csv", made);
  if (!finished)
    throw Error(ErrorKind::interrupted,
                json_.empty() ? "interrupted"
                              : fmt::format("interrupted; the same command goes on from {}", json_.string()));
  say(fmt::format("{:.0f} % of the runs", 100 * made.progress()));
  if (const std::size_t missing = made.methods_without_runs())
    observer.warn(fmt::format(
        "the budget of {} s ended before {} of {} methods had a run (building their kernels counts){}",
        request_.budget, missing, made.methods().size(),
        json_.empty() ? "" : fmt::format("; the same command goes on from {}", json_.string())));
}

void StudyJob::write_page(const Study& made, const StudyFacts& facts, const StudyScene& study,
                          double samples_per_second) const {
  const Scene& scene = renderer_->scene();
  Gallery gallery;
  if (request_.gallery) {
    const double share =
        std::max(0.1, std::min(gallery_share * request_.budget, request_.budget - elapsed()));
    const auto size = size_of(scene, std::clamp(samples_per_second * share / 3500, 2000.0, 480.0 * 360.0));
    std::tie(gallery.width, gallery.height) = size;
    gallery.pictures = make_gallery(scene_of(size), share, scene.seed + 1);
    say(fmt::format("pictures of {}x{}", gallery.width, gallery.height));
  }
  const std::filesystem::path page = request_.folder / "index.html";
  write_study_page(page, made, facts, gallery,
                   warp_patterns(renderer_->device(), study.effect().effect.exponent), request_.library);
  say(page.string());
}

StudyResult StudyJob::run(SceneRenderer& renderer, RunObserver& observer) {
  renderer_ = &renderer;
  const Scene& scene = renderer.scene();
  const double rate = scene_of(size_of(scene, 20000)).samples_per_second();
  const std::pair<int, int> size = affordable_size(rate);
  const StudyScene study = scene_of(size);
  const StudyFacts facts = facts_of(request_, renderer, study);
  say(fmt::format("{} {}x{}, {:.2f} million camera samples a second", name_of(study.effect().effect.kind),
                  size.first, size.second, rate * 1e-6));
  StudyReference reference = reference_for(study, facts);
  say(fmt::format("reference: {}", reference.description));

  std::string left_out;
  std::vector<StudyMethod> methods = study.methods(request_.choice, &left_out);
  if (!left_out.empty()) observer.warn(left_out);
  const double runs = 1 - (request_.folder.empty() ? 0 : gallery_share);
  const double seconds = std::max(0.1, runs * request_.budget - elapsed());
  Study made(std::move(methods), std::move(reference), {.seconds = seconds, .seed = scene.seed + 1});
  make_runs(made, facts, observer);
  if (!request_.folder.empty()) write_page(made, facts, study, rate);
  // Pictures of a size that means something, and a run of each method at least, take what they take.
  if (elapsed() > 1.25 * request_.budget + 1)
    observer.warn(fmt::format(
        "the study took {:.0f} s, more than its budget of {} s: the reference, building the kernels "
        "of {}, a run of each and the page's pictures take no less here",
        elapsed(), request_.budget, counted(made.methods().size(), "method")));
  return {study_json(made, facts), study_csv(made)};
}

}  // namespace nook
