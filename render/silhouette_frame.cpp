#include "render/silhouette_frame.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <array>
#include <compare>
#include <optional>

#include "volumes/detail/vectors.h"

namespace penumbra::detail {
namespace {

bool in_front(const Vec3& p) {
  return p.z > 0.0;
}

/// Where the segment meets z = 0; the same bits for both directions.
Vec3 cut(const Vec3& a, const Vec3& b) {
  const Vec3& front = in_front(a) ? a : b;
  const Vec3& back = in_front(a) ? b : a;
  const double t = front.z / (front.z - back.z);
  return {front.x + t * (back.x - front.x), front.y + t * (back.y - front.y), 0.0};
}

/// A caster under the light. Vertices are taken to the light's frame where they are needed, with the same
/// bits each time.
class LitCaster {
 public:
  LitCaster(const TriangleMesh& mesh, const UnitLight& light, double extent)
      : mesh_(mesh), to_frame_{light}, extent_(extent), box_(box_of(mesh.positions())) {}

  const Bounds& box() const { return box_; }
  bool all_in_front() const { return in_front(box_.low); }

  bool has_end_in_front(EdgeId id) const {
    const Edge& e = mesh_.edges[index(id)];
    return in_front(to_frame_(mesh_.positions[index(e.from)])) ||
           in_front(to_frame_(mesh_.positions[index(e.to)]));
  }

  BandEdge edge(EdgeId id) const {
    BandEdge e = mesh_.edge(id, to_frame_, extent_);
    const Vec3 a = e.a, b = e.b;
    if (!in_front(a)) e.a = cut(a, b);
    if (!in_front(b)) e.b = cut(a, b);
    return e;
  }

  /// Of the edge's faces those that cross the light's plane.
  void add_cut_faces(EdgeId id, std::vector<FaceId>& out) const {
    const Edge& e = mesh_.edges[index(id)];
    for (const FaceId face : {e.left, e.right}) {
      if (face == kNone<FaceId>) continue;
      const auto [a, b, c] = mesh_.corners(face, to_frame_);
      if (in_front(a) != in_front(b) || in_front(b) != in_front(c)) out.push_back(face);
    }
  }

  /// The front part of a face that crosses the light's plane ends where it leaves the front and begins again
  /// where it comes back.
  BandEdge cut_edge(FaceId face) const {
    const auto corners = mesh_.corners(face, to_frame_);
    BandEdge e{Vec3(0.0), Vec3(0.0), mesh_.plane(face, to_frame_, extent_), kNoFace};
    for (int k = 0; k < 3; ++k) {
      const Vec3 &p = corners[k], &q = corners[(k + 1) % 3];
      if (in_front(p) != in_front(q)) (in_front(p) ? e.a : e.b) = cut(p, q);
    }
    return e;
  }

 private:
  /// In the light's frame, on all cores.
  Bounds box_of(std::span<const Vec3> points) const {
    return tbb::parallel_reduce(
        tbb::blocked_range<std::size_t>(0, points.size(), 4096), Bounds{},
        [&](const auto& range, Bounds box) {
          for (std::size_t i = range.begin(); i < range.end(); ++i) {
            const Vec3 p = to_frame_(points[i]);
            box.low = glm::min(box.low, p);
            box.high = glm::max(box.high, p);
          }
          return box;
        },
        [](const Bounds& a, const Bounds& b) {
          return Bounds{glm::min(a.low, b.low), glm::max(a.high, b.high)};
        });
  }

  struct ToFrame {
    const UnitLight& light;
    Vec3 operator()(const Vec3& p) const { return light.point(p); }
  };

  MeshArrays mesh_;
  ToFrame to_frame_;
  double extent_;
  Bounds box_;
};

/// One place per object; none for those that do not cast.
using LitCasters = std::vector<std::optional<LitCaster>>;

struct CutFace {
  std::uint32_t object;
  FaceId face;
  auto operator<=>(const CutFace&) const = default;
};

/// Takes edges that lie behind the light's plane out; what is left of faces that cross it is bounded by the
/// faces that are returned. (A mixed face has all of its edges in the band.)
std::vector<CutFace> cut_at_light(const LitCasters& casters, std::vector<SceneEdge>& edges) {
  std::vector<CutFace> cuts;
  if (std::ranges::all_of(casters, [](const auto& c) { return !c || c->all_in_front(); })) return cuts;
  std::erase_if(edges, [&](const SceneEdge& e) {
    const LitCaster& caster = *casters[e.object];
    return !caster.all_in_front() && !caster.has_end_in_front(e.id);
  });
  std::vector<FaceId> faces;
  for (const SceneEdge& e : edges) {
    if (casters[e.object]->all_in_front()) continue;
    faces.clear();
    casters[e.object]->add_cut_faces(e.id, faces);
    for (const FaceId face : faces) cuts.push_back({e.object, face});
  }
  std::ranges::sort(cuts);
  cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
  return cuts;
}

/// Of the whole scene, receivers included.
double extent_of(const Scene& scene, const UnitLight& light) {
  const Bounds box = scene.bounds();
  double extent = 1.0;
  for (int corner = 0; corner < 8; ++corner)
    extent = std::max(extent, largest_component(light.point({corner & 1 ? box.high.x : box.low.x,
                                                             corner & 2 ? box.high.y : box.low.y,
                                                             corner & 4 ? box.high.z : box.low.z})));
  return extent;
}

}  // namespace

UnitLight::UnitLight(const DiskLight& light)
    : axes_(light_frame(light)),
      center_(light.center),
      across_(light.radius * axes_.u),
      up_(light.radius * axes_.v),
      per_radius_(1.0 / light.radius) {}

Band make_band(const Scene& scene, const UnitLight& light, const SceneEdges& scene_edges,
               std::span<const char> idle) {
  Band band;
  band.extent = extent_of(scene, light);
  LitCasters casters(scene.objects.size());
  for (std::size_t i = 0; i < casters.size(); ++i) {
    const SceneObject& object = scene.objects[i];
    if (!object.casts || object.mesh.empty() || (!idle.empty() && idle[i])) continue;
    casters[i].emplace(object.mesh, light, band.extent);
    band.casters.push_back(casters[i]->box());
    band.faces += object.mesh.triangles().size();
    band.mesh_edges += object.mesh.edges().size();
  }
  std::vector<SceneEdge> edges = scene_edges.band_of(scene.light, idle);
  const std::vector<CutFace> cuts = cut_at_light(casters, edges);
  band.cut_edges = cuts.size();
  band.edges = LargeArray<BandEdge>(edges.size() + cuts.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, edges.size(), 1024), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i)
      band.edges[i] = casters[edges[i].object]->edge(edges[i].id);
  });
  for (std::size_t i = 0; i < cuts.size(); ++i)
    band.edges[edges.size() + i] = casters[cuts[i].object]->cut_edge(cuts[i].face);
  return band;
}

}  // namespace penumbra::detail
