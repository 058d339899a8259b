#include "render/d_buffer/view/casters.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>

namespace penumbra::detail {
namespace {

bool is_caster(const SceneObject& object) {
  return object.casts && !object.mesh.empty();
}

std::uint32_t size_of(const auto& list) {
  return static_cast<std::uint32_t>(list.size());
}

}  // namespace

std::vector<DBufferCaster> find_casters(const Scene& scene) {
  std::vector<DBufferCaster> casters;
  for (std::uint32_t i = 0; i < scene.objects.size(); ++i)
    if (const SceneObject& object = scene.objects[i]; is_caster(object))
      casters.push_back({i, &object.mesh, VertexRings(object.mesh)});
  return casters;
}

std::vector<std::uint32_t> first_faces(const Scene& scene) {
  std::vector<std::uint32_t> out{0};
  for (const SceneObject& object : scene.objects)
    out.push_back(out.back() + size_of(object.mesh.triangles()));
  return out;
}

CasterTriangles caster_triangles(const Scene& scene) {
  CasterTriangles out;
  const std::vector<std::uint32_t> first_face = first_faces(scene);
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    if (!is_caster(scene.objects[i])) continue;
    const TriangleMesh& mesh = scene.objects[i].mesh;
    const std::uint32_t first_index = size_of(out.indices), first_point = size_of(out.points);
    out.points.insert(out.points.end(), mesh.positions().begin(), mesh.positions().end());
    for (const IndexedTriangle& t : mesh.triangles())
      for (const std::uint32_t v : t) out.indices.push_back(first_point + v);
    out.ranges.push_back({.first_face = first_face[i],
                          .first_index = first_index,
                          .index_count = size_of(out.indices) - first_index,
                          .first_point = first_point,
                          .point_count = size_of(mesh.positions()),
                          .closed = mesh.is_closed()});
  }
  return out;
}

CastersInLight casters_in_light(CasterTriangles& casters, const LightSpace& space) {
  CastersInLight out{std::vector<glm::dvec4>(casters.points.size(), glm::dvec4(0.0))};
  for (CasterRange& range : casters.ranges) {
    if (range.cannot_occlude) continue;
    const std::size_t begin = range.first_point, end = begin + range.point_count;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(begin, end, 4096), [&](const auto& part) {
      for (std::size_t i = part.begin(); i < part.end(); ++i)
        out.points[i] = space.homogeneous(casters.points[i]);
    });
    range.shows_only_fronts =
        range.closed && std::all_of(&out.points[begin], &out.points[begin] + range.point_count,
                                    [](const glm::dvec4& p) { return p.w > LightSpace::kNearWeight; });
  }
  return out;
}

std::vector<glm::vec4> drawn_points(const CastersInLight& casters, const LightSpace& windowed) {
  std::vector<glm::vec4> out(casters.points.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, out.size(), 4096), [&](const auto& part) {
    for (std::size_t i = part.begin(); i < part.end(); ++i)
      out[i] = glm::vec4(windowed.in_window(casters.points[i]));
  });
  return out;
}

}  // namespace penumbra::detail
