#include <tbb/parallel_for.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "volumes/solids/carve.h"
#include "volumes/solids/shafts/hidden_proof.h"

namespace penumbra::detail {
namespace {

using Corners = std::array<Vec3, 3>;

// Speed. Triangles that share what is found of casters: at most so many, in a box of at most so many
// tolerances a side; fewer are proved one by one.
constexpr std::size_t kMostInGroup = 24, kFewestInGroup = 4;
constexpr double kGroupSize = 2.5;

Corners corners_of(const TriangleJudge::Surface& surface, std::size_t i) {
  const IndexedTriangle& t = surface.triangles[i];
  return {surface.positions[t[0]], surface.positions[t[1]], surface.positions[t[2]]};
}

std::array<Vec3, 8> corners_of(const Bounds& box) {
  std::array<Vec3, 8> out;
  for (unsigned i = 0; i < 8; ++i)
    out[i] = {i & 1 ? box.high.x : box.low.x, i & 2 ? box.high.y : box.low.y, i & 4 ? box.high.z : box.low.z};
  return out;
}

bool none_behind(const CircularLight& light, std::span<const Vec3> points) {
  return std::ranges::none_of(points, [&](const Vec3& p) { return is_behind(light, p); });
}

/// Triangles that follow one another and lie close together.
struct Group {
  std::size_t first = 0, count = 0;
  Bounds box;
};

/// Depends on the surface alone.
std::vector<Group> groups_of(const TriangleJudge::Surface& surface, double size) {
  std::vector<Group> out;
  for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
    Bounds box = out.empty() ? Bounds{} : out.back().box;
    const auto add = [&] {
      for (const Vec3& p : corners_of(surface, i)) box.add(p);
    };
    add();
    const Vec3 sides = box.high - box.low;
    if (out.empty() || out.back().count == kMostInGroup || std::max({sides.x, sides.y, sides.z}) > size) {
      box = {};
      add();
      out.push_back({i, 0, {}});
    }
    out.back().box = box;
    ++out.back().count;
  }
  return out;
}

}  // namespace

TriangleJudge::Faults TriangleJudge::try_points(const Surface& surface, const PointPattern& pattern,
                                                TrianglePoints::Known& known,
                                                std::size_t& evaluations) const {
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

std::vector<char> TriangleJudge::prove(const Surface& surface, const HiddenProof::Effort& effort) const {
  return request_.region == ShadowRegion::kUmbra ? prove_hidden(surface, effort) : prove_lit(surface);
}

std::vector<char> TriangleJudge::prove_hidden(const Surface& surface,
                                              const HiddenProof::Effort& effort) const {
  const std::vector<Group> groups = groups_of(surface, kGroupSize * request_.tolerance);
  std::vector<char> out(surface.triangles.size(), 0);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, groups.size(), 4), [&](const auto& range) {
    HiddenProof& proof = proofs_.local();
    for (std::size_t g = range.begin(); g < range.end(); ++g) {
      const Group& group = groups[g];
      const std::array<Vec3, 8> hull = corners_of(group.box);
      const bool serves = group.count >= kFewestInGroup && none_behind(request_.light, hull);
      proof.begin_group(std::span(hull).first(serves ? hull.size() : 0));
      for (std::size_t i = group.first; i < group.first + group.count; ++i) {
        const Corners c = corners_of(surface, i);
        out[i] = none_behind(request_.light, c) && proof.holds(c, effort) ? 1 : 0;
      }
    }
  });
  return out;
}

std::vector<char> TriangleJudge::prove_lit(const Surface& surface) const {
  const LightFrame frame = light_frame(request_.light);
  Bounds all = request_.bound;
  all.add(tree_.bounds());
  const double extent = 2.0 * all.radius();
  std::vector<char> out(surface.triangles.size(), 0);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, out.size(), 64), [&](const auto& range) {
    std::uint32_t likely = CasterTree::kNoFace;
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      const Corners c = corners_of(surface, i);
      out[i] = none_behind(request_.light, c) &&
                       tree_.is_clear(LightShaft(request_.light, frame, c, extent), likely)
                   ? 1
                   : 0;
    }
  });
  return out;
}

}  // namespace penumbra::detail
