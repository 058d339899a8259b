#include "render/d_buffer/entries/receiver_grid.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace penumbra::detail {
namespace {

constexpr int kCells = ReceiverGrid::kCells;
/// Speed: an answer looks at so many cells a side at most, of the finest level that allows it
/// (d_buffer_bench).
constexpr int kMostCells = 4;
constexpr float kNobody = std::numeric_limits<float>::infinity();

std::size_t place(SupportKind kind) {
  return kind == SupportKind::kPenumbra ? 0 : 1;
}

}  // namespace

ReceiverGrid::ReceiverGrid(const ImageReceivers& image, std::span<const float> seen, const Target& target,
                           int size)
    : reads_(image.positions.size()), low_(target.window[0], target.window[2]) {
  const glm::dvec2 extent = glm::dvec2(target.window[1], target.window[3]) - low_;
  cells_per_unit_ = static_cast<double>(kCells) / extent;
  texel_ = static_cast<double>(kCells) / size;
  // An entry may lie this much behind its receiver: what two texels are worth on a slope of 1.
  const auto slack = static_cast<float>(2.0 * std::max(extent.x, extent.y) / size);
  const glm::vec2 origin(low_), scale(cells_per_unit_);
  const auto add = [&](std::size_t i, Kinds& cells) {
    if (!(image.positions[i].w > 0.0f)) return;
    const glm::vec2 uv(image.positions[i]), cell = (uv - origin) * scale;
    // Receivers that rounding puts just outside belong to the border's cells.
    if (!(cell.x > -1.0f && cell.y > -1.0f && cell.x < kCells + 1.0f && cell.y < kCells + 1.0f)) return;
    const auto x = static_cast<std::size_t>(std::clamp(cell.x, 0.0f, kCells - 1.0f));
    const auto y = static_cast<std::size_t>(std::clamp(cell.y, 0.0f, kCells - 1.0f));
    const float height = image.positions[i].z - slack * (1.0f + glm::dot(uv, uv));
    Reads& read = reads_[i];
    read.column = static_cast<std::uint8_t>(x), read.row = static_cast<std::uint8_t>(y);
    const auto put = [&](SupportKind kind, float value) {
      (kind == SupportKind::kPenumbra ? read.penumbra : read.umbra) = true;
      float& least = cells[place(kind)][y * kCells + x];
      least = std::min(least, value);
    };
    if (seen[i] < 0.5f) return put(SupportKind::kUmbra, height);
    if (image.planes[i].z > 0.0f) return put(SupportKind::kPenumbra, height);
    // Below whose horizon the center lies: any penumbra entry, near or far, decides which kind it reads.
    put(SupportKind::kPenumbra, -kNobody);
    put(SupportKind::kUmbra, height);
  };
  const std::vector<float> nobody(kCells * kCells, kNobody);
  tbb::enumerable_thread_specific<Kinds> parts(Kinds{nobody, nobody});
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, image.positions.size(), 8192), [&](const auto& range) {
    Kinds& cells = parts.local();
    for (std::size_t i = range.begin(); i < range.end(); ++i) add(i, cells);
  });
  Kinds finest{nobody, nobody};
  for (const Kinds& part : parts)
    for (std::size_t k = 0; k < 2; ++k)
      for (std::size_t i = 0; i < nobody.size(); ++i) finest[k][i] = std::min(finest[k][i], part[k][i]);
  build_levels(std::move(finest));
}

void ReceiverGrid::build_levels(Kinds finest) {
  levels_.push_back(std::move(finest));
  for (std::size_t side = kCells / 2; side > 0; side /= 2) {
    const Kinds& fine = levels_.back();
    Kinds coarse;
    for (std::size_t k = 0; k < 2; ++k) {
      coarse[k].resize(side * side);
      for (std::size_t y = 0; y < side; ++y)
        for (std::size_t x = 0; x < side; ++x) {
          const float* row = fine[k].data() + 4 * y * side + 2 * x;
          coarse[k][y * side + x] = std::min({row[0], row[1], row[2 * side], row[2 * side + 1]});
        }
    }
    levels_.push_back(std::move(coarse));
  }
}

double ReceiverGrid::least_height(SupportKind kind, const UvBounds& bounds) const {
  if (is_everywhere()) return -kNone;
  const auto cell_of = [](double cell) { return static_cast<int>(std::clamp(cell, 0.0, kCells - 1.0)); };
  const glm::dvec2 from = (bounds.low - low_) * cells_per_unit_ - texel_;
  const glm::dvec2 to = (bounds.high - low_) * cells_per_unit_ + texel_;
  if (to.x < 0.0 || to.y < 0.0 || from.x >= kCells || from.y >= kCells) return kNone;
  int x0 = cell_of(from.x), x1 = cell_of(to.x), y0 = cell_of(from.y), y1 = cell_of(to.y);
  std::size_t level = 0, side = kCells;
  while (std::max(x1 - x0, y1 - y0) >= kMostCells) {
    x0 /= 2, x1 /= 2, y0 /= 2, y1 /= 2;
    ++level, side /= 2;
  }
  const std::vector<float>& cells = levels_[level][place(kind)];
  float least = kNobody;
  for (int y = y0; y <= y1; ++y)
    for (int x = x0; x <= x1; ++x)
      least = std::min(least, cells[static_cast<std::size_t>(y) * side + static_cast<std::size_t>(x)]);
  return static_cast<double>(least);
}

}  // namespace penumbra::detail
