#include "render/support/library_memory.h"

#include <new>
#include <string>

namespace penumbra::detail {

void require_memory_for_library(const char* reason) {
  const std::string text = reason != nullptr ? reason : "";
  for (const char* sign : {"failed to map segment", "Cannot allocate memory", "out of memory"})
    if (text.find(sign) != std::string::npos) throw std::bad_alloc();
}

}  // namespace penumbra::detail
