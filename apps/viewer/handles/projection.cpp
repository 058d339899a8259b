#include "apps/viewer/handles/projection.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace penumbra::viewer {

double distance(const PicturePoint& a, const PicturePoint& b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

double distance_to_segment(const PicturePoint& p, const PicturePoint& a, const PicturePoint& b) {
  const double x = b.x - a.x, y = b.y - a.y, square = x * x + y * y;
  const double along = square > 0.0 ? ((p.x - a.x) * x + (p.y - a.y) * y) / square : 0.0;
  const double t = std::clamp(along, 0.0, 1.0);
  return distance(p, {a.x + t * x, a.y + t * y});
}

Projection::Projection(const Camera& camera, int width, int height)
    : rays_(camera, width, height),
      width_(width),
      height_(height),
      corner_(rays_.direction(0.0, 0.0)),
      across_(rays_.direction(1.0, 0.0) - corner_),
      down_(rays_.direction(0.0, 1.0) - corner_),
      forward_(glm::normalize(rays_.direction(0.5 * width, 0.5 * height))) {}

double Projection::depth(const Vec3& p) const {
  return glm::dot(p - eye(), forward_);
}

std::optional<PicturePoint> Projection::project(const Vec3& p) const {
  const double along = depth(p);
  if (!(along > 1e-9 * glm::length(p - eye())) || along <= 0.0) return std::nullopt;
  const Vec3 q = (p - eye()) / along - corner_;
  return PicturePoint{glm::dot(q, across_) / glm::dot(across_, across_),
                      glm::dot(q, down_) / glm::dot(down_, down_)};
}

double Projection::units_per_pixel(const Vec3& p) const {
  return std::abs(depth(p)) * glm::length(down_);
}

Vec3 Projection::right() const {
  return glm::normalize(across_);
}

Vec3 Projection::up() const {
  return glm::normalize(-down_);
}

std::array<float, 16> Projection::clip_matrix(double near, double far) const {
  // Rows of the matrix: right and up over half the picture's extent at depth 1, depth, and the divisor.
  const double half_width = 0.5 * width_ * glm::length(across_),
               half_height = 0.5 * height_ * glm::length(down_);
  const double a = (far + near) / (far - near), b = -2.0 * far * near / (far - near);
  const std::array<Vec3, 4> rows{right() / half_width, up() / half_height, forward_ * a, forward_};
  std::array<float, 16> matrix{};
  for (std::size_t row = 0; row < 4; ++row) {
    for (std::size_t column = 0; column < 3; ++column)
      matrix[4 * column + row] = static_cast<float>(rows[row][static_cast<int>(column)]);
    matrix[12 + row] = static_cast<float>(-glm::dot(rows[row], eye()) + (row == 2 ? b : 0.0));
  }
  return matrix;
}

}  // namespace penumbra::viewer
