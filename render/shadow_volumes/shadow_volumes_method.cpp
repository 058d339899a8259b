#include "render/shadow_volumes/shadow_volumes_method.h"

#include "render/rays/ray_scene.h"
#include "render/rays/with_unoccluded.h"
#include "render/shadow_volumes/shadow_volumes.h"

namespace penumbra {
namespace {

Counts to_counts(const ShadowVolumeCounts& c) {
  return {{"casters", c.casters},           {"culled_casters", c.culled_casters},
          {"volume_caps", c.caps},          {"volume_sides", c.sides},
          {"reached_caps", c.reached_caps}, {"reached_sides", c.reached_sides},
          {"tested_polygons", c.tested},    {"crossed_polygons", c.crossed}};
}

class ShadowVolumesMethod : public Method {
 public:
  explicit ShadowVolumesMethod(const Scene& objects) : scene_(objects) {}

  MethodResult run(const MethodInput& input) override {
    const auto is_on = [&](const char* option) { return word_of(input.options, option) == "on"; };
    const auto see = [&](bool horizon, const Progress& progress) {
      return shadow_volumes(
          scene_, input.light, input.receivers,
          {.cull = is_on("volume-culling"), .clamp = is_on("volume-clamping"), .horizon = horizon},
          input.rays.arena(), progress);
    };
    return detail::see_with_unoccluded(input, see, to_counts);
  }

 private:
  const Scene& scene_;
};

OptionSchema on_or_off(std::string name, bool usual, std::string help) {
  return {.name = std::move(name),
          .domain = WordChoice{{"on", "off"}},
          .usual = std::string(usual ? "on" : "off"),
          .unit = {},
          .help = std::move(help),
          .steps = std::vector<OptionValue>{}};
}

}  // namespace

MethodInfo shadow_volumes_method() {
  const ShadowVolumeOptions usual;
  return {.name = "shadow-volumes",
          .summary = "the hard shadow, by the shadow volumes around each receiver",
          .takes_rectangles = true,
          .takes_distant = true,
          .gives_unoccluded = true,
          .options = {on_or_off("volume-culling", usual.cull,
                                "Leave out casters whose shadow volumes hold no receiver"),
                      on_or_off("volume-clamping", usual.clamp,
                                "End shadow volumes below the deepest receiver, not at infinity")},
          .make = [](const Scene& objects) { return std::make_unique<ShadowVolumesMethod>(objects); }};
}

}  // namespace penumbra
