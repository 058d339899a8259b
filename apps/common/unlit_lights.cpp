#include "apps/common/unlit_lights.h"

#include "render/light/area_light.h"
#include "render/light/light_integrals.h"

namespace penumbra::apps {
namespace {

/// Why no surface is lit, by what is found first at any of them.
std::string reason(const AreaLight& light, const SurfaceBuffer& surface) {
  bool in_front = false, towards = false;
  for (std::size_t i = 0; i < surface.size() && !towards; ++i) {
    if (!surface.hit(i) || light.is_behind(surface.position[i])) continue;
    in_front = true;
    towards = fraction_above_horizon(light, surface.position[i], surface.normal[i]) > 0.0;
  }
  if (!in_front) return "they are all behind it; turn its normal";
  if (!towards) return "they all face away from it";
  return "what faces it is in the shadow of something; is the light inside a mesh or close behind one?";
}

}  // namespace

std::vector<std::string> unlit_lights(const Scene& scene, const RenderResult& result) {
  std::vector<std::string> lines;
  const SurfaceBuffer& surface = result.surface;
  for (std::size_t k = 0; k < scene.lights.size(); ++k) {
    std::size_t seen = 0, lit = 0;
    for (std::size_t i = 0; i < surface.size(); ++i) {
      seen += surface.hit(i);
      lit += surface.hit(i) && result.lights[k].visibility[i] > 0.0f;
    }
    if (seen == 0 || lit > 0) continue;
    const std::string& name = scene.lights[k].name;
    lines.push_back("the light" + (name.empty() ? "" : " " + name) + " lights no surface of this picture: " +
                    reason(area_light(scene.lights[k].shape), surface));
  }
  return lines;
}

}  // namespace penumbra::apps
