#include "apps/viewer/pictures/disk_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

namespace penumbra::viewer {
namespace {

constexpr double kExtent = 1.25;  // of the picture's half side, in radii

struct Point2 {
  double x, y;
};
using Polygon = std::vector<Point2>;

/// In the light's frame, as everything here: u, v and the height towards the light.
///
/// A point at d = (u, v, h) from the receiver is seen at q = a + k (u, v)/h in radii, where a is the
/// receiver's place beside the axis and k its distance from the light's plane, both in radii: 0 and
/// 1/tan(angle/2) for a distant light.
class DiskRaster {
 public:
  DiskRaster(const AreaLight& light, const Vec3& x, int size)
      : light_(light),
        x_(x),
        place_(light.to_light(x) / light.half.x),
        size_(size),
        covered_(static_cast<std::size_t>(size) * static_cast<std::size_t>(size)) {}

  void add(const std::array<Vec3, 3>& corners) {
    std::vector<Vec3> part;
    for (const Vec3& p : corners) {
      const Vec3 d = light_.direction_to_light(p - x_);
      part.push_back({d.x, d.y, -d.z});
    }
    // The pyramid over the picture with its tip at the receiver, then what is not beyond the light.
    for (const double side : {1.0, -1.0})
      for (const int k : {0, 1})
        part = clipped(part, [&](const Vec3& d) {
          return (2.0 * kExtent - side * place_[k]) * d.z - side * place_.z * d[k];
        });
    if (!light_.distant) part = clipped(part, [&](const Vec3& d) { return place_.z * light_.half.x - d.z; });
    Polygon polygon;
    for (const Vec3& d : part)
      if (d.z > 0.0) polygon.push_back({place_.x + place_.z * d.x / d.z, place_.y + place_.z * d.y / d.z});
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
  /// From the receiver to a point of the light's plane.
  Vec3 way_to(const Point2& q) const {
    return light_.from_receiver(x_) + light_.half.x * (q.x * light_.axes.u + q.y * light_.axes.v);
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

  const AreaLight& light_;
  Vec3 x_, place_;
  int size_;
  std::vector<unsigned char> covered_;
};

using Color = std::array<unsigned char, 3>;

Color color_at(const DiskRaster& raster, const Vec3& n, int column, int row) {
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
  if (glm::dot(raster.way_to(q), n) <= 0.0) return {92, 62, 40};
  return covered ? Color{28, 34, 70} : Color{255, 246, 214};
}

}  // namespace

Pixels disk_seen_from(const Scene& scene, const AreaLight& light, const Viewpoint& from, int size) {
  if (!(light.half.x > 0.0) || light.is_behind(from.position)) return {};
  DiskRaster raster(light, from.position, size);
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const TriangleMesh& mesh = scene.objects[i].mesh;
    if (!scene.objects[i].casts) continue;
    for (std::size_t f = 0; f < mesh.triangles().size(); ++f) {
      if (static_cast<std::int32_t>(i) == from.object && f == from.face) continue;
      const IndexedTriangle& t = mesh.triangles()[f];
      raster.add({mesh.positions()[t[0]], mesh.positions()[t[1]], mesh.positions()[t[2]]});
    }
  }
  Pixels pixels{size, size, {}};
  for (int row = 0; row < size; ++row)
    for (int column = 0; column < size; ++column)
      for (const unsigned char part : color_at(raster, from.normal, column, row)) pixels.rgb.push_back(part);
  return pixels;
}

}  // namespace penumbra::viewer
