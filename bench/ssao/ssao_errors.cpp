#include "bench/ssao/ssao_errors.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace nook::bench {

Reference trace_reference(const ReferenceTracer& tracer, const Camera& camera, int width, int height,
                          float radius, int grid) {
  Reference reference{width, height, {}, {}, {}};
  std::uint32_t state = 12345;
  for (int y = 0; y + 3 < height; y += 4)
    for (int x = 0; x + 3 < width; x += 4) {
      state = state * 1664525u + 1013904223u;
      reference.pixels.push_back(std::uint32_t(y + int(state >> 24 & 3)) * std::uint32_t(width) +
                                 std::uint32_t(x + int(state >> 28 & 3)));
    }
  reference.hits = tracer.primary(camera, width, height, reference.pixels);
  reference.ambient = tracer.ambient(reference.hits, radius, grid, 1);
  return reference;
}

void Differences::add(double value, const ReferenceTracer::Estimate& reference) {
  const double r = reference.value;
  n_ += 1, a_ += value, b_ += r, aa_ += value * value, bb_ += r * r, ab_ += value * r;
  absolute_ += std::abs(value - r);
  variance_ += reference.variance;
}

double Differences::rmse() const {
  return std::sqrt(std::max(0.0, (aa_ - 2 * ab_ + bb_ - variance_) / n_));
}

double Differences::correlation() const {
  return (n_ * ab_ - a_ * b_) / std::sqrt((n_ * aa_ - a_ * a_) * (n_ * bb_ - b_ * b_));
}

Errors errors_of(const Reference& reference, const std::function<double(std::uint32_t pixel)>& value) {
  Errors errors;
  for (std::size_t i = 0; i < reference.pixels.size(); ++i) {
    if (!reference.hits[i].hit) continue;
    const int x = int(reference.pixels[i]) % reference.width, y = int(reference.pixels[i]) / reference.width;
    const bool border = std::min(x, reference.width - 1 - x) < reference.width / 16 ||
                        std::min(y, reference.height - 1 - y) < reference.height / 16;
    const double v = value(reference.pixels[i]);
    errors.all.add(v, reference.ambient[i]);
    (border ? errors.border : errors.inner).add(v, reference.ambient[i]);
  }
  return errors;
}

nlohmann::json json_of(const Errors& e) {
  return {{"rmse", e.all.rmse()},         {"mae", e.all.mae()},
          {"bias", e.all.bias()},         {"correlation", e.all.correlation()},
          {"rmse_inner", e.inner.rmse()}, {"rmse_border", e.border.rmse()}};
}

}  // namespace nook::bench
