// How fast this machine is beside that on which the planner's model was fitted.
#pragma once

namespace penumbra::apps {

struct Calibration {
  /// Milliseconds of a frame's visibility by both methods, the least of some: for a ball and loose triangles
  /// over a floor.
  double silhouette_ms = 0.0, reference_ms = 0.0;
  /// The geometric mean of both: above 1 where this machine is faster.
  double speed = 1.0;
};

/// Takes about a second on a machine that does nothing else.
Calibration calibrate(int threads);

}  // namespace penumbra::apps
