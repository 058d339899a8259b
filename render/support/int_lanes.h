// Whole numbers of 32 bits that are added, compared and chosen together, as many as the processor's registers
// hold; as many floats, and half as many doubles.
//
// Wider vectors than a processor has are taken apart by the compiler number by number where they are
// compared, which is ten times slower than narrow ones. So kernels are templates of the width, and
// PENUMBRA_BY_LANES(return type, name, (parameters), call) defines a function that calls them with the widest
// one; `call` uses kLanes. Which one runs is chosen when the program starts; all give the same bits.
#pragma once

#include <cstdint>
#include <cstring>

#include "render/support/float_lanes.h"

namespace penumbra::detail {

/// Vectors of some width. Written out, since GCC takes the attribute off types that depend on parameters.
template <int kLanes>
struct IntVectors;
template <>
struct IntVectors<16> {
  using Integers = std::int32_t __attribute__((vector_size(64)));
  using Numbers = float __attribute__((vector_size(64)));
  using Reals = double __attribute__((vector_size(64)));
  using HalfIntegers = std::int32_t __attribute__((vector_size(32)));
};
template <>
struct IntVectors<8> {
  using Integers = std::int32_t __attribute__((vector_size(32)));
  using Numbers = float __attribute__((vector_size(32)));
  using Reals = double __attribute__((vector_size(32)));
  using HalfIntegers = std::int32_t __attribute__((vector_size(16)));
};
template <>
struct IntVectors<4> {
  using Integers = std::int32_t __attribute__((vector_size(16)));
  using Numbers = float __attribute__((vector_size(16)));
  using Reals = double __attribute__((vector_size(16)));
  using HalfIntegers = std::int32_t __attribute__((vector_size(8)));
};

template <int kLanes>
struct IntLanes {
  using Integers = typename IntVectors<kLanes>::Integers;
  using Numbers = typename IntVectors<kLanes>::Numbers;
  /// Half as many doubles, and as many integers.
  using Reals = typename IntVectors<kLanes>::Reals;
  using HalfIntegers = typename IntVectors<kLanes>::HalfIntegers;

  static PENUMBRA_INLINE Integers load(const std::int32_t* from) {
    Integers out;
    std::memcpy(&out, from, sizeof(out));
    return out;
  }
  static PENUMBRA_INLINE Numbers load(const float* from) {
    Numbers out;
    std::memcpy(&out, from, sizeof(out));
    return out;
  }
  static PENUMBRA_INLINE void store(const Integers& x, std::int32_t* to) { std::memcpy(to, &x, sizeof(x)); }
  static PENUMBRA_INLINE void store(const Numbers& x, float* to) { std::memcpy(to, &x, sizeof(x)); }
  static PENUMBRA_INLINE Numbers numbers(const Integers& x) { return __builtin_convertvector(x, Numbers); }
  static PENUMBRA_INLINE Integers integers(const Numbers& x) { return __builtin_convertvector(x, Integers); }
};

}  // namespace penumbra::detail

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define PENUMBRA_BY_LANES(result, name, parameters, call)            \
  __attribute__((target("arch=x86-64-v4"))) result name parameters { \
    constexpr int kLanes = 16;                                       \
    return call;                                                     \
  }                                                                  \
  __attribute__((target("avx2"))) result name parameters {           \
    constexpr int kLanes = 8;                                        \
    return call;                                                     \
  }                                                                  \
  __attribute__((target("default"))) result name parameters {        \
    constexpr int kLanes = 4;                                        \
    return call;                                                     \
  }
#else
#define PENUMBRA_BY_LANES(result, name, parameters, call) \
  result name parameters {                                \
    constexpr int kLanes = 4;                             \
    return call;                                          \
  }
#endif
