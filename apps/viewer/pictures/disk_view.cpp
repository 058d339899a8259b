#include "apps/viewer/pictures/disk_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

namespace penumbra::viewer {
namespace {

constexpr double kExtent = 1.25;   // of the picture's half side, in radii
constexpr double kNearest = 1e-5;  // of the height: parts of casters closer to x or to the light are cut off

struct Point2 {
  double x, y;
};
using Polygon = std::vector<Point2>;

class DiskRaster {
 public:
  DiskRaster(const DiskLight& light, const Vec3& x, int size)
      : light_(light),
        frame_(light_frame(light)),
        x_(x),
        size_(size),
        covered_(static_cast<std::size_t>(size) * static_cast<std::size_t>(size)) {}

  double height(const Vec3& p) const { return glm::dot(p - light_.center, frame_.w); }

  void add(const std::array<Vec3, 3>& corners) {
    const double top = height(x_);
    std::vector<Vec3> part(corners.begin(), corners.end());
    part = clipped(part, [&](const Vec3& p) { return height(p) - kNearest * top; });
    part = clipped(part, [&](const Vec3& p) { return (1.0 - kNearest) * top - height(p); });
    Polygon polygon;
    for (const Vec3& p : part) polygon.push_back(projected(p, top));
    if (polygon.size() > 2) fill(polygon);
  }
  bool covered(int column, int row) const {
    if (column < 0 || row < 0 || column >= size_ || row >= size_) return false;
    return covered_[index(column, row)] != 0;
  }
  /// The place of a pixel's center in radii.
  Point2 place(int column, int row) const {
    return {kExtent * (2.0 * (column + 0.5) / size_ - 1.0), kExtent * (1.0 - 2.0 * (row + 0.5) / size_)};
  }
  Vec3 world(const Point2& q) const {
    return light_.center + light_.radius * (q.x * frame_.u + q.y * frame_.v);
  }

 private:
  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(size_) + static_cast<std::size_t>(column);
  }
  template <class Side>
  static std::vector<Vec3> clipped(const std::vector<Vec3>& polygon, const Side& side) {
    std::vector<Vec3> out;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
      const double from = side(a), to = side(b);
      if (from >= 0.0) out.push_back(a);
      if ((from < 0.0) != (to < 0.0)) out.push_back(a + (b - a) * (from / (from - to)));
    }
    return out;
  }
  // Along the ray from x through p to the light's plane.
  Point2 projected(const Vec3& p, double top) const {
    const Vec3 q = x_ + (p - x_) * (top / (top - height(p))) - light_.center;
    return {glm::dot(q, frame_.u) / light_.radius, glm::dot(q, frame_.v) / light_.radius};
  }
  int clamped_pixel(double at) const {
    return static_cast<int>(std::clamp((at / kExtent + 1.0) * 0.5 * size_, -1.0, size_ + 1.0));
  }
  void fill(const Polygon& polygon) {
    double low_x = INFINITY, high_x = -INFINITY, low_y = INFINITY, high_y = -INFINITY, area = 0.0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Point2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
      low_x = std::min(low_x, a.x);
      high_x = std::max(high_x, a.x);
      low_y = std::min(low_y, a.y);
      high_y = std::max(high_y, a.y);
      area += a.x * b.y - b.x * a.y;
    }
    const double turn = area < 0.0 ? -1.0 : 1.0;
    const auto inside = [&](const Point2& q) {
      for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Point2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        if (turn * ((b.x - a.x) * (q.y - a.y) - (b.y - a.y) * (q.x - a.x)) < 0.0) return false;
      }
      return true;
    };
    for (int row = std::max(0, clamped_pixel(-high_y)); row <= std::min(size_ - 1, clamped_pixel(-low_y));
         ++row)
      for (int column = std::max(0, clamped_pixel(low_x));
           column <= std::min(size_ - 1, clamped_pixel(high_x)); ++column)
        if (inside(place(column, row))) covered_[index(column, row)] = 1;
  }

  const DiskLight& light_;
  LightFrame frame_;
  Vec3 x_;
  int size_;
  std::vector<unsigned char> covered_;
};

using Color = std::array<unsigned char, 3>;

Color color_at(const DiskRaster& raster, const Vec3& x, const Vec3& n, int column, int row) {
  const Point2 q = raster.place(column, row);
  const double distance = std::hypot(q.x, q.y);
  const bool covered = raster.covered(column, row);
  bool outline = false;
  for (const auto& [i, j] : {std::pair(1, 0), {-1, 0}, {0, 1}, {0, -1}})
    outline |= covered && !raster.covered(column + i, row + j);
  if (outline) return distance <= 1.0 ? Color{255, 120, 30} : Color{110, 70, 45};
  if (distance > 1.0)
    return std::abs(distance - 1.0) < 0.02 ? Color{255, 214, 64}
           : covered                       ? Color{38, 38, 44}
                                           : Color{58, 58, 62};
  if (glm::dot(raster.world(q) - x, n) <= 0.0) return {92, 62, 40};
  return covered ? Color{28, 34, 70} : Color{255, 246, 214};
}

}  // namespace

Pixels disk_seen_from(const Scene& scene, const DiskLight& light, const Vec3& x, const Vec3& n, int size) {
  if (!(light.radius > 0.0) || is_behind(light, x)) return {};
  DiskRaster raster(light, x, size);
  for (const SceneObject& object : scene.objects) {
    if (!object.casts) continue;
    const auto positions = object.mesh.positions();
    for (const IndexedTriangle& t : object.mesh.triangles())
      raster.add({positions[t[0]], positions[t[1]], positions[t[2]]});
  }
  Pixels pixels{size, size, {}};
  for (int row = 0; row < size; ++row)
    for (int column = 0; column < size; ++column)
      for (const unsigned char part : color_at(raster, x, n, column, row)) pixels.rgb.push_back(part);
  return pixels;
}

}  // namespace penumbra::viewer
