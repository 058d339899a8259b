// What stands in front of surfaces in a picture alone: glass, and lights that are seen.
//
// Glass is fog with a surface. A way s through a body hides the share 1 - (1 - density)^(s / d) of what
// stands behind, d being the casters' diagonal, and shows the body's tint in that place. Where bodies overlap
// there is the glass of the last one. A surface hides a share of its own, (1 - cos)^3 kRim, the more the ray
// runs along it: that shows its shape. A tint is as bright as a sheet of that albedo in the middle of the
// casters that faces each light, with fill light.
#pragma once

#include "render/rays/camera_rays.h"
#include "render/rays/glass/glass_rays.h"
#include "render/shading/shading.h"

namespace penumbra::detail {

/// R G B A of all pixels, as of Colors or of an image.
struct ColorChannels {
  float *r, *g, *b, *a;
};

/// Puts the scene's glass, and its lights if they are seen, over a picture of rays through `at` of each
/// pixel. `glass` may be null: there is none. Cost O(pixels · log faces), on all threads.
void add_glass(const Scene& scene, const GlassRays* glass, const SurfaceBuffer& surface,
               const PointInPixel& at, const Threads& threads, const ColorChannels& colors);

}  // namespace penumbra::detail
