#include "render/shadow_volumes/shadow_volumes_method.h"

#include "render/rays/ray_scene.h"
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
    ShadowVolumeOptions options{.cull = word_of(input.options, "volume-culling") == "on",
                                .clamp = word_of(input.options, "volume-clamping") == "on"};
    const double first = input.with_unoccluded ? 0.5 : 1.0;
    const auto seen = [&](double from, double to) {
      return shadow_volumes(scene_, input.light, input.receivers, options, input.rays.arena(),
                            part_of(input.progress, from, to));
    };
    MethodResult out;
    ShadowVolumeResult result = seen(0.0, first);
    out.counts = to_counts(result.counts);
    out.visibility = std::move(result.visibility);
    out.stages = std::move(result.stages);
    if (input.with_unoccluded) {
      options.horizon = false;
      result = seen(first, 1.0);
      out.unoccluded = std::move(result.visibility);
      out.stages.insert(out.stages.end(), result.stages.begin(), result.stages.end());
    }
    return out;
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
