#include "render/scene/scene_limits.h"

#include "mesh/vectors.h"
#include "render/scene/ray_frame.h"
#include "render/scene/scene_node.h"

namespace penumbra::detail {
namespace {

/// How far a point is from the casters, in halves of their longest side.
class Reach {
 public:
  explicit Reach(const Scene& scene) : frame_(ray_frame(scene)) {}

  bool is_too_far(const Vec3& p) const { return !(largest_component(frame_.to_local(p)) <= kMostReach); }
  std::string complaint(const std::string& where, const std::string& what, const std::string& advice) const {
    return where + ": " + what + " is farther from what casts shadows than " + to_text(kMostReach) +
           " times its size (about " + to_text(1.0 / frame_.scale) + "); " + advice;
  }

 private:
  RayFrame frame_;
};

/// A box that holds it.
Bounds bounds_of_light(const LightShape& shape) {
  const DiskLight disk = disk_around(shape);
  Bounds bounds;
  bounds.add(disk.center - Vec3(disk.radius));
  bounds.add(disk.center + Vec3(disk.radius));
  return bounds;
}

}  // namespace

std::string out_of_range(const Scene& scene) {
  const Reach reach(scene);
  const auto is_too_far = [&](const Bounds& b) {
    return !b.empty() && (reach.is_too_far(b.low) || reach.is_too_far(b.high));
  };
  if (reach.is_too_far(scene.camera.eye))
    return reach.complaint("/camera/eye", "the camera", "move it nearer");
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    const LightShape& shape = scene.lights[i].shape;
    if (!std::holds_alternative<DistantLight>(shape) && is_too_far(bounds_of_light(shape)))
      return reach.complaint("/lights/" + std::to_string(i), "the light",
                             "make it a distant light, or smaller and nearer");
  }
  for (std::size_t i = 0; i < scene.objects.size(); ++i)
    if (is_too_far(scene.objects[i].mesh.bounds()))
      return reach.complaint("/objects/" + std::to_string(i), "the object", "make the scene smaller");
  return {};
}

}  // namespace penumbra::detail
