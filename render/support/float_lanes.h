// Eight floats that are added, compared and chosen together (an extension of GCC and clang).
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>

#include "render/support/vector_clones.h"

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

/// For every set of lanes these lanes' numbers, ascending, then 0.
inline constexpr auto kLanesOf = [] {
  std::array<std::array<std::int32_t, kFloatLanes>, 1 << kFloatLanes> out{};
  for (std::uint32_t bits = 0; bits < out.size(); ++bits)
    for (std::size_t lane = 0, at = 0; lane < kFloatLanes; ++lane)
      if (bits >> lane & 1) out[bits][at++] = static_cast<std::int32_t>(lane);
  return out;
}();

/// Writes the lanes whose bits are set to `out`, one after the other, and returns how many. Eight places are
/// written in any case: what nothing could predict needs no branch.
PENUMBRA_INLINE std::size_t store_lanes(const Ints& x, std::uint32_t bits, std::int32_t* out) {
#if defined(__clang__)
  for (std::size_t k = 0; k < kFloatLanes; ++k) out[k] = x[kLanesOf[bits][k]];
#else
  const Ints packed = __builtin_shuffle(x, __builtin_bit_cast(Ints, kLanesOf[bits]));
  std::memcpy(out, &packed, sizeof(packed));
#endif
  return static_cast<std::size_t>(std::popcount(bits));
}

}  // namespace penumbra::detail
