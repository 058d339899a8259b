// Volumes as binary glTF 2.0, for programs that show or edit scenes.
#pragma once

#include <iosfwd>

#include "penumbra/volumes/shadow_mesh.h"

namespace penumbra::detail {

/// A node for each object, with its number and the guarantee in `extras`. Positions are float32 around the
/// node's translation, the middle of its box: they are off by 2^-24 of its size. One material, half
/// transparent.
void write_glb(std::ostream& out, const ShadowMesh& mesh);

}  // namespace penumbra::detail
