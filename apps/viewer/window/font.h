// The window's font: Roboto (Google, Apache-2.0), or what PENUMBRA_VIEWER_FONT named at build time.
#pragma once

#include <span>

namespace penumbra::viewer {

/// The bytes of a TrueType file, part of the program.
std::span<const unsigned char> font_file();

}  // namespace penumbra::viewer
