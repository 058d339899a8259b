// The program behind the command line: a window that shows a file until it is closed.
#pragma once

#include "apps/viewer/viewer_options.h"

namespace penumbra::viewer {

/// Opens the first file, then the window; without a file the window asks for one. Returns the exit code;
/// throws what run_guarded knows.
int show(ViewerOptions options);

}  // namespace penumbra::viewer
