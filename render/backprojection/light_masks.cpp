#include "render/backprojection/light_masks.h"

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>

#include "render/light/light_samples.h"

namespace penumbra::detail {

LightMasks::LightMasks(bool disk, int samples, std::uint64_t seed) {
  const StratumTable table(samples);
  std::array<float, kSampleLanes> a, b;
  for (int first = 0; first < table.strata.count(); first += kSampleLanes) {
    place_samples(table, disk, sample_key(seed, std::uint32_t{0}), first, a.data(), b.data());
    for (int k = 0; k < std::min(kSampleLanes, table.strata.count() - first); ++k)
      samples_.emplace_back(a[static_cast<std::size_t>(k)], b[static_cast<std::size_t>(k)]);
  }
  words_ = (samples_.size() + 63) / 64;
  x_ = make_axis(0);
  y_ = make_axis(1);
}

LightMasks::Axis LightMasks::make_axis(int k) const {
  std::vector<std::size_t> order(samples_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return samples_[i][k]; });
  Axis axis;
  axis.prefixes.assign(words_, 0);
  for (const std::size_t i : order) {
    axis.sorted.push_back(samples_[i][k]);
    const std::vector<MaskWord> last(axis.prefixes.end() - static_cast<std::ptrdiff_t>(words_),
                                     axis.prefixes.end());
    axis.prefixes.insert(axis.prefixes.end(), last.begin(), last.end());
    axis.prefixes[axis.prefixes.size() - words_ + i / 64] |= MaskWord{1} << (i % 64);
  }
  return axis;
}

const MaskWord* LightMasks::below(const Axis& axis, double x) const {
  const auto k = std::ranges::lower_bound(axis.sorted, x) - axis.sorted.begin();
  return axis.prefixes.data() + static_cast<std::size_t>(k) * words_;
}

void LightMasks::add(const LightRectangle& r, std::span<MaskWord> mask) const {
  const MaskWord *left = below(x_, r.low.x), *right = below(x_, r.high.x), *low = below(y_, r.low.y),
                 *high = below(y_, r.high.y);
  for (std::size_t i = 0; i < words_; ++i) mask[i] |= (left[i] ^ right[i]) & (low[i] ^ high[i]);
}

bool LightMasks::is_full(std::span<const MaskWord> mask) const {
  std::size_t bits = 0;
  for (const MaskWord word : mask) bits += static_cast<std::size_t>(std::popcount(word));
  return bits == samples_.size();
}

}  // namespace penumbra::detail
