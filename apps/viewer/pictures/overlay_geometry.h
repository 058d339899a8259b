// What is drawn over the picture as geometry: faces by class, silhouettes, sheets and volumes, made of what
// volumes/ returns.
#pragma once

#include <future>
#include <memory>
#include <vector>

#include "apps/viewer/state/state.h"

namespace penumbra::viewer {

struct OverlayVertex {
  float x, y, z;  ///< relative to OverlayGeometry::origin
  unsigned char color[4];
};

/// Lists for OpenGL: three vertices a triangle, two a line.
struct OverlayGeometry {
  Vec3 origin{0.0};
  std::vector<OverlayVertex> scene;  ///< every object's triangles, for depth only
  std::vector<OverlayVertex> faces, lines, sheets;
  /// Where light begins its way through the scene: a point of the light's plane, or the first point of the
  /// scene where the light is far away.
  Vec3 start{0.0};
  double reach = 0.0;  ///< from there to the furthest point of the scene, along the light's normal
  double bound =
      0.0;  ///< radius of a sphere around origin that holds the scene, and the light where it is near
};

/// Cost that of extrusion where sheets or volumes are wanted.
OverlayGeometry make_overlay_geometry(const Scene& scene, const CircularLight& light, const Overlays& wanted);

/// Makes overlays on a thread of its own, the newest wish last; `wake` is called when one is ready.
class OverlayMaker {
 public:
  explicit OverlayMaker(void (*wake)()) : wake_(wake) {}
  ~OverlayMaker();
  /// To be called each window frame. The newest geometry that is ready, null where none is wanted.
  std::shared_ptr<const OverlayGeometry> update(const State& state);
  bool busy() const { return task_.valid(); }

 private:
  bool fits(const State& state) const;

  void (*wake_)();
  std::future<std::shared_ptr<const OverlayGeometry>> task_;
  std::shared_ptr<const OverlayGeometry> ready_;
  State made_for_;
};

}  // namespace penumbra::viewer
