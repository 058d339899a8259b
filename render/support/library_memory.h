// Libraries that are opened at run time.
#pragma once

namespace penumbra::detail {

/// Throws std::bad_alloc where dlerror's reason for a library that cannot be opened is that there is no
/// memory for it.
void require_memory_for_library(const char* reason);

}  // namespace penumbra::detail
