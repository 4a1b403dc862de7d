#include <algorithm>
#include <bit>
#include <cmath>

#include "adaptive/pixel_rule.hpp"

namespace nook {
namespace {

constexpr unsigned degrees_of_neighbours = 12;
// The most by which a pixel's own variance may exceed the one asked for, as a factor. With 1.2 the root mean
// square over a picture may exceed the error asked. With 1 the decision follows the estimate's own samples
// more, and biases values as small as the error by more than .1 standard errors.
constexpr double own_excess = 1.1;
// The squared error of an Owen-scrambled sequence falls about like n^-1.25 in four dimensions with edges.
constexpr double rate = 1.25;

// Planes: samples when the pixel stopped, and the variance that it claimed then, a double: its neighbours may
// go on, and theirs is no longer comparable. The randomisations' sums are the session's.
class ReplicatedPixels : public PixelRule {
 public:
  ReplicatedPixels(double bound, const Randomisations& randomisations, const ErrorTarget& target)
      : PixelRule(randomisations.count, bound, target),
        randomisations_(randomisations),
        degrees_(randomisations.count - 1),
        quantile_(student_quantile(target.confidence, degrees_ + degrees_of_neighbours)) {}

  std::size_t planes() const override { return 2; }

  void look(Film& film, std::uint32_t stage) override {
    prepare(film);
    for (std::size_t i = 0; i < film.pixels(); ++i)
      if (!done(film, i) && film.camera_samples[i] == stage &&
          deciding_half_width(film, i) <= z_ * target_.error) {
        const double variance = moderated_variance(film, i);
        film.kept[plane_ + 1][i] = std::bit_cast<std::uint64_t>(variance);
        film.kept[plane_][i] = stage;
      }
  }
  double samples_needed(const Film& film, std::size_t i) const override {
    const double times = deciding_half_width(film, i) / (z_ * target_.error);
    return film.camera_samples[i] * std::pow(std::max(1.0, times * times), 1 / rate);
  }
  PixelEstimate estimate(const Film& film, std::size_t i) const override {
    return {film.value(i), half_width(film, i), film.camera_samples[i]};
  }
  double deciding_half_width(const Film& film, std::size_t i) const override {
    const double around = quantile_ * std::sqrt(variance_around(film, i)), own = half_width(film, i);
    return std::max(around, own / std::sqrt(own_excess));
  }
  double half_width(const Film& film, std::size_t i) const override {
    const double variance = samples_at_stop(film, i) == film.camera_samples[i]
                                ? std::bit_cast<double>(film.kept[plane_ + 1][i])
                                : moderated_variance(film, i);
    // An event of probability 1 / (9 n) has a standard error of 1 / (3 n).
    const double unseen = bound_ / (3.0 * film.camera_samples[i] * film.per_replicate);
    return quantile_ * (variance > 0 ? std::sqrt(variance) : unseen);
  }
  void prepare(const Film& film) override {
    variances_.resize(film.pixels());
    for (std::size_t i = 0; i < film.pixels(); ++i) variances_[i] = variance_of_mean(film, i);
  }

 private:
  double moderated_variance(const Film& film, std::size_t i) const {
    return (degrees_ * variances_[i] + degrees_of_neighbours * variance_around(film, i)) /
           (degrees_ + degrees_of_neighbours);
  }

  // Of pixel i's mean, by the spread of its randomisations' means. Between stages some have more samples than
  // others; each then counts by its number.
  double variance_of_mean(const Film& film, std::size_t i) const {
    const double n = film.camera_samples[i], scale = double(film.sum_scale) * film.per_replicate;
    if (n == 0) return 0;
    const double mean = film.value(i);
    double sum = 0;
    for (std::uint32_t r = 0; r < randomisations_.count; ++r) {
      const double taken = randomisations_.samples_of(r, film.camera_samples[i]);
      if (taken == 0) continue;
      const double difference = double(film.kept[r][i]) / (scale * taken) - mean;
      sum += taken * difference * difference;
    }
    return sum / (n * degrees_);
  }

  // The mean variance of the neighbours, scaled to this pixel's number of samples; its own if there is none.
  double variance_around(const Film& film, std::size_t i) const {
    const int width = film.width, x = int(i) % width, y = int(i) / width;
    double sum = 0, pixels = 0;
    for (int v = std::max(0, y - 1); v <= std::min(film.height - 1, y + 1); ++v)
      for (int u = std::max(0, x - 1); u <= std::min(width - 1, x + 1); ++u) {
        const std::size_t j = std::size_t(v) * std::size_t(width) + std::size_t(u);
        if (j == i || background(film, j) || film.camera_samples[j] == 0) continue;
        sum += variances_[j] * film.camera_samples[j] / film.camera_samples[i];
        pixels += 1;
      }
    return pixels > 0 ? sum / pixels : variances_[i];
  }

  Randomisations randomisations_;
  unsigned degrees_;
  double quantile_;
  std::vector<double> variances_;  // by pixel; follows from the sums
};

}  // namespace

std::unique_ptr<PixelRule> replicate_rule(const EffectPlan& effect, const Randomisations& randomisations,
                                          const ErrorTarget& target) {
  return std::make_unique<ReplicatedPixels>(effect.weight_bound, randomisations, target);
}

}  // namespace nook
