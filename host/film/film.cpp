#include "film/film.hpp"

#include <algorithm>

namespace nook {

Film::Film(int w, int h, float sum_fixed_point, float square_fixed_point, std::uint32_t directions,
           std::size_t extra_planes)
    : width(w),
      height(h),
      sum_scale(sum_fixed_point),
      square_scale(square_fixed_point),
      per_replicate(directions) {
  sum.resize(pixels());
  sum_square.resize(pixels());
  replicates.resize(pixels());
  camera_samples.resize(pixels());
  hits.resize(pixels());
  extra.assign(extra_planes, std::vector<std::uint64_t>(pixels()));
}

void Film::add(const Film& other) {
  for (std::size_t i = 0; i < pixels(); ++i) {
    sum[i] += other.sum[i];
    sum_square[i] += other.sum_square[i];
    replicates[i] += other.replicates[i];
    camera_samples[i] += other.camera_samples[i];
    hits[i] += other.hits[i];
    for (std::size_t plane = 0; plane < extra.size(); ++plane) extra[plane][i] += other.extra[plane][i];
  }
}

double Film::value(std::size_t pixel) const {
  const double n = double(replicates[pixel]) * per_replicate;
  return n > 0 ? double(sum[pixel]) / (double(sum_scale) * n) : 0.0;
}

double Film::variance(std::size_t pixel) const {
  const double n = replicates[pixel];
  if (n < 2) return 0;
  const double mean = value(pixel);
  const double mean_square = double(sum_square[pixel]) / (double(square_scale) * n);
  return std::max(0.0, mean_square - mean * mean) / (n - 1);
}

double Film::coverage(std::size_t pixel) const {
  return camera_samples[pixel] ? double(hits[pixel]) / camera_samples[pixel] : 0.0;
}

}  // namespace nook
