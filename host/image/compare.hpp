#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "image/image.hpp"
#include "image/metrics.hpp"

namespace nook {

/// When a comparison counts as failed (or deserves a warning); OpenImageIO's idiff has the same three
/// numbers.
struct DifferenceLimit {
  double each = 1e-6;                                     ///< a value differs if |a-b| exceeds this
  double percent = 0;                                     ///< this many pixels may hold such values
  double hard = std::numeric_limits<double>::infinity();  ///< no value may differ by more than this
};

struct CompareOptions {
  std::filesystem::path a;
  std::filesystem::path b;  ///< the reference
  std::optional<std::filesystem::path> reference_variance;
  std::vector<std::string> channels;  ///< empty: R, G and B if both images have them, else all; "all": all
  DifferenceLimit fail, warn;
};

/// idiff's exit codes.
enum class CompareStatus : int { same = 0, warning = 1, failure = 2, incomparable = 3, unreadable = 4 };

struct ChannelComparison {
  std::string name;  ///< "R=G=B" if these are equal in both images
  Metrics metrics;
};

/// What was found. Values that are not finite in one image alone, or not alike, differ by infinity.
struct Comparison {
  CompareStatus status = CompareStatus::same;
  std::string reason;  ///< why the images are incomparable; else empty
  int width = 0, height = 0;
  std::vector<ChannelComparison> channels;
  std::uint64_t pixels_over_fail = 0, pixels_over_warn = 0;
  struct Worst {
    std::string channel;
    int x = 0, y = 0;
    float a = 0, b = 0;
    double difference = 0;
  } worst;
  Image difference;  ///< a - b, one plane a channel
};

/// Throws Error if a file cannot be read; whatever else may be wrong with the pair is in `status` and
/// `reason`.
Comparison compare_files(const CompareOptions& options);
/// The same for images in memory; options.a and options.b are for messages alone, reference_variance is the
/// image.
Comparison compare(const Image& a, const Image& b, const Image* reference_variance,
                   const CompareOptions& options);

/// A table for people, ending with the verdict: PASS, WARNING or FAILURE.
std::string comparison_text(const Comparison& comparison, const CompareOptions& options);
/// One JSON object; numbers that are infinite or undefined are null.
std::string comparison_json(const Comparison& comparison, const CompareOptions& options);

}  // namespace nook
