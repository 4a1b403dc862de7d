// For the parts of hot loops: PoCL inlines small functions alone, and a loop that calls one stays scalar.
#ifndef NOOK_INLINE_H
#define NOOK_INLINE_H

#define INLINE __attribute__((always_inline, unused)) static inline

#endif
