// The module that writes fields as grids of OpenVDB: a library of its own, opened when a field is written as
// .vdb, because starting OpenVDB takes a program 40 ms and 30 MB.
#pragma once

#include <iosfwd>

#include "penumbra/render/solids/light_field.h"

namespace penumbra::detail {

using WriteVdb = void(std::ostream& out, const LightField& field);

/// What dlsym finds in the module.
constexpr const char* kWriteVdbSymbol = "penumbra_write_vdb";

}  // namespace penumbra::detail

extern "C" penumbra::detail::WriteVdb penumbra_write_vdb;
