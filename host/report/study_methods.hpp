#pragma once

#include <memory>
#include <optional>

#include "bvh/bvh.hpp"
#include "device/device.hpp"
#include "mesh/triangle_mesh.hpp"
#include "plan/plan.hpp"
#include "report/study.hpp"
#include "scene/scene.hpp"

namespace nook {

/// What a study compares. Empty lists stand for a default: every sampler with the best distribution, and
/// every distribution with two samplers.
struct StudyChoice {
  std::vector<Sampling> samplings;
  std::vector<Sampler> samplers;
  std::uint32_t max_spp = 1024;
  bool adaptive = true, ssao = true;
  bool predictions = true;  ///< of the variance, which takes a short render
};

/// One scene's picture at one size, by every method of a study. Studies its first AO or RO effect; an SSAO
/// effect as AO of the same radius.
class StudyScene {
 public:
  /// device, mesh and bvh must outlive it and its methods. Throws Error(scene) if the scene has no occlusion
  /// effect.
  StudyScene(const Device& device, const Scene& scene, const TriangleMesh& mesh, const Bvh& bvh, int width,
             int height);

  int width() const { return scene_.width; }
  int height() const { return scene_.height; }
  const EffectPlan& effect() const { return plan_.effects.front(); }

  /// The methods; their kernels are built before their first run. This must outlive them. `warning`: what is
  /// left out that was asked for, in one line.
  std::vector<StudyMethod> methods(const StudyChoice& choice, std::string* warning = nullptr) const;
  /// One of them.
  StudyMethod ray_traced(Sampling sampling, Sampler sampler, std::uint32_t directions,
                         std::uint32_t max_spp) const;
  /// By the stop rule of that sampler: independent or sobol.
  StudyMethod adaptive(Sampler sampler) const;
  /// Cosine (RO: lobe) and Sobol' through image/denoise.hpp.
  StudyMethod denoised(std::uint32_t max_spp) const;

  /// 16 independent scrambles of Halton's sequence, with seeds that no method has. Their samples are doubled
  /// until about `seconds` have passed; the variance is measured between the scrambles.
  StudyReference reference(double seconds) const;

  /// Camera samples a second of the cosine (RO: lobe) estimator, from a run of a fraction of a second.
  double samples_per_second() const;

 private:
  // far from the runs' seeds, which count up from the study's
  static constexpr std::uint32_t reference_seed = 0x7265666fu, moments_seed = reference_seed + 1000;
  // Means over pixels: of the value, of its square, of a sample's square.
  struct Moments {
    double value = 0, mean_square_value = 0, second = 0;
  };
  struct Program;
  Plan plan_with(Sampling sampling, Sampler sampler, std::uint32_t directions) const;
  Moments moments(Sampling sampling, float exponent) const;
  void predict(std::vector<StudyMethod>& methods) const;
  StudyMethod screen_space(SsaoSettings::Method method, std::optional<SsaoSettings::Quality> quality) const;

  const Device& device_;
  Scene scene_;
  const TriangleMesh& mesh_;
  const Bvh& bvh_;
  Plan plan_;
};

/// About how many camera samples a study of these methods takes for each pixel. The size of its picture
/// follows from that.
double samples_per_pixel(const std::vector<StudyMethod>& methods);

}  // namespace nook
