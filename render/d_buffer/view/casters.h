// The scene's casters as the D-buffer needs them.
#pragma once

#include <cstdint>
#include <glm/vec4.hpp>
#include <vector>

#include "penumbra/mesh/vertex_rings.h"
#include "penumbra/render/scene/scene.h"
#include "render/d_buffer/view/light_space.h"

namespace penumbra::detail {

/// An object that casts and has faces. Refers to the scene's mesh.
struct DBufferCaster {
  /// Index in Scene::objects.
  std::uint32_t object;
  const TriangleMesh* mesh;
  VertexRings rings;
  /// It hides nothing of the light of this frame from any receiver, so it takes no part in the frame.
  bool cannot_occlude = false;
};

/// All casters, in the order of the scene. Cost O(vertices + faces).
std::vector<DBufferCaster> find_casters(const Scene& scene);

/// Of each object the number of its first face, counted over all objects of the scene; then the number of all
/// faces.
std::vector<std::uint32_t> first_faces(const Scene& scene);

/// One caster's place in the buffers.
struct CasterRange {
  /// Number of its first face, counted over all objects of the scene.
  std::uint32_t first_face;
  std::uint32_t first_index, index_count;
  std::uint32_t first_point, point_count;
  bool closed;
  /// Of this frame's light: not drawn (DBufferCaster::cannot_occlude).
  bool cannot_occlude = false;
  /// The light's center sees only faces that are turned to it: the caster is closed, and the light's plane
  /// does not cut it open.
  bool shows_only_fronts = false;
};

/// All casters' faces, in the world; three indices a face; one range a caster, in the order of find_casters.
struct CasterTriangles {
  std::vector<Vec3> points;
  std::vector<std::uint32_t> indices;
  std::vector<CasterRange> ranges;
};
/// Cost O(vertices + faces).
CasterTriangles caster_triangles(const Scene& scene);

/// What one light sees of CasterTriangles::points.
struct CastersInLight {
  /// LightSpace::homogeneous in the space without a window. Those of casters that cannot occlude are left
  /// out: 0.
  std::vector<glm::dvec4> points;
};
/// Also finds which casters show only fronts. Cost O(vertices), on all cores.
CastersInLight casters_in_light(CasterTriangles& casters, const LightSpace& space);

/// The points in a window, in float, to be drawn. Cost O(vertices), on all cores.
std::vector<glm::vec4> drawn_points(const CastersInLight& casters, const LightSpace& windowed);

}  // namespace penumbra::detail
