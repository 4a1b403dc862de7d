// For the parts of hot loops: PoCL inlines small functions alone, and a loop that calls one stays scalar. A struct is given back through a
// pointer, for oclgrind does not know what Clang makes of one that such a function returns.
#ifndef NOOK_INLINE_H
#define NOOK_INLINE_H

#define INLINE __attribute__((always_inline, unused)) static inline

// Before a loop whose count is constant: all of it, one pass behind the other.
#ifdef __OPENCL_VERSION__
#define UNROLL __attribute__((opencl_unroll_hint))
#else
#define UNROLL
#endif

#endif
