#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <optional>

#include "base/error.hpp"
#include "film/film_part_file.hpp"

namespace nook {
namespace {

bool same_bits(const Channel& a, const Channel& b) {
  const auto& x = std::get<std::vector<float>>(a.values);
  const auto& y = std::get<std::vector<float>>(b.values);
  return x.size() == y.size() && std::memcmp(x.data(), y.data(), x.size() * sizeof(float)) == 0;
}

}  // namespace

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
    throw Error(ErrorKind::scene, why);
  if (!part.films.front().kept.empty())
    throw Error(ErrorKind::scene, Place{name}, "a render to an error cannot be joined with another");
  SampleBoxes both = part.held;
  both.insert(both.end(), other.held.begin(), other.held.end());
  std::optional<SampleBox> overlap;
  both = unite(std::move(both), &overlap);
  if (overlap)
    throw Error(ErrorKind::scene,
                fmt::format("{}: samples {} to {} of {} pixels are in another part already", other_name,
                            overlap->first, overlap->end - 1, overlap->pixel_end - overlap->pixel_begin));
  for (const Channel& theirs : other.surface)
    for (const Channel& ours : part.surface)
      if (ours.name == theirs.name && !same_bits(ours, theirs))
        throw Error(ErrorKind::scene,
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
