#include "render/support/run_time_module.h"

#include <dlfcn.h>

#include "penumbra/mesh/error.h"
#include "render/support/library_memory.h"

namespace penumbra::detail {

void* symbol_of_module(const char* file, const char* symbol, const std::string& need,
                       const std::string& instead) {
  void* module = dlopen(file, RTLD_NOW | RTLD_LOCAL);
  void* found = module != nullptr ? dlsym(module, symbol) : nullptr;
  if (found != nullptr) return found;
  // It begins with the file that is missing: the module itself, or a library that it needs.
  const std::string reason = dlerror();
  require_memory_for_library(reason.c_str());
  const bool lacks_module = reason.starts_with(file);
  throw SystemError(need + (lacks_module ? ", build Penumbra again and install it with its module" : "") +
                    "; " + instead + " (" + reason + ')');
}

}  // namespace penumbra::detail
