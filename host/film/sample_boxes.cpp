#include "film/sample_boxes.hpp"

#include <algorithm>

namespace nook {
namespace {

using Interval = std::pair<std::uint32_t, std::uint32_t>;  // samples [first, second)

// Calls visit(begin, end, of_a, of_b) for each run of pixels over which the boxes of both lists do not
// change; of_a and of_b are the boxes over the run, sorted by their first sample.
template <class Visit>
void sweep(const SampleBoxes& a, const SampleBoxes& b, Visit visit) {
  struct Side {
    std::vector<const SampleBox*> waiting, active;
    explicit Side(const SampleBoxes& boxes) {
      for (const SampleBox& box : boxes)
        if (!box.empty()) waiting.push_back(&box);
      std::sort(waiting.begin(), waiting.end(),
                [](auto* x, auto* y) { return x->pixel_begin > y->pixel_begin; });
    }
    void move_to(std::uint32_t pixel) {
      std::erase_if(active, [&](auto* box) { return box->pixel_end <= pixel; });
      for (; !waiting.empty() && waiting.back()->pixel_begin <= pixel; waiting.pop_back()) {
        const auto by_sample = [](auto* x, auto* y) { return x->first < y->first; };
        active.insert(std::upper_bound(active.begin(), active.end(), waiting.back(), by_sample),
                      waiting.back());
      }
    }
  } side_a(a), side_b(b);

  std::vector<std::uint32_t> edges;
  for (const SampleBoxes* boxes : {&a, &b})
    for (const SampleBox& box : *boxes)
      if (!box.empty()) edges.insert(edges.end(), {box.pixel_begin, box.pixel_end});
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    side_a.move_to(edges[i]);
    side_b.move_to(edges[i]);
    visit(edges[i], edges[i + 1], side_a.active, side_b.active);
  }
}

// Collects runs of pixels with their intervals; neighbouring runs with the same intervals become one.
class Runs {
 public:
  void add(std::uint32_t begin, std::uint32_t end, const std::vector<Interval>& intervals) {
    if (intervals.empty()) return;
    if (begin == end_ && intervals == last_) {
      for (std::size_t i = boxes_.size() - last_.size(); i < boxes_.size(); ++i) boxes_[i].pixel_end = end;
    } else {
      for (const auto& [first, stop] : intervals) boxes_.push_back({begin, end, first, stop});
      last_ = intervals;
    }
    end_ = end;
  }
  SampleBoxes take() { return std::move(boxes_); }

 private:
  SampleBoxes boxes_;
  std::vector<Interval> last_;
  std::uint32_t end_ = 0;
};

}  // namespace

// NOLINTNEXTLINE(performance-unnecessary-value-param): callers move what they have
SampleBoxes unite(SampleBoxes boxes, std::optional<SampleBox>* overlap) {
  Runs runs;
  std::vector<Interval> joined;
  sweep(boxes, {}, [&](std::uint32_t begin, std::uint32_t end, const auto& active, const auto&) {
    joined.clear();
    for (const SampleBox* box : active) {
      if (overlap && !*overlap && !joined.empty() && box->first < joined.back().second)
        *overlap = SampleBox{begin, end, box->first, std::min(box->end, joined.back().second)};
      if (!joined.empty() && box->first <= joined.back().second)
        joined.back().second = std::max(joined.back().second, box->end);
      else
        joined.emplace_back(box->first, box->end);
    }
    runs.add(begin, end, joined);
  });
  return runs.take();
}

SampleBoxes subtract(const SampleBoxes& whole, const SampleBoxes& taken) {
  Runs runs;
  std::vector<Interval> left;
  // `whole` is united first, so that a sample in two of its boxes is left once.
  sweep(unite(whole), taken,
        [&](std::uint32_t begin, std::uint32_t end, const auto& asked, const auto& held) {
          left.clear();
          for (const SampleBox* box : asked) {
            std::uint32_t at = box->first;
            for (const SampleBox* hole : held) {
              if (hole->end <= at) continue;
              if (hole->first >= box->end) break;
              if (hole->first > at) left.emplace_back(at, hole->first);
              at = std::max(at, hole->end);
            }
            if (at < box->end) left.emplace_back(at, box->end);
          }
          runs.add(begin, end, left);
        });
  return runs.take();
}

std::uint64_t samples_in(const SampleBoxes& disjoint) {
  std::uint64_t sum = 0;
  for (const SampleBox& box : disjoint) sum += box.samples();
  return sum;
}

void HeldSamples::add(const SampleBox& box) {
  boxes_.push_back(box);
  if (boxes_.size() > 2 * united_ + 65536) boxes();
}

const SampleBoxes& HeldSamples::boxes() const {
  if (boxes_.size() != united_) boxes_ = unite(std::move(boxes_));
  united_ = boxes_.size();
  return boxes_;
}

}  // namespace nook
