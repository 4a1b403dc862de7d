#include "image/denoise.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <system_error>
#include <thread>

#include "base/threads.hpp"

namespace nook {
namespace {

constexpr float b3_spline[3] = {3.0f / 8, 1.0f / 4, 1.0f / 16};  // of |offset| 0, 1, 2
constexpr float gauss[2] = {1.0f / 2, 1.0f / 4};

struct Point {
  float n[3], x[3];
  bool surface;
};

float dot(const float (&a)[3], const float (&b)[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

std::vector<Point> points_of(const DenoiseGuides& guides) {
  std::vector<Point> points(std::size_t(guides.width) * std::size_t(guides.height));
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      points[i].n[axis] = guides.normal[axis][i];
      points[i].x[axis] = guides.position[axis][i];
    }
    points[i].surface = dot(points[i].n, points[i].n) > 0;
  }
  return points;
}

// How much of one surface q is as seen from p, 0 to 1.
float surface_weight(const Point& p, const Point& q, const DenoiseSettings& settings) {
  const float cosine = dot(p.n, q.n);
  if (!q.surface || cosine <= 0) return 0;
  const float to_q[3] = {q.x[0] - p.x[0], q.x[1] - p.x[1], q.x[2] - p.x[2]};
  const float length = std::sqrt(dot(to_q, to_q)), off_plane = std::abs(dot(p.n, to_q));
  const float sine = length > 0 ? off_plane / length : 0;
  return std::exp(settings.normal_power * std::log(std::min(cosine, 1.0f)) - sine / settings.plane_tolerance);
}

class Filter {
 public:
  Filter(const DenoiseGuides& guides, const DenoiseSettings& settings)
      : width_(guides.width), height_(guides.height), settings_(settings), points_(points_of(guides)) {}

  void pass(int step, std::vector<float>& values, std::vector<float>& variance) const {
    std::vector<float> new_values(values), new_variance(variance);
    for_rows([&](int y) {
      for (int x = 0; x < width_; ++x) filter(x, y, step, values, variance, new_values, new_variance);
    });
    values.swap(new_values);
    variance.swap(new_variance);
  }

 private:
  std::size_t at(int x, int y) const { return std::size_t(y) * std::size_t(width_) + std::size_t(x); }

  // Calls visit(weight, index) for the pixels x + dx step, y + dy step with |dx|, |dy| <= reach, itself
  // included.
  template <class Visit>
  void taps(int x, int y, int step, int reach, const float* kernel, Visit visit) const {
    for (int dy = -reach; dy <= reach; ++dy)
      for (int dx = -reach; dx <= reach; ++dx) {
        const int qx = x + dx * step, qy = y + dy * step;
        if (qx < 0 || qy < 0 || qx >= width_ || qy >= height_) continue;
        visit(kernel[std::abs(dx)] * kernel[std::abs(dy)], at(qx, qy));
      }
  }

  void filter(int x, int y, int step, const std::vector<float>& values, const std::vector<float>& variance,
              std::vector<float>& new_values, std::vector<float>& new_variance) const {
    const std::size_t p = at(x, y);
    if (!points_[p].surface) return;
    float variance_sum = 0, variance_weights = 0;
    taps(x, y, 1, 1, gauss, [&](float weight, std::size_t q) {
      weight *= q == p ? 1 : surface_weight(points_[p], points_[q], settings_);
      variance_sum += weight * variance[q];
      variance_weights += weight;
    });
    const float tolerance = settings_.deviations * std::sqrt(variance_sum / variance_weights);
    float weights = 0, moved = 0, of_variance = 0, least = values[p], largest = values[p];
    taps(x, y, step, 2, b3_spline, [&](float weight, std::size_t q) {
      const float difference = values[q] - values[p];
      if (q != p) {
        if (difference != 0 && !(tolerance > 0)) return;
        weight *= surface_weight(points_[p], points_[q], settings_);
        if (difference != 0) weight *= std::exp(-std::abs(difference) / tolerance);
      }
      if (!(weight > 0)) return;
      weights += weight;
      moved += weight * difference;
      of_variance += weight * weight * variance[q];
      least = std::min(least, values[q]);
      largest = std::max(largest, values[q]);
    });
    // Around the pixel's own value, so that equal values stay what they are whatever the weights' rounding.
    new_values[p] = std::clamp(values[p] + moved / weights, least, largest);
    new_variance[p] = of_variance / (weights * weights);
  }

  template <class Row>
  void for_rows(Row row) const {
    const unsigned count = threads_to_use(settings_.threads);
    std::atomic<int> next{0};
    const auto work = [&] {
      for (int y; (y = next++) < height_;) row(y);
    };
    std::vector<std::jthread> threads;
    try {
      for (unsigned i = 1; i < count; ++i) threads.emplace_back(work);
    } catch (const std::system_error&) {
      // The system gives no more threads: those there are do the work.
    }
    work();
  }

  int width_, height_;
  DenoiseSettings settings_;
  std::vector<Point> points_;
};

}  // namespace

std::vector<float> denoise(const DenoiseGuides& guides, std::span<const float> values,
                           std::span<const float> variance, const DenoiseSettings& settings) {
  std::vector<float> filtered(values.begin(), values.end()), spread(variance.begin(), variance.end());
  const Filter filter(guides, settings);
  for (int pass = 0; pass < settings.passes; ++pass) filter.pass(1 << pass, filtered, spread);
  return filtered;
}

}  // namespace nook
