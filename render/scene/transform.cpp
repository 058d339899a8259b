#include "render/scene/transform.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "mesh/vectors.h"

namespace penumbra::detail {
namespace {

// Below this a matrix flattens space up to rounding: a unit cube becomes one of volume 1e-12.
constexpr double kSingular = 1e-12;

Transform read_matrix(const SceneNode& node) {
  const std::vector<double> m = node.numbers(16);
  if (m[3] != 0.0 || m[7] != 0.0 || m[11] != 0.0 || m[15] != 1.0)
    node.fail("the last row must be 0 0 0 1 (numbers 4, 8, 12 and 16; the matrix is column-major)");
  Transform transform;
  for (std::size_t i = 0; i < 3; ++i) transform.columns[i] = {m[4 * i], m[4 * i + 1], m[4 * i + 2]};
  transform.translation = {m[12], m[13], m[14]};
  if (std::abs(transform.relative_determinant()) <= kSingular)
    node.fail("is singular: it flattens the mesh; use a matrix whose determinant is not 0");
  return transform;
}

// Columns of the rotation matrix of the quaternion x, y, z, w.
std::array<Vec3, 3> read_rotation(const SceneNode& node) {
  std::vector<double> q = node.numbers(4);
  double largest = 0.0;
  for (double value : q) largest = std::max(largest, std::abs(value));
  if (largest == 0.0) node.fail("is the zero quaternion; no rotation is [0, 0, 0, 1]");
  double length = 0.0;
  for (double value : q) length += (value / largest) * (value / largest);
  length = largest * std::sqrt(length);
  if (std::abs(length - 1.0) > 1e-6) node.warn("has length " + to_text(length) + ", normalised to 1");
  for (double& value : q) value /= length;
  const double x = q[0], y = q[1], z = q[2], w = q[3];
  return {Vec3(1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)),
          Vec3(2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)),
          Vec3(2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y))};
}

}  // namespace

double Transform::relative_determinant() const {
  return glm::dot(glm::cross(unit(columns[0]), unit(columns[1])), unit(columns[2]));
}

Transform read_transform(const SceneNode& object) {
  if (const auto matrix = object.find("matrix")) {
    for (const char* other : {"translation", "rotation", "scale"})
      if (object.find(other)) object.fail(std::string("has both \"matrix\" and \"") + other + "\"; keep one");
    return read_matrix(*matrix);
  }
  Transform transform;
  if (const auto rotation = object.find("rotation")) transform.columns = read_rotation(*rotation);
  if (const auto scale = object.find("scale")) {
    const Vec3 factors = scale->number_or_vec3();
    if (factors.x == 0.0 || factors.y == 0.0 || factors.z == 0.0)
      scale->fail("is 0: it flattens the mesh; use numbers other than 0");
    transform.columns[0] *= factors.x;
    transform.columns[1] *= factors.y;
    transform.columns[2] *= factors.z;
  }
  if (const auto translation = object.find("translation")) transform.translation = translation->vec3();
  return transform;
}

}  // namespace penumbra::detail
