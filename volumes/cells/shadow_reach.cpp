#include "volumes/cells/shadow_reach.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "mesh/vectors.h"
#include "penumbra/mesh/error.h"

namespace penumbra::detail {

namespace {

constexpr double kDefaultBound = 10.0;  // times the sphere around caster and near light
constexpr double kBeyond = 1.0 + 1e-6;  // far ends clear the bound by this factor

}  // namespace

void require_valid(const ExtrudeOptions& options) {
  if (options.cone_segments < 3)
    throw UsageError("cone_segments is below 3: a polygon around the disk has at least 3 corners");
  const Vec3& c = options.bound_center;
  if (!std::isfinite(c.x) || !std::isfinite(c.y) || !std::isfinite(c.z) ||
      !std::isfinite(options.bound_radius) || options.bound_radius < 0.0) {
    throw UsageError("the bound is not a finite sphere: give a finite center and a radius of at least 0");
  }
}

double ShadowReach::distance() const {
  return (glm::length(bound_center - light.center) + bound_radius + light.radius) * kBeyond;
}

ShadowReach shadow_reach(const TriangleMesh& mesh, const CircularLight& light,
                         const ExtrudeOptions& options) {
  require_valid(options);
  ShadowReach reach{.light = light,
                    .frame = light_frame(light),
                    .bound_center = options.bound_center,
                    .bound_radius = options.bound_radius,
                    .far_height = 0.0};
  if (options.bound_radius == 0.0) {
    Bounds bounds = mesh.bounds();
    if (!light.is_distant()) {
      bounds.add(light.center - Vec3(light.radius));
      bounds.add(light.center + Vec3(light.radius));
    }
    reach.bound_center = bounds.center();
    reach.bound_radius = kDefaultBound * bounds.radius();
  }
  reach.far_height = reach.bound_radius * kBeyond;
  return reach;
}

}  // namespace penumbra::detail
