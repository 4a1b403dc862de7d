// The stop rules' mathematics, without randomness: a sequential rule is a finite Markov chain over (samples,
// hits), so bias and the share of intervals that hold follow exactly from summing the probabilities of where
// it ends.
#include "adaptive/stop_rule.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

namespace nook {
namespace {

struct Outcome {
  std::uint32_t n, k;
  double probability;
};

// Where the rule ends for hits of probability p, and how likely. A forward recursion over single batches; it
// knows of the rule only when it stops.
std::vector<Outcome> outcomes(const CountRule& rule, double p) {
  std::vector<double> going_on{1};
  std::uint32_t n = 0;
  std::vector<Outcome> ends;
  for (const std::uint32_t stage : rule.stages()) {
    for (; n < stage; ++n) {
      going_on.push_back(0);
      for (std::size_t k = going_on.size() - 1; k > 0; --k)
        going_on[k] = going_on[k] * (1 - p) + going_on[k - 1] * p;
      going_on[0] *= 1 - p;
    }
    for (std::uint32_t k = 0; k <= n; ++k) {
      if (stage != rule.stages().back() && !rule.done(n, k)) continue;
      if (going_on[k] > 0) ends.push_back({n, k, going_on[k]});
      going_on[k] = 0;
    }
    if (std::accumulate(going_on.begin(), going_on.end(), 0.0) < 1e-13) break;
  }
  return ends;
}

double expectation(const std::vector<Outcome>& ends, const std::function<double(const Outcome&)>& f) {
  double sum = 0;
  for (const Outcome& end : ends) sum += end.probability * f(end);
  return sum;
}

constexpr double probabilities[] = {.01, .02, .05, .1, .2, .3, .5, .7, .8, .9, .95, .98, .99};

TEST(NormalQuantile, KnownValues) {
  EXPECT_NEAR(normal_quantile(0.95), 1.959963984540054, 1e-12);
  EXPECT_NEAR(normal_quantile(0.6826894921370859), 1, 1e-12);
  EXPECT_NEAR(normal_quantile(0.999), 3.2905267314919255, 1e-11);
}

// Wilson's interval for 7 of 50 (z = 1.959964): (.0695, .2619), e.g. Newcombe 1998, table I has 81 of 263 at
// (.2553, .3662).
TEST(ScoreInterval, IsWilsonsForCounts) {
  const Interval interval = score_interval({81, 81, 263}, 1, normal_quantile(0.95));
  EXPECT_NEAR(interval.low, 0.2553, 5e-5);
  EXPECT_NEAR(interval.high, 0.3662, 5e-5);
}

// The samples' unit does not matter: values 0 and w give w times the interval of counts.
TEST(ScoreInterval, Scales) {
  const double w = 2.5;
  const Interval counts = score_interval({7, 7, 50}, 1, 1.96),
                 weights = score_interval({7 * w, 7 * w * w, 50}, w, 1.96);
  EXPECT_NEAR(weights.low, w * counts.low, 1e-12);
  EXPECT_NEAR(weights.high, w * counts.high, 1e-12);
}

TEST(SamplesNeeded, MeetsTheTarget) {
  for (const double p : probabilities)
    for (const double error : {.05, .01, .002}) {
      const double n = samples_needed(p, p, 1, error, 1.96);
      EXPECT_NEAR(score_interval({p * n, p * n, n}, 1, 1.96).half_width(), 1.96 * error, 1e-9);
    }
}

TEST(Checkpoints, GrowByAnEighthAndEndAtTheLast) {
  EXPECT_EQ(stages_from(16, 64), (std::vector<std::uint32_t>{16, 32, 48, 64}));
  EXPECT_EQ(stages_from(500, 700), (std::vector<std::uint32_t>{500, 548, 612, 676, 700}));
  EXPECT_EQ(stages_from(100, 50), std::vector<std::uint32_t>{50});
}

TEST(CountRule, TheEstimateIsUnbiased) {
  for (const double error : {.05, .02, .01}) {
    const CountRule rule({.error = error});
    for (const double p : probabilities) {
      const auto ends = outcomes(rule, p);
      EXPECT_NEAR(expectation(ends, [](const Outcome&) { return 1.0; }), 1, 1e-12);
      EXPECT_NEAR(expectation(ends, [&](const Outcome& end) { return rule.estimate(end.n, end.k); }), p, 1e-9)
          << "error " << error << ", p " << p;
    }
  }
}

// A stop for other reasons, after 200 samples, which is no checkpoint.
TEST(CountRule, StaysUnbiasedWhenStoppedFromOutside) {
  const CountRule whole({.error = .02}), cut({.error = .02, .max_spp = 200});
  for (const double p : probabilities) {
    const auto ends = outcomes(cut, p);
    EXPECT_NEAR(expectation(ends, [&](const Outcome& end) { return whole.estimate(end.n, end.k); }), p, 1e-9)
        << p;
  }
}

// Why the estimate is needed: k/n at the stopping time is low for small p by more than a tenth of its
// standard error.
TEST(CountRule, ThePlainMeanIsBiased) {
  const CountRule rule({.error = .02});
  const double p = .05;
  const auto ends = outcomes(rule, p);
  const double bias = expectation(ends, [](const Outcome& end) { return double(end.k) / end.n; }) - p;
  EXPECT_LT(bias, -.1 * .02);
}

double held_share(const CountRule& rule, double p) {
  return expectation(outcomes(rule, p),
                     [&](const Outcome& end) { return double(rule.interval(end.n, end.k).contains(p)); });
}

// Where the error asked is well below p and 1-p, so that the number of hits takes many values.
TEST(CountRule, IntervalsCoverAsOftenAsTheySay) {
  for (const double error : {.01, .005, .0025}) {
    const CountRule rule({.error = error});
    for (const double p : probabilities) {
      if (std::min(p, 1 - p) < 3.9 * error || (error < .005 && std::min(p, 1 - p) > .06)) continue;
      const double held = held_share(rule, p);
      EXPECT_GE(held, .929) << "error " << error << ", p " << p;
      EXPECT_LE(held, .97) << "error " << error << ", p " << p;
    }
  }
}

// What AO.variance says: the estimate, give or take 1.96 times its root. And the root is the estimate's
// standard error.
TEST(CountRule, TheEstimateIsAsAccurateAsItSays) {
  for (const double error : {.02, .01, .005}) {
    const CountRule rule({.error = error});
    for (const double p : {.01, .02, .03, .05, .07, .1, .2, .5, .8, .9, .93, .95, .97, .98, .99}) {
      if (std::min(p, 1 - p) < 2.9 * error || (error < .01 && std::min(p, 1 - p) > .06)) continue;
      const auto ends = outcomes(rule, p);
      const auto off = [&](const Outcome& end) { return rule.estimate(end.n, end.k) - p; };
      const double held = expectation(ends, [&](const Outcome& end) {
        return double(std::abs(off(end)) <= rule.half_width(end.n, end.k));
      });
      const double square = expectation(ends, [&](const Outcome& end) { return off(end) * off(end); });
      EXPECT_GE(held, .93) << "error " << error << ", p " << p;
      EXPECT_LE(held, .97) << "error " << error << ", p " << p;
      EXPECT_LE(std::sqrt(square), 1.01 * error) << "error " << error << ", p " << p;
    }
  }
}

// Where the error asked is as large as p itself, a few values of the count carry all the probability, and no
// set of them has 95 %; the interval then covers too often rather than too seldom.
TEST(CountRule, IntervalsOfRareEventsAreWide) {
  for (const double error : {.02, .01, .005}) {
    const CountRule rule({.error = error});
    for (const double p : {.01, .02, .98, .99}) {
      EXPECT_GE(held_share(rule, p), .929) << "error " << error << ", p " << p;
      EXPECT_LE(held_share(rule, p), .99) << "error " << error << ", p " << p;
    }
  }
}

// The samples taken are those that a fixed number would need, give or take the steps between the stages.
TEST(CountRule, TakesNoMoreThanItNeeds) {
  const CountRule rule({.error = .01});
  for (const double p : {.05, .2, .5, .8, .95}) {
    const double taken = expectation(outcomes(rule, p), [](const Outcome& end) { return double(end.n); });
    EXPECT_NEAR(taken / samples_needed(p, p, 1, .01, normal_quantile(.95)), 1.06, .08) << p;
  }
}

}  // namespace
}  // namespace nook
