// The GLSL files of the methods, embedded at build time (render/CMakeLists.txt).
#pragma once

#include <string_view>

namespace penumbra::gl {

/// Text of the file of that name, from the `shaders` folder of whichever method has it. Asking for a file
/// that does not exist is a programmer's mistake (std::logic_error).
std::string_view shader_source(std::string_view name);

}  // namespace penumbra::gl
