#include "render/gl/state_scope.h"

#include <initializer_list>

namespace penumbra::gl {
namespace {

constexpr GLenum kTextureUnits = 24;  // more than any pass binds

void reset_tests(const Functions& gl) {
  for (const GLenum each : {GL_DEPTH_TEST, GL_CULL_FACE, GL_CLIP_DISTANCE0, GL_COLOR_LOGIC_OP})
    gl.Disable(each);
  gl.DepthFunc(GL_LESS);
  gl.DepthMask(GL_TRUE);
  gl.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  gl.CullFace(GL_BACK);
  gl.LogicOp(GL_COPY);
  gl.ClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
  gl.PixelStorei(GL_PACK_ALIGNMENT, 4);
  gl.PixelStorei(GL_UNPACK_ALIGNMENT, 4);
}

void reset_bindings(const Functions& gl) {
  gl.UseProgram(0);
  gl.BindVertexArray(0);
  gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
  for (const GLenum each : {GL_ARRAY_BUFFER, GL_TEXTURE_BUFFER, GL_UNIFORM_BUFFER, GL_SHADER_STORAGE_BUFFER})
    gl.BindBuffer(each, 0);
  for (GLenum unit = kTextureUnits; unit-- > 0;) {
    gl.ActiveTexture(GL_TEXTURE0 + unit);
    for (const GLenum each : {GL_TEXTURE_2D, GL_TEXTURE_2D_ARRAY, GL_TEXTURE_BUFFER}) gl.BindTexture(each, 0);
  }
}

}  // namespace

StateScope::~StateScope() {
  reset_tests(gl_);
  reset_bindings(gl_);
}

}  // namespace penumbra::gl
