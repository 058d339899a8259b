#include "render/receivers/unlit.h"

#include "render/light/light_integrals.h"

namespace penumbra {
namespace {

std::string nothing_by(const Light& light) {
  return (light.name.empty() ? "the light" : "light " + light.name) + " lights nothing that is seen: ";
}

}  // namespace

std::string why_dark(const Light& light) {
  return nothing_by(light) + "all of it faces away from the light or lies behind its plane";
}

std::optional<std::string> why_nothing_is_lit(const Light& light, const Receivers& receivers,
                                              std::span<const float> visibility) {
  const AreaLight area = area_light(light.shape);
  bool any = false, in_front = false, facing = false;
  for (std::size_t i = 0; i < receivers.size(); ++i) {
    if (!receivers.is_present(i)) continue;
    if (visibility[i] > 0.0f) return std::nullopt;
    any = true;
    if (facing || area.is_behind(receivers.points[i])) continue;
    in_front = true;
    facing = !receivers.has_normals() ||
             fraction_above_horizon(area, receivers.points[i], receivers.normals[i]) > 0.0;
  }
  if (!any) return std::nullopt;
  const std::string nothing = nothing_by(light);
  if (!in_front)
    return nothing + "all of it lies behind the light's plane; turn the light's normal or move it";
  if (!facing) return why_dark(light);
  return nothing + "casters hide the light from all of it; it may lie inside of one or behind one";
}

}  // namespace penumbra
