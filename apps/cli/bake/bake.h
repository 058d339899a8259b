// Visibility averaged over the faces or around the vertices of a surface.
#pragma once

#include <vector>

#include "apps/cli/sun/surface.h"
#include "penumbra/render/visibility.h"

namespace penumbra::apps {

struct BakeOptions {
  /// Each face is divided into side² triangles of one shape; receivers are their centers.
  int side = 4;
  /// Around vertices, else over faces.
  bool vertices = false;
  VisibilityOptions visibility{};
};

/// One value a face: the mean of its receivers. Or one a vertex: the mean over its faces, weighted by area and by the hat function, which is 1 at
/// the vertex and 0 at its neighbors. NaN for a face without area, and for a vertex that has no other. Throws as `visibility` does.
std::vector<float> bake(const Casters& casters, const Surface& surface, const LightShape& light,
                        const BakeOptions& options);

}  // namespace penumbra::apps
