#include "render/silhouette_frame.h"

#include <tbb/parallel_for.h>

#include <glm/geometric.hpp>

#include "volumes/detail/vectors.h"
#include "volumes/silhouette.h"

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

/// One caster's vertices in the light's frame, and its part of the band.
class CasterBand {
 public:
  CasterBand(const TriangleMesh& mesh, const DiskLight& world, const UnitLight& light)
      : mesh_(mesh), classes_(classify_faces(mesh, world)), points_(mesh.positions().size()) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, points_.size(), 4096), [&](const auto& range) {
      for (std::size_t i = range.begin(); i < range.end(); ++i)
        points_[i] = light.point(mesh_.positions()[i]);
    });
  }

  Bounds box() const { return bounds_of(points_); }
  std::size_t mixed_faces() const { return classes_.mixed; }

  void append_to(Band& band) const {
    add_edges(find_silhouettes(mesh_, classes_).band, band);
    for (std::size_t f = 0; f < classes_.faces.size(); ++f)
      if (classes_.faces[f] == FaceClass::kMixed) add_cut(f, band);
  }

 private:
  const Vec3& point(VertexId v) const { return points_[index(v)]; }

  FacePlane plane_of(std::size_t face, double extent) const {
    const IndexedTriangle& t = mesh_.triangles()[face];
    const Vec3 a = points_[t[0]], e1 = points_[t[1]] - a, e2 = points_[t[2]] - a;
    const Vec3 normal = glm::cross(e1, e2);
    const double length = glm::length(normal);
    if (!(length > 0.0)) return {Vec3(0.0), 0.0, std::numeric_limits<double>::infinity()};
    const Vec3 n = normal / length;
    const double spread = (glm::length(e1) + glm::length(e2)) / length;
    return {n, -glm::dot(n, a), 0x1p-46 * extent * (1.0 + 4.0 * extent * spread)};
  }

  /// On all cores, in the order of `ids`.
  void add_edges(const std::vector<EdgeId>& ids, Band& band) const {
    constexpr std::size_t kBlock = 1024;
    std::vector<std::vector<BandEdge>> blocks((ids.size() + kBlock - 1) / kBlock);
    tbb::parallel_for(std::size_t{0}, blocks.size(), [&](std::size_t b) {
      for (std::size_t i = b * kBlock; i < std::min(ids.size(), (b + 1) * kBlock); ++i)
        add_edge(mesh_.edges()[index(ids[i])], band.extent, blocks[b]);
    });
    for (const auto& block : blocks) band.edges.insert(band.edges.end(), block.begin(), block.end());
  }

  void add_edge(const Edge& edge, double extent, std::vector<BandEdge>& out) const {
    Vec3 a = point(edge.from), b = point(edge.to);
    if (!in_front(a) && !in_front(b)) return;
    if (!in_front(a)) a = cut(a, b);
    if (!in_front(b)) b = cut(a, b);
    BandEdge e{a, b, plane_of(index(edge.left), extent), {}, !edge.is_boundary()};
    if (e.has_right) e.right = plane_of(index(edge.right), extent);
    out.push_back(e);
  }

  /// The front part of a face that crosses the light's plane ends where it leaves the front and begins again
  /// where it comes back.
  void add_cut(std::size_t face, Band& band) const {
    const IndexedTriangle& t = mesh_.triangles()[face];
    Vec3 leaves(0.0), returns(0.0);
    bool crosses = false;
    for (int k = 0; k < 3; ++k) {
      const Vec3 &a = points_[t[k]], &b = points_[t[(k + 1) % 3]];
      if (in_front(a) == in_front(b)) continue;
      crosses = true;
      (in_front(a) ? leaves : returns) = cut(a, b);
    }
    if (!crosses) return;
    band.edges.push_back({leaves, returns, plane_of(face, band.extent), {}, false});
    ++band.cut_edges;
  }

  const TriangleMesh& mesh_;
  Classification classes_;
  std::vector<Vec3> points_;
};

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

Vec3 UnitLight::direction(const Vec3& world) const {
  return {glm::dot(world, axes_.u), glm::dot(world, axes_.v), glm::dot(world, axes_.w)};
}

Band make_band(const Scene& scene, const UnitLight& light) {
  Band band;
  band.extent = extent_of(scene, light);
  std::vector<CasterBand> casters;
  for (const SceneObject& object : scene.objects) {
    if (!object.casts || object.mesh.empty()) continue;
    casters.emplace_back(object.mesh, scene.light, light);
    band.casters.push_back(casters.back().box());
    band.faces += object.mesh.triangles().size();
    band.mixed_faces += casters.back().mixed_faces();
    band.mesh_edges += object.mesh.edges().size();
  }
  for (const CasterBand& caster : casters) caster.append_to(band);
  return band;
}

}  // namespace penumbra::detail
