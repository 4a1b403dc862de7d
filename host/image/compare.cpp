#include "image/compare.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <optional>
#include <span>

#include "image/exr.hpp"

namespace nook {

namespace {

using Plane = std::vector<float>;
const std::array<std::string, 3> rgb = {"R", "G", "B"};

/// A channel as reals; counts (AO.samples) are converted.
std::optional<Plane> plane(const Image& image, const std::string& name) {
  const Channel* channel = image.find(name);
  if (!channel) return std::nullopt;
  if (const Plane* reals = std::get_if<Plane>(&channel->values)) return *reals;
  const auto& counts = std::get<std::vector<std::uint32_t>>(channel->values);
  return Plane(counts.begin(), counts.end());
}

bool same_bits(const Plane& a, const Plane& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](float x, float y) {
    return std::bit_cast<std::uint32_t>(x) == std::bit_cast<std::uint32_t>(y);
  });
}

bool gray(const Image& image) {
  const auto r = plane(image, "R"), g = plane(image, "G"), b = plane(image, "B");
  return r && g && b && same_bits(*r, *g) && same_bits(*r, *b);
}

/// The channels to look at, or the reason why there are none in common.
std::vector<std::string> choose_channels(const Image& a, const Image& b,
                                         const std::vector<std::string>& asked, std::string& reason) {
  const auto has_rgb = [](const Image& image) {
    return std::all_of(rgb.begin(), rgb.end(), [&](const std::string& name) { return image.find(name); });
  };
  std::vector<std::string> names = asked;
  if (asked.empty() && has_rgb(a) && has_rgb(b)) {
    names.assign(rgb.begin(), rgb.end());
  } else if (asked.empty() || asked == std::vector<std::string>{"all"}) {
    names.clear();
    for (const Channel& channel : a.channels) names.push_back(channel.name);
    for (const Channel& channel : b.channels)
      if (!a.find(channel.name)) names.push_back(channel.name);
  }
  const auto missing = std::find_if(names.begin(), names.end(),
                                    [&](const std::string& name) { return !a.find(name) || !b.find(name); });
  if (missing != names.end())
    reason = fmt::format("channel {} is missing in {}", *missing,
                         a.find(*missing)   ? "the reference"
                         : b.find(*missing) ? "the first image"
                                            : "both images");
  return names;
}

/// Each pixel's variance: the plane that says so (AO.variance), or else an image of variances with the same
/// channel.
std::optional<Plane> variance_plane(const Image& image, const std::string& channel) {
  for (const Channel& candidate : image.channels)
    if (candidate.name.ends_with("variance")) return plane(image, candidate.name);
  return plane(image, channel);
}

double difference_of(float a, float b) {
  if (std::isfinite(a) && std::isfinite(b)) return double{a} - b;
  const bool alike = (std::isnan(a) && std::isnan(b)) || a == b;
  return alike ? 0 : std::numeric_limits<double>::infinity();
}

}  // namespace

Comparison compare(const Image& a, const Image& b, const Image* reference_variance,
                   const CompareOptions& options) {
  Comparison result;
  result.width = a.width;
  result.height = a.height;
  const auto incomparable = [&](const std::string& reason) {
    result.status = CompareStatus::incomparable;
    result.reason = reason;
    return result;
  };
  if (a.width != b.width || a.height != b.height)
    return incomparable(
        fmt::format("sizes differ: {} x {} and {} x {}", a.width, a.height, b.width, b.height));
  if (a.x0 != b.x0 || a.y0 != b.y0)
    return incomparable(
        fmt::format("the images are crops at {}, {} and {}, {} of theirs", a.x0, a.y0, b.x0, b.y0));
  if (reference_variance && (reference_variance->width != a.width || reference_variance->height != a.height))
    return incomparable(fmt::format("the variance has another size: {} x {}", reference_variance->width,
                                    reference_variance->height));
  std::vector<std::string> names = choose_channels(a, b, options.channels, result.reason);
  if (!result.reason.empty()) return incomparable(result.reason);
  const bool one_for_three =
      std::equal(names.begin(), names.end(), rgb.begin(), rgb.end()) && gray(a) && gray(b);
  if (one_for_three) names.resize(1);

  const std::size_t pixels = static_cast<std::size_t>(a.width) * static_cast<std::size_t>(a.height);
  std::vector<double> largest(pixels, 0.0);  // over the channels
  result.difference.width = a.width;
  result.difference.height = a.height;
  for (const std::string& name : names) {
    const Plane plane_a = *plane(a, name), plane_b = *plane(b, name);
    std::optional<Plane> variance;
    if (reference_variance && !(variance = variance_plane(*reference_variance, name)))
      return incomparable(fmt::format("the variance image has no channel for {}", name));
    const std::string label = one_for_three ? "R=G=B" : name;
    result.channels.push_back(
        {label, compare_images(plane_a, plane_b, a.width, a.height,
                               variance ? std::span(*variance) : std::span<const float>())});

    Plane difference(pixels);
    for (std::size_t i = 0; i < pixels; ++i) {
      const double d = difference_of(plane_a[i], plane_b[i]);
      difference[i] = static_cast<float>(d);
      largest[i] = std::max(largest[i], std::abs(d));
      if (std::abs(d) > std::abs(result.worst.difference))
        result.worst = {label,
                        static_cast<int>(i % static_cast<std::size_t>(a.width)),
                        static_cast<int>(i / static_cast<std::size_t>(a.width)),
                        plane_a[i],
                        plane_b[i],
                        d};
    }
    result.difference.channels.push_back({name, std::move(difference)});
  }

  const auto over = [&](double limit) {
    return static_cast<std::uint64_t>(
        std::count_if(largest.begin(), largest.end(), [&](double d) { return d > limit; }));
  };
  const auto exceeds = [&](const DifferenceLimit& limit, std::uint64_t count) {
    return 100.0 * static_cast<double>(count) > limit.percent * static_cast<double>(pixels) ||
           std::abs(result.worst.difference) > limit.hard;
  };
  result.pixels_over_fail = over(options.fail.each);
  result.pixels_over_warn = over(options.warn.each);
  if (exceeds(options.fail, result.pixels_over_fail))
    result.status = CompareStatus::failure;
  else if (exceeds(options.warn, result.pixels_over_warn))
    result.status = CompareStatus::warning;
  return result;
}

Comparison compare_files(const CompareOptions& options) {
  const Image a = read_exr(options.a), b = read_exr(options.b);
  std::optional<Image> variance;
  if (options.reference_variance) variance = read_exr(*options.reference_variance);
  return compare(a, b, variance ? &*variance : nullptr, options);
}

}  // namespace nook
