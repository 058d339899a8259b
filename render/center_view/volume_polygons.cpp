#include "render/center_view/volume_polygons.h"

#include <cstdlib>

#include "penumbra/volumes/predicates/predicates.h"
#include "render/light/circle_around.h"

namespace penumbra::detail {
namespace {

bool is_within(const Bounds& box, const Vec3& p) {
  return box.low.x <= p.x && p.x <= box.high.x && box.low.y <= p.y && p.y <= box.high.y && box.low.z <= p.z &&
         p.z <= box.high.z;
}

/// 1 where the face is a cap as it is wound, -1 where it is one turned round, 0 where it is none.
std::vector<int> turns_of_caps(const TriangleMesh& mesh, const CircularLight& center) {
  const bool all = !mesh.is_closed() || (!center.is_distant() && is_within(mesh.bounds(), center.center));
  std::vector<int> turns;
  turns.reserve(mesh.triangles().size());
  for (const IndexedTriangle& t : mesh.triangles()) {
    const FaceClass side =
        classify_face(mesh.positions()[t[0]], mesh.positions()[t[1]], mesh.positions()[t[2]], center);
    turns.push_back(side == FaceClass::kAllFront ? 1 : side == FaceClass::kNoneFront && all ? -1 : 0);
  }
  return turns;
}

void add_object(const TriangleMesh& mesh, std::uint32_t object, const CircularLight& center,
                VolumePolygons& out) {
  const std::vector<int> turns = turns_of_caps(mesh, center);
  for (std::uint32_t f = 0; f < turns.size(); ++f) {
    if (turns[f] == 0) continue;
    const IndexedTriangle& t = mesh.triangles()[f];
    const Vec3 &a = mesh.positions()[t[0]], &b = mesh.positions()[t[1]], &c = mesh.positions()[t[2]];
    out.caps.push_back({turns[f] > 0 ? FaceCorners{a, b, c} : FaceCorners{b, a, c}, object, f});
  }
  for (const Edge& edge : mesh.edges()) {
    const int right = edge.is_boundary() ? 0 : turns[index(edge.right)];
    const int volumes = turns[index(edge.left)] - right;
    if (volumes == 0) continue;
    const Vec3 &from = mesh.position(edge.from), &to = mesh.position(edge.to);
    out.sides.push_back(volumes > 0 ? VolumeSide{from, to, volumes} : VolumeSide{to, from, -volumes});
  }
}

}  // namespace

VolumePolygons volume_polygons(const Scene& scene, const LightShape& light,
                               const std::vector<char>& left_out) {
  CircularLight center = circle_around(light);
  center.radius = 0.0;
  VolumePolygons out;
  for (std::uint32_t i = 0; i < scene.objects.size(); ++i) {
    const SceneObject& object = scene.objects[i];
    if (!object.casts || object.mesh.empty() || (!left_out.empty() && left_out[i] != 0)) continue;
    add_object(object.mesh, i, center, out);
    ++out.casters;
  }
  return out;
}

}  // namespace penumbra::detail
