#include "render/plan/sample/seen_edges.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <limits>
#include <utility>

#include "render/support/vector_clones.h"

namespace penumbra::detail {
namespace {

// As the silhouette method merges: faces of casters that have so many; and the length of what is left, light
// radii, about.
constexpr std::size_t kFine = 1024;
constexpr double kLong = 0.1;

/// Calls visit(mesh, i) for `count` of the items of all casters that may reach, of which each has
/// `items(mesh)`, or for all where there are no more. Returns how many items one of these stands for.
template <class Items, class Visit>
double visit_some(const Scene& objects, std::span<const CasterFacts> casters, std::size_t count,
                  const Items& items, const Visit& visit) {
  std::size_t all = 0;
  for (const CasterFacts& caster : casters)
    if (caster.reach == CasterReach::kMayReach) all += items(objects.objects[caster.object].mesh);
  const std::size_t some = std::min(all, count);
  std::size_t before = 0, k = 0;
  for (const CasterFacts& caster : casters) {
    if (caster.reach != CasterReach::kMayReach) continue;
    const TriangleMesh& mesh = objects.objects[caster.object].mesh;
    const std::size_t here = items(mesh);
    for (; k < some; ++k) {
      const std::size_t at = (2 * k + 1) * all / (2 * some);
      if (at >= before + here) break;
      visit(mesh, at - before);
    }
    before += here;
  }
  return some > 0 ? static_cast<double>(all) / static_cast<double>(some) : 1.0;
}

/// A receiver x in the light's frame. What lies at p projects to (a h + c (p - x)) / h with h = x.w - p.w, so
/// it is beside the disk where one of four linear functions of p is above 0, a h + c (p - x) ∓ r h. Two more
/// are above 0 behind x and behind the light.
struct Seer {
  Vec3 x;
  double radius;
  /// a and c: of a distant light 0 and 1.
  double u, v, scale;
  bool distant;

