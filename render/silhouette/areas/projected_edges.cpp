#include "render/silhouette/areas/projected_edges.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

#include "render/silhouette/areas/disk_part.h"
#include "render/support/vector_clones.h"

namespace penumbra::detail {
namespace {

// Speed.
/// So few edges are projected one by one, since vectors would not be filled. Seen in the benchmark
/// `silhouette`.
constexpr std::size_t kFewEdges = 6;

/// How a projected edge lies.
enum State : std::int64_t {
  /// Beyond the margin of the certificate.
  kFar,
  /// Near, and wholly below the horizon.
  kBelow,
  /// Near, and partly above the horizon.
  kCrosses,
  /// Both ends lie in the disk and above the horizon.
  kInside,
  /// An end does not lie below the receiver, or lies very close to it.
  kUnclear
};

/// The receiver, its horizon, how close an end is too close, and (1 + slack)².
struct Eye {
  double x, y, z, close, reach2, horizon_x, horizon_y, horizon_delta;
};

/// Projects edges by their places, and tells how they lie. The ends of the edge at place i are the six
/// numbers from ends[stride · i] on.
PENUMBRA_VECTOR_CLONES
void project(const double* ends, std::int32_t stride, const std::int32_t* places, int count, const Eye& eye,
             double* __restrict ax, double* __restrict ay, double* __restrict bx, double* __restrict by,
             std::int64_t* __restrict states) {
  const Eye e = eye;
  for (int i = 0; i < count; ++i) {
    const std::int32_t at = stride * places[i];
    const double wa = e.z - ends[at + 2], wb = e.z - ends[at + 5];
    const double ga = e.z / wa, gb = e.z / wb;
    const double pdx = ends[at] - e.x, pdy = ends[at + 1] - e.y;
    const double qdx = ends[at + 3] - e.x, qdy = ends[at + 4] - e.y;
    const double px = e.x + pdx * ga, py = e.y + pdy * ga;
    const double qx = e.x + qdx * gb, qy = e.y + qdy * gb;
    const double p2 = px * px + py * py, q2 = qx * qx + qy * qy;
    const double sx = qx - px, sy = qy - py;
    const bool p_in = p2 < 1.0, q_in = q2 < 1.0;
    const bool near =
        p_in | q_in | comes_near(p2, q2, sx * sx + sy * sy, px * sx + py * sy, px * sy - py * sx, e.reach2);
    const bool p_above = e.horizon_x * px + e.horizon_y * py + e.horizon_delta > 0.0;
    const bool q_above = e.horizon_x * qx + e.horizon_y * qy + e.horizon_delta > 0.0;
    const double p_beside = std::abs(pdx) + std::abs(pdy), q_beside = std::abs(qdx) + std::abs(qdy);
    const bool below = (wa > kLeastBelow * p_beside) & (wb > kLeastBelow * q_beside) &
                       (wa + p_beside > e.close) & (wb + q_beside > e.close);
    const std::int64_t state = near ? ((p_in & q_in & p_above & q_above) ? kInside
                                       : (p_above | q_above)             ? kCrosses
                                                                         : kBelow)
                                    : kFar;
    ax[i] = px, ay[i] = py, bx[i] = qx, by[i] = qy;
    states[i] = below ? state : kUnclear;
  }
}

/// Adds one edge by the definition, for those that `project` or the edge test left open.
void add_projection(const BandEdge& edge, const Vec3& x, const Chord& horizon, const Rounding& rounding,
                    ProjectedEdges& out) {
  const Projection p = project_edge(edge, x, rounding);
  if (!p.near) return;
  out.certain = false;
  if (!(height(horizon, p.segment.a) > 0.0) && !(height(horizon, p.segment.b) > 0.0)) return;
  out.crossing.push_back(p.segment);
}

/// The edges that passed the edge test: in vectors, and then one by one what is still open.
template <class EdgeAt>
void project_tested(const TestedEdges& tested, const double* ends, std::int32_t stride, const EdgeAt& edge_at,
                    const Vec3& x, const Chord& horizon, const Rounding& rounding, ProjectedEdges& out) {
  const std::size_t count = tested.count;
  for (auto& column : out.ends) column.resize(std::max(column.size(), count));
  out.states.resize(std::max(out.states.size(), count));
  out.segments.resize(count);
  const double reach = 1.0 + rounding.slack;
  const double *ax = out.ends[0].data(), *ay = out.ends[1].data(), *bx = out.ends[2].data(),
               *by = out.ends[3].data();
  project(ends, stride, tested.places.data(), static_cast<int>(count),
          {x.x, x.y, x.z, 2.0 * kTooClose * rounding.extent, reach * reach, horizon.normal.x,
           horizon.normal.y, horizon.delta},
          out.ends[0].data(), out.ends[1].data(), out.ends[2].data(), out.ends[3].data(), out.states.data());

  // Segments inside first, then the others.
  std::size_t inside = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::int64_t state = out.states[i];
    const std::int32_t jump = tested.jumps[i];
    const bool sure = jump != TestedEdges::kUnsure;
    out.segments[inside] = {{ax[i], ay[i]}, {bx[i], by[i]}, jump};
    if (state == kInside && sure) {
      ++inside;
      continue;
    }
    if (state == kFar) continue;
    if (state == kUnclear || !sure) {
      add_projection(edge_at(tested.places[i]), x, horizon, rounding, out);
    } else {
      out.certain = false;
      if (state == kCrosses) out.crossing.push_back(out.segments[inside]);
    }
  }
  out.inside = inside;
  out.certain = out.certain && inside == 0;
  out.segments.resize(inside);
  out.segments.insert(out.segments.end(), out.crossing.begin(), out.crossing.end());
}

}  // namespace

void ProjectedEdges::clear() {
  segments.clear();
  inside = 0;
  certain = true;
  crossing.clear();
}

void project_edges(const EdgeList& list, const Vec3& x, const Chord& horizon, const Rounding& rounding,
                   ProjectedEdges& out) {
  out.clear();
  if (list.size() <= kFewEdges) {
    for (std::size_t i = 0; i < list.size(); ++i)
      add_projection(list.edge(list.place(i)), x, horizon, rounding, out);
    std::swap(out.segments, out.crossing);
    return;
  }
  test_edges(list, x, out.tested);
  project_tested(
      out.tested, list.ends(), 6, [&](std::int32_t place) -> const BandEdge& { return list.edge(place); }, x,
      horizon, rounding, out);
}

void project_edges(const Band& band, const TestedEdges& tested, const Vec3& x, const Chord& horizon,
                   const Rounding& rounding, ProjectedEdges& out) {
  static_assert(offsetof(BandEdge, b) == 3 * sizeof(double) && sizeof(BandEdge) % sizeof(double) == 0);
  constexpr std::int32_t kStride = sizeof(BandEdge) / sizeof(double);
  out.clear();
  if (tested.count == 0) return;
  for (std::size_t i = 0; i < tested.count; ++i)
    __builtin_prefetch(&band.edges[static_cast<std::size_t>(tested.places[i])]);
  project_tested(
      tested, &band.edges[0].a.x, kStride,
      [&](std::int32_t place) -> const BandEdge& { return band.edges[static_cast<std::size_t>(place)]; }, x,
      horizon, rounding, out);
}

}  // namespace penumbra::detail
