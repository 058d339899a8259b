// The disk that stands for a light in the picture: what handles are at, and what dragging them changes.
#pragma once

#include <optional>

#include "penumbra/mesh/triangle_mesh.h"
#include "penumbra/render/light/light.h"

namespace penumbra::viewer {

struct HandledLight {
  DiskLight disk;
  /// Of a distant light, which has no place: the middle of the sphere over which its disk slides, always
  /// facing it.
  std::optional<Vec3> middle{};

  HandledLight(const DiskLight& near) : disk(near) {}  // NOLINT(google-explicit-constructor)
  HandledLight(const DiskLight& shown, const Vec3& around) : disk(shown), middle(around) {}
  bool operator==(const HandledLight&) const = default;
};

/// A disk is itself; a rectangle has the disk around it; a distant light has a disk of its angle that faces
/// the middle of `casters`, twice their radius away.
HandledLight handled(const LightShape& shape, const Bounds& casters);

/// The light whose disk was changed from handled(shape, ...) = `before` to `after`. A rectangle keeps its
/// proportions. A distant light takes the normal as its direction, and its angle from the radius.
LightShape changed(const LightShape& shape, const HandledLight& before, const HandledLight& after);

/// A distant light by where it is seen in the sky, y up.
struct Heading {
  /// From z towards x, degrees.
  double azimuth = 0.0;
  /// Above the plane y = 0, degrees.
  double elevation = 90.0;
};
Heading heading_of(const DistantLight& light);
/// The direction in which a light at this place of the sky shines.
Vec3 direction_from(const Heading& heading);

}  // namespace penumbra::viewer
