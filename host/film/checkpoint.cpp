#include "film/checkpoint.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/error.hpp"
#include "base/pending_file.hpp"

namespace nook {
namespace {

static_assert(std::endian::native == std::endian::little, "parts are little-endian");

// The file (docs/checkpoints.md): Start, header (JSON), then the arrays that the header counts, then their
// checksum.
struct Start {
  char magic[8];
  std::uint32_t version;
  std::uint32_t header_bytes;
  std::uint64_t header_checksum;
};
constexpr char magic[8] = {'n', 'o', 'o', 'k', 'p', 'a', 'r', 't'};
constexpr std::uint32_t format_version = 2;
constexpr std::uint32_t largest_header = 1u << 24;
constexpr std::uint32_t most_extra_planes = 64;
constexpr std::uint64_t bytes_a_pixel = 2 * sizeof(std::uint64_t) + 3 * sizeof(std::uint32_t);

using Hash = std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)>;

Hash new_hash() {
  Hash hash(XXH3_createState(), XXH3_freeState);
  if (!hash) throw std::bad_alloc();
  XXH3_64bits_reset(hash.get());
  return hash;
}

// Film pixels [first, first + count) hold all samples there are: a shard of tiles does not store the rest of
// the picture.
struct Extent {
  std::uint64_t first = 0, count = 0;
};

// At least this share of the pixels is stored, so that the memory a file asks for is bounded by its size.
std::uint64_t least_stored(std::uint64_t pixels) {
  return (pixels + 255) / 256;
}

Extent extent_of(const std::vector<Film>& films) {
  const auto& replicates = films.front().replicates;
  const auto some = [](std::uint32_t n) { return n != 0; };
  const auto first = std::find_if(replicates.begin(), replicates.end(), some);
  const auto last = std::find_if(replicates.rbegin(), replicates.rend(), some).base();
  Extent extent;
  if (first < last) extent = {std::uint64_t(first - replicates.begin()), std::uint64_t(last - first)};
  extent.count = std::max(extent.count, least_stored(replicates.size()));
  extent.first = std::min(extent.first, replicates.size() - extent.count);
  return extent;
}

nlohmann::json to_json(const FilmPart& part, const Extent& extent) {
  nlohmann::json json;
  json["identity"] = part.identity;
  json["metadata"] = part.metadata;
  json["layers"] = part.layers;
  json["aovs"] = part.aovs;
  json["width"] = part.films.front().width;
  json["height"] = part.films.front().height;
  json["samples_per_pixel"] = part.samples_per_pixel;
  json["finished"] = part.finished;
  json["counts"] = {part.counts.camera_rays, part.counts.occlusion_rays, part.counts.rejected};
  json["render_seconds"] = part.render_seconds;
  for (const Film& film : part.films)
    json["films"].push_back(
        {film.sum_scale, film.square_scale, film.per_replicate, film.extra.size(), film.kept.size()});
  json["first_pixel"] = extent.first;
  json["pixels"] = extent.count;
  json["held_boxes"] = part.held.size();
  json["planned_boxes"] = part.planned.size();
  json["surface"] = nlohmann::json::array();
  for (const Channel& channel : part.surface) json["surface"].push_back(channel.name);
  return json;
}

class Writer {
 public:
  explicit Writer(PendingFile& file) : file_(file), hash_(new_hash()) {}
  template <class T>
  void array(const T* values, std::size_t count) {
    XXH3_64bits_update(hash_.get(), values, count * sizeof(T));
    file_.write(values, count * sizeof(T));
  }
  void finish() {
    const std::uint64_t checksum = XXH3_64bits_digest(hash_.get());
    file_.write(&checksum, sizeof checksum);
  }

 private:
  PendingFile& file_;
  Hash hash_;
};

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
  throw Error(ExitCode::scene, fmt::format("{}: {}", path.string(), why));
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

}  // namespace

void write_film_part(const std::filesystem::path& path, const FilmPart& part) {
  const Extent extent = extent_of(part.films);
  const std::string header = to_json(part, extent).dump();
  Start start;
  std::memcpy(start.magic, magic, sizeof magic);
  start.version = format_version;
  start.header_bytes = std::uint32_t(header.size());
  start.header_checksum = XXH3_64bits(header.data(), header.size());
  if (header.size() > largest_header) throw Error(ExitCode::internal, "a part's header is too large");

  PendingFile file(path);
  file.write(&start, sizeof start);
  file.write(header.data(), header.size());
  Writer writer(file);
  for (const SampleBoxes* boxes : {&part.held, &part.planned}) writer.array(boxes->data(), boxes->size());
  for (const Film& film : part.films) {
    for (const auto* values : {&film.sum, &film.sum_square})
      writer.array(values->data() + extent.first, extent.count);
    for (const auto* values : {&film.replicates, &film.camera_samples, &film.hits})
      writer.array(values->data() + extent.first, extent.count);
    for (const auto* planes : {&film.extra, &film.kept})
      for (const auto& values : *planes) writer.array(values.data() + extent.first, extent.count);
  }
  for (const Channel& channel : part.surface) {
    const auto& values = std::get<std::vector<float>>(channel.values);
    writer.array(values.data(), values.size());
  }
  writer.finish();
  file.sync();
  file.commit();
}

