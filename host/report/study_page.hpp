#pragma once

#include <filesystem>
#include <span>

#include "device/device.hpp"
#include "report/plot_library.hpp"
#include "report/study_file.hpp"
#include "report/study_gallery.hpp"

namespace nook {

/// Directions of a warp, its axis z; the disk's points have z = 0.
struct WarpPattern {
  std::string name;
  std::vector<vec3> points;
};

/// 256 points of Sobol's sequence through the warps of kernels/sample/warp.cl; the lobe with the scene's
/// exponent.
std::vector<WarpPattern> warp_patterns(const Device& device, float exponent);

struct Gallery {
  int width = 0, height = 0;
  std::vector<GalleryPicture> pictures;
};

/// Writes the study as one HTML file that needs nothing else: the library that draws its plots goes in;
/// without one it shows tables. Pictures go in as 16-bit numbers, so that the page can show errors and values
/// and not just colours. Throws Error(output).
void write_study_page(const std::filesystem::path& path, const Study& study, const StudyFacts& facts,
                      const Gallery& gallery, std::span<const WarpPattern> patterns,
                      const PlotLibrary& library);

}  // namespace nook
