// What a scene gets where its file says nothing: a bare mesh becomes a scene, a scene without a camera gets
// one.
#pragma once

#include <filesystem>

#include "penumbra/mesh/io/polygon_soup.h"
#include "penumbra/render/scene/scene.h"

namespace penumbra::detail {

/// A camera in front, to the right and above, that sees all of `bounds`. The bounds must not be empty.
Camera camera_for(const Bounds& bounds);

/// The mesh (object 1) on a floor that does not cast and fades into the background (object 0), a disk light
/// whose shadow falls into view, a camera that sees mesh and shadow, fill light and samples a pixel: all in
/// proportion to the mesh's bounds, without those of specks: parts of less than 2% of the largest one's size,
/// where they are less than 1% of all area. y is up. Cost O(faces).
Scene scene_around(const TriangleMesh& mesh, const std::string& name);

}  // namespace penumbra::detail
