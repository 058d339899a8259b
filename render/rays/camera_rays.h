// Rays of a camera: what each pixel of a picture sees.
//
// In: a scene and its camera, a picture's size. Out: object and face at a point of each pixel (Embree), and
// the point in double from the pixel's ray and the face's plane.
#pragma once

#include "penumbra/mesh/progress.h"
#include "penumbra/render/receivers/surface_buffer.h"
#include "render/rays/ray_scene.h"

namespace penumbra {

/// Where in a pixel its ray goes: from the top left corner, in pixels.
struct PointInPixel {
  double x = 0.5, y = 0.5;
  bool is_center() const { return x == 0.5 && y == 0.5; }
};

/// Has a revision of its own. Cost O(pixels · log faces), on all threads of `rays`; deterministic. Throws
/// UsageError for a side of 0 or above 65,536 pixels, Cancelled. `memory`: a buffer whose memory is used
/// again.
SurfaceBuffer make_surface_buffer(const Scene& scene, const RayScene& rays, int width, int height,
                                  const PointInPixel& at = {}, const Progress& progress = {},
                                  SurfaceBuffer memory = {});

}  // namespace penumbra
