// The module that reads rasters by GDAL: a library of its own, opened when a heightfield is read, because
// starting GDAL and the hundred libraries that it links takes a program long.
#pragma once

#include <string>

#include "render/scene/heightfield/height_grid.h"

namespace penumbra::detail {

/// Gives what is wrong and what to do, or nothing.
using ReadHeights = std::string(const std::string& path, HeightGrid& out);

/// What dlsym finds in the module.
constexpr const char* kReadHeightsSymbol = "penumbra_read_heights";

}  // namespace penumbra::detail

// C linkage only names it: both sides are built together.
#pragma GCC diagnostic push
#ifdef __clang__
#pragma GCC diagnostic ignored "-Wreturn-type-c-linkage"
#endif
extern "C" penumbra::detail::ReadHeights penumbra_read_heights;
#pragma GCC diagnostic pop
