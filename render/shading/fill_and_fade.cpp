#include "render/shading/fill_and_fade.h"

#include <algorithm>

namespace penumbra::detail {

double opacity_at(const SceneObject::Fade& fade, const Vec3& middle, const Vec3& point) {
  if (!(fade.to > 0.0)) return 1.0;
  const double t = std::clamp((fade.to - glm::distance(point, middle)) / (fade.to - fade.from), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

double catcher_opacity(const Vec3& with, const Vec3& without) {
  const double full = luminance(without);
  return full > 0.0 ? std::clamp(1.0 - luminance(with) / full, 0.0, 1.0) : 0.0;
}

}  // namespace penumbra::detail
