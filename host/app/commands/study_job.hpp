#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/options/scene_options.hpp"
#include "render/scene_renderer.hpp"
#include "report/plot_library.hpp"
#include "report/study_methods.hpp"
#include "report/study_page.hpp"

namespace nook {

/// What `nook study` is asked for.
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

/// A study from its options to its page, within about the budget.
class StudyJob {
 public:
  /// Checks options and folders before anything is loaded. `options` must outlive it. Throws Error.
  explicit StudyJob(const StudyOptions& options);
  /// Writes study.json, study.csv and index.html. Throws Error; interrupted, the runs so far are kept.
  void run();

 private:
  double elapsed() const;
  void say(const std::string& text) const;
  StudyScene scene_of(std::pair<int, int> size);
  std::pair<int, int> affordable_size(double samples_per_second);
  StudyReference reference_for(const StudyScene& study, const StudyFacts& facts) const;
  void make_runs(Study& made, const StudyFacts& facts) const;
  Gallery gallery(double samples_per_second);

  const StudyOptions& options_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  Scene scene_;
  PlotLibrary library_;
  StudyChoice choice_;
  std::filesystem::path folder_, json_, reference_file_;
  std::optional<SceneRenderer> renderer_;
};

}  // namespace nook
