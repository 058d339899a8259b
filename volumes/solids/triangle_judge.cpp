#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "volumes/solids/carve.h"
#include "volumes/solids/shafts/hidden_proof.h"

namespace penumbra::detail {
namespace {

constexpr std::uint8_t kAll = 7;

using Corners = std::array<Vec3, 3>;

Corners corners_of(const TriangleJudge::Surface& surface, std::size_t i) {
  const IndexedTriangle& t = surface.triangles[i];
  return {surface.positions[t[0]], surface.positions[t[1]], surface.positions[t[2]]};
}

}  // namespace

TriangleJudge::Faults TriangleJudge::try_middles(const Surface& surface, TrianglePoints::Known& known,
                                                 std::size_t& evaluations) const {
  const PointPattern pattern = middle_points();
  const TrianglePoints points(surface.positions, surface.triangles, pattern, known);
  const std::vector<float> seen = request_.judge(points.points());
  evaluations += seen.size();
  Faults out(surface.triangles.size());
  tbb::parallel_for(std::size_t{0}, out.size(), [&](std::size_t i) {
    const auto has_fault = [&](std::size_t p) { return seen[p] != 0.0f; };
    out[i] = points.corners_near_faults(i, has_fault);
    known[i] = static_cast<std::uint8_t>(TrianglePoints::kWhole & ~points.faults(i, has_fault));
  });
  return out;
}

std::vector<char> TriangleJudge::prove(const Surface& surface, int depth) const {
  const LightFrame frame = light_frame(request_.light);
  Bounds all = request_.bound;
  all.add(tree_.bounds());
  const double extent = 2.0 * all.radius();
  const bool umbra = request_.region == ShadowRegion::kUmbra;
  tbb::enumerable_thread_specific<HiddenProof> proofs([&] { return HiddenProof(tree_, request_.light); });
  std::vector<char> out(surface.triangles.size(), 0);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, out.size(), 64), [&](const auto& range) {
    std::uint32_t likely = CasterTree::kNoFace;
    HiddenProof& proof = proofs.local();
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      const Corners c = corners_of(surface, i);
      if (std::ranges::any_of(c, [&](const Vec3& p) { return is_behind(request_.light, p); })) continue;
      out[i] = (umbra ? proof.holds(c, depth)
                      : tree_.is_clear(LightShaft(request_.light, frame, c, extent), likely))
                   ? 1
                   : 0;
    }
  });
  return out;
}

TriangleJudge::Faults TriangleJudge::try_proofs(const Surface& surface, std::span<const Vec3> grown,
                                                int parts, std::size_t& evaluations) const {
  const std::vector<char> proved = prove(surface, 0);
  Faults out(proved.size(), 0);
  std::vector<std::size_t> asked;
  std::vector<IndexedTriangle> triangles;
  for (std::size_t i = 0; i < proved.size(); ++i) {
    if (proved[i]) continue;
    asked.push_back(i);
    triangles.push_back(surface.triangles[i]);
  }
  if (request_.region == ShadowRegion::kPenumbra) {
    for (const std::size_t i : asked) out[i] = kAll;
    return out;
  }
  const PointPattern pattern = lattice_points(parts);
  const TrianglePoints points(grown, triangles, pattern);
  const std::vector<float> seen = request_.judge(points.points());
  evaluations += seen.size();
  tbb::parallel_for(std::size_t{0}, asked.size(), [&](std::size_t a) {
    out[asked[a]] = points.corners_near_faults(a, [&](std::size_t p) { return seen[p] != 0.0f; });
  });
  return out;
}

}  // namespace penumbra::detail
