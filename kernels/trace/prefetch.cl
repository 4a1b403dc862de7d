// Asks for a cache line that is read later, where the compiler can say so: a load that waits for memory keeps a CPU from all behind it.
#ifndef NOOK_PREFETCH_CL
#define NOOK_PREFETCH_CL

#if defined(__clang__) && (defined(__x86_64__) || defined(__aarch64__))
#define PREFETCH_LINE(p, line) __builtin_prefetch((const void*)((size_t)(p) + 64u * (line)))
#else
#define PREFETCH_LINE(p, line)
#endif

#endif
