// Linear light to 8 bits as sRGB has it (IEC 61966-2-1).
#pragma once

#include <array>
#include <bit>
#include <cstdint>

namespace penumbra::detail {

/// By the curve itself: 0 for what is not above 0, NaN too, 255 from 1 on.
unsigned char to_srgb_by_curve(float linear);

/// The same without a power: a table of the least number that each byte stands for, found by the curve.
class SrgbTable {
 public:
  SrgbTable();
  unsigned char operator()(float linear) const {
    if (!(linear > kLow)) return 0;
    if (linear >= 1.0f) return 255;
    // The numbers of one entry of first_ have at most three bytes.
    std::size_t byte = first_[entry_of(linear)];
    byte += linear >= least_[byte + 1] ? 1 : 0;
    byte += linear >= least_[byte + 1] ? 1 : 0;
    return static_cast<unsigned char>(byte);
  }

 private:
  /// Below half of what 1 stands for.
  static constexpr float kLow = 0x1p-14f;
  /// Numbers that share sign, exponent and the first seven bits of the fraction.
  static std::size_t entry_of(float linear) {
    return (std::bit_cast<std::uint32_t>(linear) >> 16) - (std::bit_cast<std::uint32_t>(kLow) >> 16);
  }

  std::array<float, 257> least_{};
  std::array<unsigned char, 14 * 128> first_{};
};

}  // namespace penumbra::detail
