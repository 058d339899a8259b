#include "render/variance/variance_method.h"

#include "render/center_view/map_options.h"
#include "render/rays/point_light.h"
#include "render/rays/ray_scene.h"
#include "render/variance/variance.h"

namespace penumbra {
namespace {

class VarianceMethod : public Method {
 public:
  explicit VarianceMethod(const Scene& objects) : scene_(objects) {}

  MethodResult run(const MethodInput& input) override {
    if (is_point(input.light)) return hard_shadow(input);
    const VarianceOptions options{.map_size = static_cast<int>(integer_of(input.options, "map-size")),
                                  .warp = real_of(input.options, "depth-warp"),
                                  .least_share = real_of(input.options, "leak-cut")};
    return variance_visibility(scene_, area_light(input.light), input.receivers, options, input.keep_textures,
                               input.rays.arena(), input.progress);
  }

 private:
  const Scene& scene_;
};

std::vector<OptionSchema> options() {
  const VarianceOptions usual;
  return {
      detail::map_size_option(),
      {.name = "depth-warp",
       .domain = RealRange{0.0, 20.0},
       .usual = usual.warp,
       .unit = {},
       .help = "c of the warps exp(c z) and -exp(-c z) of depths z from 0 to 1: less light leaks; 0: none",
       .steps = std::vector<OptionValue>{0.0, 4.0, 8.0, 16.0}},
      {.name = "leak-cut",
       .domain = RealRange{0.0, 0.9},
       .usual = usual.least_share,
       .unit = "fraction of the light",
       .help = "Visibility up to this becomes 0 and the rest is stretched: against light leaks",
       .steps = std::vector<OptionValue>{0.0, 0.1, 0.3}}};
}

}  // namespace

MethodInfo variance_method() {
  return {.name = "variance",
          .summary = "mean and variance of depths in a prefiltered shadow map, as engines have it",
          .takes_rectangles = true,
          .takes_distant = true,
          .options = options(),
          .make = [](const Scene& objects) { return std::make_unique<VarianceMethod>(objects); }};
}

}  // namespace penumbra
