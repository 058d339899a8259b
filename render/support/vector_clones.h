// Loops that are compiled for several instruction sets; which one runs is chosen when the program starts.
// Contraction of products and sums is off in the whole project, so that all give the same bits.
#pragma once

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define PENUMBRA_VECTOR_CLONES __attribute__((target_clones("arch=x86-64-v4", "avx2", "default")))
#define PENUMBRA_INLINE __attribute__((always_inline)) inline  // into clones, or they stay scalar
#else
#define PENUMBRA_VECTOR_CLONES
#define PENUMBRA_INLINE inline
#endif
