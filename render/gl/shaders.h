// The GLSL files of render/shaders, embedded at build time.
#pragma once

#include <string_view>

namespace penumbra::gl {

/// Text of render/shaders/NAME. Asking for a file that does not exist is a programmer's mistake
/// (std::logic_error).
std::string_view shader_source(std::string_view name);

}  // namespace penumbra::gl
