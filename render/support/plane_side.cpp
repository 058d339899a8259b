#include "render/support/plane_side.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace penumbra::detail {
namespace {

constexpr double kUnit = 0x1p-53;
/// Roundings of every coordinate; see the header.
constexpr double kCoordinateRoundings = 6.0;
/// D is a sum of products of three differences. Each is rounded eight times at most: three differences, two
/// products, one difference of products, two sums. Nine make up for terms of higher order and for the
/// rounding of `size`.
constexpr double kProductRoundings = 9.0;

/// The cross product of absolute values with a sum in place of the difference: what its rounding is a part
/// of.
Vec3 cross_sizes(const Vec3& a, const Vec3& b) {
  const Vec3 s = glm::abs(a), t = glm::abs(b);
  return {s.y * t.z + s.z * t.y, s.z * t.x + s.x * t.z, s.x * t.y + s.y * t.x};
}

}  // namespace

int side_of_plane(const FaceCorners& face, const Vec3& p) {
  const Vec3 a = face.a - p, b = face.b - p, c = face.c - p, ab = face.b - face.a, ac = face.c - face.a;
  const Vec3 n = glm::cross(ab, ac);
  const double value = glm::dot(n, a);  // -D
  const double moved = glm::dot(glm::abs(glm::cross(b, c)), glm::abs(face.a)) +
                       glm::dot(glm::abs(glm::cross(c, a)), glm::abs(face.b)) +
                       glm::dot(glm::abs(glm::cross(a, b)), glm::abs(face.c)) +
                       glm::dot(glm::abs(n), glm::abs(p));
  const double size = glm::dot(cross_sizes(ab, ac), glm::abs(a));
  if (!(std::abs(value) > kUnit * (kCoordinateRoundings * moved + kProductRoundings * size))) return 0;
  return value < 0.0 ? 1 : -1;
}

}  // namespace penumbra::detail
