// Draws overlay geometry over the picture with the window's OpenGL: the scene's own triangles give depth, so
// that what lies behind them is hidden.
#pragma once

#include <memory>

#include "apps/viewer/handles/projection.h"
#include "apps/viewer/pictures/overlay_geometry.h"
#include "apps/viewer/pictures/vertex_list.h"
#include "render/gl/program.h"

namespace penumbra::viewer {

/// Where the picture is in a framebuffer, whose rows count from the bottom. Pixels.
struct Viewport {
  int bottom, width, height;
};

class OverlayPass {
 public:
  explicit OverlayPass(const gl::Functions& gl);
  /// Uploads when it is another one. Null: nothing will be drawn.
  void set(std::shared_ptr<const OverlayGeometry> geometry);
  /// Into `place` of the bound framebuffer; blending must be on. Changes GL state freely.
  void draw(const State& state, const Viewport& place) const;
  const OverlayGeometry* geometry() const { return geometry_.get(); }

 private:
  void draw_list(const VertexList& list, GLenum mode) const;

  const gl::Functions& gl_;
  gl::Program program_;
  VertexList scene_, faces_, lines_, sheets_;
  std::shared_ptr<const OverlayGeometry> geometry_;
};

}  // namespace penumbra::viewer
