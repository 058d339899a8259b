// Draws solids over the picture as glass: clear where one looks at their surface, denser where one looks
// along it. Where they are cut the section is filled.
#pragma once

#include <memory>

#include "apps/viewer/pictures/cut.h"
#include "apps/viewer/pictures/overlay_colors.h"
#include "apps/viewer/pictures/overlay_pass.h"
#include "apps/viewer/pictures/vertex_list.h"
#include "apps/viewer/work/solid_maker.h"
#include "render/gl/program.h"

namespace penumbra::viewer {

class SolidPass {
 public:
  explicit SolidPass(const gl::Functions& gl);
  /// Uploads when it is another one. Null: nothing will be drawn.
  void set(std::shared_ptr<const Solids> solids);
  /// After OverlayPass, whose depth buffer it uses, into the same pixels; blending must be on. `faint`: they
  /// are those of another light than that of now. Changes GL state freely.
  void draw(const State& state, const OverlayGeometry& geometry, const Viewport& place, bool faint) const;

 private:
  struct Glass {
    const VertexList& list;
    const OverlayColor& color;
    bool shown;
  };
  void set_tint(const OverlayColor& color) const;
  void draw_surface(const Glass& glass, GLenum culled) const;
  void draw_section(const Glass& glass, float cut) const;
  void set_section(const Cut& cut, const Vec3& origin, double bound) const;

  const gl::Functions& gl_;
  gl::Program program_;
  VertexList umbra_, penumbra_, section_;
  std::shared_ptr<const Solids> solids_;
};

}  // namespace penumbra::viewer
