// As much of OpenCL C as kernels/sample uses, for a file that includes these kernels as C++. To be included
// within a namespace of that file's own; the file includes <cmath> and <cstdint> before.
using uint = std::uint32_t;
using ulong = std::uint64_t;
struct float2 {
  float x, y;
};
struct uint4 {
  uint x, y, z, w;
};
using std::fmin;
inline uint clz(uint x) {
  return x == 0u ? 32u : static_cast<uint>(__builtin_clz(x));
}
#define __constant static const
#define __global
