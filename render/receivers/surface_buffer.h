// Render step 1: what the camera sees, once, for every method: object and face at each pixel's centre
// (Embree), the point in double from the pixel's ray and the face's plane.
#pragma once

#include <cstdint>
#include <vector>

#include "penumbra/render/scene/scene.h"
#include "render/rays/ray_scene.h"

namespace penumbra {

struct SurfaceBuffer {
  int width = 0, height = 0;
  std::vector<std::int32_t> object;  ///< scene index, -1 where nothing is seen
  std::vector<std::uint32_t> face;   ///< in the object's mesh
  std::vector<Vec3> position;        ///< world, double
  std::vector<Vec3> normal;          ///< unit, geometric, towards the viewer
  std::size_t size() const { return object.size(); }
  bool hit(std::size_t pixel) const { return object[pixel] >= 0; }
};

/// Cost O(pixels · log faces), on all cores; deterministic. Throws UsageError for a size of 0 or above
/// 65,536.
SurfaceBuffer make_surface_buffer(const Scene& scene, const RayScene& rays, int width, int height);

}  // namespace penumbra
