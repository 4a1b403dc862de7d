#include "mesh/ear_clip.hpp"

#include <algorithm>

#include "mesh/orientation.hpp"
#include "mesh/outline_crossing.hpp"
#include "mesh/star_outline.hpp"

namespace nook {
namespace {

// Once an outline that crosses itself has lost this number of corners that were no ears, the rest is not
// looked at closely any more.
constexpr std::size_t most_forced = 64;
// Corners that are looked at, in all, for what is an ear but for rounding.
constexpr std::size_t most_looks = 10'000'000;

}  // namespace

int EarClipper::turn_of(std::uint32_t corner) const {
  return orientation(place(corners_[corner].before), place(corner), place(corners_[corner].after));
}

void EarClipper::enqueue(std::uint32_t corner) {
  Corner& c = corners_[corner];
  if (c.gone || c.queued || c.turn <= 0) return;
  c.queued = true;
  queue_.push_back(corner);
}

void EarClipper::wake(std::uint32_t& list) {
  for (std::uint32_t w = list; w != nobody; w = waits_[w].next) enqueue(waits_[w].corner);
  list = nobody;
}

bool EarClipper::enters(std::uint32_t other, const dvec2& tip, const dvec2& from, const dvec2& to) const {
  for (const std::uint32_t end : {corners_[other].before, corners_[other].after})
    if (orientation(tip, from, place(end)) > 0 && orientation(tip, to, place(end)) < 0) return true;
  return false;
}

bool EarClipper::blocks(std::uint32_t other, const std::array<std::uint32_t, 3>& ear, bool& touching) const {
  const dvec2 &a = place(ear[0]), &b = place(ear[1]), &c = place(ear[2]), &p = place(other);
  const int ab = orientation(a, b, p), bc = orientation(b, c, p), ca = orientation(c, a, p);
  if (ab < 0 || bc < 0 || ca < 0) return false;
  if (loose_)
    return std::min({distance_to_line(a, b, p), distance_to_line(b, c, p), distance_to_line(c, a, p)}) >
           tolerance_;
  touching = ab == 0 || bc == 0 || ca == 0;
  if (!touching) return true;
  if (p == a) return enters(other, a, b, c);
  if (p == b) return enters(other, b, c, a);
  if (p == c) return enters(other, c, a, b);
  if (ca == 0) return true;
  const dvec2 &from = ab == 0 ? a : b, &to = ab == 0 ? b : c;  // it comes in from that side, or from outside
  return orientation(from, to, place(corners_[other].before)) > 0 ||
         orientation(from, to, place(corners_[other].after)) > 0;
}

// The corner that keeps `corner` from being an ear, or nobody.
std::uint32_t EarClipper::blocker_of(std::uint32_t corner, bool& touching) {
  const std::array<std::uint32_t, 3> ear = {corners_[corner].before, corner, corners_[corner].after};
  const std::array<dvec2, 3> triangle = {place(ear[0]), place(ear[1]), place(ear[2])};
  touching = true;
  // the outline on the far sides of the neighbours
  const std::uint32_t first = corners_[ear[0]].before, last = corners_[ear[2]].after;
  if (!loose_ && orientation(triangle[0], triangle[1], place(first)) > 0 &&
      orientation(triangle[0], triangle[2], place(first)) < 0)
    return ear[0];
  if (!loose_ && orientation(triangle[2], triangle[0], place(last)) > 0 &&
      orientation(triangle[2], triangle[1], place(last)) < 0)
    return ear[2];
  std::uint32_t found = nobody;
  obstacles_.any(triangle, [&](std::uint32_t other) {
    if (other == ear[0] || other == ear[1] || other == ear[2] || !blocks(other, ear, touching)) return false;
    found = other;
    return true;
  });
  return found;
}

bool EarClipper::sees_ear(std::uint32_t corner) const {
  return centre_ && orientation(*centre_, place(corners_[corner].before), place(corners_[corner].after)) > 0;
}

void EarClipper::build_obstacles() {
  std::vector<std::uint32_t> obstacles;
  for (std::uint32_t i = 0; i < corners_.size(); ++i)
    if (!corners_[i].gone && corners_[i].turn <= 0) obstacles.push_back(i);
  obstacles_.build(outline_, std::move(obstacles));
  centre_.reset();
}

// After a neighbour of `corner` is gone.
void EarClipper::changed(std::uint32_t corner) {
  Corner& c = corners_[corner];
  const int turn = turn_of(corner);
  if (c.turn <= 0 && turn > 0) {
    if (!centre_) obstacles_.remove(corner);
    wake(c.waiting);
  }
  c.turn = std::int8_t(turn);
  wake(c.waiting_at_touch);
  enqueue(corner);
}

void EarClipper::clip_corner(std::uint32_t corner, std::vector<Triangle>& triangles) {
  Corner& c = corners_[corner];
  triangles.push_back({c.before, corner, c.after});
  c.gone = true;
  corners_[c.before].after = c.after;
  corners_[c.after].before = c.before;
  --left_;
  some_ = c.after;
  if (c.turn <= 0 && !centre_) obstacles_.remove(corner);
  wake(c.waiting);
  wake(c.waiting_at_touch);
  changed(c.before);
  changed(c.after);
}

// Whether clipping the corner covers nothing but what rounding may have made.
bool EarClipper::is_flat(std::uint32_t corner) const {
  const dvec2 &a = place(corners_[corner].before), &b = place(corner), &c = place(corners_[corner].after);
  return std::min({distance_to_line(a, b, c), distance_to_line(b, c, a), distance_to_line(c, a, b)}) <
         tolerance_;
}

// Of corners none of which is an ear: one on a line with its neighbours if there is one; or one whose
// triangle something lies in that rounding may have put there; else the outline must cross itself, and any
// will do. False: that.
bool EarClipper::clip_without_ear(std::vector<Triangle>& triangles) {
  bool touching = false;
  const auto convex = [&](std::uint32_t c) { return corners_[c].turn > 0; };
  const auto straight = [&](std::uint32_t c) { return corners_[c].turn == 0; };
  const auto flat = [&](std::uint32_t c) { return is_flat(c); };
  const auto nearly = [&](std::uint32_t c) { return convex(c) && blocker_of(c, touching) == nobody; };
  const auto find = [&](const auto& good) {
    std::uint32_t c = some_;
    for (std::size_t n = 0; n < left_; ++n, c = corners_[c].after)
      if (good(c)) return c;
    return nobody;
  };
  std::uint32_t chosen = find(straight);
  if (chosen == nobody && looks_ < most_looks) {
    looks_ += left_;
    chosen = find(flat);
    loose_ = true;
    if (chosen == nobody) chosen = find(nearly);
    loose_ = false;
  }
  const bool good = chosen != nobody;
  if (!good) chosen = find(convex);
  clip_corner(good || chosen != nobody ? chosen : some_, triangles);
  return good;
}

bool EarClipper::clip(std::span<const dvec2> outline, std::vector<Triangle>& triangles) {
  outline_ = outline;
  left_ = outline.size();
  forced_ = queue_front_ = looks_ = 0;
  tolerance_ = outline_tolerance(outline);
  some_ = 0;
  queue_.clear();
  waits_.clear();
  const std::uint32_t count = std::uint32_t(outline.size());
  corners_.resize(count);
  for (std::uint32_t i = 0; i < count; ++i)
    corners_[i] = {i == 0 ? count - 1 : i - 1, i + 1 == count ? 0 : i + 1, nobody, nobody, 0, false, false};
  for (std::uint32_t i = 0; i < count; ++i) {
    corners_[i].turn = std::int8_t(turn_of(i));
    enqueue(i);
  }
  centre_ = star_centre(outline);
  bool good = centre_ || !outline_crosses(outline);
  if (!centre_) build_obstacles();

  while (left_ > 3) {
    if (queue_front_ == queue_.size()) {
      if (centre_) build_obstacles();
      if (!good && forced_ > most_forced) break;
      if (!clip_without_ear(triangles)) good = false;
      ++forced_;
      continue;
    }
    const std::uint32_t corner = queue_[queue_front_++];
    corners_[corner].queued = false;
    if (corners_[corner].gone || corners_[corner].turn <= 0) continue;
    if (sees_ear(corner)) {
      clip_corner(corner, triangles);
      continue;
    }
    if (centre_) build_obstacles();
    bool touching = false;
    const std::uint32_t blocker = !good && forced_ > most_forced ? nobody : blocker_of(corner, touching);
    if (blocker == nobody) {
      clip_corner(corner, triangles);
      continue;
    }
    std::uint32_t& list = touching ? corners_[blocker].waiting_at_touch : corners_[blocker].waiting;
    waits_.push_back({corner, list});
    list = std::uint32_t(waits_.size() - 1);
  }
  for (std::uint32_t c = corners_[some_].after; corners_[c].after != some_; c = corners_[c].after)
    triangles.push_back({some_, c, corners_[c].after});
  return good;
}

}  // namespace nook
