#include "render/silhouette_frame.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <numeric>

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

/// Of points 0 to count - 1, on all cores.
template <class PointAt>
Bounds box_of(std::size_t count, const PointAt& point_at) {
  return tbb::parallel_reduce(
      tbb::blocked_range<std::size_t>(0, count, 4096), Bounds{},
      [&](const auto& range, Bounds box) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
          const Vec3 p = point_at(i);
          box.low = glm::min(box.low, p);
          box.high = glm::max(box.high, p);
        }
        return box;
      },
      [](const Bounds& a, const Bounds& b) {
        return Bounds{glm::min(a.low, b.low), glm::max(a.high, b.high)};
      });
}

/// One caster's part of the band. Vertices are taken to the light's frame where they are needed, with the
/// same bits each time.
class CasterBand {
 public:
  CasterBand(const TriangleMesh& mesh, const DiskLight& world, const UnitLight& light)
      : mesh_(mesh), light_(light), classes_(classify_faces(mesh, world)) {
    box_ = box_of(mesh.positions().size(), [&](std::size_t i) { return light.point(mesh.positions()[i]); });
    find_edges();
    if (!in_front(box_.low)) find_cut_faces();
  }

  const Bounds& box() const { return box_; }
  std::size_t mixed_faces() const { return classes_.mixed; }
  const std::vector<EdgeId>& edges() const { return edges_; }
  const std::vector<std::uint32_t>& cut_faces() const { return cut_faces_; }

  /// Before it is cut.
  Vec3 middle(EdgeId id) const {
    const Edge& edge = mesh_.edges()[index(id)];
    return 0.5 * (point(edge.from) + point(edge.to));
  }

  BandEdge band_edge(EdgeId id, double extent) const {
    const Edge& edge = mesh_.edges()[index(id)];
    Vec3 a = point(edge.from), b = point(edge.to);
    if (!in_front(a)) a = cut(a, b);
    if (!in_front(b)) b = cut(a, b);
    const bool has_right = !edge.is_boundary();
    return {a, b, plane_of(index(edge.left), extent),
            has_right ? plane_of(index(edge.right), extent) : kNoFace, has_right};
  }

  /// The front part of a face that crosses the light's plane ends where it leaves the front and begins again
  /// where it comes back.
  BandEdge cut_edge(std::uint32_t face, double extent) const {
    const auto corners = corners_of(face);
    BandEdge e{Vec3(0.0), Vec3(0.0), plane_of(face, extent), kNoFace, false};
    for (int k = 0; k < 3; ++k) {
      const Vec3 &p = corners[k], &q = corners[(k + 1) % 3];
      if (in_front(p) != in_front(q)) (in_front(p) ? e.a : e.b) = cut(p, q);
    }
    return e;
  }

 private:
  Vec3 point(VertexId v) const { return light_.point(mesh_.position(v)); }

  std::array<Vec3, 3> corners_of(std::size_t face) const {
    const IndexedTriangle& t = mesh_.triangles()[face];
    return {light_.point(mesh_.positions()[t[0]]), light_.point(mesh_.positions()[t[1]]),
            light_.point(mesh_.positions()[t[2]])};
  }

  FacePlane plane_of(std::size_t face, double extent) const {
    const auto [a, b, c] = corners_of(face);
    const Vec3 e1 = b - a, e2 = c - a, normal = glm::cross(e1, e2);
    const double length = glm::length(normal);
    if (!(length > 0.0)) return {Vec3(0.0), 0.0, std::numeric_limits<double>::infinity()};
    const Vec3 n = normal / length;
    const double spread = (glm::length(e1) + glm::length(e2)) / length;
    return {n, -glm::dot(n, a), 0x1p-46 * extent * (1.0 + 4.0 * extent * spread)};
  }

  /// Those with an end in front, ascending.
  void find_edges() {
    const bool all_in_front = in_front(box_.low);
    const auto edges = mesh_.edges();
    constexpr std::size_t kRun = 8192;
    std::vector<std::vector<EdgeId>> runs((edges.size() + kRun - 1) / kRun);
    tbb::parallel_for(std::size_t{0}, runs.size(), [&](std::size_t run) {
      for (std::size_t i = run * kRun; i < std::min(edges.size(), (run + 1) * kRun); ++i)
        if (is_in_band(edges[i], classes_) &&
            (all_in_front || in_front(point(edges[i].from)) || in_front(point(edges[i].to))))
          runs[run].push_back(EdgeId{static_cast<std::uint32_t>(i)});
    });
    for (const auto& run : runs) edges_.insert(edges_.end(), run.begin(), run.end());
  }

  void find_cut_faces() {
    for (std::uint32_t f = 0; f < classes_.faces.size(); ++f) {
      if (classes_.faces[f] != FaceClass::kMixed) continue;
      const auto [a, b, c] = corners_of(f);
      if (in_front(a) != in_front(b) || in_front(b) != in_front(c)) cut_faces_.push_back(f);
    }
  }

