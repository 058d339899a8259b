#include "apps/common/scene_volumes.h"

#include <glm/geometric.hpp>

namespace penumbra::apps {
namespace {

constexpr double kFarAway = 10.0;  // times the sphere around all objects
constexpr double kMargin = 0.02;   // of the radius of the casters, around all objects

}  // namespace

ExtrudeOptions extrude_options_for(const Scene& scene, const CircularLight& light) {
  Bounds bounds = scene.bounds();
  const bool near = !light.is_distant() &&
                    glm::length(light.center - bounds.center()) + light.radius <= kFarAway * bounds.radius();
  if (near) {
    bounds.add(light.center - Vec3(light.radius));
    bounds.add(light.center + Vec3(light.radius));
  }
  ExtrudeOptions options;
  options.bound_center = bounds.center();
  options.bound_radius = 1.01 * bounds.radius();
  return options;
}

Bounds solid_bound_for(const Scene& scene) {
  Bounds bounds = scene.bounds();
  const bool alone = scene.objects.size() == 1;
  const Vec3 by(alone ? 2.0 * bounds.radius() : kMargin * scene.caster_bounds().radius());
  bounds.low -= by;
  bounds.high += by;
  return bounds;
}

}  // namespace penumbra::apps
