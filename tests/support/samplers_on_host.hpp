#pragma once

#include "kernels/shared/task.h"
#include "math/types.hpp"
#include "scene/scene.hpp"

namespace nook::test {

/// kernels/sample/sampler.cl compiled as C++: sample_pixel and sample_direction of each sampler.
vec2 host_sample_pixel(Sampler sampler, std::uint32_t pixel, std::uint32_t sample, const EstimatorParams& p);
vec2 host_sample_direction(Sampler sampler, std::uint32_t pixel, std::uint32_t sample,
                           std::uint32_t direction, const EstimatorParams& p);

/// The functions underneath, for their own tests.
std::uint32_t host_permute(std::uint32_t i, std::uint32_t n, std::uint32_t key);
/// Fractions of 2^32, unscrambled; dimension 0 to 3.
std::uint32_t host_sobol(std::uint32_t index, unsigned dimension);

}  // namespace nook::test
