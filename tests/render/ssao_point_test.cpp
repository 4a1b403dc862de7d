#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "ssao/shading_pass.hpp"
#include "ssao/ssao.hpp"
#include "ssao_scenes.hpp"

namespace nook {
namespace {

std::uint32_t pcg(std::uint32_t v) {
  const std::uint32_t state = v * 747796405u + 2891336453u;
  const std::uint32_t word = ((state >> ((state >> 28) + 4)) ^ state) * 277803737u;
  return (word >> 22) ^ word;
}

// Positions and normals as a G-buffer holds them, four floats a pixel.
struct SyntheticBuffer {
  int width, height;
  std::vector<float> positions, normals;
  vec3 position(int x, int y) const { return at(positions, x, y); }
  vec3 at(const std::vector<float>& values, int x, int y) const {
    const float* v = &values[4 * (std::size_t(y) * std::size_t(width) + std::size_t(x))];
    return {v[0], v[1], v[2]};
  }
};

// Depths jump at random from pixel to pixel between 2 and 3; a tenth is background; normals face the viewer's
// half.
SyntheticBuffer make_buffer(const SsaoView& view) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> uniform(0, 1);
  SyntheticBuffer buffer{view.width, view.height, {}, {}};
  for (int y = 0; y < view.height; ++y)
    for (int x = 0; x < view.width; ++x) {
      const bool background = uniform(random) < 0.1f;
      const vec3 p = background ? vec3(0, 0, -1e9f)
                                : view.reconstruct({float(x) + 0.5f, float(y) + 0.5f}, 2 + uniform(random));
      const vec3 n =
          glm::normalize(vec3(uniform(random) - 0.5f, uniform(random) - 0.5f, 0.2f + uniform(random)));
      buffer.positions.insert(buffer.positions.end(), {p.x, p.y, p.z, background ? 0.0f : 1.0f});
      buffer.normals.insert(buffer.normals.end(), {n.x, n.y, n.z, 1});
    }
  return buffer;
}

// The assignment's estimator, written from its equation (glsl/ssao.frag), in double precision.
double estimate(const SyntheticBuffer& buffer, const SsaoView& view, int x, int y, const SsaoPlan& plan) {
  const double pi = std::acos(-1.0);
  const dvec3 p = buffer.position(x, y), n = glm::normalize(dvec3(buffer.at(buffer.normals, x, y)));
  // Duff et al. 2017; the sign of n.z is positive in this test.
  const double a = -1 / (1 + n.z), b = n.x * n.y * a;
  const dvec3 s(1 + n.x * n.x * a, b, -n.x), t(b, 1 + n.y * n.y * a, -n.y);
  const double turn = double(pcg(std::uint32_t(y * view.width + x)) >> 8) / 16777216.0;
  double sum = 0;
  for (int i = 0; i < plan.directions; ++i) {
    const double z = (i + 0.5) / plan.directions, r = std::sqrt(1 - z * z);
    const double phi = 2 * pi * (turn + 0.6180339887 * i), pdf = 1 / (2 * pi);
    const dvec3 sample = p + double(plan.radius) * (r * std::cos(phi) * s + r * std::sin(phi) * t + z * n);
    bool visible = true;
    if (sample.z < 0) {
      const vec2 q = view.project(vec3(sample));
      const int column = int(std::floor(q.x)), row = int(std::floor(q.y));
      if (column >= 0 && row >= 0 && column < view.width && row < view.height) {
        const double stored = -buffer.position(column, row).z;
        visible = stored >= -sample.z - plan.bias;
        if (plan.range_check && -p.z - stored > plan.radius) visible = true;
      }
    }
    if (visible) sum += z / (pi * pdf);
  }
  return sum / plan.directions;
}

void shader_equals_host(const SsaoPlan& plan) {
  const Camera camera{{0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 45};
  const SsaoView view = make_ssao_view(camera, 61, 47, 0);
  const SyntheticBuffer synthetic = make_buffer(view);
  const std::unique_ptr<GlContext> context = make_gl_context();
  const GlFunctions& gl = context->functions();
  GBuffer buffer(*context, view.width, view.height, true, 1);
  const auto upload = [&](const GlTexture& texture, const std::vector<float>& values) {
    gl.glBindTexture(GL_TEXTURE_2D, texture.id());
    gl.glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, view.width, view.height, GL_RGBA, GL_FLOAT, values.data());
  };
  upload(*buffer.position, synthetic.positions);
  upload(*buffer.exact_normals, synthetic.normals);
  ShadingTargets targets(*context, view.width, view.height, false);
  ShadingPass shading(*context);
  const std::vector<float> values =
      shading.draw(plan, view, buffer, targets, [](const char*) {}).read(0, 1, 0, 0, view.width, view.height);
  // A sample whose pixel or depth falls on the other side by rounding changes the value by up to 2/N.
  int differ = 0;
  double occluded = 0;
  for (int y = 0; y < view.height; ++y)
    for (int x = 0; x < view.width; ++x) {
      const std::size_t i = std::size_t(y) * std::size_t(view.width) + std::size_t(x);
      const double expected = synthetic.positions[4 * i + 3] == 0 ? 0 : estimate(synthetic, view, x, y, plan);
      const double difference = std::abs(double(values[i]) - expected);
      differ += difference > 1e-5;
      EXPECT_LE(difference, 4.0 / plan.directions) << x << "," << y;
      occluded += expected < 0.95;
    }
  EXPECT_LE(differ, 12) << "of " << values.size();
  EXPECT_GT(occluded, 0.3 * double(values.size())) << "the case tests little";
}

TEST(SsaoPoint, ShaderEqualsHost) {
  SsaoPlan plan;
  plan.radius = 0.4f;
  shader_equals_host(plan);
  plan.directions = 5;
  shader_equals_host(plan);
}

TEST(SsaoPoint, ShaderEqualsHostWithBiasAndRangeCheck) {
  SsaoPlan plan;
  plan.radius = 0.4f;
  plan.bias = 0.1f;
  shader_equals_host(plan);
  plan.bias = 0;
  plan.range_check = true;
  shader_equals_host(plan);
}

// Nothing above a plane: every sample is visible, and 1/32 sum 2 (i + 1/2)/32 = 1.
TEST(SsaoPoint, FlatPlaneIsExactlyOne) {
  TriangleMesh mesh;
  test::add_quad(mesh, {-10, -10, 0}, {20, 0, 0}, {0, 20, 0});
  for (const int samples : {1, 8, 32}) {
    SsaoSettings settings;
    settings.samples = samples;
    const SsaoFrame frame =
        SsaoRenderer(mesh).render({{0, 0, 3}, {0, 0, 0}, {0, 1, 0}, 50}, settings, 65, 33);
    for (const float value : frame.occlusion) ASSERT_EQ(value, 1.0f);
  }
}

// Independent directions: 1/32 sum 2 u has mean 1 and variance 1/(3 32); clamped to 1, a normal variable of
// that spread loses sigma / sqrt(2 pi).
TEST(SsaoPoint, AsPublishedAFlatPlaneIsClampedNoise) {
  TriangleMesh mesh;
  test::add_quad(mesh, {-10, -10, 0}, {20, 0, 0}, {0, 20, 0});
  SsaoPlan plan;
  plan.as_published = true;
  const SsaoFrame frame = SsaoRenderer(mesh).render({{0, 0, 3}, {0, 0, 0}, {0, 1, 0}, 50}, plan, 256, 256);
  double sum = 0;
  for (const float value : frame.occlusion) {
    ASSERT_LE(value, 1.0f);
    sum += double(value);
  }
  // 65536 pixels of standard deviation .06: a standard error of 2.4e-4; 4 of them.
  EXPECT_NEAR(sum / double(frame.occlusion.size()), 1 - std::sqrt(1.0 / (3 * 32) / (2 * std::acos(-1.0))),
              1e-3);
}

// A silhouette far in front of a wall: without the range check the point method draws a dark halo around it,
// with it none.
TEST(SsaoPoint, RangeCheckRemovesTheHalo) {
  TriangleMesh mesh;
  test::add_quad(mesh, {-10, -10, -5}, {20, 0, 0}, {0, 20, 0});
  test::add_quad(mesh, {-0.5f, -0.5f, 0}, {1, 0, 0}, {0, 1, 0});
  const Camera camera{{0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 40};
  SsaoSettings settings;
  settings.radius = 0.5f;
  SsaoRenderer renderer(mesh);
  const auto darkest = [&] {
    const SsaoFrame frame = renderer.render(camera, settings, 200, 200);
    return *std::min_element(frame.occlusion.begin(), frame.occlusion.end());
  };
  EXPECT_LT(darkest(), 0.7f);
  settings.range_check = true;
  EXPECT_EQ(darkest(), 1.0f);
}

}  // namespace
}  // namespace nook
