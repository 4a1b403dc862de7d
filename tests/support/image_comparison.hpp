#pragma once

#include <string>

#include "support/oracle.hpp"

namespace nook::test {

/// The smallest p-value at each scale, and whether it passes: alpha 1e-3 for each scale, Sidak within it.
/// Pixels alone miss a small uniform bias, the mean of the image alone misses errors that cancel.
struct ImageVerdict {
  double pixel_p = 1, tile_p = 1, image_p = 1;
  bool pixels_agree = true, tiles_agree = true, image_agrees = true;
  bool agree() const { return pixels_agree && tiles_agree && image_agrees; }
};

/// Welch tests (Student's t with Welch-Satterthwaite degrees) that two images have the same expectation, by
/// pixel, by 16 x 16 tile and as a whole. Where both sides draw independent samples of one distribution
/// (`pooled`) their variances are pooled by pixel: a pixel where one side saw no shadow has no variance of
/// its own.
ImageVerdict compare(const ReferenceImage& a, const ReferenceImage& b, bool pooled);

/// compare(), and if they differ the evidence in NOOK_EVIDENCE (default ./evidence): NAME.exr with image,
/// reference, difference and p-value, NAME.png of |difference|.
ImageVerdict compare_with_evidence(const ReferenceImage& image, const ReferenceImage& reference, bool pooled,
                                   const std::string& name);

}  // namespace nook::test
