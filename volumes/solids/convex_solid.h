// Solids of one convex body: exact but for rounding and, in penumbras, for the polygon around the disk.
#pragma once

#include <optional>

#include "volumes/solids/solid_mesher.h"

namespace penumbra::detail {

/// Umbra (convex_umbra.h) or penumbra (cells/penumbra_cell.h) cut off at the bound. Nothing where the caster
/// is not one convex body in front of the light, where a level is wanted, or where rounding has spoiled the
/// surface.
std::optional<SolidMesh> mesh_convex_shadow(const SolidMeshRequest& request);

}  // namespace penumbra::detail
