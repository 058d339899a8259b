#include "render/bake/texture_coverage.h"

#include <algorithm>
#include <cmath>

#include "render/bake/clip.h"

namespace penumbra::detail {
namespace {

/// Sums of areas of pieces differ from 1 by rounding.
constexpr double kFull = 1.0 - 0x1p-30;

struct Span {
  int first, last;  ///< one beyond
};
/// The cells of a row that numbers from `low` to `high` may lie in.
Span cells_between(double low, double high, double begin, int side, int count) {
  const double from = std::floor((low - begin) * side), to = std::ceil((high - begin) * side);
  return {static_cast<int>(std::clamp(from, 0.0, double(count))),
          static_cast<int>(std::clamp(to, 0.0, double(count)))};
}

ConvexPolygon between(const ConvexPolygon& polygon, int axis, double low, double high) {
  return polygon.cut([&](const glm::dvec2& p) { return p[axis] - low; }).cut([&](const glm::dvec2& p) {
    return high - p[axis];
  });
}

}  // namespace

TextureCoverage::TextureCoverage(const TextureAtlas& atlas, int tile)
    : atlas_(atlas), tile_(tile), columns_((atlas.width + tile - 1) / tile) {
  const int rows = (atlas.height + tile - 1) / tile;
  faces_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows));
  for (std::uint32_t object = 0; object < atlas.uv.size(); ++object)
    for (std::uint32_t face = 0; face < atlas.uv[object].size(); ++face) {
      const FaceUv& uv = atlas.uv[object][face];
      if (doubled_area(uv) == 0.0) continue;
      const UvBox box(uv);
      const auto number = [&](double x, int most) {
        return std::clamp(static_cast<int>(std::floor(x / tile)), 0, most - 1);
      };
      for (int y = number(box.low.y, rows); y <= number(box.high.y, rows); ++y)
        for (int x = number(box.low.x, columns_); x <= number(box.high.x, columns_); ++x)
          faces_[static_cast<std::size_t>(y * columns_ + x)].push_back({object, face});
    }
  coverage_.resize(static_cast<std::size_t>(atlas.width) * static_cast<std::size_t>(atlas.height));
  for (std::size_t t = 0; t < tiles(); ++t) {
    const TexelRange range = range_of(t);
    std::vector<double> areas(range.size(), 0.0);
    for_each_piece(
        t, 1, [](int, int) { return true; },
        [&](const TexelPiece& piece) {
          areas[static_cast<std::size_t>((piece.y - range.top) * range.width + piece.x - range.left)] +=
              piece.area;
        });
    for (int y = 0; y < range.height; ++y)
      for (int x = 0; x < range.width; ++x) {
        const double area = areas[static_cast<std::size_t>(y * range.width + x)];
        coverage_[static_cast<std::size_t>(range.top + y) * static_cast<std::size_t>(atlas.width) +
                  static_cast<std::size_t>(range.left + x)] =
            area >= kFull ? 1.0f : std::min(static_cast<float>(area), std::nextafter(1.0f, 0.0f));
      }
  }
}

TexelRange TextureCoverage::range_of(std::size_t tile) const {
  const int x = static_cast<int>(tile) % columns_ * tile_, y = static_cast<int>(tile) / columns_ * tile_;
  return {x, y, std::min(tile_, atlas_.width - x), std::min(tile_, atlas_.height - y)};
}

float TextureCoverage::at(int x, int y) const {
  if (x < 0 || y < 0 || x >= atlas_.width || y >= atlas_.height) return 0.0f;
  return coverage_[static_cast<std::size_t>(y) * static_cast<std::size_t>(atlas_.width) +
                   static_cast<std::size_t>(x)];
}

bool TextureCoverage::is_at_border(int x, int y) const {
  for (int j = std::max(0, y - 1); j <= std::min(atlas_.height - 1, y + 1); ++j)
    for (int i = std::max(0, x - 1); i <= std::min(atlas_.width - 1, x + 1); ++i)
      if (!is_full(i, j)) return true;
  return false;
}

void TextureCoverage::for_each_piece(std::size_t tile, int side,
                                     const std::function<bool(int x, int y)>& wanted,
                                     const std::function<void(const TexelPiece&)>& visit) const {
  const TexelRange range = range_of(tile);
  const double step = 1.0 / side;
  for (const FaceNumber& number : faces_[tile]) {
    const FaceUv& uv = atlas_.uv[number.object][number.face];
    const UvBox box(uv);
    const Span rows = cells_between(box.low.y, box.high.y, range.top, side, range.height * side);
    const Span columns = cells_between(box.low.x, box.high.x, range.left, side, range.width * side);
    for (int j = rows.first; j < rows.last; ++j) {
      const ConvexPolygon row =
          between(ConvexPolygon(uv), 1, range.top + j * step, range.top + (j + 1) * step);
      if (row.empty()) continue;
      for (int i = columns.first; i < columns.last; ++i) {
        const int x = range.left + i / side, y = range.top + j / side;
        if (!wanted(x, y)) continue;
        const auto cell = between(row, 0, range.left + i * step, range.left + (i + 1) * step).measure();
        if (cell.area > 0.0) visit({x, y, number.object, number.face, cell.area, cell.centroid});
      }
    }
  }
}

Vec3 barycentric_in(const FaceUv& uv, const glm::dvec2& at) {
  const double whole = doubled_area(uv);
  const double b = std::clamp(cross(at - uv[0], uv[2] - uv[0]) / whole, 0.0, 1.0);
  const double c = std::clamp(cross(uv[1] - uv[0], at - uv[0]) / whole, 0.0, 1.0 - b);
  return {1.0 - b - c, b, c};
}

}  // namespace penumbra::detail
