#include "render/d_buffer_tiles.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace penumbra::detail {
namespace {

constexpr int kTile = 16;    // pixels a side
constexpr int kCells = 128;  // a side of the grid over the window

/// Cells of the target's window that some entry's triangle may touch.
class Occupancy {
 public:
  Occupancy(const EntryGeometry& entries, const Target& target) : occupied_(kCells * kCells, 0) {
    low_ = glm::vec2(target.window[0], target.window[2]);
    per_unit_ = static_cast<float>(kCells) / (glm::vec2(target.window[1], target.window[3]) - low_);
    for (const auto* triangles : {&entries.penumbra, &entries.umbra})
      for (std::size_t i = 0; i + 2 < triangles->size(); i += 3) mark(triangles->data() + i);
  }

  bool at(const glm::vec2& uv) const {
    const glm::vec2 cell = (uv - low_) * per_unit_;
    if (!(cell.x >= 0.0f && cell.y >= 0.0f && cell.x < kCells && cell.y < kCells)) return false;
    return occupied_[index(static_cast<int>(cell.x), static_cast<int>(cell.y))] != 0;
  }

 private:
  static std::size_t index(int x, int y) { return static_cast<std::size_t>(y * kCells + x); }

  /// A cell more on every side, for rounding.
  void mark(const EntryVertex* corners) {
    glm::vec2 low(1e30f), high(-1e30f);
    for (int k = 0; k < 3; ++k) {
      low = glm::min(low, glm::vec2(corners[k].u, corners[k].v));
      high = glm::max(high, glm::vec2(corners[k].u, corners[k].v));
    }
    const auto cell = [](float value) {
      return static_cast<int>(std::clamp(value, -2.0f, static_cast<float>(kCells + 1)));
    };
    const glm::vec2 from = (low - low_) * per_unit_, to = (high - low_) * per_unit_;
    for (int y = std::max(0, cell(from.y) - 1); y <= std::min(kCells - 1, cell(to.y) + 1); ++y)
      for (int x = std::max(0, cell(from.x) - 1); x <= std::min(kCells - 1, cell(to.x) + 1); ++x)
        occupied_[index(x, y)] = 1;
  }

  std::vector<char> occupied_;
  glm::vec2 low_, per_unit_;
};

bool tile_matters(const ImageReceivers& image, const Occupancy& occupancy, int tile_x, int tile_y) {
  for (int y = tile_y * kTile; y < std::min(image.height, (tile_y + 1) * kTile); ++y)
    for (int x = tile_x * kTile; x < std::min(image.width, (tile_x + 1) * kTile); ++x) {
      const glm::vec4& p = image.positions[static_cast<std::size_t>(y * image.width + x)];
      if (p.w == 0.0f) continue;
      const glm::vec3 local = image.axes * glm::vec3(p) + image.offset;
      if (local.z > 0.0f && occupancy.at(glm::vec2(local) / local.z)) return true;
    }
  return false;
}

void add_rectangle(const glm::vec2& low, const glm::vec2& high, std::vector<glm::vec2>& out) {
  const glm::vec2 corners[4] = {low, {high.x, low.y}, high, {low.x, high.y}};
  for (int k : {0, 1, 2, 0, 2, 3}) out.push_back(corners[k]);
}

}  // namespace

std::vector<glm::vec2> tiles_with_entries(const ImageReceivers& image, const EntryGeometry& entries,
                                          const Target& target) {
  const Occupancy occupancy(entries, target);
  const int columns = (image.width + kTile - 1) / kTile, rows = (image.height + kTile - 1) / kTile;
  std::vector<char> matters(static_cast<std::size_t>(columns * rows));
  tbb::parallel_for(0, rows, [&](int y) {
    for (int x = 0; x < columns; ++x)
      matters[static_cast<std::size_t>(y * columns + x)] = tile_matters(image, occupancy, x, y);
  });
  std::vector<glm::vec2> out;
  const auto clip = [&](int x, int y) {
    const glm::vec2 pixel(std::min(x * kTile, image.width), std::min(y * kTile, image.height));
    return 2.0f * pixel / glm::vec2(image.width, image.height) - 1.0f;
  };
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x) {  // neighbours in a row are one rectangle
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
