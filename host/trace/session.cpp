#include "trace/session.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <map>

#include "base/error.hpp"
#include "film/film_part_file.hpp"

namespace nook {
namespace {

// The positions of the boxes' pixels.
std::vector<std::uint32_t> positions_of(const SampleBoxes& boxes) {
  std::vector<std::uint32_t> positions;
  for (const SampleBox& box : boxes)
    for (std::uint32_t p = box.pixel_begin; p < box.pixel_end; ++p) positions.push_back(p);
  return positions;
}

}  // namespace

Session::Session(OcclusionTracer& tracer, const Plan& plan, FilmPart::Texts identity,
                 Randomisations randomisations, std::size_t rule_planes)
    : tracer_(tracer),
      plan_(plan),
      randomisations_(std::move(randomisations)),
      order_(pixels_in_order(plan.window, plan.width)) {
  part_.identity = std::move(identity);
  part_.samples_per_pixel = plan.samples_per_pixel();
  part_.films = tracer.make_films();
  part_.layers.resize(part_.films.size());
  const std::size_t planes = rule_planes + (randomisations_.count > 1 ? randomisations_.count : 0);
  for (Film& film : part_.films) film.kept.assign(planes, std::vector<std::uint64_t>(film.pixels()));
}

void Session::resume(FilmPart part, const std::string& file) {
  part.layers = part_.layers;  // the caller's to name
  if (const std::string why = difference(part, file, part_, "this render"); !why.empty())
    throw Error(ErrorKind::scene, why);
  std::vector<std::uint32_t> expected(order_.size());
  for (const SampleBox& box : part.held)
    for (std::uint32_t p = box.pixel_begin; p < box.pixel_end; ++p)
      expected[film_index(p)] += box.end - box.first;
  for (const Film& film : part.films)
    if (film.replicates != expected)
      throw Error(ErrorKind::scene, Place{file}, "damaged: its sums and its sample ranges disagree");
  held_ = HeldSamples(part.held);
  samples_held_ = samples_in(held_.boxes());
  part_ = std::move(part);
}

bool Session::run(const Schedule& schedule, const GoOn& go_on) {
  for (;;) {
    SampleBoxes open = subtract(part_.planned, held_.boxes());
    if (open.empty()) {
      part_.planned = unite(schedule(*this));
      open = subtract(part_.planned, held_.boxes());
      if (open.empty()) return true;
    }
    if (!work(open, go_on)) return false;
  }
}

// Pixels that lack the same samples are worked on together: few large launches.
bool Session::work(const SampleBoxes& open, const GoOn& go_on) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, SampleBoxes> by_range;
  for (const SampleBox& box : open) by_range[{box.first, box.end}].push_back(box);
  for (const auto& [range, boxes] : by_range)
    if (!work(boxes, {range.first, range.second - range.first}, go_on)) return false;
  return true;
}

bool Session::work(const SampleBoxes& boxes, SampleRange range, const GoOn& go_on) {
  const std::vector<std::uint32_t> positions = positions_of(boxes);
  std::vector<std::uint32_t> pixels(positions.size());
  std::transform(positions.begin(), positions.end(), pixels.begin(),
                 [&](std::uint32_t p) { return order_[p]; });
  for (const Randomisations::Piece& piece : randomisations_.pieces(range)) {
    if (randomisations_.count > 1)
      tracer_.set_samples(plan_.spp, Randomisations::seed_of(plan_.seed, piece.randomisation));
    if (!work(positions, pixels, piece, go_on)) return false;
  }
  return true;
}

bool Session::work(const std::vector<std::uint32_t>& positions, const std::vector<std::uint32_t>& pixels,
                   const Randomisations::Piece& piece, const GoOn& go_on) {
  RenderCounters before = tracer_.counters();
  auto last = std::chrono::steady_clock::now();
  bool wanted = true;  // also asked after the last launch, which leaves nothing to stop
  return tracer_.accumulate(pixels, piece.range, part_.films, [&](std::span<const Finished> finished) {
    for (const Finished& f : finished) {
      if (randomisations_.count > 1)
        for (std::size_t p = f.begin; p < f.end; ++p)
          keep_sums(piece.randomisation, film_index(positions[p]));
      const std::uint32_t first = piece.first + (f.range.first - piece.range.first);
      for (std::size_t begin = f.begin, end; begin < f.end; begin = end) {
        for (end = begin + 1; end < f.end && positions[end] == positions[end - 1] + 1;) ++end;
        const SampleBox box{positions[begin], positions[end - 1] + 1, first, first + f.range.count};
        held_.add(box);
        samples_held_ += box.samples();
      }
    }
    const RenderCounters& now = tracer_.counters();
    part_.counts.camera_rays += now.camera_rays - before.camera_rays;
    part_.counts.occlusion_rays += now.occlusion_rays - before.occlusion_rays;
    part_.counts.rejected += now.rejected - before.rejected;
    before = now;
    const auto time = std::chrono::steady_clock::now();
    part_.render_seconds += std::chrono::duration<double>(time - last).count();
    last = time;
    return wanted = go_on();
  }) && wanted;
}

// What the films have more than the randomisations is this one's.
void Session::keep_sums(std::uint32_t randomisation, std::size_t pixel) {
  for (Film& film : part_.films) {
    std::uint64_t known = 0;
    for (std::uint32_t r = 0; r < randomisations_.count; ++r) known += film.kept[r][pixel];
    film.kept[randomisation][pixel] += film.sum[pixel] - known;
  }
}

SampleBox Session::share(const Share& share) const {
  const auto begin_of = [&](std::uint64_t total, std::uint64_t i) {
    return std::uint32_t(total * i / share.count);
  };
  SampleBox box = part_.whole();
  if (box.end >= share.count)
    return {box.pixel_begin, box.pixel_end, begin_of(box.end, share.index),
            begin_of(box.end, share.index + 1ull)};
  return {begin_of(box.pixel_end, share.index), begin_of(box.pixel_end, share.index + 1ull), box.first,
          box.end};
}

FilmPart& Session::part() {
  part_.held = held_.boxes();
  return part_;
}

Session::Schedule all_of(const SampleBox& box) {
  return [box](const Session&) { return SampleBoxes{box}; };
}

}  // namespace nook
