#include <fmt/format.h>
#include <png.h>

#include <csetjmp>
#include <cstdio>
#include <memory>
#include <string>

#include "base/error.hpp"
#include "image/png.hpp"

namespace nook {
namespace {

constexpr png_uint_32 largest_side = 16384;

struct Source {
  std::FILE* file;
  std::string message;
};

void on_read(png_structp png, png_bytep bytes, png_size_t count) {
  const Source* source = static_cast<Source*>(png_get_io_ptr(png));
  if (std::fread(bytes, 1, count, source->file) != count) png_error(png, "truncated");
}

void on_error(png_structp png, png_const_charp message) {
  static_cast<Source*>(png_get_error_ptr(png))->message = message;
  png_longjmp(png, 1);
}

void on_warning(png_structp, png_const_charp) {}

// Nothing with a destructor lives in these frames, since longjmp would skip it. False: the source knows why.
bool read_header(png_structp png, png_infop info, png_uint_32* width, png_uint_32* height, int* passes) {
  if (setjmp(png_jmpbuf(png))) return false;
  png_read_info(png, info);
  *width = png_get_image_width(png, info);
  *height = png_get_image_height(png, info);
  if (*width > largest_side || *height > largest_side) png_error(png, "over 16384 pixels a side");
  png_set_expand(png);
  png_set_strip_16(png);
  png_set_packing(png);
  *passes = png_set_interlace_handling(png);
  png_read_update_info(png, info);
  return true;
}

bool read_rows(png_structp png, png_uint_32 height, int passes, png_bytep pixels, std::size_t row_bytes) {
  if (setjmp(png_jmpbuf(png))) return false;
  for (int pass = 0; pass < passes; ++pass)
    for (png_uint_32 y = 0; y < height; ++y) png_read_row(png, pixels + y * row_bytes, nullptr);
  png_read_end(png, nullptr);
  return true;
}

std::uint8_t opacity_of(const png_byte* pixel, std::size_t channels, char wanted) {
  const bool with_alpha = channels == 2 || channels == 4, gray = channels < 3;
  if (wanted == 'm' && !with_alpha) return 255;
  const bool of_color = wanted == 'r' || wanted == 'g' || wanted == 'b' || wanted == 'l';
  if (with_alpha && !of_color) return pixel[channels - 1];
  if (gray) return pixel[0];
  if (of_color && wanted != 'l') return pixel[wanted == 'r' ? 0 : wanted == 'g' ? 1 : 2];
  return std::uint8_t(0.2126 * pixel[0] + 0.7152 * pixel[1] + 0.0722 * pixel[2] + 0.5);
}

}  // namespace

GrayImage read_png_opacity(const std::filesystem::path& path, char channel) {
  const auto fail = [&](const std::string& why) { throw Error(ErrorKind::scene, Place{path.string()}, why); };
  std::error_code code;
  if (!std::filesystem::exists(path, code)) fail("no such file");
  if (!std::filesystem::is_regular_file(path, code)) fail("not a regular file");
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
  if (!file) fail("cannot be read");
  png_byte signature[8] = {};
  if (std::fread(signature, 1, 8, file.get()) != 8 || png_sig_cmp(signature, 0, 8) != 0)
    fail("not a PNG file");

  Source source{file.get(), {}};
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &source, on_error, on_warning);
  png_infop info = png ? png_create_info_struct(png) : nullptr;
  GrayImage image;
  bool complete = false;
  if (info) {
    png_set_read_fn(png, &source, on_read);
    png_set_sig_bytes(png, 8);
    int passes = 1;
    if (read_header(png, info, &image.width, &image.height, &passes)) {
      const std::size_t row_bytes = png_get_rowbytes(png, info), channels = png_get_channels(png, info);
      std::vector<png_byte> pixels(row_bytes * image.height);
      complete = read_rows(png, image.height, passes, pixels.data(), row_bytes);
      for (png_uint_32 y = 0; complete && y < image.height; ++y)
        for (png_uint_32 x = 0; x < image.width; ++x)
          image.values.push_back(opacity_of(&pixels[y * row_bytes + x * channels], channels, channel));
    }
  }
  png_destroy_read_struct(&png, &info, nullptr);
  if (!complete) fail(source.message.empty() ? "not enough memory to read it" : source.message);
  return image;
}

}  // namespace nook
