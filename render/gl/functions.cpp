#include "render/gl/functions.h"

#include <string>

#include "penumbra/mesh/error.h"

namespace penumbra::gl {

Functions load_functions(ProcLoader loader) {
  Functions gl;
#define PENUMBRA_GL_LOAD(name, type)                    \
  gl.name = reinterpret_cast<type>(loader("gl" #name)); \
  if (!gl.name) throw SystemError("OpenGL function gl" #name " is missing: OpenGL 4.5 core is required");
  PENUMBRA_GL_FUNCTIONS(PENUMBRA_GL_LOAD)
#undef PENUMBRA_GL_LOAD
  GLint major = 0, minor = 0;
  gl.GetIntegerv(GL_MAJOR_VERSION, &major);
  gl.GetIntegerv(GL_MINOR_VERSION, &minor);
  if (10 * major + minor < 45)
    throw SystemError("OpenGL " + std::to_string(major) + "." + std::to_string(minor) +
                      " found, 4.5 core is required: install Mesa 22 or newer");
  return gl;
}

}  // namespace penumbra::gl
