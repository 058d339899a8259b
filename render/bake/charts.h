// Bake: a mesh as charts, each flat enough to be projected to a plane.
#pragma once

#include <cstdint>
#include <vector>

#include "penumbra/render/bake/texture_atlas.h"

namespace penumbra::detail {

struct Chart {
  std::uint32_t object = 0;
  std::vector<std::uint32_t> faces;
  /// One a face, scene units; the least coordinates are 0.
  std::vector<FaceUv> uv;
  /// Of the bounding box, scene units.
  glm::dvec2 extent{0.0};
};

/// Faces that are connected over edges, with normals within `degrees` of the first one's, projected along
/// their mean normal and turned so that the bounding box is small. Where faces of one chart overlap in the
/// plane, later ones begin charts of their own. Faces without area are left out. Cost expected O(faces · log
/// faces).
std::vector<Chart> make_charts(const TriangleMesh& mesh, std::uint32_t object, double degrees);

}  // namespace penumbra::detail
