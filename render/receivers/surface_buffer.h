// What the camera sees, once, for every method: a picture's pixels as receivers.
//
// Object and face are those that the ray through the pixel's center meets first, the point is where it meets
// the face's plane, in double (rays/camera_rays.h).
#pragma once

#include <cstdint>
#include <vector>

#include "penumbra/render/receivers/receivers.h"

namespace penumbra {

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

}  // namespace penumbra
