// Opacity from every kind of PNG.
#include <gtest/gtest.h>
#include <png.h>

#include "image/png.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace nook {
namespace {

using test::expect_error;
using test::read_bytes;
using test::TemporaryFolder;
using test::write_bytes;

// Two pixels beside each other.
std::filesystem::path write(const TemporaryFolder& folder, png_uint_32 format,
                            const std::vector<std::uint8_t>& values) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = 2;
  image.height = 1;
  image.format = format;
  const auto file = folder / "opacity.png";
  EXPECT_TRUE(png_image_write_to_file(&image, file.c_str(), 0, values.data(), 0, nullptr));
  return file;
}

TEST(PngOpacity, OfEveryKind) {
  const TemporaryFolder folder;
  const std::vector<std::uint8_t> expected{10, 200};
  const auto opacity = [&](png_uint_32 format, const std::vector<std::uint8_t>& values) {
    const GrayImage image = read_png_opacity(write(folder, format, values));
    EXPECT_EQ(image.width, 2u);
    EXPECT_EQ(image.height, 1u);
    return image.values;
  };
  EXPECT_EQ(opacity(PNG_FORMAT_GRAY, {10, 200}), expected);
  EXPECT_EQ(opacity(PNG_FORMAT_RGB, {10, 10, 10, 200, 200, 200}), expected);
  EXPECT_EQ(opacity(PNG_FORMAT_GA, {255, 10, 0, 200}), expected);
  EXPECT_EQ(opacity(PNG_FORMAT_RGBA, {255, 0, 0, 10, 0, 0, 255, 200}), expected);
  EXPECT_EQ(opacity(PNG_FORMAT_RGB, {0, 255, 0, 255, 0, 0}), (std::vector<std::uint8_t>{182, 54}));
}

TEST(PngOpacity, OfAChannel) {
  const TemporaryFolder folder;
  const auto two = [&](png_uint_32 format, const std::vector<std::uint8_t>& values, char channel) {
    return read_png_opacity(write(folder, format, values), channel).values;
  };
  const std::vector<std::uint8_t> colors = {1, 2, 3, 4, 5, 6, 7, 8};
  EXPECT_EQ(two(PNG_FORMAT_RGBA, colors, 'r'), (std::vector<std::uint8_t>{1, 5}));
  EXPECT_EQ(two(PNG_FORMAT_RGBA, colors, 'g'), (std::vector<std::uint8_t>{2, 6}));
  EXPECT_EQ(two(PNG_FORMAT_RGBA, colors, 'b'), (std::vector<std::uint8_t>{3, 7}));
  EXPECT_EQ(two(PNG_FORMAT_RGBA, colors, 'm'), (std::vector<std::uint8_t>{4, 8}));
  EXPECT_EQ(two(PNG_FORMAT_RGBA, colors, 'l'), (std::vector<std::uint8_t>{2, 6}));
  EXPECT_EQ(two(PNG_FORMAT_GA, {1, 2, 3, 4}, 'l'), (std::vector<std::uint8_t>{1, 3}));
  EXPECT_EQ(two(PNG_FORMAT_GRAY, {1, 2}, 'm'), (std::vector<std::uint8_t>{255, 255}));
}

TEST(PngOpacity, DamagedFilesAreOneLine) {
  const TemporaryFolder folder;
  const auto file = write(folder, PNG_FORMAT_GRAY, {10, 200});
  const std::string bytes = read_bytes(file);
  for (const std::size_t length : {std::size_t(0), std::size_t(7), std::size_t(20), bytes.find("IDAT") + 6}) {
    write_bytes(file, bytes.substr(0, length));
    expect_error(ErrorKind::scene, "opacity.png: ", [&] { read_png_opacity(file); });
  }
  std::string damaged = bytes;
  const std::size_t data = damaged.find("IDAT") + 6;
  damaged[data] = char(damaged[data] ^ 0x55);
  write_bytes(file, damaged);
  expect_error(ErrorKind::scene, "opacity.png: ", [&] { read_png_opacity(file); });
  expect_error(ErrorKind::scene, "none.png: no such file", [&] { read_png_opacity(folder / "none.png"); });
  expect_error(ErrorKind::scene, "not a regular file", [&] { read_png_opacity(folder.path()); });
}

}  // namespace
}  // namespace nook
