// The scene's casters as the D-buffer needs them, and the frame in which they are uploaded.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "penumbra/mesh/vertex_rings.h"
#include "penumbra/render/receivers/receivers.h"
#include "penumbra/render/scene/scene.h"
#include "render/receivers/occluding_casters.h"

namespace penumbra::detail {

/// The caster frame: (world - origin) · scale. Points are uploaded in it: its origin is the middle of the
/// casters, so floats keep their digits wherever the light is.
struct CasterFrame {
  Vec3 origin{0.0};
  double scale = 1.0;
  Vec3 from_world(const Vec3& p) const { return (p - origin) * scale; }
};

/// The frame of a scene's casters, about the origin of the world where there are none. `scale`: a power of
/// two that brings the scene to about unit size.
CasterFrame caster_frame(const Scene& scene, double scale);

/// An object that casts and has faces. Refers to the scene's mesh.
struct DBufferCaster {
  const TriangleMesh* mesh;
  VertexRings rings;
  CasterPlanes planes;
  /// It hides nothing of the light of this frame from any receiver, so it takes no part in the frame.
  bool cannot_occlude = false;
};

/// All casters, in the order of the scene. Cost O(vertices + faces).
std::vector<DBufferCaster> find_casters(const Scene& scene, const CasterFrame& frame);

/// One caster's place in the uploaded buffers.
struct CasterRange {
  /// Number of its first face, counted over all objects of the scene.
  std::uint32_t first_face;
  std::uint32_t first_index, index_count;
  bool closed;
  /// In the caster frame.
  Bounds bounds;
  /// Not drawn (DBufferCaster::cannot_occlude).
  bool cannot_occlude = false;
};

/// All casters' faces, in the caster frame; three indices a face; one range a caster, in the order of
/// find_casters.
struct CasterTriangles {
  std::vector<glm::vec3> points;
  std::vector<std::uint32_t> indices;
  std::vector<CasterRange> ranges;
};

/// Cost O(vertices + faces).
CasterTriangles caster_triangles(const Scene& scene, const CasterFrame& frame);

/// The surface points of an image in the caster frame. The fourth number is 1 + the number of the face that
/// is seen, counted over all objects of the scene; 0 where nothing is seen. Cost O(pixels).
std::vector<glm::vec4> receiver_positions(const Scene& scene, const CasterFrame& frame,
                                          const Receivers& surface);

}  // namespace penumbra::detail
