#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace nook {

/// Samples [first, end) of the pixels at positions [pixel_begin, pixel_end) of the render order.
struct SampleBox {
  std::uint32_t pixel_begin = 0, pixel_end = 0;
  std::uint32_t first = 0, end = 0;

  bool empty() const { return pixel_begin >= pixel_end || first >= end; }
  std::uint64_t samples() const {
    return empty() ? 0 : std::uint64_t(pixel_end - pixel_begin) * (end - first);
  }
  bool operator==(const SampleBox&) const = default;
};

using SampleBoxes = std::vector<SampleBox>;

/// The union of `boxes` in its one canonical form: disjoint, sorted by pixel, then sample; pixels whose
/// samples are the same and adjoin share boxes. If `overlap` is given, it becomes a box (or a part of one)
/// that two of `boxes` hold, if any do.
SampleBoxes unite(SampleBoxes boxes, std::optional<SampleBox>* overlap = nullptr);

/// What of `whole` is not in `taken`, in canonical form.
SampleBoxes subtract(const SampleBoxes& whole, const SampleBoxes& taken);

std::uint64_t samples_in(const SampleBoxes& disjoint);

/// Which samples a film holds. Boxes are added one by one as they are finished, and united now and then, so
/// that a render's millions of launches cost no memory.
class HeldSamples {
 public:
  HeldSamples() = default;
  explicit HeldSamples(SampleBoxes disjoint) : boxes_(unite(std::move(disjoint))), united_(boxes_.size()) {}
  /// The box must be disjoint from what is held.
  void add(const SampleBox& box);
  /// In canonical form.
  const SampleBoxes& boxes() const;

 private:
  mutable SampleBoxes boxes_;
  mutable std::size_t united_ = 0;  ///< the number of boxes_, from the first, in canonical form
};

}  // namespace nook
