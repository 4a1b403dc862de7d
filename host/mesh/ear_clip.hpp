#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "math/types.hpp"
#include "mesh/obstacle_tree.hpp"

namespace nook {

/// Cuts a polygon into triangles by clipping ears (Meisters 1975): corners with their two neighbours whose
/// triangle lies inside. n corners give n - 2 triangles.
///
/// The outline may touch itself, or go back along itself to a hole: of corners at one place, each is judged
/// by the way the outline goes there. A corner on a straight line keeps its place in some triangle, so that a
/// neighbouring face that has it too leaves no gap. Which corners lie in the way is looked up in a tree of
/// those that are not convex (obstacle_tree.hpp), and a corner that is no ear yet waits for the one that was
/// in its way: n log n steps for most outlines. Where all of the outline is seen from one point
/// (star_outline.hpp), nothing is looked up: a convex corner is an ear if its neighbours pass that point on
/// their left as well, since the triangle then lies between two rays that meet the outline once each.
class EarClipper {
 public:
  using Triangle = std::array<std::uint32_t, 3>;

  /// Appends the triangles of a counter-clockwise outline of at least 4 corners. False: it crosses itself
  /// (outline_crosses); then the triangles have its corners and some cover.
  bool clip(std::span<const dvec2> outline, std::vector<Triangle>& triangles);

 private:
  static constexpr std::uint32_t nobody = 0xffffffffu;

  struct Corner {
    std::uint32_t before, after;  // along what is left of the outline
    std::uint32_t waiting,
        waiting_at_touch;  // lists in waits_: for it to leave; or else for its neighbours to
    std::int8_t turn;      // 1: convex, 0: straight or a spike, -1: reflex
    bool gone, queued;
  };
  struct Wait {
    std::uint32_t corner, next;
  };

  const dvec2& place(std::uint32_t corner) const { return outline_[corner]; }
  int turn_of(std::uint32_t corner) const;
  void enqueue(std::uint32_t corner);
  void wake(std::uint32_t& list);
  /// Whether the outline, where it passes corner `other` at the place of `tip`, enters the angle there from
  /// `tip` -> `from` counter-clockwise to `tip` -> `to`.
  bool enters(std::uint32_t other, const dvec2& tip, const dvec2& from, const dvec2& to) const;
  /// Whether `other` keeps the triangle of an ear from being clipped; `touching`: it lies on its border.
  bool blocks(std::uint32_t other, const std::array<std::uint32_t, 3>& ear, bool& touching) const;
  std::uint32_t blocker_of(std::uint32_t corner, bool& touching);
  bool sees_ear(std::uint32_t corner) const;
  void build_obstacles();
  void clip_corner(std::uint32_t corner, std::vector<Triangle>& triangles);
  void changed(std::uint32_t corner);
  bool is_flat(std::uint32_t corner) const;
  bool clip_without_ear(std::vector<Triangle>& triangles);

  std::span<const dvec2> outline_;
  std::vector<Corner> corners_;
  std::vector<Wait> waits_;
  std::vector<std::uint32_t> queue_;
  std::size_t queue_front_ = 0, left_ = 0, forced_ = 0, looks_ = 0;
  double tolerance_ = 0;
  bool loose_ = false;           // what lies in an ear by no more than the tolerance does not block it
  std::uint32_t some_ = 0;       // a corner that is left
  std::optional<dvec2> centre_;  // sees all that is left of the outline; the tree is then not built yet
  ObstacleTree obstacles_;
};

}  // namespace nook
