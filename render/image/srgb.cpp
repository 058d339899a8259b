#include "render/image/srgb.h"

#include <cmath>
#include <limits>

namespace penumbra::detail {

unsigned char to_srgb_by_curve(float linear) {
  if (!(linear > 0.0f)) return 0;
  if (linear >= 1.0f) return 255;
  const float encoded =
      linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
  return static_cast<unsigned char>(std::lround(255.0f * encoded));
}

SrgbTable::SrgbTable() {
  // Between 0 and 1 floats are in the order of their bits.
  const auto least_for = [](unsigned byte) {
    std::uint32_t low = 0, high = std::bit_cast<std::uint32_t>(1.0f);
    while (high - low > 1) {
      const std::uint32_t middle = low + (high - low) / 2;
      (to_srgb_by_curve(std::bit_cast<float>(middle)) >= byte ? high : low) = middle;
    }
    return std::bit_cast<float>(high);
  };
  for (unsigned byte = 1; byte < 256; ++byte) least_[byte] = least_for(byte);
  least_[256] = std::numeric_limits<float>::infinity();
  const std::uint32_t lowest = std::bit_cast<std::uint32_t>(kLow) >> 16;
  for (std::uint32_t k = 0; k < first_.size(); ++k)
    first_[k] = to_srgb_by_curve(std::bit_cast<float>((lowest + k) << 16));
}

}  // namespace penumbra::detail
