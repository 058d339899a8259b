#include "render/center_view/map_options.h"

namespace penumbra::detail {

OptionSchema map_size_option() {
  return {.name = "map-size",
          .domain = IntegerRange{16, 8192},
          .usual = std::uint64_t{1024},
          .unit = "texels",
          .help = "Texels a side of the light center's shadow map",
          .draft = std::uint64_t{512},
          .steps = std::vector<OptionValue>{std::uint64_t{256}, std::uint64_t{1024}, std::uint64_t{4096}}};
}

std::vector<OptionSchema> bias_options() {
  const MapBias usual;
  return {
      {.name = "map-bias",
       .domain = RealRange{0.0, 1000.0},
       .usual = usual.constant,
       .unit = "texels",
       .help =
           "What is not this much nearer to the light hides nothing: against shadows of a surface on itself",
       .steps = std::vector<OptionValue>{}},
      {.name = "slope-bias",
       .domain = RealRange{0.0, 1000.0},
       .usual = usual.slope,
       .unit = "texels",
       .help = "The same, times the tangent of the slope at which the receiver's surface lies in the map",
       .steps = std::vector<OptionValue>{}}};
}

MapBias bias_of(const OptionValues& values) {
  return {real_of(values, "map-bias"), real_of(values, "slope-bias")};
}

}  // namespace penumbra::detail
