#include "render/penumbra_maps/penumbra_maps_method.h"

#include "render/penumbra_maps/penumbra_maps.h"
#include "render/rays/point_light.h"
#include "render/rays/ray_scene.h"

namespace penumbra {
namespace {

class PenumbraMapsMethod : public Method {
 public:
  explicit PenumbraMapsMethod(const Scene& objects) : scene_(objects) {}

  MethodResult run(const MethodInput& input) override {
    if (is_point(input.light)) return hard_shadow(input);
    return penumbra_map_visibility(scene_, input.light, input.receivers,
                                   {.map_size = static_cast<int>(integer_of(input.options, "map-size")),
                                    .bias = detail::bias_of(input.options)},
                                   input.keep_textures, input.rays.arena(), input.progress);
  }

 private:
  const Scene& scene_;
};

}  // namespace

MethodInfo penumbra_maps_method() {
  std::vector<OptionSchema> options{detail::map_size_option()};
  for (OptionSchema& bias : detail::bias_options()) options.push_back(std::move(bias));
  return {.name = "penumbra-maps",
          .summary = "a hard shadow with a penumbra outside of it: cones and sheets in the light's view",
          .takes_rectangles = true,
          .takes_distant = true,
          .options = std::move(options),
          .make = [](const Scene& objects) { return std::make_unique<PenumbraMapsMethod>(objects); }};
}

}  // namespace penumbra
