#include "render/backprojection/backprojection_method.h"

#include "render/backprojection/backprojection.h"
#include "render/rays/point_light.h"
#include "render/rays/ray_scene.h"

namespace penumbra {
namespace {

class BackprojectionMethod : public Method {
 public:
  explicit BackprojectionMethod(const Scene& objects) : scene_(objects) {}

  MethodResult run(const MethodInput& input) override {
    if (is_point(input.light)) return hard_shadow(input);
    const OptionValues& values = input.options;
    const BackprojectionOptions options{
        .map_size = static_cast<int>(integer_of(values, "patch-map-size")),
        .layers = static_cast<int>(integer_of(values, "map-layers")),
        .samples = static_cast<int>(integer_of(values, "mask-samples")),
        .patches = {.bias = detail::bias_of(values), .fill_gaps = word_of(values, "gap-filling") == "on"}};
    return backprojected_visibility(scene_, area_light(input.light), input.receivers, options,
                                    input.keep_textures, input.rays.arena(), input.progress);
  }

 private:
  const Scene& scene_;
};

std::vector<OptionSchema> options() {
  const BackprojectionOptions usual;
  std::vector<OptionSchema> out{
      {.name = "patch-map-size",
       .domain = IntegerRange{16, 2048},
       .usual = static_cast<std::uint64_t>(usual.map_size),
       .unit = "texels",
       .help = "Texels a side of the shadow map whose texels are projected back onto the light",
       .draft = std::uint64_t{64},
       .steps = std::vector<OptionValue>{}},
      {.name = "map-layers",
       .domain = IntegerRange{1, 16},
       .usual = static_cast<std::uint64_t>(usual.layers),
       .unit = "surfaces",
       .help = "Surfaces that the map keeps at each texel, the nearest to the light first",
       .steps = std::vector<OptionValue>{std::uint64_t{1}, std::uint64_t{2}}},
      {.name = "mask-samples",
       .domain = IntegerRange{16, 1024},
       .usual = static_cast<std::uint64_t>(usual.samples),
       .unit = "samples",
       .help = "Samples of the light, the same for all receivers",
       .draft = std::uint64_t{64},
       .steps = std::vector<OptionValue>{std::uint64_t{256}, std::uint64_t{1024}}},
      {.name = "gap-filling",
       .domain = WordChoice{{"on", "off"}},
       .usual = std::string(usual.patches.fill_gaps ? "on" : "off"),
       .unit = {},
       .help = "Stretch texels to the borders of their neighbors, so that surfaces have no gaps"}};
  for (OptionSchema& bias : detail::bias_options()) out.push_back(std::move(bias));
  return out;
}

}  // namespace

MethodInfo backprojection_method() {
  return {.name = "backprojection",
          .summary = "texels of the center's shadow map, projected back onto the light as masks of samples",
          .takes_rectangles = true,
          .takes_distant = true,
          .options = options(),
          .make = [](const Scene& objects) { return std::make_unique<BackprojectionMethod>(objects); }};
}

}  // namespace penumbra