  const TriangleMesh& mesh_;
  const UnitLight& light_;
  Classification classes_;
  Bounds box_;
  std::vector<EdgeId> edges_;
  std::vector<std::uint32_t> cut_faces_;
};

constexpr int kCodeBits = 13;  // an axis

/// Numbers of kCodeBits with two free bits after each of theirs.
std::uint64_t spread_bits(std::uint64_t x) {
  x = (x | x << 16) & 0x0000ff0000ff;
  x = (x | x << 8) & 0x00f00f00f00f;
  x = (x | x << 4) & 0x0c30c30c30c3;
  return (x | x << 2) & 0x249249249249;
}

/// Whatever lies outside of the box counts as on its sides.
std::uint64_t morton_code(const Vec3& p, const Bounds& box) {
  std::uint64_t code = 0;
  for (int k = 0; k < 3; ++k) {
    const double size = box.high[k] - box.low[k];
    const double t = size > 0.0 ? std::clamp((p[k] - box.low[k]) / size, 0.0, 1.0) : 0.0;
    code |= spread_bits(static_cast<std::uint64_t>(t * ((1 << kCodeBits) - 1))) << k;
  }
  return code;
}

/// Indices in the order of codes, equal ones ascending, by three passes over a third of the bits each.
std::vector<std::uint32_t> sorted_by(const std::vector<std::uint64_t>& codes) {
  constexpr std::uint64_t kMask = (1 << kCodeBits) - 1;
  std::vector<std::uint32_t> order(codes.size()), next(codes.size());
  std::iota(order.begin(), order.end(), 0u);
  for (int pass = 0; pass < 3; ++pass) {
    const auto digit = [&](std::uint64_t code) { return code >> pass * kCodeBits & kMask; };
    std::vector<std::uint32_t> start(kMask + 2);
    for (const std::uint64_t code : codes) ++start[digit(code) + 1];
    std::partial_sum(start.begin(), start.end(), start.begin());
    for (const std::uint32_t i : order) next[start[digit(codes[i])]++] = i;
    std::swap(order, next);
  }
  return order;
}

/// All casters' edges, as they come.
class Unsorted {
 public:
  explicit Unsorted(const std::vector<CasterBand>& casters) : casters_(casters) {
    for (const CasterBand& c : casters) {
      starts_.push_back(size_);
      size_ += c.edges().size() + c.cut_faces().size();
    }
  }
  std::size_t size() const { return size_; }
  Vec3 middle(std::size_t i) const {
    const auto [caster, at] = place(i);
    return at < caster.edges().size() ? caster.middle(caster.edges()[at]) : Vec3(0.0);
  }
  BandEdge edge(std::size_t i, double extent) const {
    const auto [caster, at] = place(i);
    const std::size_t edges = caster.edges().size();
    return at < edges ? caster.band_edge(caster.edges()[at], extent)
                      : caster.cut_edge(caster.cut_faces()[at - edges], extent);
  }

 private:
  std::pair<const CasterBand&, std::size_t> place(std::size_t i) const {
    const auto next = std::upper_bound(starts_.begin(), starts_.end(), i);
    const auto caster = static_cast<std::size_t>(next - starts_.begin()) - 1;
    return {casters_[caster], i - starts_[caster]};
  }

  const std::vector<CasterBand>& casters_;
  std::vector<std::size_t> starts_;
  std::size_t size_ = 0;
};

/// Runs body(i) for 0 to count - 1 on all cores.
template <class Body>
void for_each_index(std::size_t count, const Body& body) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 1024), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) body(i);
  });
}

void fill_along_curve(const Unsorted& unsorted, Band& band) {
  LargeArray<Vec3> middles(unsorted.size());
  const Bounds box = box_of(middles.size(), [&](std::size_t i) { return middles[i] = unsorted.middle(i); });
  std::vector<std::uint64_t> codes(middles.size());
  for_each_index(codes.size(), [&](std::size_t i) { codes[i] = morton_code(middles[i], box); });
  const std::vector<std::uint32_t> order = sorted_by(codes);
  band.edges = LargeArray<BandEdge>(order.size());
  for_each_index(order.size(), [&](std::size_t i) { band.edges[i] = unsorted.edge(order[i], band.extent); });
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

Band make_band(const Scene& scene, const UnitLight& light, std::span<const char> idle) {
  Band band;
  band.extent = extent_of(scene, light);
  std::vector<CasterBand> casters;
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const SceneObject& object = scene.objects[i];
    if (!object.casts || object.mesh.empty() || (!idle.empty() && idle[i])) continue;
    casters.emplace_back(object.mesh, scene.light, light);
    band.casters.push_back(casters.back().box());
    band.faces += object.mesh.triangles().size();
    band.mixed_faces += casters.back().mixed_faces();
    band.mesh_edges += object.mesh.edges().size();
    band.cut_edges += casters.back().cut_faces().size();
  }
  fill_along_curve(Unsorted(casters), band);
  return band;
}

}  // namespace penumbra::detail
