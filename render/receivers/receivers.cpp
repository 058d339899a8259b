#include "penumbra/render/receivers/receivers.h"

#include <cmath>
#include <string>

#include "penumbra/mesh/error.h"

namespace penumbra {
namespace {

bool is_finite(const Vec3& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

void require_as_many(std::size_t count, std::size_t points, const char* what) {
  if (count != 0 && count != points)
    throw UsageError("there are " + std::to_string(points) + " receivers and " + std::to_string(count) + " " +
                     what + "; give one for each, or none");
}

}  // namespace

void require_valid(const Receivers& receivers) {
  const std::size_t count = receivers.points.size();
  require_as_many(receivers.normals.size(), count, "normals");
  require_as_many(receivers.objects.size(), count, "objects");
  require_as_many(receivers.faces.size(), count, "faces");
  if (receivers.are_pixels() &&
      static_cast<std::size_t>(receivers.width) * static_cast<std::size_t>(receivers.height) != count)
    throw UsageError("a picture of " + std::to_string(receivers.width) + "x" +
                     std::to_string(receivers.height) + " pixels has not " + std::to_string(count) +
                     " receivers");
  for (std::size_t i = 0; i < count; ++i)
    if (!is_finite(receivers.points[i]))
      throw UsageError("the point of receiver " + std::to_string(i) + " is not finite");
  for (std::size_t i = 0; i < receivers.normals.size(); ++i)
    if (!is_finite(receivers.normals[i]))
      throw UsageError("the normal of receiver " + std::to_string(i) + " is not finite");
}

}  // namespace penumbra