  /// The functions as planes, normal·(p - x) + offset.
  struct Plane {
    Vec3 normal;
    double offset;
  };
  std::array<Plane, 6> planes() const {
    const auto side = [&](int axis, double sign) {
      Vec3 normal(0.0);
      normal[axis] = sign * scale;
      normal.z = radius - sign * (axis == 0 ? u : v);  // h = -(p - x).w
      return Plane{normal, 0.0};
    };
    return {side(0, 1.0),           side(0, -1.0),
            side(1, 1.0),           side(1, -1.0),
            {{0.0, 0.0, 1.0}, 0.0}, distant ? Plane{{0.0, 0.0, 0.0}, -1.0} : Plane{{0.0, 0.0, -1.0}, -x.z}};
  }
};

bool misses(const std::array<Seer::Plane, 6>& planes, const Vec3& x, const Bounds& box) {
  const Vec3 middle = box.center() - x, half = 0.5 * (box.high - box.low);
  return std::ranges::any_of(planes, [&](const Seer::Plane& plane) {
    return glm::dot(plane.normal, middle) + plane.offset > glm::dot(glm::abs(plane.normal), half);
  });
}

/// The same planes for points that are relative to a place near the edges; x, too.
struct FloatPlanes {
  float x[3];
  std::array<std::array<float, 4>, 6> planes;
};

/// 1 for each of `count` edges from `first` that may be a silhouette across the disk: its faces' planes have
/// x on different sides, and none of six planes has all of it on the wrong one. Homogeneous, so that ends
/// behind x need no case of their own.
PENUMBRA_VECTOR_CLONES
void find_across(const EdgeColumns& edges, std::size_t first, std::size_t count, const FloatPlanes& seer,
                 std::int32_t* across) {
  const float *fu = edges.from[0].data() + first, *fv = edges.from[1].data() + first,
              *fw = edges.from[2].data() + first, *tu = edges.to[0].data() + first,
              *tv = edges.to[1].data() + first, *tw = edges.to[2].data() + first;
  const float *la = edges.left[0].data() + first, *lb = edges.left[1].data() + first,
              *lc = edges.left[2].data() + first, *ld = edges.left[3].data() + first,
              *ra = edges.right[0].data() + first, *rb = edges.right[1].data() + first,
              *rc = edges.right[2].data() + first, *rd = edges.right[3].data() + first;
  const float xu = seer.x[0], xv = seer.x[1], xw = seer.x[2];
  for (std::size_t i = 0; i < count; ++i) {
    const bool on_left = la[i] * xu + lb[i] * xv + lc[i] * xw + ld[i] > 0.0f;
    const bool on_right = ra[i] * xu + rb[i] * xv + rc[i] * xw + rd[i] > 0.0f;
    across[i] = on_left != on_right ? 1 : 0;
  }
  for (const auto& [a, b, c, d] : seer.planes)
    for (std::size_t i = 0; i < count; ++i) {
      const bool from = a * fu[i] + b * fv[i] + c * fw[i] + d > 0.0f;
      const bool to = a * tu[i] + b * tv[i] + c * tw[i] + d > 0.0f;
      across[i] = from && to ? 0 : across[i];
    }
}

PENUMBRA_INLINE double smaller(double a, double b) {
  return a < b ? a : b;
}
PENUMBRA_INLINE double larger(double a, double b) {
  return a > b ? a : b;
}

/// How many boxes the segment, or the ray, from x meets.
PENUMBRA_VECTOR_CLONES
std::int64_t count_boxes(const BoxColumns& boxes, const Vec3& x, const Vec3& inverse, double farthest) {
  const double *lx = boxes.low[0].data(), *ly = boxes.low[1].data(), *lz = boxes.low[2].data(),
               *hx = boxes.high[0].data(), *hy = boxes.high[1].data(), *hz = boxes.high[2].data();
  const std::size_t size = boxes.low[0].size();
  const double x0 = x.x, x1 = x.y, x2 = x.z, i0 = inverse.x, i1 = inverse.y, i2 = inverse.z;
  std::int64_t count = 0;
  for (std::size_t i = 0; i < size; ++i) {
    const double ax = (lx[i] - x0) * i0, bx = (hx[i] - x0) * i0;
    const double ay = (ly[i] - x1) * i1, by = (hy[i] - x1) * i1;
    const double az = (lz[i] - x2) * i2, bz = (hz[i] - x2) * i2;
    const double first = larger(larger(smaller(ax, bx), smaller(ay, by)), larger(smaller(az, bz), 0.0));
    const double last = smaller(smaller(larger(ax, bx), larger(ay, by)), smaller(larger(az, bz), farthest));
    count += first <= last ? 1 : 0;
  }
  return count;
}

}  // namespace

EdgeSample::EdgeSample(const Scene& objects, const CircularLight& light, std::span<const CasterFacts> casters,
                       std::size_t count)
    : light_(light), axes_(light_frame(light)) {
  std::vector<std::pair<const TriangleMesh*, std::size_t>> some;
  each_stands_for_ = visit_some(
      objects, casters, count, [](const TriangleMesh& mesh) { return mesh.edges().size(); },
      [&](const TriangleMesh& mesh, std::size_t i) { some.emplace_back(&mesh, i); });
  edges_.resize(some.size());
  tbb::parallel_for(std::size_t{0}, some.size(), [&](std::size_t k) {
    edges_[k] = seen(*some[k].first, some[k].first->edges()[some[k].second]);
  });
  for (const Seen& edge : edges_) band_ += is_in_band(edge) ? 1 : 0;
  fill_columns();
}

void EdgeSample::fill_columns() {
  if (edges_.empty()) return;
  origin_ = edges_.front().from;
  groups_.resize((edges_.size() + kGroup - 1) / kGroup);
  for (auto* ends : {&columns_.from, &columns_.to})
    for (std::vector<float>& column : *ends) column.resize(edges_.size());
  for (auto* planes : {&columns_.left, &columns_.right})
    for (std::vector<float>& column : *planes) column.resize(edges_.size());
  for (std::size_t i = 0; i < edges_.size(); ++i) {
    const Seen& edge = edges_[i];
    groups_[i / kGroup].add(edge.from);
    groups_[i / kGroup].add(edge.to);
    const Vec3 from = edge.from - origin_, to = edge.to - origin_;
    for (int k = 0; k < 3; ++k) {
      const auto at = static_cast<std::size_t>(k);
      columns_.from[at][i] = static_cast<float>(from[k]);
      columns_.to[at][i] = static_cast<float>(to[k]);
      columns_.left[at][i] = static_cast<float>(edge.normals[0][k]);
      columns_.right[at][i] = static_cast<float>(edge.normals[1][k]);
    }
    const auto offset = [&](std::size_t k) {
      return static_cast<float>(edge.is_boundary ? edge.offsets[k] : -glm::dot(edge.normals[k], from));
    };
    columns_.left[3][i] = offset(0);
    columns_.right[3][i] = offset(1);
  }
}

EdgeSample::Seen EdgeSample::seen(const TriangleMesh& mesh, const Edge& edge) const {
  Seen out{.from = in_frame(mesh.position(edge.from)), .to = in_frame(mesh.position(edge.to))};
  if (edge.is_boundary()) return out;
  out.is_boundary = false;
  out.may_merge = mesh.triangles().size() >= kFine;
  const auto set_plane = [&](std::size_t k, VertexId apex, const Vec3& along) {
    out.normals[k] = glm::cross(along, in_frame(mesh.position(apex)) - out.from);
    out.offsets[k] = -glm::dot(out.normals[k], out.from);
  };
  set_plane(0, edge.left_apex, out.to - out.from);
  set_plane(1, edge.right_apex, out.from - out.to);
  return out;
}

Vec3 EdgeSample::in_frame(const Vec3& world) const {
  const Vec3 p = light_.is_distant() ? world : world - light_.center;
  return {glm::dot(p, axes_.u), glm::dot(p, axes_.v), glm::dot(p, axes_.w)};
}

bool EdgeSample::is_in_band(const Seen& edge) const {
  if (edge.is_boundary) return true;
  // The plane's height over the light's center, and by how much it changes over the light.
  const auto side = [&](std::size_t k) {
    const Vec3& n = edge.normals[k];
    const double over = light_.is_distant() ? n.z : edge.offsets[k],
                 change = light_.radius * std::hypot(n.x, n.y);
    return over > change ? 1 : over < -change ? -1 : 0;
  };
  return side(0) == 0 || side(0) != side(1);
}

EdgeSample::Crossing EdgeSample::crossing(const Vec3& world) const {
  const Vec3 x = in_frame(world), near = x - origin_;
  const bool distant = light_.is_distant();
  const auto planes = Seer{.x = x,
                           .radius = light_.radius,
                           .u = distant ? 0.0 : x.x,
                           .v = distant ? 0.0 : x.y,
                           .scale = distant ? 1.0 : x.z,
                           .distant = distant}
                          .planes();
  FloatPlanes in_float{};
  for (int k = 0; k < 3; ++k) in_float.x[k] = static_cast<float>(near[k]);
  for (std::size_t k = 0; k < planes.size(); ++k) {
    const Vec3& n = planes[k].normal;
    in_float.planes[k] = {static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z),
                          static_cast<float>(planes[k].offset - glm::dot(n, near))};
  }
  Crossing out;
  alignas(64) std::array<std::int32_t, kGroup> across;
  for (std::size_t group = 0; group < groups_.size(); ++group) {
    if (misses(planes, x, groups_[group])) continue;
    const std::size_t first = group * kGroup, count = std::min(kGroup, edges_.size() - first);
    find_across(columns_, first, count, in_float, across.data());
    for (std::size_t i = 0; i < count; ++i)
      if (across[i] != 0) add(edges_[first + i], x, out);
  }
  return out;
}

