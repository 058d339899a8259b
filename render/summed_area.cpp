#include "render/summed_area.h"

namespace penumbra::detail {
namespace {

/// A border between the two corners next to it.
struct Between {
  std::size_t low;
  double share;  ///< of the corner above `low`
};

Between between(double at, int size) {
  const int low = std::min(static_cast<int>(at), size - 1);
  return {static_cast<std::size_t>(low), at - low};
}

}  // namespace

SummedArea::SummedArea(std::span<const std::uint8_t> texels, int size) : size_(size) {
  const auto n = static_cast<std::size_t>(size), stride = n + 1;
  sums_.resize(stride * stride);
  for (std::size_t j = 0; j < n; ++j) {
    std::uint32_t row = 0;
    const std::uint8_t* in = texels.data() + j * n;
    std::uint32_t* below = sums_.data() + j * stride + 1;
    std::uint32_t* out = below + stride;
    for (std::size_t i = 0; i < n; ++i) {
      row += in[i];
      out[i] = below[i] + row;
    }
  }
}

double SummedArea::covered(const TexelBox& any_box) const {
  const TexelBox box = clipped(any_box, size_);
  if (box.empty()) return 0.0;
  const Between x0 = between(box.x0, size_), x1 = between(box.x1, size_), y0 = between(box.y0, size_),
                y1 = between(box.y1, size_);
  const std::size_t stride = static_cast<std::size_t>(size_) + 1;
  // Sums below a row's border between the two borders in x: differences of integers first, which are exact.
  const auto strip = [&](std::size_t row) {
    const std::uint32_t* s = sums_.data() + row * stride;
    const std::uint32_t a = s[x0.low], b = s[x1.low];
    return static_cast<double>(b - a) + x1.share * (s[x1.low + 1] - b) - x0.share * (s[x0.low + 1] - a);
  };
  const double low = strip(y0.low), high = strip(y1.low);
  const double sum =
      high - low + y1.share * (strip(y1.low + 1) - high) - y0.share * (strip(y0.low + 1) - low);
  return sum / 255.0;
}

}  // namespace penumbra::detail
