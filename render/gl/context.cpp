#include "render/gl/context.h"

#include <string>

#include "penumbra/mesh/error.h"
#include "render/gl/context_backends.h"

namespace penumbra::gl {

Backend backend_of(const std::string& name) {
  if (name == "osmesa") return Backend::kOsMesa;
  if (name == "egl") return Backend::kEgl;
  throw UsageError("unknown backend '" + name + "': use osmesa or egl");
}

const char* name_of(Backend backend) {
  return backend == Backend::kOsMesa ? "osmesa" : "egl";
}

std::unique_ptr<Context> make_context(Backend backend) {
  return backend == Backend::kOsMesa ? make_osmesa_context() : make_egl_context();
}

std::string renderer_string(const Functions& gl) {
  const auto text = [&](GLenum what) {
    const auto* found = reinterpret_cast<const char*>(gl.GetString(what));
    return std::string(found != nullptr ? found : "unknown");
  };
  return text(GL_RENDERER) + ", OpenGL " + text(GL_VERSION);
}

}  // namespace penumbra::gl
