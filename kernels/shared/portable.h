// Types that mean the same on both sides. Share float[3] plus a real field, never float3 (it hides padding).
#ifndef NOOK_SHARED_PORTABLE_H
#define NOOK_SHARED_PORTABLE_H

#ifdef __OPENCL_C_VERSION__
typedef uint nook_uint;
typedef ulong nook_ulong;
#else
#include <cstdint>
typedef std::uint32_t nook_uint;
typedef std::uint64_t nook_ulong;
#endif

#endif
