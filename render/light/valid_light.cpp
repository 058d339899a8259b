#include "render/light/valid_light.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "mesh/vectors.h"
#include "penumbra/mesh/error.h"

namespace penumbra {
namespace {

// Directions closer to parallel than this leave the other one of a frame to rounding.
constexpr double kParallel = 1e-9;

bool is_finite(const Vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

void require(bool fine, const char* trouble) {
  if (!fine) throw UsageError(std::string("the light's ") + trouble);
}

void require_valid_disk(const DiskLight& light) {
  require(is_finite(light.center), "center is not finite");
  require(is_finite(light.normal), "normal is not finite");
  require(light.normal != Vec3(0.0), "normal has length 0; give the direction in which it shines");
  require(std::isfinite(light.radius) && light.radius >= 0.0, "radius is not a number of 0 or more");
}

}  // namespace

void require_valid(const LightShape& shape) {
  if (const auto* rectangle = std::get_if<RectangleLight>(&shape)) {
    for (const double half : {rectangle->half_extents.x, rectangle->half_extents.y})
      require(std::isfinite(half) && half > 0.0, "half extents are not numbers above 0");
    require_valid_disk(disk_around(shape));
    require(is_finite(rectangle->tangent), "tangent is not finite");
    require(rectangle->tangent != Vec3(0.0) &&
                glm::length(glm::cross(detail::unit(rectangle->tangent), detail::unit(rectangle->normal))) >=
                    kParallel,
            "tangent is 0 or parallel to its normal; give the direction of one side");
  } else if (const auto* distant = std::get_if<DistantLight>(&shape)) {
    require(is_finite(distant->direction), "direction is not finite");
    require(distant->direction != Vec3(0.0), "direction has length 0; give the direction in which it shines");
    require(distant->angle_degrees >= 0.0 && distant->angle_degrees < 180.0,
            "angle is not a number of degrees from 0 to below 180");
  } else {
    require_valid_disk(std::get<DiskLight>(shape));
  }
}

}  // namespace penumbra
