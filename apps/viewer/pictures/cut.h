// The plane at which sheets, volumes and solids end.
#pragma once

#include "apps/viewer/pictures/overlay_geometry.h"

namespace penumbra::viewer {

/// What is further along the axis than `most`, from the geometry's origin, is cut off.
struct Cut {
  Vec3 axis;  ///< unit vector
  double most;
  bool cuts = false;  ///< false: everything is kept
};
Cut cut_of(const State& state, const OverlayGeometry& geometry);

}  // namespace penumbra::viewer
