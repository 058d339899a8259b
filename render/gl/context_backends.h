// The windowless backends behind make_context.
#pragma once

#include <memory>
#include <string>

#include "render/gl/context.h"
#include "render/gl/functions.h"

namespace penumbra::gl {

std::unique_ptr<Context> make_osmesa_context();
std::unique_ptr<Context> make_egl_context();

/// "GL_RENDERER, OpenGL GL_VERSION" of the current context.
std::string renderer_string(const Functions& gl);

}  // namespace penumbra::gl