void EdgeSample::add(const Seen& edge, const Vec3& x, Crossing& out) const {
  const double length = length_across(edge, x);
  if (!(length > 0.0)) return;
  out.edges += each_stands_for_;
  out.length += each_stands_for_ * length;
  out.merged += each_stands_for_ * (edge.may_merge ? std::min(1.0, length / kLong) : 1.0);
}

/// The part of the edge that lies between x and the light is projected from x onto the disk.
double EdgeSample::length_across(const Seen& edge, const Vec3& x) const {
  const bool distant = light_.is_distant();
  const double low = distant ? -std::numeric_limits<double>::infinity() : 0.0;
  const double high = x.z - 1e-9 * (std::abs(x.z) + glm::length(edge.to - edge.from));
  // Clipped to depths that count.
  double first = 0.0, last = 1.0;
  const double rise = edge.to.z - edge.from.z;
  for (const auto& [limit, sign] : {std::pair{low, -1.0}, std::pair{high, 1.0}}) {
    const double over = sign * (edge.from.z - limit), change = sign * rise;  // over + t change ≤ 0
    if (change > 0.0)
      last = std::min(last, -over / change);
    else if (change < 0.0)
      first = std::max(first, -over / change);
    else if (over > 0.0)
      return 0.0;
  }
  if (!(first < last)) return 0.0;
  const auto project = [&](double t) {
    const Vec3 p = edge.from + t * (edge.to - edge.from);
    const glm::dvec2 way = glm::dvec2(p - x) / (x.z - p.z);
    return (distant ? way : glm::dvec2(x) + way * x.z) / light_.radius;
  };
  const glm::dvec2 a = project(first), d = project(last) - a;
  const double t = std::clamp(-glm::dot(a, d) / std::max(glm::dot(d, d), 1e-300), 0.0, 1.0);
  const glm::dvec2 nearest = a + t * d;
  return glm::dot(nearest, nearest) < 1.0 ? std::min(2.0, glm::length(d)) : 0.0;
}

FaceSample::FaceSample(const Scene& objects, std::span<const CasterFacts> casters, std::size_t count) {
  each_stands_for_ = visit_some(
      objects, casters, count, [](const TriangleMesh& mesh) { return mesh.triangles().size(); },
      [&](const TriangleMesh& mesh, std::size_t i) {
        Bounds box;
        for (const std::uint32_t v : mesh.triangles()[i]) box.add(mesh.positions()[v]);
        for (int k = 0; k < 3; ++k) {
          boxes_.low[static_cast<std::size_t>(k)].push_back(box.low[k]);
          boxes_.high[static_cast<std::size_t>(k)].push_back(box.high[k]);
        }
      });
}

double FaceSample::boxes_on(const Vec3& x, const Vec3& way, bool endless) const {
  const double farthest = endless ? std::numeric_limits<double>::infinity() : 1.0;
  return static_cast<double>(count_boxes(boxes_, x, 1.0 / way, farthest)) * each_stands_for_;
}

}  // namespace penumbra::detail
