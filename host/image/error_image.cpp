#include "image/error_image.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "image/exr.hpp"
#include "image/png.hpp"

namespace nook {

namespace {

std::vector<float> largest_of(const Image& difference) {
  std::vector<float> largest(static_cast<std::size_t>(difference.width) *
                             static_cast<std::size_t>(difference.height));
  for (const Channel& channel : difference.channels) {
    const auto& values = std::get<std::vector<float>>(channel.values);
    for (std::size_t i = 0; i < values.size(); ++i)
      if (!(std::abs(values[i]) <= std::abs(largest[i]))) largest[i] = values[i];
  }
  return largest;
}

/// The 99th percentile: a few outliers of a noisy image would leave the rest white.
double scale_of(const std::vector<float>& values) {
  std::vector<float> magnitudes;
  for (float value : values)
    if (std::isfinite(value)) magnitudes.push_back(std::abs(value));
  if (magnitudes.empty()) return 1;
  const auto rank = magnitudes.begin() + static_cast<std::ptrdiff_t>((magnitudes.size() - 1) * 99 / 100);
  std::nth_element(magnitudes.begin(), rank, magnitudes.end());
  return *rank > 0 ? *rank : 1;
}

}  // namespace

double write_error_image(const std::filesystem::path& path, const Image& difference) {
  const std::vector<float> values = largest_of(difference);
  const double scale = scale_of(values);
  if (path.extension() == ".exr") {
    write_exr(path, difference);
    return scale;
  }
  std::vector<float> red(values.size()), green(values.size()), blue(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i])) continue;
    const float t = static_cast<float>(std::clamp(values[i] / scale, -1.0, 1.0));
    red[i] = t < 0 ? 1 + t : 1;
    green[i] = 1 - std::abs(t);
    blue[i] = t > 0 ? 1 - t : 1;
  }
  Image colors{difference.width, difference.height, {}, {}};
  colors.channels.push_back({"R", std::move(red)});
  colors.channels.push_back({"G", std::move(green)});
  colors.channels.push_back({"B", std::move(blue)});
  write_png(path, colors);
  return scale;
}

}  // namespace nook
