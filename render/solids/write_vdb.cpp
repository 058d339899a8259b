#include "render/solids/write_vdb.h"

#include <dlfcn.h>

#include <string>

#include "penumbra/mesh/error.h"
#include "render/solids/vdb/vdb_module.h"
#include "render/support/library_memory.h"

namespace penumbra::detail {
namespace {

/// dlerror's reason begins with the file that is missing: the module itself, or OpenVDB or another library that it needs.
[[noreturn]] void fail_to_open(const std::string& reason) {
  require_memory_for_library(reason.c_str());
  const bool lacks_module = reason.starts_with(PENUMBRA_VDB_MODULE);
  throw SystemError(std::string("fields as .vdb need OpenVDB: install the Debian package libopenvdb-dev") +
                    (lacks_module ? ", build Penumbra again and install it with its module" : "") +
                    "; or write .vti or .npy (" + reason + ')');
}

/// The loader looks for the module where the program's run path says. It stays open: OpenVDB's registries cannot be taken down.
WriteVdb* open_module() {
  void* module = dlopen(PENUMBRA_VDB_MODULE, RTLD_NOW | RTLD_LOCAL);
  void* function = module != nullptr ? dlsym(module, kWriteVdbSymbol) : nullptr;
  if (function == nullptr) fail_to_open(dlerror());
  return reinterpret_cast<WriteVdb*>(function);
}

WriteVdb& module_function() {
  static WriteVdb* const opened = open_module();
  return *opened;
}

}  // namespace

void require_vdb() {
  module_function();
}

void write_vdb(std::ostream& out, const LightField& field) {
  module_function()(out, field);
}

}  // namespace penumbra::detail
