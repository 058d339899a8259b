#include "render/d_buffer/entries/tiles.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace penumbra::detail {
namespace {

// Speed (d_buffer_bench).

/// Pixels a side of the tiles of which rectangles are made.
constexpr int kTile = 8;
/// Cells of the receivers' grid a side of a cell of the grid here.
constexpr int kFiner = 2;
/// Cells a side of the grid over the target's window.
constexpr int kCells = ReceiverGrid::kCells / kFiner;

/// Cells of the target's window that some entry's triangle may touch, by the entry's kind.
class Occupancy {
 public:
  Occupancy(const EntryGeometry& entries, const Target& target)
      : low_(target.window[0], target.window[2]),
        per_unit_(static_cast<float>(kCells) / (glm::vec2(target.window[1], target.window[3]) - low_)) {
    mark_all(entries.penumbra, penumbra_);
    mark_all(entries.umbra, umbra_);
  }

  bool touches(const ReceiverGrid::Reads& r) const {
    const std::size_t at = index(r.column / kFiner, r.row / kFiner);
    return (r.penumbra && penumbra_[at]) || (r.umbra && umbra_[at]);
  }

 private:
  using Cells = std::vector<char>;
  static std::size_t index(int x, int y) { return static_cast<std::size_t>(y * kCells + x); }

  void mark_all(const std::vector<EntryVertex>& triangles, Cells& cells) const {
    for (std::size_t i = 0; i + 2 < triangles.size(); i += 3) mark(triangles.data() + i, cells);
  }

  /// A cell more on every side, for rounding.
  void mark(const EntryVertex* corners, Cells& cells) const {
    glm::vec2 low(std::numeric_limits<float>::infinity()), high(-low);
    for (int k = 0; k < 3; ++k) {
      const glm::vec2 uv = glm::vec2(corners[k].place) / corners[k].place.w;
      low = glm::min(low, uv);
      high = glm::max(high, uv);
    }
    const auto cell = [](float value) {
      return static_cast<int>(std::clamp(value, -2.0f, static_cast<float>(kCells + 1)));
    };
    const glm::vec2 from = (low - low_) * per_unit_, to = (high - low_) * per_unit_;
    const int left = std::max(0, cell(from.x) - 1), right = std::min(kCells - 1, cell(to.x) + 1);
    if (left > right) return;
    for (int y = std::max(0, cell(from.y) - 1); y <= std::min(kCells - 1, cell(to.y) + 1); ++y)
      std::fill_n(cells.begin() + static_cast<std::ptrdiff_t>(index(left, y)), right - left + 1, char{1});
  }

  glm::vec2 low_, per_unit_;
  Cells penumbra_ = Cells(kCells * kCells, 0), umbra_ = Cells(kCells * kCells, 0);
};

bool tile_matters(const ImageReceivers& image, std::span<const ReceiverGrid::Reads> reads,
                  const Occupancy& occupancy, int tile_x, int tile_y) {
  for (int y = tile_y * kTile; y < std::min(image.height, (tile_y + 1) * kTile); ++y)
    for (int x = tile_x * kTile; x < std::min(image.width, (tile_x + 1) * kTile); ++x)
      if (occupancy.touches(reads[static_cast<std::size_t>(y * image.width + x)])) return true;
  return false;
}

void add_rectangle(const glm::vec2& low, const glm::vec2& high, std::vector<glm::vec2>& out) {
  const glm::vec2 corners[4] = {low, {high.x, low.y}, high, {low.x, high.y}};
  for (int k : {0, 1, 2, 0, 2, 3}) out.push_back(corners[k]);
}

}  // namespace

std::vector<glm::vec2> tiles_with_entries(const ImageReceivers& image, const ReceiverGrid& receivers,
                                          const EntryGeometry& entries, const Target& target) {
  const Occupancy occupancy(entries, target);
  const int columns = (image.width + kTile - 1) / kTile, rows = (image.height + kTile - 1) / kTile;
  std::vector<char> matters(static_cast<std::size_t>(columns * rows));
  tbb::parallel_for(0, rows, [&](int y) {
    for (int x = 0; x < columns; ++x)
      matters[static_cast<std::size_t>(y * columns + x)] =
          tile_matters(image, receivers.reads(), occupancy, x, y);
  });
  std::vector<glm::vec2> out;
  const auto clip = [&](int x, int y) {
    const glm::vec2 pixel(std::min(x * kTile, image.width), std::min(y * kTile, image.height));
    return 2.0f * pixel / glm::vec2(image.width, image.height) - 1.0f;
  };
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x) {  // neighbors in a row are one rectangle
      const int first = x;
      while (x < columns && matters[static_cast<std::size_t>(y * columns + x)]) ++x;
      if (x > first) add_rectangle(clip(first, y), clip(x, y + 1), out);
    }
  return out;
}

std::vector<glm::vec2> whole_image() {
  std::vector<glm::vec2> out;
  add_rectangle(glm::vec2(-1.0f), glm::vec2(1.0f), out);
  return out;
}

}  // namespace penumbra::detail
