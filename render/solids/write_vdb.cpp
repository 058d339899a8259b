#include "render/solids/write_vdb.h"

#include "render/solids/vdb/vdb_module.h"
#include "render/support/run_time_module.h"

namespace penumbra::detail {
namespace {

/// It stays open: OpenVDB's registries cannot be taken down.
WriteVdb& module_function() {
  static void* const opened = symbol_of_module(
      PENUMBRA_VDB_MODULE, kWriteVdbSymbol,
      "fields as .vdb need OpenVDB: install the Debian package libopenvdb-dev", "or write .vti or .npy");
  return *reinterpret_cast<WriteVdb*>(opened);
}

}  // namespace

void require_vdb() {
  module_function();
}

void write_vdb(std::ostream& out, const LightField& field) {
  module_function()(out, field);
}

}  // namespace penumbra::detail
