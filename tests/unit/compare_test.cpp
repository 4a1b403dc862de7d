#include "image/compare.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "image/error_image.hpp"
#include "image/exr.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace nook {
namespace {

using Plane = std::vector<float>;
const float nan = std::nanf("");
const float infinity = std::numeric_limits<float>::infinity();

Image gray(int width, int height, const Plane& values) {
  return {width, height, {{"R", values}, {"G", values}, {"B", values}}, {}};
}

CompareOptions limits(double fail, double warn) {
  CompareOptions options;
  options.fail.each = fail;
  options.warn.each = warn;
  return options;
}

CompareStatus status_of(const Plane& a, const Plane& b, const CompareOptions& options) {
  const int width = static_cast<int>(a.size());
  return compare(gray(width, 1, a), gray(width, 1, b), nullptr, options).status;
}

TEST(Compare, ThresholdsAreExclusive) {
  const Plane a = {0, 0.5f}, b = {0, 0.25f};
  EXPECT_EQ(status_of(a, a, limits(0, 0)), CompareStatus::same);
  EXPECT_EQ(status_of(a, b, limits(0.25, 0.25)), CompareStatus::same);
  EXPECT_EQ(status_of(a, b, limits(0.25, 0.125)), CompareStatus::warning);
  EXPECT_EQ(status_of(a, b, limits(0.125, 0.125)), CompareStatus::failure);
}

// Two crops of the same size from different places of a picture have nothing to do with each other.
TEST(Compare, CropsLieInTheSamePlace) {
  test::TemporaryFolder folder;
  Image a = gray(2, 1, {0, 1}), b = a;
  a.full_width = b.full_width = 8;
  a.full_height = b.full_height = 6;
  a.x0 = 3;
  a.y0 = b.y0 = 2;
  b.x0 = 4;
  write_exr(folder.path() / "a.exr", a);
  write_exr(folder.path() / "b.exr", b);
  CompareOptions options = limits(0, 0);
  options.a = options.b = folder.path() / "a.exr";
  EXPECT_EQ(compare_files(options).status, CompareStatus::same);
  options.b = folder.path() / "b.exr";
  const Comparison result = compare_files(options);
  EXPECT_EQ(result.status, CompareStatus::incomparable);
  EXPECT_EQ(result.reason, "the images are crops at 3, 2 and 4, 2 of theirs");
}

TEST(Compare, SomePercentMayDiffer) {
  const Plane a = {0, 0, 0, 1}, b = {0, 0, 0, 0};
  CompareOptions options = limits(0.5, 1);
  options.fail.percent = 25;
  EXPECT_EQ(status_of(a, b, options), CompareStatus::same);
  options.fail.percent = 24;
  EXPECT_EQ(status_of(a, b, options), CompareStatus::failure);
  options.fail.percent = 25;
  options.fail.hard = 0.75;
  EXPECT_EQ(status_of(a, b, options), CompareStatus::failure);
}

TEST(Compare, ValuesThatAreNotFiniteMustBeAlike) {
  const CompareOptions loose = limits(1e30, 1e30);
  EXPECT_EQ(status_of({nan, infinity, 1}, {nan, infinity, 1}, loose), CompareStatus::same);
  EXPECT_EQ(status_of({nan}, {1}, loose), CompareStatus::failure);
  EXPECT_EQ(status_of({1}, {infinity}, loose), CompareStatus::failure);
  EXPECT_EQ(status_of({nan}, {infinity}, loose), CompareStatus::failure);
  EXPECT_EQ(status_of({-infinity}, {infinity}, loose), CompareStatus::failure);
}

TEST(Compare, SaysWhereTheWorstPixelIs) {
  Plane a(12, 0.5f), b(12, 0.5f);
  a[7] = 0.75f;
  b[11] = 1.5f;  // x 3, y 2 of 4 x 3
  const Comparison c = compare(gray(4, 3, a), gray(4, 3, b), nullptr, {});
  EXPECT_EQ(c.worst.x, 3);
  EXPECT_EQ(c.worst.y, 2);
  EXPECT_EQ(c.worst.difference, -1);
  EXPECT_EQ(c.worst.channel, "R=G=B");
  EXPECT_EQ(c.pixels_over_fail, 2u);
  ASSERT_EQ(c.channels.size(), 1u);
}

TEST(Compare, PixelsThatDifferInOneChannelCount) {
  Image a = gray(2, 1, {0, 0}), b = a;
  std::get<Plane>(b.channels[2].values)[1] = 1;
  const Comparison c = compare(a, b, nullptr, {});
  EXPECT_EQ(c.channels.size(), 3u);
  EXPECT_EQ(c.pixels_over_fail, 1u);
  EXPECT_EQ(c.worst.channel, "B");
}

TEST(Compare, IncomparablePairsSayWhy) {
  const Image a = gray(2, 1, {0, 0});
  const auto reason = [&](const Image& b, const CompareOptions& options) {
    const Comparison c = compare(a, b, nullptr, options);
    EXPECT_EQ(c.status, CompareStatus::incomparable);
    return c.reason;
  };
  EXPECT_EQ(reason(gray(1, 2, {0, 0}), {}), "sizes differ: 2 x 1 and 1 x 2");
  EXPECT_EQ(reason({2, 1, {{"Y", Plane(2)}}, {}}, {}), "channel R is missing in the reference");
  CompareOptions normals;
  normals.channels = {"N.X"};
  EXPECT_EQ(reason(a, normals), "channel N.X is missing in both images");
}

TEST(Compare, TheVarianceComesFromItsOwnChannel) {
  const Plane a = {0.5f, 0.5f}, b = {0.625f, 0.375f};
  Image reference = gray(2, 1, b);
  reference.channels.push_back({"AO.variance", Plane(2, 1.0f / 64)});
  const Comparison c = compare(gray(2, 1, a), reference, &reference, {});
  EXPECT_DOUBLE_EQ(c.channels[0].metrics.rmse, 0.125);
  EXPECT_EQ(c.channels[0].metrics.rmse_without_reference_noise, 0);
}

TEST(Compare, FilesAndJson) {
  test::TemporaryFolder folder;
  CompareOptions options = limits(0.1, 0.1);
  options.a = folder / "a.exr";
  options.b = folder / "b.exr";
  write_exr(options.a, gray(2, 1, {0, 0.5f}));
  write_exr(options.b, gray(2, 1, {0, 0.25f}));
  const Comparison c = compare_files(options);
  const auto json = nlohmann::json::parse(comparison_json(c, options));
  EXPECT_EQ(json["verdict"], "FAILURE");
  EXPECT_EQ(json["channels"][0]["max_abs"], 0.25);
  EXPECT_TRUE(json["channels"][0]["ssim"].is_null());  // no 11 x 11 window
  EXPECT_EQ(json["worst"]["x"], 1);
  EXPECT_TRUE(comparison_text(c, options).ends_with("FAILURE\n"));
  options.b = folder / "none.exr";
  test::expect_error(ErrorKind::scene, "none.exr", [&] { compare_files(options); });
}

TEST(ErrorImage, ExrHoldsTheSignedDifferences) {
  test::TemporaryFolder folder;
  const Comparison c = compare(gray(3, 1, {1, 0, 0}), gray(3, 1, {0, 0, 0.5f}), nullptr, {});
  EXPECT_EQ(write_error_image(folder / "e.exr", c.difference),
            0.5);  // the 99th percentile of 0, .5, 1 is rank 1
  EXPECT_EQ(std::get<Plane>(read_exr(folder / "e.exr").find("R")->values), (Plane{1, 0, -0.5f}));
}

}  // namespace
}  // namespace nook
