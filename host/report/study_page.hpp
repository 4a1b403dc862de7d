#pragma once

#include <filesystem>
#include <span>

#include "device/device.hpp"
#include "report/study_file.hpp"
#include "report/study_gallery.hpp"

namespace nook {

/// Points of a warp, in the plane perpendicular to its axis.
struct WarpPattern {
  std::string name;
  std::vector<vec2> points;
};

/// 256 points of Sobol's sequence through the warps of kernels/warp.cl; the lobe with the scene's exponent.
std::vector<WarpPattern> warp_patterns(const Device& device, float exponent);

struct Gallery {
  int width = 0, height = 0;
  std::vector<GalleryPicture> pictures;
};

/// Writes the study as one HTML file that needs nothing else. Pictures go in as 16-bit numbers, so that the
/// page can show errors and values and not just colours. Throws Error(output).
void write_study_page(const std::filesystem::path& path, const Study& study, const StudyFacts& facts,
                      const Gallery& gallery, std::span<const WarpPattern> patterns);

}  // namespace nook
