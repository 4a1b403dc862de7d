#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace nook {

/// The state of one effect's estimate over a window of pixels: integers alone, so that adding the same
/// samples in any order, split over any launches, machines or restarts, gives the same bits.
///
/// A replicate is what the spread is measured between: the mean over the directions of one camera ray, or
/// (one camera ray a pixel) one direction.
struct Film {
  int width = 0, height = 0;        ///< pixels of the window
  float sum_scale = 1;              ///< fixed point of `sum`, a power of two
  float square_scale = 1;           ///< fixed point of `sum_square`, a power of two
  std::uint32_t per_replicate = 1;  ///< directions in a replicate

  std::vector<std::uint64_t> sum;         ///< Σ w V over all directions
  std::vector<std::uint64_t> sum_square;  ///< Σ replicate²
  std::vector<std::uint32_t> replicates;
  std::vector<std::uint32_t> camera_samples;
  std::vector<std::uint32_t> hits;  ///< camera samples that hit the mesh
  /// What an effect sums besides, a plane each: for bent normals x, y and z of Σ w V ω in the fixed point of
  /// `sum`, two's complement.
  std::vector<std::vector<std::uint64_t>> extra;
  /// What a stop rule remembers of each pixel, a plane each (trace/session.hpp, adaptive/pixel_rule.hpp); not
  /// sums: films with such planes are not added.
  std::vector<std::vector<std::uint64_t>> kept;

  /// What the effect was, by the keys' names and values: what the sums mean may depend on it.
  std::map<std::string, std::string> settings;

  Film() = default;
  /// Throws std::bad_alloc.
  Film(int width, int height, float sum_scale, float square_scale, std::uint32_t per_replicate,
       std::size_t extra_planes = 0);

  std::size_t pixels() const { return std::size_t(width) * std::size_t(height); }
  /// Adds the samples of a film of the same size and scales, without planes of a stop rule.
  void add(const Film& other);
  /// The estimate, 0 without samples.
  double value(std::size_t pixel) const;
  /// The variance of value(): the sample variance of the replicates over their number; 0 with fewer than two.
  double variance(std::size_t pixel) const;
  /// The share of camera samples that hit the mesh, 0 to 1.
  double coverage(std::size_t pixel) const;
};

}  // namespace nook
