#include "apps/common/scene_volumes.h"

namespace penumbra::apps {

ExtrudeOptions extrude_options_for(const Scene& scene, const DiskLight& light) {
  Bounds bounds = scene.bounds();
  bounds.add(light.center - Vec3(light.radius));
  bounds.add(light.center + Vec3(light.radius));
  ExtrudeOptions options;
  options.bound_center = bounds.center();
  options.bound_radius = 1.01 * bounds.radius();
  return options;
}

}  // namespace penumbra::apps
