// What one independent sample's variance should be, from moments of V that another distribution measured.
#include <optional>

#include "report/study_methods.hpp"
#include "scene/names.hpp"
#include "trace/occlusion_tracer.hpp"

namespace nook {
namespace {

constexpr std::uint32_t moments_spp = 256;

}  // namespace

// With random numbers of its own: no method has these seeds.
StudyScene::Moments StudyScene::moments(Sampling sampling, float exponent) const {
  Scene scene = scene_;
  scene.effects.front().sampling = sampling;
  scene.effects.front().exponent = exponent;
  scene.sampler = Sampler::independent;
  Plan plan = make_plan(scene, mesh_);
  plan.spp = moments_spp;
  plan.seed = moments_seed;
  OcclusionTracer tracer(device_, plan, mesh_, bvh_);
  std::vector<Film> films = tracer.make_films();
  tracer.accumulate(pixels_in_order(plan.window, plan.width), {0, plan.spp}, films);
  const Film& film = films.front();
  Moments m;
  for (std::size_t i = 0; i < film.pixels(); ++i) {
    const double mean = film.value(i);
    m.value += mean / double(film.pixels());
    m.mean_square_value += (mean * mean - film.variance(i)) / double(film.pixels());
    m.second += double(film.sum_square[i]) / (double(film.square_scale) * plan.spp) / double(film.pixels());
  }
  return m;
}

// With V 0 or 1, a sample w V has the second moment E[w² V], and all of them are integrals of V over powers
// of cosines. AO: kernels/effect/ambient.cl, M = E[V cos θ] = half of a hemisphere sample's second moment. RO
// with exponent n, mirror direction r: let
//   S_m = 1/2π ∫ (r·ω)^m (N·ω)² V dω,
// then a lobe sample's second moment is (n+2)²/(n+1) S_n. Those of samples that know nothing of the lobe
// follow from a lobe of twice the exponent: cosine (n+2)²/(4(n+1)) RO_2n, hemisphere (n+2)² S_2n, sphere 2
// (n+2)² S_2n. Lobes of exponents n and 2n measure these. The balance heuristic has no such form. Neither
// have samples with a falloff or with an exponent that each material chooses: their own second moment is
// measured.
void StudyScene::predict(std::vector<StudyMethod>& methods) const {
  const Effect& effect = plan_.effects.front().effect;
  const bool ro = effect.kind == EffectKind::ro;
  const bool formulas = ro ? !effect.exponent_of_material : effect.falloff == Falloff::none;
  const double n = effect.exponent;
  std::optional<Moments> wide, narrow;  // RO: lobes of exponents n and 2n; AO: the hemisphere
  const auto lobe = [&] { return wide ? *wide : *(wide = moments(Sampling::lobe, effect.exponent)); };
  const auto half_lobe = [&] {
    return narrow ? *narrow : *(narrow = moments(Sampling::lobe, 2 * effect.exponent));
  };
  const auto hemisphere = [&] {
    return wide ? *wide : *(wide = moments(Sampling::hemisphere, effect.exponent));
  };
  for (StudyMethod& method : methods) {
    if (method.sampler != name_of(Sampler::independent) || method.directions != 1) continue;
    const Sampling sampling = *value_of<Sampling>(sampling_names, method.sampling);
    double second = 0, square = 0;
    std::string formula;
    if (formulas && ro && sampling == Sampling::lobe) {
      second = lobe().second;
      formula = "(n+2)²/(n+1) S(n) − RO²";
    } else if (formulas && ro && sampling != Sampling::mixture) {
      const double s2n = half_lobe().second * (2 * n + 1) / ((2 * n + 2) * (2 * n + 2));
      const double squared = (n + 2) * (n + 2);
      second = sampling == Sampling::cosine       ? squared / (4 * (n + 1)) * half_lobe().value
               : sampling == Sampling::hemisphere ? squared * s2n
                                                  : 2 * squared * s2n;
      formula = sampling == Sampling::cosine       ? "(n+2)²/(4n+4) RO(2n) − RO²"
                : sampling == Sampling::hemisphere ? "(n+2)² S(2n) − RO²"
                                                   : "2 (n+2)² S(2n) − RO²";
    } else if (formulas && !ro) {
      second = sampling == Sampling::cosine       ? hemisphere().value
               : sampling == Sampling::hemisphere ? hemisphere().second
                                                  : 2 * hemisphere().second;
      const bool uniform = effect.uniform_weight;
      formula = sampling == Sampling::cosine       ? "A − A²"
                : sampling == Sampling::hemisphere ? (uniform ? "A − A²" : "2M − A²")
                                                   : (uniform ? "2A − A²" : "4M − A²");
    } else {
      const Moments own = moments(sampling, effect.exponent);
      second = own.second;
      square = own.mean_square_value;
      formula = "its own moments, other seeds";
    }
    if (square == 0) square = ro ? lobe().mean_square_value : hemisphere().mean_square_value;
    method.predicted_variance = second - square;
    method.prediction = formula;
  }
}

}  // namespace nook
