#include "report/study_file.hpp"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "base/input_file.hpp"
#include "base/pending_file.hpp"

namespace nook {
namespace {

using nlohmann::json;

constexpr double errors_of_interest[] = {.05, .02, .01, .005};
constexpr const char* family_names[] = {"fixed", "adaptive", "ssao"};

void write_text(const std::filesystem::path& path, const std::string& text) {
  PendingFile file(path);
  file.write(text.data(), text.size());
  file.commit();
}

json of_run(const StudyRun& r) {
  return {{"seed", r.seed},       {"wall_seconds", r.wall_seconds},  {"device_seconds", r.device_seconds},
          {"rays", r.rays},       {"mse", r.mean_square_error},      {"mean_error", r.mean_error},
          {"covered", r.covered}, {"error_claimed", r.error_claimed}};
}

StudyRun run_of(const json& j) {
  return {j.at("seed"), j.at("wall_seconds"), j.at("device_seconds"), j.at("rays"),
          j.at("mse"),  j.at("mean_error"),   j.at("covered"),        j.at("error_claimed")};
}

json of_summary(const StudyPoint& point) {
  const PointSummary s = summarise(point);
  return {{"level", point.level},
          {"runs", point.runs.size()},
          {"rmse", s.rmse.value},
          {"rmse_low", s.rmse.low},
          {"rmse_high", s.rmse.high},
          {"wall_seconds", s.wall_seconds},
          {"device_seconds", s.device_seconds},
          {"rays", s.rays},
          {"bias", std::sqrt(std::max(0.0, point.bias_square))},
          {"covered", s.covered},
          {"error_claimed", s.error_claimed},
          {"efficiency", s.efficiency},
          {"mean_error", s.mean_error}};
}

// Log error against log cost, over the points from 4 samples on: with fewer, the overhead of a launch hides
// the noise.
json fit(const std::vector<CostPoint>& curve) {
  std::vector<double> x, y;
  for (const CostPoint& point : curve)
    if (point.cost > 0 && point.error > 0) {
      x.push_back(std::log10(point.cost));
      y.push_back(std::log10(point.error));
    }
  const auto line = fit_line(x, y, std::vector<double>(x.size(), 1.0));
  if (!line) return nullptr;
  return {{"slope", line->slope}, {"intercept", line->intercept}, {"slope_error", line->slope_error}};
}

json of_method(const Study& study, const StudyMethod& method) {
  json j = {{"name", method.name},
            {"family", family_names[int(method.family)]},
            {"sampling", method.sampling},
            {"sampler", method.sampler},
            {"directions", method.directions},
            {"predicted_variance", method.predicted_variance},
            {"prediction", method.prediction},
            {"points", json::array()}};
  std::vector<CostPoint> by_seconds, to_fit_seconds, to_fit_device, to_fit_rays;
  for (const StudyPoint& point : study.points()) {
    if (point.method != method.name || point.runs.empty()) continue;
    j["points"].push_back(of_summary(point));
    const PointSummary s = summarise(point);
    by_seconds.push_back({s.wall_seconds, s.rmse.value});
    if (method.family == StudyMethod::Family::adaptive || point.level >= 4) {
      to_fit_seconds.push_back({s.wall_seconds, s.rmse.value});
      to_fit_device.push_back({s.device_seconds, s.rmse.value});
      to_fit_rays.push_back({s.rays, s.rmse.value});
    }
  }
  j["fit_seconds"] = fit(to_fit_seconds);
  j["fit_device_seconds"] = fit(to_fit_device);
  j["fit_rays"] = fit(to_fit_rays);
  for (const double error : errors_of_interest) {
    const auto cost = cost_of_error(by_seconds, error);
    j["seconds_to"].push_back(
        cost ? json{{"error", error}, {"seconds", cost->value}, {"extrapolated", cost->extrapolated}}
             : json{{"error", error}, {"seconds", nullptr}});
  }
  return j;
}

json whole(const Study& study, const StudyFacts& facts) {
  json j;
  for (const auto& [name, text] : facts) j["facts"].push_back({{"name", name}, {"text", text}});
  double variance = 0;
  for (const float v : study.reference().variance)
    variance += double(v) / double(study.reference().variance.size());
  j["reference"] = {{"description", study.reference().description},
                    {"spp", study.reference().spp},
                    {"seconds", study.reference().seconds},
                    {"standard_error", std::sqrt(variance)}};
  j["progress"] = study.progress();
  for (const StudyMethod& method : study.methods()) j["methods"].push_back(of_method(study, method));
  return j;
}

}  // namespace

std::string study_json(const Study& study, const StudyFacts& facts) {
  return whole(study, facts).dump();
}

void write_study_json(const std::filesystem::path& path, const Study& study, const StudyFacts& facts) {
  json j = whole(study, facts);
  for (const StudyPoint& point : study.points()) {
    json runs = json::array();
    for (const StudyRun& run : point.runs) runs.push_back(of_run(run));
    j["runs"].push_back({{"method", point.method},
                         {"level", point.level},
                         {"bias_square", point.bias_square},
                         {"pairs", point.pairs},
                         {"runs", runs}});
  }
  write_text(path, j.dump(1) + '\n');
}

std::string study_csv(const Study& study) {
  std::string text =
      "method,family,sampling,sampler,directions,level,runs,rmse,rmse_low,rmse_high,wall_seconds,device_"
      "seconds,rays,bias,mean_error,covered,"
      "error_claimed,efficiency\n";
  for (const StudyMethod& method : study.methods())
    for (const StudyPoint& point : study.points()) {
      if (point.method != method.name || point.runs.empty()) continue;
      const json s = of_summary(point);
      const auto number = [&](const char* name) { return s.at(name).get<double>(); };
      text += fmt::format(
          "{},{},{},{},{},{},{},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.0f},{:.6g},{:.6g},{:.4f},{:.6g},{:.6g}"
          "\n",
          method.name, family_names[int(method.family)], method.sampling, method.sampler, method.directions,
          point.level, point.runs.size(), number("rmse"), number("rmse_low"), number("rmse_high"),
          number("wall_seconds"), number("device_seconds"), number("rays"), number("bias"),
          number("mean_error"), number("covered"), number("error_claimed"), number("efficiency"));
    }
  return text;
}

void write_study_csv(const std::filesystem::path& path, const Study& study) {
  write_text(path, study_csv(study));
}

std::vector<StudyPoint> read_study_points(const std::filesystem::path& path, const StudyFacts& facts,
                                          const std::vector<std::string>& identity) {
  std::error_code code;
  if (!std::filesystem::exists(path, code)) return {};
  size_of_input(path);
  std::ifstream file(path);
  try {
    const json j = json::parse(file);
    std::map<std::string, std::string> before, now(facts.begin(), facts.end());
    for (const json& fact : j.at("facts")) before[fact.at("name")] = fact.at("text");
    for (const std::string& name : identity)
      if (before[name] != now[name]) return {};
    std::vector<StudyPoint> points;
    for (const json& p : j.at("runs")) {
      StudyPoint point{p.at("method"), p.at("level"), 0, {}, p.at("bias_square"), p.at("pairs")};
      for (const json& run : p.at("runs")) point.runs.push_back(run_of(run));
      points.push_back(std::move(point));
    }
    return points;
  } catch (const json::exception& e) {
    throw Error(ErrorKind::scene, Place{path.string()}, fmt::format("not a study (JSON error {})", e.id));
  }
}

}  // namespace nook
