// Options that methods with a shadow map of the light's center share.
#pragma once

#include "penumbra/render/method_option.h"

namespace penumbra::detail {

/// map-size: texels a side.
OptionSchema map_size_option();
/// map-bias and slope-bias: what is not this much nearer to the light than the receiver hides nothing from
/// it; texels, and texels times the tangent of the slope of the receiver's plane.
std::vector<OptionSchema> bias_options();

/// As of those options.
struct MapBias {
  double constant = 1.0, slope = 1.0;
};
MapBias bias_of(const OptionValues& values);

}  // namespace penumbra::detail
