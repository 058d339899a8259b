// Eight floats that are added, compared and chosen together (an extension of GCC and clang).
#pragma once

#include <bit>
#include <cstdint>

#include "render/vector_clones.h"

// How vectors are returned differs between instruction sets; functions here are always inlined.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wpsabi"
#endif

namespace penumbra::detail {

inline constexpr int kFloatLanes = 8;
using Floats = float __attribute__((vector_size(kFloatLanes * sizeof(float))));
using Ints = std::int32_t __attribute__((vector_size(kFloatLanes * sizeof(std::int32_t))));

PENUMBRA_INLINE Floats magnitude(const Floats& x) {
  return __builtin_bit_cast(Floats, __builtin_bit_cast(Ints, x) & 0x7fffffff);
}

/// Bit i is set where lane i of a comparison is true.
PENUMBRA_INLINE std::uint32_t bits_of(const Ints& truth) {
  using Bytes = std::int8_t __attribute__((vector_size(kFloatLanes)));
  const auto bytes = __builtin_bit_cast(std::uint64_t, __builtin_convertvector(truth, Bytes));
  return static_cast<std::uint32_t>((bytes & 0x0101010101010101) * 0x0102040810204080 >> 56);
}

}  // namespace penumbra::detail
