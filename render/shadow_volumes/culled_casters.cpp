#include "render/shadow_volumes/culled_casters.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>

namespace penumbra::detail {
namespace {

/// Accuracy. Windows are larger by that, relative to what they hold.
constexpr double kRounding = 1e-9;

/// A box as the center sees it.
struct Window {
  std::array<double, 3> low, high;  ///< (u, v) over the depth, or beside a distant light; depth
};

/// None where the box reaches behind the light's plane.
std::optional<Window> window_of(const Bounds& box, const AreaLight& light) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Window out{{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}};
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 p((corner & 1 ? box.high : box.low).x, (corner & 2 ? box.high : box.low).y,
                 (corner & 4 ? box.high : box.low).z);
    const Vec3 q = light.distant ? p : p - light.center;
    const double depth = glm::dot(q, light.axes.w), scale = light.distant ? 1.0 : depth;
    if (!light.distant && !(depth > 0.0)) return std::nullopt;
    const double at[3] = {glm::dot(q, light.axes.u) / scale, glm::dot(q, light.axes.v) / scale, depth};
    for (std::size_t k = 0; k < 3; ++k) {
      const double margin = kRounding * std::abs(at[k]);
      out.low[k] = std::min(out.low[k], at[k] - margin);
      out.high[k] = std::max(out.high[k], at[k] + margin);
    }
  }
  return out;
}

bool may_hide(const Window& caster, const Window& group) {
  for (std::size_t k = 0; k < 2; ++k)
    if (caster.low[k] > group.high[k] || group.low[k] > caster.high[k]) return false;
  return caster.low[2] <= group.high[2];
}

}  // namespace

std::vector<char> casters_without_receivers(const Scene& scene, const AreaLight& light,
                                            const BoxedGroups& groups) {
  std::vector<Window> windows;
  bool some_unknown = false;
  for (const ReceiverBox& box : groups.boxes) {
    if (box.count == 0) continue;
    if (const auto window = window_of(box.points, light))
      windows.push_back(*window);
    else
      some_unknown = true;
  }
  std::vector<char> out(scene.objects.size(), 0);
  for (std::size_t i = 0; i < out.size(); ++i) {
    const SceneObject& object = scene.objects[i];
    if (!object.casts || object.mesh.empty() || some_unknown) continue;
    const auto caster = window_of(object.mesh.bounds(), light);
    out[i] = caster && std::ranges::none_of(windows, [&](const Window& w) { return may_hide(*caster, w); });
  }
  return out;
}

}  // namespace penumbra::detail
