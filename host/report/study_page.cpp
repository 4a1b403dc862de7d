#include "report/study_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>

#include "base/embedded_file.hpp"
#include "base/error.hpp"
#include "base/pending_file.hpp"
#include "device/warps.hpp"

namespace nook {
namespace report_page {
extern const EmbeddedFile files[];
extern const unsigned file_count;
}  // namespace report_page

namespace {

using nlohmann::json;

std::string page_file(std::string_view name) {
  for (unsigned i = 0; i < report_page::file_count; ++i)
    if (std::string_view(report_page::files[i].path).ends_with(std::string("/").append(name)))
      return report_page::files[i].text;
  throw Error(ErrorKind::internal, fmt::format("the page's {} is not embedded", name));
}

std::string base64(const std::vector<std::uint8_t>& bytes) {
  static constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t left = bytes.size() - i;
    const unsigned v = unsigned(bytes[i]) << 16 | (left > 1 ? unsigned(bytes[i + 1]) << 8 : 0u) |
                       (left > 2 ? bytes[i + 2] : 0u);
    text += digits[v >> 18];
    text += digits[v >> 12 & 63];
    text += left > 1 ? digits[v >> 6 & 63] : '=';
    text += left > 2 ? digits[v & 63] : '=';
  }
  return text;
}

// value = low + step * number
template <class T>
json sixteen_bits(const std::vector<T>& values) {
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  const double low = double(*least), step = std::max((double(*most) - low) / 65535, 1e-12);
  std::vector<std::uint8_t> bytes;
  for (const T v : values) {
    const auto number = std::uint16_t(std::lround((double(v) - low) / step));
    bytes.push_back(std::uint8_t(number & 255));
    bytes.push_back(std::uint8_t(number >> 8));
  }
  return {{"low", low}, {"step", step}, {"data", base64(bytes)}};
}

json of_picture(const GalleryPicture& picture, int width, int height) {
  json j = sixteen_bits(picture.image);
  j.update({{"group", picture.group},
            {"name", picture.name},
            {"detail", picture.detail},
            {"width", width},
            {"height", height}});
  if (!picture.samples.empty()) j["samples"] = sixteen_bits(picture.samples);
  return j;
}

// The first two dimensions of Sobol's sequence: the index reversed, and its Pascal-matrix product reversed
// (Sobol' 1967).
vec2 sobol_point(std::uint32_t index) {
  std::uint32_t x = 0, y = 0, column = 1u << 31;
  for (unsigned bit = 0; bit < 32; ++bit, column ^= column >> 1)
    if (index >> bit & 1u) {
      x |= 1u << (31 - bit);
      y ^= column;
    }
  return vec2(float(x >> 8) * 0x1p-24f, float(y >> 8) * 0x1p-24f);
}

void replace(std::string& text, const std::string& what, const std::string& with) {
  const std::size_t at = text.find(what);
  if (at == std::string::npos) throw Error(ErrorKind::internal, fmt::format("the page has no {}", what));
  text.replace(at, what.size(), with);
}

}  // namespace

std::vector<WarpPattern> warp_patterns(const Device& device, float exponent) {
  std::vector<vec2> u;
  for (std::uint32_t i = 0; i < 256; ++i) u.push_back(sobol_point(i));
  const Warps warps(device);
  const std::pair<const char*, Warp> all[] = {{"disk", Warp::disk},
                                              {"sphere", Warp::sphere},
                                              {"hemisphere", Warp::hemisphere},
                                              {"cosine hemisphere", Warp::cosine_hemisphere},
                                              {"lobe", Warp::cosine_power}};
  std::vector<WarpPattern> patterns;
  for (const auto& [name, warp] : all) {
    WarpPattern& pattern = patterns.emplace_back();
    pattern.name = warp == Warp::cosine_power ? fmt::format("lobe, exponent {}", exponent) : name;
    for (const vec3& w : warps.map(warp, u, exponent)) pattern.points.push_back(w);
  }
  return patterns;
}

void write_study_page(const std::filesystem::path& path, const Study& study, const StudyFacts& facts,
                      const Gallery& gallery, std::span<const WarpPattern> patterns,
                      const PlotLibrary& library) {
  json data = json::parse(study_json(study, facts));
  for (const GalleryPicture& picture : gallery.pictures)
    data["gallery"].push_back(of_picture(picture, gallery.width, gallery.height));
  for (const WarpPattern& pattern : patterns) {
    json points;
    for (const vec3& p : pattern.points)
      points.push_back({std::round(p.x * 1e4) / 1e4, std::round(p.y * 1e4) / 1e4, int(p.z < 0)});
    data["patterns"].push_back({{"name", pattern.name}, {"points", points}});
  }
  if (!library.licence.empty()) data["plot_library"] = library.licence;
  std::string page = page_file("index.html");
  replace(page, "/*@style.css@*/", page_file("style.css"));
  for (const char* script :
       {"elements.js", "plot.js", "tables.js", "curves.js", "screen.js", "viewer.js", "main.js"})
    replace(page, fmt::format("/*@{}@*/", script), page_file(script));
  // "</script>" in a text would end the element; "\u003c" is the same character inside a JSON string.
  std::string text = data.dump();
  for (std::size_t at = text.find('<'); at != std::string::npos; at = text.find('<', at + 6))
    text.replace(at, 1, "\\u003c");
  replace(page, "@data@", text);
  replace(page, "/*@plot library@*/", library.script);
  PendingFile file(path);
  file.write(page.data(), page.size());
  file.commit();
}

}  // namespace nook
