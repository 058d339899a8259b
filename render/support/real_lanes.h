// Doubles that are added, compared and chosen together, as many as the processor's registers hold.
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
struct RealVectors;
template <>
struct RealVectors<8> {
  using Reals = double __attribute__((vector_size(64)));
  using Integers = std::int64_t __attribute__((vector_size(64)));
};
template <>
struct RealVectors<4> {
  using Reals = double __attribute__((vector_size(32)));
  using Integers = std::int64_t __attribute__((vector_size(32)));
};
template <>
struct RealVectors<2> {
  using Reals = double __attribute__((vector_size(16)));
  using Integers = std::int64_t __attribute__((vector_size(16)));
};

template <int kLanes>
struct RealLanes {
  using Reals = typename RealVectors<kLanes>::Reals;
  using Integers = typename RealVectors<kLanes>::Integers;

  static PENUMBRA_INLINE Reals load(const double* from) {
    Reals out;
    std::memcpy(&out, from, sizeof(out));
    return out;
  }
  static PENUMBRA_INLINE void store(const Reals& x, double* to) { std::memcpy(to, &x, sizeof(x)); }
  static PENUMBRA_INLINE void store(const Integers& x, std::int64_t* to) { std::memcpy(to, &x, sizeof(x)); }
};

}  // namespace penumbra::detail

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define PENUMBRA_BY_LANES(result, name, parameters, call)            \
  __attribute__((target("arch=x86-64-v4"))) result name parameters { \
    constexpr int kLanes = 8;                                        \
    return call;                                                     \
  }                                                                  \
  __attribute__((target("avx2"))) result name parameters {           \
    constexpr int kLanes = 4;                                        \
    return call;                                                     \
  }                                                                  \
  __attribute__((target("default"))) result name parameters {        \
    constexpr int kLanes = 2;                                        \
    return call;                                                     \
  }
#else
#define PENUMBRA_BY_LANES(result, name, parameters, call) \
  result name parameters {                                \
    constexpr int kLanes = 2;                             \
    return call;                                          \
  }
#endif
