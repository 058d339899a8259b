// What the camera sees, once, for every method: a picture's pixels as receivers.
//
// In: a scene, a picture's size. Out: object and face at each pixel's center (Embree), and the point in
// double from the pixel's ray and the face's plane.
#pragma once

#include <cstdint>
#include <vector>

#include "penumbra/render/receivers/receivers.h"
#include "penumbra/render/scene/camera.h"

namespace penumbra {

class RayScene;
struct Scene;

struct SurfaceBuffer {
  /// Pixels.
  int width = 0, height = 0;
  /// The scene's index; -1 where nothing is seen.
  std::vector<std::int32_t> object;
  /// In the object's mesh.
  std::vector<std::uint32_t> face;
  /// World, double.
  std::vector<Vec3> position;
  /// Unit, geometric, towards the viewer.
  std::vector<Vec3> normal;
  /// See Receivers; 0 for one made by hand.
  std::uint64_t revision = 0;

  std::size_t size() const { return object.size(); }
  bool hit(std::size_t pixel) const { return object[pixel] >= 0; }
  /// Refers to this buffer.
  Receivers receivers() const { return {position, normal, object, face, width, height, revision}; }
};

/// Has a revision of its own. Cost O(pixels · log faces), on all threads of `rays`; deterministic. Throws
/// UsageError for a side of 0 or above 65,536 pixels.
SurfaceBuffer make_surface_buffer(const Scene& scene, const RayScene& rays, int width, int height);

}  // namespace penumbra
