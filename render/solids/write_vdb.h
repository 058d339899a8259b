// Fields as grids of OpenVDB.
#pragma once

#include <iosfwd>

#include "penumbra/render/solids/light_field.h"

namespace penumbra::detail {

/// Throws UsageError where OpenVDB was missing when the library was built.
void write_vdb(std::ostream& out, const LightField& field);

}  // namespace penumbra::detail
