// The windowless backends behind make_context.
#pragma once

#include <memory>
#include <string>

#include "render/gl/context.h"
#include "render/gl/functions.h"

namespace penumbra::gl {

std::unique_ptr<Context> make_osmesa_context();
std::unique_ptr<Context> make_egl_context();

/// Throws std::bad_alloc where dlerror's reason for a library that cannot be opened is that there is no memory for it.
void require_memory_for_library(const char* reason);

/// "GL_RENDERER, OpenGL GL_VERSION" of the current context.
std::string renderer_string(const Functions& gl);

}  // namespace penumbra::gl
