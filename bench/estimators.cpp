// nook_bench_estimators: what docs/estimators.md shows, measured. JSON lines on stdout: variances per sample
// against their predictions, variance against samples by point set, and points to draw. docs/estimators.py
// makes figures and tables of them.
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <numbers>

#include "device/warps.hpp"
#include "support/estimates.hpp"
#include "support/samplers_on_host.hpp"
#include "support/statistics.hpp"

using namespace nook;
using namespace nook::test;

namespace {

const Sampler samplers[] = {Sampler::independent, Sampler::stratified, Sampler::halton, Sampler::sobol,
                            Sampler::zorder};

void print(const nlohmann::json& line) {
  std::printf("%s\n", line.dump().c_str());
}

void ambient_variances() {
  for (Sampling sampling : {Sampling::cosine, Sampling::hemisphere, Sampling::sphere}) {
    Estimator estimator({EffectKind::ao, sampling, Sampler::independent});
    for (const AmbientCase& c : ambient_cases()) {
      std::vector<float> values =
          estimator.samples({c.shape, c.size, c.limit, 0, {0, 0, 1}, 0}, 4096, 1, 256, 1);
      Moments m = moments(std::span<const float>(values));
      bool known = sampling == Sampling::cosine || c.cosine_moment > 0;
      print({{"table", "ambient"},
             {"case", c.name},
             {"value", c.value},
             {"sampling", name_of(sampling)},
             {"mean", m.mean},
             {"variance", m.variance},
             {"predicted", known ? nlohmann::json(c.variance(sampling)) : nlohmann::json()}});
    }
  }
}

void reflection_variances() {
  for (Sampling sampling :
       {Sampling::lobe, Sampling::mixture, Sampling::cosine, Sampling::hemisphere, Sampling::sphere}) {
    Estimator estimator({EffectKind::ro, sampling, Sampler::independent});
    for (float n : {0.0f, 1.0f, 2.0f, 10.0f, 100.0f})
      for (double degrees : {0.0, 60.0, 85.0}) {
        double theta = degrees * std::numbers::pi / 180;
        EstimatedScene scene;
        scene.exponent = n;
        scene.view = view_for_mirror_angle(theta);
        std::vector<float> values = estimator.samples(scene, 4096, 1, 256, 1);
        Moments m = moments(std::span<const float>(values));
        print({{"table", "reflection"},
               {"exponent", n},
               {"degrees", degrees},
               {"value", open_reflection(n, theta)},
               {"sampling", name_of(sampling)},
               {"mean", m.mean},
               {"variance", m.variance},
               {"predicted", open_reflection_variance(sampling, n, theta)}});
      }
  }
}

// The wall of height 1 at distance 1 before a receiver that moves by 1: pixel and direction, four dimensions.
void convergence() {
  const EstimatedScene moving{Shape::wall, {1, INFINITY, 1, 0}, INFINITY, 0, {0, 0, 1}, 1};
  for (Sampler sampler : samplers) {
    Estimator estimator({EffectKind::ao, Sampling::cosine, sampler});
    for (std::uint32_t n = 1; n <= 4096; n *= 2) {
      std::vector<double> means = estimator.pixel_means(moving, 1024, n, 1, 1);
      print({{"figure", "convergence"},
             {"sampler", name_of(sampler)},
             {"samples", n},
             {"variance", moments(std::span<const double>(means)).variance}});
    }
  }
}

void points() {
  EstimatorParams p{};
  p.samples = p.total_samples = 1;
  p.directions = p.total_directions = 256;
  p.seed = 1;
  std::vector<vec2> of_sobol;
  for (Sampler sampler : samplers) {
    nlohmann::json list = nlohmann::json::array();
    for (std::uint32_t d = 0; d < p.directions; ++d) {
      vec2 u = host_sample_direction(sampler, 7, 0, d, p);
      list.push_back({u.x, u.y});
      if (sampler == Sampler::sobol) of_sobol.push_back(u);
    }
    print({{"figure", "samplers"}, {"sampler", name_of(sampler)}, {"points", list}});
  }
  Warps warps(device());
  const std::tuple<const char*, Warp, float> maps[] = {{"cosine", Warp::cosine_hemisphere, 0.0f},
                                                       {"hemisphere", Warp::hemisphere, 0.0f},
                                                       {"sphere", Warp::sphere, 0.0f},
                                                       {"lobe, n = 10", Warp::cosine_power, 10.0f},
                                                       {"lobe, n = 300", Warp::cosine_power, 300.0f}};
  for (const auto& [name, warp, exponent] : maps) {
    nlohmann::json list = nlohmann::json::array();
    for (const vec3& w : warps.map(warp, of_sobol, exponent)) list.push_back({w.x, w.y, w.z});
    print({{"figure", "warps"}, {"warp", name}, {"points", list}});
  }
}

}  // namespace

int main() {
  ambient_variances();
  reflection_variances();
  convergence();
  points();
}
