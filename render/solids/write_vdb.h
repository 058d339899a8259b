// Fields as grids of OpenVDB, by the module of vdb/.
#pragma once

#include <iosfwd>

#include "penumbra/render/solids/light_field.h"

namespace penumbra::detail {

/// Opens the module, once. Throws SystemError where it, or OpenVDB, is not installed.
void require_vdb();

/// The same, and writes the field.
void write_vdb(std::ostream& out, const LightField& field);

}  // namespace penumbra::detail
