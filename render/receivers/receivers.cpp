#include "penumbra/render/receivers/receivers.h"

#include <atomic>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>

#include "penumbra/mesh/error.h"

namespace penumbra {
namespace {

// A normal's squared length may differ from 1 by this: those read from files are float.
constexpr double kUnit = 1e-4;

bool is_finite(const Vec3& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

void require_as_many(std::size_t count, std::size_t points, const char* what) {
  if (count != 0 && count != points)
    throw UsageError("there are " + std::to_string(points) + " receivers and " + std::to_string(count) + " " +
                     what + "; give one for each, or none");
}

}  // namespace

Bounds bounds_of_present(const Receivers& receivers) {
  Bounds bounds;
  for (std::size_t i = 0; i < receivers.size(); ++i)
    if (receivers.is_present(i)) bounds.add(receivers.points[i]);
  return bounds;
}

std::uint64_t new_revision() {
  static std::atomic<std::uint64_t> last{0};
  return ++last;
}

void require_valid(const Receivers& receivers) {
  const std::size_t count = receivers.points.size();
  require_as_many(receivers.normals.size(), count, "normals");
  require_as_many(receivers.objects.size(), count, "objects");
  require_as_many(receivers.faces.size(), count, "faces");
  if (receivers.width < 0 || receivers.height < 0)
    throw UsageError("a picture's size is below 0; give 0 where receivers are no pixels");
  if (receivers.are_pixels() &&
      static_cast<std::size_t>(receivers.width) * static_cast<std::size_t>(receivers.height) != count)
    throw UsageError("a picture of " + std::to_string(receivers.width) + "x" +
                     std::to_string(receivers.height) + " pixels has not " + std::to_string(count) +
                     " receivers");
  for (std::size_t i = 0; i < count; ++i)
    if (!is_finite(receivers.points[i]))
      throw UsageError("the point of receiver " + std::to_string(i) + " is not finite");
  for (std::size_t i = 0; i < receivers.normals.size(); ++i) {
    const Vec3& n = receivers.normals[i];
    if (!is_finite(n)) throw UsageError("the normal of receiver " + std::to_string(i) + " is not finite");
    if (receivers.is_present(i) && !(std::abs(glm::dot(n, n) - 1.0) <= kUnit))
      throw UsageError("the normal of receiver " + std::to_string(i) + " has not length 1");
  }
}

}  // namespace penumbra
