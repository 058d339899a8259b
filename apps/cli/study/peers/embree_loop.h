// study --peers: soft shadows as somebody would write them with Embree alone, to compare with.
//
// One ray at a time from the pixel's point, in float, to a point of the light chosen by chance, with `tnear`
// against self-shadowing as in Embree's tutorial triangle_geometry (0.001 scene units). Neither strata nor
// packets nor exact tests.
#pragma once

#include "penumbra/render/method.h"

namespace penumbra::apps {

MethodInfo embree_loop();

}  // namespace penumbra::apps