namespace {

FilmPart read_checked(const std::filesystem::path& path) {
  const std::uint64_t size = size_of_regular_file(path);
  std::ifstream in(path, std::ios::binary);
  if (!in) reject(path, "cannot be read");
  Start start;
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

bool same_bits(const Channel& a, const Channel& b) {
  const auto& x = std::get<std::vector<float>>(a.values);
  const auto& y = std::get<std::vector<float>>(b.values);
  return x.size() == y.size() && std::memcmp(x.data(), y.data(), x.size() * sizeof(float)) == 0;
}

}  // namespace

FilmPart read_film_part(const std::filesystem::path& path) {
  try {
    return read_checked(path);
  } catch (const std::bad_alloc&) {
    reject(path, "not enough memory for its pixels");
  }
}

std::string difference(const FilmPart& a, const std::string& name_a, const FilmPart& b,
                       const std::string& name_b) {
  for (std::size_t i = 0; i < std::max(a.identity.size(), b.identity.size()); ++i) {
    if (i >= a.identity.size() || i >= b.identity.size() || a.identity[i].first != b.identity[i].first)
      return fmt::format("{} and {} are of different kinds of render", name_a, name_b);
    if (a.identity[i].second != b.identity[i].second)
      return fmt::format("{} and {} differ in {}: {} and {}", name_a, name_b, a.identity[i].first,
                         a.identity[i].second, b.identity[i].second);
  }
  bool same =
      a.films.size() == b.films.size() && a.layers == b.layers && a.samples_per_pixel == b.samples_per_pixel;
  for (std::size_t e = 0; same && e < a.films.size(); ++e)
    same = a.films[e].width == b.films[e].width && a.films[e].height == b.films[e].height &&
           a.films[e].sum_scale == b.films[e].sum_scale &&
           a.films[e].square_scale == b.films[e].square_scale &&
           a.films[e].per_replicate == b.films[e].per_replicate &&
           a.films[e].extra.size() == b.films[e].extra.size() &&
           a.films[e].kept.size() == b.films[e].kept.size();
  return same ? "" : fmt::format("{} and {} are not parts of one picture", name_a, name_b);
}

void join_film_part(FilmPart& part, const std::string& name, const FilmPart& other,
                    const std::string& other_name) {
  if (const std::string why = difference(part, name, other, other_name); !why.empty())
    throw Error(ExitCode::scene, why);
  if (!part.films.front().kept.empty())
    throw Error(ExitCode::scene, fmt::format("{}: a render to an error cannot be joined with another", name));
  SampleBoxes both = part.held;
  both.insert(both.end(), other.held.begin(), other.held.end());
  std::optional<SampleBox> overlap;
  both = unite(std::move(both), &overlap);
  if (overlap)
    throw Error(ExitCode::scene,
                fmt::format("{}: samples {} to {} of {} pixels are in another part already", other_name,
                            overlap->first, overlap->end - 1, overlap->pixel_end - overlap->pixel_begin));
  for (const Channel& theirs : other.surface)
    for (const Channel& ours : part.surface)
      if (ours.name == theirs.name && !same_bits(ours, theirs))
        throw Error(ExitCode::scene,
                    fmt::format("{} and {} differ in their channel {}", name, other_name, ours.name));

  part.held = std::move(both);
  part.planned.insert(part.planned.end(), other.planned.begin(), other.planned.end());
  part.planned = unite(std::move(part.planned));
  part.finished = part.finished || other.finished;
  for (std::size_t e = 0; e < part.films.size(); ++e) part.films[e].add(other.films[e]);
  part.counts.camera_rays += other.counts.camera_rays;
  part.counts.occlusion_rays += other.counts.occlusion_rays;
  part.counts.rejected += other.counts.rejected;
  part.render_seconds += other.render_seconds;
  if (part.surface.empty()) part.surface = other.surface;
  for (const std::string& aov : other.aovs)
    if (std::find(part.aovs.begin(), part.aovs.end(), aov) == part.aovs.end()) part.aovs.push_back(aov);
}

}  // namespace nook
