#include "render/occlusion_textures/summed_area.h"

namespace penumbra::detail {

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

PENUMBRA_VECTOR_CLONES
void SummedArea::covered(const TexelBoxes& boxes, double* __restrict out) const {
  const Table table{sums_.data(), size_};
  for (std::size_t i = 0; i < boxes.count; ++i) out[i] = table.covered(boxes[i]);
}

}  // namespace penumbra::detail
