// Modules of this project that are opened at run time, because what they link takes long to start.
#pragma once

#include <string>

namespace penumbra::detail {

/// Opens the module `file` and gives its symbol. The loader looks for it where the program's run path says.
/// It stays open. Throws std::bad_alloc, or SystemError: `need`, what to build, `instead` and the loader's
/// reason.
void* symbol_of_module(const char* file, const char* symbol, const std::string& need,
                       const std::string& instead);

}  // namespace penumbra::detail
