// study --peers: Cycles, the path tracer of Blender (Debian's package blender), on the same pixels.
//
// cycles.py makes the scene in Blender: white, no light but the disk (a sun where the light is distant), no
// light that bounces, no denoiser, no adaptive sampling, a fixed seed. It renders it with shadows and with
// rays that no object stops. The ratio of the two, which have the same points of the light, times what the
// horizon leaves is visibility. Linear, 32-bit float. The pixel filter is a hundredth of a pixel wide, so
// that rays go through the pixel's center but for that.
//
// Blender's diffuse surfaces under its area lights weigh each point of the light by what it adds to the
// irradiance: the cosine at the receiver, the cosine at the light, 1/d². Shadows are then other numbers than
// visibility. So there are two settings of `weights`: "irradiance" leaves it so; "even" has a surface without
// the cosine and a light that undoes the rest, so that equal areas of the light count alike.
#pragma once

#include "apps/cli/study/peers/peer.h"

namespace penumbra::apps {

/// Settings: 16, 64 and 256 samples a pixel evenly weighed, 64 by irradiance. Times are what Blender's render
/// call takes, with the scene and its hierarchy kept from the frame before; as many frames as fit in some
/// seconds, at most the case's rounds.
Peer cycles_peer();

}  // namespace penumbra::apps
