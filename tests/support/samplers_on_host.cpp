#include "support/samplers_on_host.hpp"

#include <algorithm>
#include <cmath>

namespace nook::test::kernels_as_cpp {

#include "support/opencl_as_cpp.hpp"

#include "kernels/sample/halton.cl"
#include "kernels/sample/random.cl"
#include "kernels/sample/sobol.cl"
#include "kernels/sample/stratified.cl"

// The samplers are chosen by a macro: the file is compiled once for each.
namespace independent {
#define SAMPLER 0
#include "kernels/sample/sampler.cl"
}  // namespace independent
namespace stratified {
#undef NOOK_SAMPLER_CL
#undef SAMPLER
#define SAMPLER 1
#include "kernels/sample/sampler.cl"
}  // namespace stratified
namespace halton {
#undef NOOK_SAMPLER_CL
#undef SAMPLER
#define SAMPLER 2
#include "kernels/sample/sampler.cl"
}  // namespace halton
namespace sobol {
#undef NOOK_SAMPLER_CL
#undef SAMPLER
#define SAMPLER 3
#include "kernels/sample/sampler.cl"
}  // namespace sobol
namespace zorder {
#undef NOOK_SAMPLER_CL
#undef SAMPLER
#define SAMPLER 4
#include "kernels/sample/sampler.cl"
}  // namespace zorder

}  // namespace nook::test::kernels_as_cpp

namespace nook::test {

namespace k = kernels_as_cpp;

vec2 host_sample_pixel(Sampler sampler, std::uint32_t pixel, std::uint32_t sample, const EstimatorParams& p) {
  using Function = k::float2 (*)(k::uint, k::uint, const EstimatorParams*);
  static const Function functions[] = {k::independent::sample_pixel, k::stratified::sample_pixel,
                                       k::halton::sample_pixel, k::sobol::sample_pixel,
                                       k::zorder::sample_pixel};
  k::float2 u = functions[int(sampler)](pixel, sample, &p);
  return {u.x, u.y};
}

vec2 host_sample_direction(Sampler sampler, std::uint32_t pixel, std::uint32_t sample,
                           std::uint32_t direction, const EstimatorParams& p) {
  using Function = k::float2 (*)(k::uint, k::uint, k::uint, const EstimatorParams*);
  static const Function functions[] = {k::independent::sample_direction, k::stratified::sample_direction,
                                       k::halton::sample_direction, k::sobol::sample_direction,
                                       k::zorder::sample_direction};
  k::float2 u = functions[int(sampler)](pixel, sample, direction, &p);
  return {u.x, u.y};
}

std::uint32_t host_permute(std::uint32_t i, std::uint32_t n, std::uint32_t key) {
  k::permute(&i, &key, 1, n);
  return i;
}

std::uint32_t host_sobol(std::uint32_t index, unsigned dimension) {
  using Function = k::uint (*)(k::uint);
  static const Function functions[] = {k::sobol0_reversed, k::sobol1_reversed, k::sobol2_reversed,
                                       k::sobol3_reversed};
  return k::reverse_bits(functions[dimension](index));
}

}  // namespace nook::test
