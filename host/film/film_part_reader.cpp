#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/error.hpp"
#include "film/film_part_file.hpp"
#include "film/film_part_format.hpp"

namespace nook {
namespace {

using namespace film_part_format;

class Reader {
 public:
  explicit Reader(std::ifstream& in) : in_(in), hash_(new_hash()) {}
  template <class T>
  void array(T* values, std::size_t count) {
    in_.read(reinterpret_cast<char*>(values), std::streamsize(count * sizeof(T)));
    if (in_) XXH3_64bits_update(hash_.get(), values, count * sizeof(T));
  }
  bool checksum_holds() {
    std::uint64_t checksum = 0;
    return in_.read(reinterpret_cast<char*>(&checksum), sizeof checksum) &&
           checksum == XXH3_64bits_digest(hash_.get());
  }

 private:
  std::ifstream& in_;
  Hash hash_;
};

[[noreturn]] void reject(const std::filesystem::path& path, const std::string& why) {
  throw Error(ErrorKind::scene, Place{path.string()}, why);
}

std::uint64_t size_of_regular_file(const std::filesystem::path& path) {
  std::error_code code;
  const auto status = std::filesystem::status(path, code);
  if (!std::filesystem::exists(status)) reject(path, "no such file");
  if (!std::filesystem::is_regular_file(status)) reject(path, "not a regular file");
  const auto size = std::filesystem::file_size(path, code);
  return code ? 0 : size;
}

bool is_power_of_two(float scale) {
  int exponent = 0;
  return std::isfinite(scale) && scale > 0 && std::frexp(scale, &exponent) == 0.5f;
}

bool inside(const SampleBoxes& boxes, const SampleBox& whole) {
  for (const SampleBox& b : boxes)
    if (b.empty() || b.pixel_end > whole.pixel_end || b.end > whole.end) return false;
  return true;
}

// What the header says, with room for nothing yet; throws nlohmann's exceptions, or returns why it cannot be.
std::string from_json(const nlohmann::json& json, FilmPart& part, Extent& extent,
                      std::array<std::uint64_t, 2>& boxes) {
  const auto whole_number = [&](const char* key, std::uint64_t largest) {
    const nlohmann::json& value = json.at(key);
    if (!value.is_number_unsigned() || value.get<std::uint64_t>() > largest) throw std::out_of_range(key);
    return value.get<std::uint64_t>();
  };
  part.identity = json.at("identity").get<FilmPart::Texts>();
  part.metadata = json.at("metadata").get<FilmPart::Texts>();
  part.layers = json.at("layers").get<std::vector<std::string>>();
  part.aovs = json.at("aovs").get<std::vector<std::string>>();
  const int width = int(whole_number("width", 65535)), height = int(whole_number("height", 65535));
  part.samples_per_pixel = std::uint32_t(whole_number("samples_per_pixel", 0xffffffffu));
  part.finished = json.at("finished").get<bool>();
  const auto counts = json.at("counts").get<std::array<std::uint64_t, 3>>();
  part.counts = {counts[0], counts[1], counts[2]};
  part.render_seconds = json.at("render_seconds").get<double>();
  for (const auto& film :
       json.at("films")
           .get<std::vector<std::tuple<float, float, std::uint32_t, std::uint32_t, std::uint32_t>>>()) {
    Film& made = part.films.emplace_back();
    std::uint32_t extra = 0, kept = 0;
    std::tie(made.sum_scale, made.square_scale, made.per_replicate, extra, kept) = film;
    if (extra > most_extra_planes || kept > most_extra_planes) return "a film's planes are too many";
    made.extra.resize(extra);
    made.kept.resize(kept);
    made.width = width;
    made.height = height;
    if (!is_power_of_two(made.sum_scale) || !is_power_of_two(made.square_scale) || made.per_replicate == 0)
      return "a film's scale is impossible";
  }
  const auto settings = json.at("settings").get<std::vector<std::map<std::string, std::string>>>();
  if (settings.size() != part.films.size()) return "its films are not as many as their settings";
  for (std::size_t f = 0; f < settings.size(); ++f) part.films[f].settings = settings[f];
  for (const auto& name : json.at("surface").get<std::vector<std::string>>())
    part.surface.push_back({name, std::vector<float>()});
  extent.first = whole_number("first_pixel", 0xffffffffu);
  extent.count = whole_number("pixels", 0xffffffffu);
  boxes = {whole_number("held_boxes", 0xffffffffu), whole_number("planned_boxes", 0xffffffffu)};
  if (part.films.empty() || part.films.size() > 1024 || part.layers.size() != part.films.size())
    return "its films are not as many as its layers";
  if (width == 0 || height == 0 || part.samples_per_pixel == 0) return "it has no pixels";
  const std::uint64_t pixels = part.films.front().pixels();
  if (extent.first + extent.count > pixels || extent.count < least_stored(pixels))
    return "its range of pixels is impossible";
  return "";
}

FilmPart read_checked(const std::filesystem::path& path) {
  const std::uint64_t size = size_of_regular_file(path);
  std::ifstream in(path, std::ios::binary);
  if (!in) reject(path, "cannot be read");
  Start start{};
  if (!in.read(reinterpret_cast<char*>(&start), sizeof start) ||
      std::memcmp(start.magic, magic, sizeof magic) != 0)
    reject(path, "not a part of a render (see nook render --checkpoint, --shard)");
  if (start.version != format_version)
    reject(path,
           fmt::format("a part of format {}, this program reads format {}", start.version, format_version));
  if (start.header_bytes > largest_header || start.header_bytes > size)
    reject(path, "truncated or damaged: its header does not fit");
  std::string header(start.header_bytes, '\0');
  if (!in.read(header.data(), std::streamsize(header.size())) ||
      XXH3_64bits(header.data(), header.size()) != start.header_checksum)
    reject(path, "damaged: its header's checksum is wrong");

  FilmPart part;
  Extent extent;
  std::array<std::uint64_t, 2> boxes{};
  try {
    if (const std::string why = from_json(nlohmann::json::parse(header), part, extent, boxes); !why.empty())
      reject(path, "damaged: " + why);
  } catch (const nlohmann::json::exception& e) {
    reject(path, fmt::format("damaged: its header cannot be read (JSON error {})", e.id));
  } catch (const std::out_of_range& e) {
    reject(path, fmt::format("damaged: its header's {} is impossible", e.what()));
  }

  const std::uint64_t pixels = part.films.front().pixels();
  std::uint64_t extra_planes = 0;
  for (const Film& film : part.films) extra_planes += film.extra.size() + film.kept.size();
  const std::uint64_t expected =
      sizeof start + header.size() + (boxes[0] + boxes[1]) * sizeof(SampleBox) +
      (part.films.size() * bytes_a_pixel + extra_planes * sizeof(std::uint64_t)) * extent.count +
      part.surface.size() * pixels * sizeof(float) + sizeof(std::uint64_t);
  if (size != expected)
    reject(path, fmt::format("truncated or damaged: {} bytes, expected {}", size, expected));

  Reader reader(in);
  part.held.resize(boxes[0]);
  part.planned.resize(boxes[1]);
  for (SampleBoxes* list : {&part.held, &part.planned}) reader.array(list->data(), list->size());
  for (Film& film : part.films) {
    const std::size_t kept = film.kept.size();
    film = Film(film.width, film.height, film.sum_scale, film.square_scale, film.per_replicate,
                film.extra.size());
    film.kept.assign(kept, std::vector<std::uint64_t>(film.pixels()));
    for (auto* values : {&film.sum, &film.sum_square})
      reader.array(values->data() + extent.first, extent.count);
    for (auto* values : {&film.replicates, &film.camera_samples, &film.hits})
      reader.array(values->data() + extent.first, extent.count);
    for (auto* planes : {&film.extra, &film.kept})
      for (auto& values : *planes) reader.array(values.data() + extent.first, extent.count);
  }
  for (Channel& channel : part.surface) {
    auto& values = std::get<std::vector<float>>(channel.values);
    values.resize(pixels);
    reader.array(values.data(), values.size());
  }
  if (!reader.checksum_holds()) reject(path, "damaged: its checksum is wrong");
  std::optional<SampleBox> overlap;
  if (!inside(part.held, part.whole()) || !inside(part.planned, part.whole()) ||
      unite(part.held, &overlap) != part.held || overlap)
    reject(path, "damaged: its sample ranges are impossible");
  return part;
}
}  // namespace

FilmPart read_film_part(const std::filesystem::path& path) {
  try {
    return read_checked(path);
  } catch (const std::bad_alloc&) {
    reject(path, "not enough memory for its pixels");
  }
}

}  // namespace nook
