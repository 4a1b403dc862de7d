#include "support/image_comparison.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "image/exr.hpp"
#include "image/png.hpp"
#include "support/statistics.hpp"

namespace nook::test {
namespace {

struct Mean {
  double mean = 0, variance = 0, count = 0;
};

// P-value that a and b estimate the same; each has the variance of its mean.
double p_of_difference(const Mean& a, const Mean& b) {
  double variance = a.variance + b.variance, difference = a.mean - b.mean;
  if (variance == 0) return std::abs(difference) < 1e-6 ? 1 : 0;
  double degrees = variance * variance /
                   (a.variance * a.variance / (a.count - 1) + b.variance * b.variance / (b.count - 1));
  return student_p(difference / std::sqrt(variance), degrees);
}

std::vector<Mean> pixels_of(const ReferenceImage& image) {
  std::vector<Mean> pixels;
  for (std::size_t i = 0; i < image.mean.size(); ++i)
    pixels.push_back({image.mean[i], image.variance[i], image.count});
  return pixels;
}

void pool(std::vector<Mean>& a, std::vector<Mean>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    double between = (a[i].mean - b[i].mean) * (a[i].mean - b[i].mean) * a[i].count * b[i].count /
                     (a[i].count + b[i].count);
    double within =
        a[i].variance * a[i].count * (a[i].count - 1) + b[i].variance * b[i].count * (b[i].count - 1);
    double of_sample = (within + between) / (a[i].count + b[i].count - 1);
    a[i].variance = of_sample / a[i].count;
    b[i].variance = of_sample / b[i].count;
  }
}

// Means over tiles of `size` x `size` pixels; pixels are independent, so variances add.
std::vector<Mean> tiles_of(const std::vector<Mean>& pixels, int width, int height, int size) {
  int columns = (width + size - 1) / size, rows = (height + size - 1) / size;
  std::vector<Mean> tiles(std::size_t(columns * rows));
  std::vector<double> area(tiles.size());
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      std::size_t tile = std::size_t(y / size * columns + x / size);
      const Mean& pixel = pixels[std::size_t(y * width + x)];
      tiles[tile].mean += pixel.mean;
      tiles[tile].variance += pixel.variance;
      tiles[tile].count += pixel.count;
      ++area[tile];
    }
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    tiles[i].mean /= area[i];
    tiles[i].variance /= area[i] * area[i];
  }
  return tiles;
}

std::vector<double> p_values(const std::vector<Mean>& a, const std::vector<Mean>& b) {
  std::vector<double> p(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) p[i] = p_of_difference(a[i], b[i]);
  return p;
}

std::vector<float> floats(const std::vector<double>& values) {
  return {values.begin(), values.end()};
}

}  // namespace

ImageVerdict compare(const ReferenceImage& a, const ReferenceImage& b, bool pooled) {
  std::vector<Mean> pixels_a = pixels_of(a), pixels_b = pixels_of(b);
  if (pooled) pool(pixels_a, pixels_b);
  ImageVerdict verdict;
  auto smallest = [&](int size, double& p, bool& agrees) {
    std::vector<double> all =
        p_values(tiles_of(pixels_a, a.width, a.height, size), tiles_of(pixels_b, a.width, a.height, size));
    p = *std::min_element(all.begin(), all.end());
    agrees = p >= sidak(1e-3, all.size());
  };
  smallest(1, verdict.pixel_p, verdict.pixels_agree);
  smallest(16, verdict.tile_p, verdict.tiles_agree);
  smallest(std::max(a.width, a.height), verdict.image_p, verdict.image_agrees);
  return verdict;
}

ImageVerdict compare_with_evidence(const ReferenceImage& image, const ReferenceImage& reference, bool pooled,
                                   const std::string& name) {
  ImageVerdict verdict = compare(image, reference, pooled);
  if (verdict.agree()) return verdict;
  const char* chosen = std::getenv("NOOK_EVIDENCE");
  std::filesystem::path folder = chosen ? chosen : "evidence";
  std::filesystem::create_directories(folder);
  std::vector<Mean> a = pixels_of(image), b = pixels_of(reference);
  if (pooled) pool(a, b);
  std::vector<double> difference, magnitude, p = p_values(a, b);
  for (std::size_t i = 0; i < a.size(); ++i) {
    difference.push_back(image.mean[i] - reference.mean[i]);
    magnitude.push_back(std::abs(difference.back()));
  }
  Image exr{image.width,
            image.height,
            {{"image", floats(image.mean)},
             {"reference", floats(reference.mean)},
             {"reference.variance", floats(reference.variance)},
             {"difference", floats(difference)},
             {"p", floats(p)}},
            {}};
  write_exr(folder / (name + ".exr"), exr);
  std::vector<float> gray = floats(magnitude);
  write_png(folder / (name + ".png"),
            Image{image.width, image.height, {{"R", gray}, {"G", gray}, {"B", gray}}, {}});
  return verdict;
}

}  // namespace nook::test
