// The study's efficiency table against theory, where both are known in closed form: under a ceiling at height
// 1 with rays of length r, A = 1/r² and, since rays closer to the normal than cos θ = √A are blocked, M = E[V
// cos θ] = 2/3 A^(3/2).
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>

#include "mesh/obj_loader.hpp"
#include "report/study_methods.hpp"
#include "support/kernels.hpp"
#include "temporary_folder.hpp"

namespace nook {
namespace {

TEST(StudyTheory, MeasuredVariancesAreThoseOfTheFormulas) {
  test::TemporaryFolder folder;
  std::ofstream obj(folder.path() / "ceiling.obj");
  for (const char* height : {"0", "1"})
    obj << "v -25 " << height << " -25\nv 25 " << height << " -25\nv 25 " << height << " 25\nv -25 " << height
        << " 25\n";
  obj << "f 4 3 2 1\nf 5 6 7 8\n";
  obj.close();
  const TriangleMesh mesh = load_obj(folder.path() / "ceiling.obj");
  const Bvh bvh = build_bvh(mesh);
  const double value = .3, m = 2. / 3 * std::pow(value, 1.5);
  const std::map<std::string, double> variance = {{"cosine", value - value * value},
                                                  {"hemisphere", 2 * m - value * value},
                                                  {"sphere", 4 * m - value * value}};
  Scene scene;
  scene.camera = {{0, 0.9f, 0}, {0.1f, 0, 0}, {0, 0, 1}, 40};
  scene.effects = {Effect{}};
  scene.effects.front().max_distance = {DistanceLimit::Kind::value, float(1 / std::sqrt(value))};
  const StudyScene studied(test::device(), scene, mesh, bvh, 64, 64);
  StudyChoice choice;
  choice.samplers = {Sampler::independent};
  choice.max_spp = 16;
  choice.adaptive = choice.ssao = false;
  Study study(studied.methods(choice), studied.reference(0.5), {.seconds = 60, .seed = 3});
  EXPECT_TRUE(study.run([](const Study&) { return true; }));
  for (const StudyMethod& method : study.methods()) {
    const double expected = variance.at(method.sampling);
    // From 256 samples of 4096 pixels, a standard error of .2 % at the most skewed.
    EXPECT_NEAR(method.predicted_variance / expected, 1, .01) << method.name;
    for (const StudyPoint& point : study.points()) {
      if (point.method != method.name) continue;
      EXPECT_GE(point.runs.size(), 16u);
      double mean = 0, square = 0;
      for (const StudyRun& run : point.runs) mean += run.mean_square_error / double(point.runs.size());
      for (const StudyRun& run : point.runs) square += std::pow(run.mean_square_error - mean, 2);
      const double runs = double(point.runs.size()), deviation = std::sqrt(square / (runs - 1) / runs);
      EXPECT_NEAR(mean * point.level, expected, 3 * deviation * point.level) << method.name << point.level;
      const PointSummary s = summarise(point);
      EXPECT_NEAR(s.efficiency * s.wall_seconds * mean, 1, 1e-9);
    }
  }
}

}  // namespace
}  // namespace nook
