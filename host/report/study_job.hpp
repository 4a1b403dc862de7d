#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>

#include "render/scene_renderer.hpp"
#include "report/plot_library.hpp"
#include "report/study_methods.hpp"
#include "report/study_page.hpp"

namespace nook {

/// What a study is asked for.
struct StudyRequest {
  double budget = 120;                   ///< seconds, about
  StudyChoice choice;                    ///< see check_choice()
  bool own_size = false;                 ///< of the scene's size, and not of what the budget can afford
  std::string name, command;             ///< the scene's and what was called, for the page
  std::filesystem::path folder;          ///< of study.json, study.csv, index.html; empty: nothing is written
  std::filesystem::path reference;       ///< EXR to measure errors against; empty: rendered
  bool gallery = true;                   ///< pictures on the page
  PlotLibrary library;                   ///< of its plots
  std::function<void(std::string)> say;  ///< steps, for people; may be empty
};

/// Throws Error(usage) for a distribution that the effect cannot have, in the words of flags.
void check_choice(const StudyChoice& choice, const Effect& effect);

/// What a study found: the texts of study.json (without single runs) and study.csv.
struct StudyResult {
  std::string json, csv;
};

/// A study of a scene's first effect, within about the budget. Time counts from when it is made.
class StudyJob {
 public:
  /// Throws Error(output) if the folder cannot be made.
  explicit StudyJob(StudyRequest request);
  /// `renderer` has the scene's mesh as copies, and a tree for many rays. A study that is in the folder goes
  /// on. Progress counts runs. Throws Error; interrupted, the runs so far are kept in the folder.
  StudyResult run(SceneRenderer& renderer, RunObserver& observer);
  const StudyRequest& request() const { return request_; }

 private:
  double elapsed() const;
  void say(const std::string& text) const;
  StudyScene scene_of(std::pair<int, int> size) const;
  std::pair<int, int> affordable_size(double samples_per_second) const;
  StudyReference reference_for(const StudyScene& study, const StudyFacts& facts) const;
  void make_runs(Study& made, const StudyFacts& facts, RunObserver& observer) const;
  void keep(const Study& made, const StudyFacts& facts) const;
  void write_page(const Study& made, const StudyFacts& facts, const StudyScene& study,
                  double samples_per_second) const;

  StudyRequest request_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::filesystem::path json_, reference_file_;
  SceneRenderer* renderer_ = nullptr;
};

}  // namespace nook
