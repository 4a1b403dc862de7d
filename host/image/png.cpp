#include "image/png.hpp"

#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <array>
#include <csetjmp>
#include <exception>
#include <vector>

#include "base/error.hpp"
#include "base/pending_file.hpp"
#include "image/srgb.hpp"

namespace nook {

namespace {

struct Planes {
  const float* rgb[3];
  const float* alpha;  // null: opaque
  int width, height;
  bool gray;

  int colors() const { return gray ? 1 : 3; }
};

/// Where libpng writes. A C++ exception must not cross libpng's frames: it waits here while libpng jumps out.
struct Sink {
  PendingFile& file;
  std::exception_ptr failure;
  std::string message;
};

void on_write(png_structp png, png_bytep bytes, png_size_t count) {
  Sink* sink = static_cast<Sink*>(png_get_io_ptr(png));
  try {
    sink->file.write(bytes, count);
  } catch (...) {
    sink->failure = std::current_exception();
  }
  if (sink->failure) png_error(png, "write failed");
}

void on_flush(png_structp) {}

void on_error(png_structp png, png_const_charp message) {
  Sink* sink = static_cast<Sink*>(png_get_error_ptr(png));
  sink->message = message;
  png_longjmp(png, 1);
}

void on_warning(png_structp, png_const_charp) {}

void encode_row(const Planes& planes, int y, std::uint8_t* row) {
  const std::size_t begin = static_cast<std::size_t>(y) * static_cast<std::size_t>(planes.width);
  const int colors = planes.colors(), count = colors + (planes.alpha ? 1 : 0);
  for (int c = 0; c < colors; ++c) {
    const float* values = planes.rgb[c] + begin;
    for (int x = 0; x < planes.width; ++x) row[x * count + c] = srgb_byte(values[x]);
  }
  for (int x = 0; planes.alpha && x < planes.width; ++x)
    row[x * count + colors] = static_cast<std::uint8_t>(255 * planes.alpha[begin + std::size_t(x)] + 0.5f);
}

/// Nothing with a destructor lives in this frame, since longjmp would skip it. False: the sink knows why.
bool encode(png_structp png, png_infop info, const Planes& planes, std::uint8_t* row) {
  if (setjmp(png_jmpbuf(png))) return false;
  png_set_IHDR(
      png, info, static_cast<png_uint_32>(planes.width), static_cast<png_uint_32>(planes.height), 8,
      (planes.gray ? PNG_COLOR_TYPE_GRAY : PNG_COLOR_TYPE_RGB) | (planes.alpha ? PNG_COLOR_MASK_ALPHA : 0),
      PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_sRGB_gAMA_and_cHRM(png, info, PNG_sRGB_INTENT_RELATIVE);
  // A preview: the noise of an estimate barely compresses, and higher levels cost several times as much.
  png_set_compression_level(png, 3);
  png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_SUB);
  png_write_info(png, info);
  for (int y = 0; y < planes.height; ++y) {
    encode_row(planes, y, row);
    png_write_row(png, row);
  }
  png_write_end(png, info);
  return true;
}

const float* plane(const Image& image, const char* name) {
  const Channel* channel = image.find(name);
  const auto* values = channel ? std::get_if<std::vector<float>>(&channel->values) : nullptr;
  const std::size_t pixels = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  if (!values || values->size() != pixels || pixels == 0)
    throw Error(ErrorKind::internal, fmt::format("write_png: the image has no channel {} of its size", name));
  return values->data();
}

bool equal(const float* a, const float* b, std::size_t count) {
  return std::equal(a, a + count, b, [](float x, float y) { return srgb_byte(x) == srgb_byte(y); });
}

// A channel of a pixel: what stays whatever lies behind, and the share of that which is seen: where nothing
// is, and on the ground, which has the background's color and dims it.
struct Light {
  float own, through;
};

Light light_of(float value, const Image& image, std::size_t pixel) {
  const float of_ground = image.ground.empty() ? 0 : std::max(value, 0.0f) * image.ground[pixel];
  return {value - of_ground, 1 - image.coverage[pixel] + of_ground};
}

struct Composed {
  std::array<std::vector<float>, 3> rgb;
  std::vector<float> alpha;
};

// Viewers blend encoded values. So alpha and color are those with which a pixel over black and over white has
// the code that it should have there: color alpha, and color alpha + 1 - alpha. Where the channels disagree
// on alpha, the largest.
Composed with_alpha(const Planes& planes, const Image& image) {
  Composed made;
  const std::size_t pixels = image.coverage.size();
  made.alpha.resize(pixels);
  for (std::vector<float>& channel : made.rgb) channel.resize(pixels);
  for (std::size_t i = 0; i < pixels; ++i) {
    int over_black[3], alpha = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      const Light light = light_of(planes.rgb[c][i], image, i);
      over_black[c] = srgb_byte(light.own);
      alpha = std::max(alpha, 255 - (srgb_byte(std::max(light.own, 0.0f) + light.through) - over_black[c]));
    }
    made.alpha[i] = float(alpha) / 255;
    for (std::size_t c = 0; c < 3 && alpha > 0; ++c)
      made.rgb[c][i] =
          float(linear_of(std::uint8_t(std::min(255, (255 * over_black[c] + alpha / 2) / alpha))));
  }
  return made;
}

Composed over(const Planes& planes, const Image& image, const Background& background) {
  Composed made;
  const std::uint8_t behind[3] = {background.red, background.green, background.blue};
  for (std::size_t c = 0; c < 3; ++c) {
    const float color = float(linear_of(behind[c]));
    for (std::size_t i = 0; i < image.coverage.size(); ++i) {
      const Light light = light_of(planes.rgb[c][i], image, i);
      made.rgb[c].push_back(light.own + light.through * color);
    }
  }
  return made;
}

}  // namespace

void write_png(const std::filesystem::path& path, const Image& image, const Background& background) {
  Planes planes{
      {plane(image, "R"), plane(image, "G"), plane(image, "B")}, nullptr, image.width, image.height, false};
  const std::size_t pixels = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  Composed composed;
  if (image.coverage.size() == pixels && background != Background{}) {
    composed = background.transparent ? with_alpha(planes, image) : over(planes, image, background);
    for (std::size_t c = 0; c < 3; ++c) planes.rgb[c] = composed.rgb[c].data();
    if (background.transparent) planes.alpha = composed.alpha.data();
  }
  planes.gray = equal(planes.rgb[0], planes.rgb[1], pixels) && equal(planes.rgb[0], planes.rgb[2], pixels);
  std::vector<std::uint8_t> row(static_cast<std::size_t>(image.width) * 4);

  PendingFile file(path);
  Sink sink{file, nullptr, {}};
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &sink, on_error, on_warning);
  png_infop info = png ? png_create_info_struct(png) : nullptr;
  bool complete = false;
  if (info) {
    png_set_write_fn(png, &sink, on_write, on_flush);
    complete = encode(png, info, planes, row.data());
  }
  png_destroy_write_struct(&png, &info);
  if (sink.failure) std::rethrow_exception(sink.failure);
  if (!complete)
    throw Error(ErrorKind::output, fmt::format("cannot write {}: {}", path.string(),
                                               sink.message.empty() ? "not enough memory" : sink.message));
  file.commit();
}

}  // namespace nook
