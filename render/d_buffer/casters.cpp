#include "render/d_buffer/casters.h"

namespace penumbra::detail {
namespace {

bool is_caster(const SceneObject& object) {
  return object.casts && !object.mesh.empty();
}

std::uint32_t face_count(const SceneObject& object) {
  return static_cast<std::uint32_t>(object.mesh.triangles().size());
}

}  // namespace

CasterFrame caster_frame(const Scene& scene, double scale) {
  const Bounds bounds = scene.caster_bounds();
  return {bounds.empty() ? Vec3(0.0) : bounds.center(), scale};
}

std::vector<DBufferCaster> find_casters(const Scene& scene, const CasterFrame& frame) {
  std::vector<DBufferCaster> casters;
  for (const SceneObject& object : scene.objects)
    if (is_caster(object))
      casters.push_back(
          {&object.mesh, VertexRings(object.mesh), CasterPlanes(object.mesh, frame.origin, frame.scale)});
  return casters;
}

CasterTriangles caster_triangles(const Scene& scene, const CasterFrame& frame) {
  CasterTriangles out;
  std::uint32_t first_face = 0;
  for (const SceneObject& object : scene.objects) {
    const TriangleMesh& mesh = object.mesh;
    if (is_caster(object)) {
      const auto first_index = static_cast<std::uint32_t>(out.indices.size());
      const auto first_point = static_cast<std::uint32_t>(out.points.size());
      Bounds bounds;
      for (const Vec3& p : mesh.positions()) {
        bounds.add(frame.from_world(p));
        out.points.push_back(glm::vec3(frame.from_world(p)));
      }
      for (const IndexedTriangle& t : mesh.triangles())
        for (const std::uint32_t v : t) out.indices.push_back(first_point + v);
      const auto index_count = static_cast<std::uint32_t>(out.indices.size()) - first_index;
      out.ranges.push_back({first_face, first_index, index_count, mesh.is_closed(), bounds});
    }
    first_face += face_count(object);
  }
  return out;
}

std::vector<glm::vec4> receiver_positions(const Scene& scene, const CasterFrame& frame,
                                          const Receivers& surface) {
  std::vector<std::uint32_t> first_face{0};
  for (const SceneObject& object : scene.objects)
    first_face.push_back(first_face.back() + face_count(object));
  std::vector<glm::vec4> positions(surface.size(), glm::vec4(0.0f));
  for (std::size_t i = 0; i < surface.size(); ++i) {
    if (!surface.is_present(i)) continue;
    const std::uint32_t face =
        first_face[static_cast<std::size_t>(surface.objects[i])] + surface.faces[i] + 1;
    positions[i] = glm::vec4(glm::vec3(frame.from_world(surface.points[i])), static_cast<float>(face));
  }
  return positions;
}

}  // namespace penumbra::detail
