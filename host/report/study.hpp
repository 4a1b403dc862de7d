#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "report/study_statistics.hpp"

namespace nook {

/// One picture and what it cost.
struct StudyPicture {
  std::vector<float> image;            ///< row-major
  std::vector<float> variance;         ///< of each pixel, as the renderer claims it; may be empty
  std::vector<std::uint32_t> samples;  ///< of each pixel, if they differ; else empty
  double wall_seconds = 0;
  double device_seconds = 0;  ///< in kernels; 0 where that is not known
  std::uint64_t rays = 0;
};

/// One way to make the picture, at several levels of effort.
struct StudyMethod {
  enum class Family { fixed, adaptive, ssao };
  std::string name;  ///< unique in the study
  Family family = Family::fixed;
  std::string sampling, sampler;  ///< may be empty
  std::uint32_t directions = 1;   ///< occlusion rays a camera ray
  std::vector<double> levels;     ///< fixed: spp; adaptive: error asked; ssao: samples. In the order of cost
  bool random = true;             ///< otherwise runs differ in time alone
  double predicted_variance = 0;  ///< of one sample, the mean over pixels; 0: not predicted
  std::string prediction;         ///< the formula, or how else it was predicted
  std::function<StudyPicture(double level, std::uint32_t seed)> render;
};

struct StudyReference {
  std::vector<float> image, variance;  ///< variance: of each pixel's value; may be empty (exact)
  std::uint64_t spp = 0;
  double seconds = 0;
  std::string description;
};

/// One run of a method at a level.
struct StudyRun {
  std::uint32_t seed = 0;
  double wall_seconds = 0, device_seconds = 0;
  double rays = 0;
  double mean_square_error = 0;  ///< less the reference's mean variance: unbiased, and so perhaps negative
  double mean_error = 0;
  double covered = -1;       ///< share of pixels whose 95 % interval holds the reference; -1: no intervals
  double error_claimed = 0;  ///< root mean square of the claimed standard errors
};

struct StudyPoint {
  std::string method;
  double level = 0;
  std::uint32_t wanted = 0;  ///< runs
  std::vector<StudyRun> runs;
  double bias_square = 0;  ///< estimate of the mean squared bias, from pairs of runs; may be negative
  double pairs = 0;        ///< pairs of runs behind it
  bool finished() const { return runs.size() >= wanted; }
};

/// What the runs of a point say together.
struct PointSummary {
  Band rmse;
  double wall_seconds = 0, device_seconds = 0, rays = 0;   ///< medians
  double covered = -1, error_claimed = 0, mean_error = 0;  ///< means
  double efficiency = 0;  ///< 1 / (mean square error x wall seconds), 1/s; 0 if not positive
};
PointSummary summarise(const StudyPoint& point);

/// Runs wanted at a level: 20 where they are cheap, at least 2.
std::uint32_t runs_wanted(const StudyMethod& method, double level);

/// Measures every method at every level, as far as the budget goes.
///
/// Runs are interleaved by cost: each goes to the point that has had the least time. So cheap points get all
/// the runs they want, the dearest at least one if the budget allows it, and methods of like cost take turns,
/// so that a machine's drift meets them alike. Run r of a point has seed `seed + r`.
class Study {
 public:
  struct Settings {
    double seconds = 60;  ///< for the runs
    std::uint32_t seed = 1;
  };
  Study(std::vector<StudyMethod> methods, StudyReference reference, const Settings& settings);

  /// Takes over points measured before; those of methods or levels that this study does not have are dropped.
  void resume(const std::vector<StudyPoint>& points);
  /// Runs until finished or out of time (true), or `go_on`, called after each run, says no (false).
  bool run(const std::function<bool(const Study&)>& go_on);

  const std::vector<StudyMethod>& methods() const { return methods_; }
  const std::vector<StudyPoint>& points() const { return points_; }
  const StudyReference& reference() const { return reference_; }
  /// Share of the runs wanted that are made.
  double progress() const;
  /// Methods that no level of was run: time was short.
  std::size_t methods_without_runs() const;

 private:
  struct Slot {
    std::size_t method;
    std::vector<double> error_sum;     // Σ over this process's runs of the signed error
    std::vector<double> mean_squares;  // of these, the reference's variance included
    double bias_before = 0, pairs_before = 0;
  };
  void measure(std::size_t point);
  double expected_seconds(std::size_t point) const;

  std::vector<StudyMethod> methods_;
  StudyReference reference_;
  Settings settings_;
  double reference_variance_ = 0;
  std::vector<StudyPoint> points_;
  std::vector<Slot> slots_;
};

}  // namespace nook
