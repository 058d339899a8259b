#include "render/smoothies/smoothies_method.h"

#include "render/rays/point_light.h"
#include "render/rays/ray_scene.h"
#include "render/smoothies/smoothies.h"

namespace penumbra {
namespace {

class SmoothiesMethod : public Method {
 public:
  explicit SmoothiesMethod(const Scene& objects) : scene_(objects) {}

  MethodResult run(const MethodInput& input) override {
    if (is_point(input.light)) return hard_shadow(input);
    return smoothie_visibility(scene_, input.light, input.receivers,
                               {.map_size = static_cast<int>(integer_of(input.options, "map-size")),
                                .bias = detail::bias_of(input.options),
                                .width = real_of(input.options, "smoothie-width")},
                               input.keep_textures, input.rays.arena(), input.progress);
  }

 private:
  const Scene& scene_;
};

}  // namespace

MethodInfo smoothies_method() {
  std::vector<OptionSchema> options{detail::map_size_option()};
  for (OptionSchema& bias : detail::bias_options()) options.push_back(std::move(bias));
  options.push_back({.name = "smoothie-width",
                     .domain = RealRange{0.01, 100.0},
                     .usual = SmoothieOptions().width,
                     .unit = {},
                     .help = "Width of the fins, times that of the mean edge's outer penumbra",
                     .steps = std::vector<OptionValue>{0.5, 1.0, 2.0}});
  return {.name = "smoothies",
          .summary = "a hard shadow with a fake penumbra outside of it: fins at silhouettes",
          .takes_rectangles = true,
          .options = std::move(options),
          .make = [](const Scene& objects) { return std::make_unique<SmoothiesMethod>(objects); }};
}

}  // namespace penumbra
