#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "ssao/gl_context.hpp"
#include "ssao/plan.hpp"
#include "support/expect_error.hpp"

namespace nook {
namespace {

TEST(GlContext, DrawsWithGl45) {
  const std::unique_ptr<GlContext> context = make_gl_context();
  EXPECT_NE(context->version().find("4.5"), std::string::npos) << context->version();
  EXPECT_FALSE(context->renderer().empty());
}

TEST(GlContext, DrawsWithSurfacelessEgl) {
  setenv("NOOK_GL", "egl", 1);
  const std::unique_ptr<GlContext> context = make_gl_context(), another = make_gl_context();
  unsetenv("NOOK_GL");
  context->make_current();
  EXPECT_EQ(context->version().rfind("4.", 0), 0u) << context->version();
  EXPECT_FALSE(context->renderer().empty());
  context->check("testing");
}

TEST(GlContext, RefusesAnUnknownLibrary) {
  setenv("NOOK_GL", "glx", 1);
  test::expect_error(ErrorKind::device, "NOOK_GL is 'glx'", [] { make_gl_context(); });
  unsetenv("NOOK_GL");
}

TEST(GlContext, ReportsGlErrorsInOneLine) {
  const std::unique_ptr<GlContext> context = make_gl_context();
  context->functions().glEnable(0xffff);
  test::expect_error(ErrorKind::device, "0x0500 while testing", [&] { context->check("testing"); });
  context->check("testing again");
}

TEST(GlContext, SaysWhenTheLibraryIsMissing) {
  setenv("NOOK_OSMESA", "libnook-no-such-library.so", 1);
  test::expect_error(ErrorKind::device, "libnook-no-such-library.so", [] { make_gl_context(); });
  setenv("NOOK_OSMESA", "libm.so.6", 1);
  test::expect_error(ErrorKind::device, "OSMesaCreateContextAttribs", [] { make_gl_context(); });
  unsetenv("NOOK_OSMESA");
}

// Mesa itself crashes on an unknown name.
TEST(GlContext, RefusesAnUnknownGalliumDriver) {
  setenv("GALLIUM_DRIVER", "nouveau-typo", 1);
  test::expect_error(ErrorKind::device, "nouveau-typo", [] { make_gl_context(); });
  unsetenv("GALLIUM_DRIVER");
}

TEST(SsaoPlan, RadiusZeroIsHalfTheBoundingRadius) {
  Bounds3 bounds;
  bounds.add(vec3(0));
  bounds.add(vec3(2, 4, 4));  // diagonal 6, radius 3
  SsaoSettings settings;
  settings.radius = 0;
  EXPECT_FLOAT_EQ(plan_ssao(settings, bounds).radius, 1.5f);
}

TEST(SsaoPlan, RefusesWhatMakesNoPicture) {
  const auto refuses = [](const char* part, auto&& change) {
    SsaoSettings settings;
    change(settings);
    test::expect_error(ErrorKind::scene, part, [&] { plan_ssao(settings, {}); });
  };
  refuses("samples", [](SsaoSettings& s) { s.samples = 0; });
  refuses("samples", [](SsaoSettings& s) { s.samples = 33; });
  refuses("radius", [](SsaoSettings& s) { s.radius = -1; });
  refuses("radius", [](SsaoSettings& s) { s.radius = std::nanf(""); });
  refuses("bias", [](SsaoSettings& s) { s.bias = -0.1f; });
}

}  // namespace
}  // namespace nook
