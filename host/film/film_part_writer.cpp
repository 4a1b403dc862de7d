#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "base/pending_file.hpp"
#include "film/film_part_file.hpp"
#include "film/film_part_format.hpp"

namespace nook {
namespace {

using namespace film_part_format;

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
  for (const Film& film : part.films) {
    json["films"].push_back(
        {film.sum_scale, film.square_scale, film.per_replicate, film.extra.size(), film.kept.size()});
    json["settings"].push_back(film.settings);
  }
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
}  // namespace

void write_film_part(const std::filesystem::path& path, const FilmPart& part) {
  const Extent extent = extent_of(part.films);
  const std::string header = to_json(part, extent).dump();
  Start start{};
  std::memcpy(start.magic, magic, sizeof magic);
  start.version = format_version;
  start.header_bytes = std::uint32_t(header.size());
  start.header_checksum = XXH3_64bits(header.data(), header.size());
  if (header.size() > largest_header) throw Error(ErrorKind::internal, "a part's header is too large");

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

}  // namespace nook
