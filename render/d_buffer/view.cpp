#include "render/d_buffer/view.h"

#include <algorithm>
#include <glm/matrix.hpp>

namespace penumbra::detail {
namespace {

/// Speed. Facets up to this part of the target's width are narrow: one ray finds their reach instead of
/// three. Too large, and boundaries end too early or too late in the middle of facets
/// (DBufferScenes.ErrorOnTheFloor).
constexpr double kNarrow = 1.0 / 32.0;

/// Stands for "all directions" in (x/z, y/z).
constexpr double kEverywhere = 1e9;

/// 1/z of the farthest corner of an object's bounds: no receiver is farther away.
double far_weight(const Scene& scene, const LightSpace& space) {
  double farthest = 0.0;
  for (const SceneObject& object : scene.objects) {
    const Bounds& b = object.mesh.bounds();
    if (b.empty()) continue;
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 p{corner & 1 ? b.high.x : b.low.x, corner & 2 ? b.high.y : b.low.y,
                   corner & 4 ? b.high.z : b.low.z};
      farthest = std::max(farthest, space.to_light(p).z);
    }
  }
  return farthest > 0.0 ? 1.0 / farthest : 1.0;
}

/// Where casters and their penumbrae are seen, in (x/z, y/z). A penumbra is at most radius · (1/z - far)
/// wider than its caster. Everywhere for a caster that crosses the light's plane.
UvBounds caster_window(const std::vector<DBufferCaster>& casters, const LightSpace& space, double far) {
  UvBounds window;
  for (const DBufferCaster& caster : casters) {
    if (caster.cannot_occlude) continue;
    std::size_t behind = 0;
    for (const Vec3& world : caster.mesh->positions()) {
      const Vec3 p = space.to_light(world);
      if (p.z < kNearDepth) {
        ++behind;
        continue;
      }
      const glm::dvec2 uv = glm::dvec2(p.x, p.y) / p.z;
      const double reach = space.radius * std::max(0.0, 1.0 / p.z - far);
      window.add(uv - reach);
      window.add(uv + reach);
    }
    if (behind > 0 && behind < caster.mesh->positions().size())
      return {glm::dvec2(-kEverywhere), glm::dvec2(kEverywhere)};
  }
  return window;
}

}  // namespace

DBufferView choose_view(const Scene& scene, const std::vector<DBufferCaster>& casters,
                        const CasterFrame& frame, const DiskLight& light, int size) {
  const LightSpace space(light, frame.scale);
  const glm::mat3 axes(glm::vec3(space.axes.u), glm::vec3(space.axes.v), glm::vec3(space.axes.w));
  DBufferView view{space, glm::transpose(axes), glm::vec3(space.to_light(frame.origin))};
  const double far = far_weight(scene, space);
  const UvBounds window = caster_window(casters, space, far);
  view.targets = choose_targets(window.low, window.high, size);
  if (view.targets.empty()) return view;
  const auto& [left, right, bottom, top] = view.targets[0].window;
  const double width = std::max(right - left, top - bottom);
  view.footprint = {kNearDepth, far, width / size, view.is_hemicube(), width * kNarrow};
  return view;
}

}  // namespace penumbra::detail
