#include "image/png.hpp"

#include <gtest/gtest.h>
#include <png.h>

#include <cmath>
#include <limits>

#include "image/srgb.hpp"
#include "support/expect_error.hpp"
#include "support/file_size_limit.hpp"
#include "support/temporary_folder.hpp"

namespace nook {
namespace {

using test::expect_error;

struct Decoded {
  int width = 0, height = 0;
  bool color = false;
  std::vector<std::uint8_t> bytes;  ///< RGB
};

Decoded decode(const std::filesystem::path& path) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  EXPECT_TRUE(png_image_begin_read_from_file(&png, path.c_str())) << png.message;
  Decoded decoded{static_cast<int>(png.width),
                  static_cast<int>(png.height),
                  (png.format & PNG_FORMAT_FLAG_COLOR) != 0,
                  {}};
  png.format = PNG_FORMAT_RGB;
  decoded.bytes.resize(PNG_IMAGE_SIZE(png));
  EXPECT_TRUE(png_image_finish_read(&png, nullptr, decoded.bytes.data(), 0, nullptr)) << png.message;
  return decoded;
}

Image rgb_image(int width, int height, std::vector<float> r, std::vector<float> g, std::vector<float> b) {
  return {width, height, {{"R", std::move(r)}, {"G", std::move(g)}, {"B", std::move(b)}}, {}};
}

/// The standard's own formula, in double precision.
int srgb_code(double linear) {
  const double encoded = linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
  return static_cast<int>(std::floor(encoded * 255 + 0.5));
}

TEST(Srgb, FollowsTheStandard) {
  int mismatches = 0;
  for (int i = 0; i <= 1'000'000; ++i) {
    const float linear = static_cast<float>(i) * 1e-6f;
    const int difference = std::abs(srgb_byte(linear) - srgb_code(linear));
    EXPECT_LE(difference, 1) << linear;
    mismatches += difference;
  }
  // The standard's two branches meet 1e-7 apart; only a value that close to a rounding edge may differ.
  EXPECT_LE(mismatches, 2);
}

TEST(Srgb, ClampsAndShowsNaNAsBlack) {
  const float infinity = std::numeric_limits<float>::infinity();
  EXPECT_EQ(srgb_byte(-1), 0);
  EXPECT_EQ(srgb_byte(-infinity), 0);
  EXPECT_EQ(srgb_byte(std::nanf("")), 0);
  EXPECT_EQ(srgb_byte(1), 255);
  EXPECT_EQ(srgb_byte(std::nextafter(1.0f, 0.0f)), 255);
  EXPECT_EQ(srgb_byte(infinity), 255);
}

TEST(Png, GrayWhenTheChannelsAreEqual) {
  test::TemporaryFolder folder;
  const std::vector<float> values = {0, 0.25f, 0.5f, 1, 2, std::nanf("")};
  write_png(folder / "a.png", rgb_image(3, 2, values, values, values));
  const Decoded decoded = decode(folder / "a.png");
  EXPECT_EQ(decoded.width, 3);
  EXPECT_EQ(decoded.height, 2);
  EXPECT_FALSE(decoded.color);
  for (std::size_t i = 0; i < values.size(); ++i) EXPECT_EQ(decoded.bytes[3 * i], srgb_byte(values[i])) << i;
  EXPECT_EQ(folder.entries(), 1);
}

// Of a picture over black: covered, half covered with the half's value .25, empty.
Image half_covered() {
  Image image = rgb_image(3, 1, {0.5f, 0.125f, 0}, {0.5f, 0.125f, 0}, {0.5f, 0.125f, 0});
  image.coverage = {1, 0.5f, 0};
  return image;
}

// Over black and over white, as viewers blend, a pixel has the code that it should have there.
TEST(Png, HasAlphaWhereNothingIs) {
  test::TemporaryFolder folder;
  write_png(folder / "a.png", half_covered(), {.transparent = true});
  const GrayImage alpha = read_png_opacity(folder / "a.png"), color = read_png_opacity(folder / "a.png", 'l');
  const float over_black[] = {0.5f, 0.125f, 0}, over_white[] = {0.5f, 0.625f, 1};
  for (std::size_t i = 0; i < 3; ++i) {
    const double a = alpha.values[i] / 255.0, own = color.values[i] * a;
    EXPECT_NEAR(own, srgb_byte(over_black[i]), 0.51) << i;
    EXPECT_NEAR(own + 255 * (1 - a), srgb_byte(over_white[i]), 0.51) << i;
  }
  EXPECT_EQ(alpha.values[0], 255);
  EXPECT_EQ(alpha.values[2], 0);
}

// A ground is seen as its shadow: black with an alpha, or the background's color times its value.
TEST(Png, HasTheBackgroundsColorOnAGround) {
  test::TemporaryFolder folder;
  Image image = rgb_image(3, 1, {0.5f, 0.25f, 1}, {0.5f, 0.25f, 1}, {0.5f, 0.25f, 1});
  image.coverage = {1, 1, 1};
  image.ground = {0, 1, 1};
  write_png(folder / "a.png", image, {.transparent = true});
  const GrayImage alpha = read_png_opacity(folder / "a.png"), color = read_png_opacity(folder / "a.png", 'l');
  EXPECT_EQ(alpha.values, (std::vector<std::uint8_t>{255, std::uint8_t(255 - srgb_byte(0.25f)), 0}));
  EXPECT_EQ(color.values[0], srgb_byte(0.5f));
  EXPECT_EQ(color.values[1], 0);

  write_png(folder / "a.png", image, {false, 188, 188, 188});
  const Decoded gray = decode(folder / "a.png");
  EXPECT_EQ(gray.bytes[0], srgb_byte(0.5f));
  EXPECT_EQ(gray.bytes[3], srgb_byte(0.25f * float(linear_of(188))));
  EXPECT_EQ(gray.bytes[6], 188);

  write_png(folder / "a.png", image, {false, 255, 255, 255});
  EXPECT_EQ(decode(folder / "a.png").bytes[3], srgb_byte(0.25f)) << "over white it is as it was";
}

// Light adds up linearly: half of white is .5, and of what covers the other half .125 were there.
TEST(Png, HasABackgroundWhereNothingIs) {
  test::TemporaryFolder folder;
  write_png(folder / "a.png", half_covered(), {false, 255, 255, 255});
  const Decoded white = decode(folder / "a.png");
  EXPECT_FALSE(white.color);
  for (const auto& [x, value] : {std::pair(0, 0.5f), {1, 0.625f}, {2, 1.0f}})
    EXPECT_EQ(white.bytes[std::size_t(3 * x)], srgb_byte(value)) << x;

  write_png(folder / "a.png", half_covered(), {false, 10, 128, 250});
  const Decoded color = decode(folder / "a.png");
  EXPECT_TRUE(color.color);
  EXPECT_EQ(color.bytes[6], 10);
  EXPECT_EQ(color.bytes[7], 128);
  EXPECT_EQ(color.bytes[8], 250);
  EXPECT_EQ(color.bytes[0], srgb_byte(0.5f));

  write_png(folder / "a.png", half_covered());  // black: the values as they are
  EXPECT_EQ(decode(folder / "a.png").bytes[3], srgb_byte(0.125f));
}

TEST(Png, KeepsRowsAndColumnsAndChannelsInOrder) {
  test::TemporaryFolder folder;
  write_png(folder / "a.png", rgb_image(2, 2, {1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}));
  const Decoded decoded = decode(folder / "a.png");
  EXPECT_TRUE(decoded.color);
  EXPECT_EQ(decoded.bytes, (std::vector<std::uint8_t>{255, 0, 0, 0, 255, 0, 0, 0, 255, 0, 0, 0}));
}

TEST(Png, FullDiskIsOneLineAndLeavesNothing) {
  test::TemporaryFolder folder;
  std::vector<float> values(100 * 100);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<float>(i * 7919 % 10007) / 10007;
  const Image image = rgb_image(100, 100, values, values, values);
  for (rlim_t bytes : {0, 20, 1000}) {
    test::FileSizeLimit limit(bytes);
    expect_error(ErrorKind::output, (folder / "a.png").string() + ": File too large",
                 [&] { write_png(folder / "a.png", image); });
  }
  EXPECT_EQ(folder.entries(), 0);
}

TEST(Png, RefusesAnImageWithoutColours) {
  test::TemporaryFolder folder;
  expect_error(ErrorKind::internal, "no channel G", [&] {
    write_png(folder / "a.png", {1, 1, {{"R", std::vector<float>(1)}}, {}});
  });
  EXPECT_EQ(folder.entries(), 0);
}

}  // namespace
}  // namespace nook
