#pragma once

#include <span>

namespace nook {

/// Mean structural similarity, Wang, Bovik, Sheikh and Simoncelli 2004, eq. 13: 11x11 Gaussian window of
/// sigma 1.5, K1 = 0.01, K2 = 0.03, L = 1, over the windows that lie inside the image and hold finite values
/// only. NaN if there is none, as in an image smaller than 11 x 11.
double structural_similarity(std::span<const float> a, std::span<const float> b, int width, int height);

}  // namespace nook
