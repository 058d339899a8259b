#include "render/scene/ray_frame.h"

#include <algorithm>
#include <cmath>

namespace penumbra {

RayFrame ray_frame(const Scene& scene, const LightShape& light) {
  const DiskLight disk = disk_around(light);
  RayFrame frame;
  frame.origin = disk.center;
  Bounds bounds = scene.bounds();
  bounds.add(disk.center);
  double reach = disk.radius;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 p{corner & 1 ? bounds.high.x : bounds.low.x, corner & 2 ? bounds.high.y : bounds.low.y,
                 corner & 4 ? bounds.high.z : bounds.low.z};
    const Vec3 d = p - frame.origin;
    for (int k = 0; k < 3; ++k) reach = std::max(reach, std::abs(d[k]));
  }
  if (reach > 0.0) frame.scale = std::exp2(-std::ceil(std::log2(reach)));
  return frame;
}

RayFrame ray_frame(const Scene& scene) {
  if (!scene.lights.empty()) return ray_frame(scene, scene.lights.front().shape);
  const Bounds bounds = scene.bounds();
  return ray_frame(scene, DiskLight{.center = bounds.empty() ? Vec3(0.0) : bounds.center()});
}

}  // namespace penumbra
