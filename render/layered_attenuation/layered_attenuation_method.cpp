#include "render/layered_attenuation/layered_attenuation_method.h"

#include "render/layered_attenuation/layered_attenuation.h"
#include "render/rays/point_light.h"
#include "render/rays/ray_scene.h"

namespace penumbra {
namespace {

class LayeredAttenuationMethod : public Method {
 public:
  explicit LayeredAttenuationMethod(const Scene& objects) : scene_(objects) {}

  MethodResult run(const MethodInput& input) override {
    if (is_point(input.light)) return hard_shadow(input);
    return layered_attenuation(scene_, area_light(input.light), input.receivers,
                               {.size = static_cast<int>(integer_of(input.options, "attenuation-size")),
                                .views = static_cast<int>(integer_of(input.options, "light-views")),
                                .tolerance = real_of(input.options, "layer-tolerance")},
                               input.keep_textures, input.rays.arena(), input.progress);
  }

 private:
  const Scene& scene_;
};

std::vector<OptionSchema> options() {
  const detail::AttenuationOptions usual;
  return {{.name = "attenuation-size",
           .domain = IntegerRange{16, 4096},
           .usual = static_cast<std::uint64_t>(usual.size),
           .unit = "texels",
           .help = "Texels a side of the map whose layers keep how much of the light they see",
           .draft = std::uint64_t{128},
           .steps = std::vector<OptionValue>{std::uint64_t{256}, std::uint64_t{512}, std::uint64_t{1024}}},
          {.name = "light-views",
           .domain = IntegerRange{1, 4096},
           .usual = static_cast<std::uint64_t>(usual.views),
           .unit = "points",
           .help = "Points of the light from which the scene is drawn",
           .draft = std::uint64_t{16},
           .steps = std::vector<OptionValue>{std::uint64_t{16}, std::uint64_t{64}, std::uint64_t{256}}},
          {.name = "layer-tolerance",
           .domain = RealRange{0.0, 1000.0},
           .usual = usual.tolerance,
           .unit = "texels",
           .help = "Surfaces whose heights differ by less are one layer",
           .steps = std::vector<OptionValue>{}}};
}

}  // namespace

MethodInfo layered_attenuation_method() {
  return {.name = "layered-attenuation",
          .summary = "shadow maps from many points of the light, taken back to layers of one view",
          .takes_rectangles = true,
          .takes_distant = true,
          .needs_pixels = true,
          .options = options(),
          .make = [](const Scene& objects) { return std::make_unique<LayeredAttenuationMethod>(objects); }};
}

}  // namespace penumbra
