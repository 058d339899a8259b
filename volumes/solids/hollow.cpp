#include "volumes/solids/hollow.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace penumbra::detail {
namespace {

constexpr int kBisections = 12;
constexpr double kLeast = 1.0 / 256;  ///< of an edge: vertices stay so far from its ends

bool holds(const Bounds& box, const Vec3& p) {
  for (int k = 0; k < 3; ++k)
    if (!(box.low[k] <= p[k] && p[k] <= box.high[k])) return false;
  return true;
}

}  // namespace

CasterBodies::CasterBodies(std::span<const TriangleMesh> casters)
    : tree_(casters, CircularLight(DistantLight{})) {
  for (const TriangleMesh& mesh : casters)
    for (const Component& component : mesh.components()) is_closed_.push_back(component.closed ? 1 : 0);
}

bool CasterBodies::hold(const Vec3& p) const {
  if (!holds(tree_.bounds(), p)) return false;
  const double far = 4.0 * tree_.bounds().radius();
  std::vector<Crossing> found;
  // Another way where the segment touches an edge. A point in a face's plane is in the face's way whichever
  // it is: then it is moved, by a hair first.
  constexpr int kExact = 8;
  for (int k = 0;; ++k) {
    bool clean = true;
    const Vec3 way = glm::normalize(Vec3(0.31 + 0.017 * k, 0.87, 0.23 - 0.029 * k));
    const Vec3 from = k < kExact ? p : p + std::ldexp(far, std::min(k - kExact, 30) - 50) * way;
    tree_.crossings(from, p + far * way, found, clean);
    if (!clean) continue;
    int sum = 0;
    for (const Crossing& c : found)
      if (is_closed_[tree_.faces()[c.face].component]) sum += c.sign;
    return sum != 0;
  }
}

void leave_out_bodies(SolidGrid& grid, CrossedEdges& edges, const SolidMeshRequest& request) {
  const CasterBodies bodies(request.casters);
  std::vector<char> in_body(grid.size(), 0);
  tbb::parallel_for(0u, static_cast<std::uint32_t>(grid.size()), [&](std::uint32_t v) {
    in_body[v] = grid.is_inside(v) && bodies.hold(grid.point(v)) ? 1 : 0;
  });
  for (std::uint32_t v = 0; v < in_body.size(); ++v)
    if (in_body[v]) grid.set_inside(v, false);
  edges.update(0.5, 0.0);
  std::vector<CrossedEdge>& all = edges.all();
  tbb::parallel_for(std::size_t{0}, all.size(), [&](std::size_t i) {
    if (!in_body[edges.outer_end(all[i])]) return;
    CrossedEdge e = all[i];
    double low = 0.0, high = 1.0;
    for (int round = 0; round < kBisections; ++round) {
      e.at = 0.5 * (low + high);
      (bodies.hold(edges.position(e)) ? high : low) = e.at;
    }
    all[i].at = std::clamp(request.region == ShadowRegion::kUmbra ? low : high, kLeast, 1.0 - kLeast);
  });
}

}  // namespace penumbra::detail
