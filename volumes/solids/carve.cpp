#include "volumes/solids/carve.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <glm/geometric.hpp>

#include "volumes/solids/hidden_proof.h"

namespace penumbra::detail {
namespace {

/// The first pull, of an edge. Each next one is twice as far.
constexpr double kFirstPull = 1.0 / 64;
/// Where an edge begins that is crossed since a grid point changed sides: so far from that point.
constexpr double kStart = 1.0 / 16;
/// Points on each side of a triangle at which it is judged, corners included: at first, and where it cannot be proved.
constexpr int kFewPointsASide = 4, kManyPointsASide = 9;

bool is_umbra(const SolidMeshRequest& request) {
  return request.region == ShadowRegion::kUmbra;
}

void append_points(const TriangleJudge::Triangle& t, int a_side, std::vector<Vec3>& out) {
  const int n = a_side - 1;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; i + j <= n; ++j)
      out.push_back(t[0] + (static_cast<double>(i) / n) * (t[1] - t[0]) +
                    (static_cast<double>(j) / n) * (t[2] - t[0]));
}

/// Moves what bad triangles touch.
class Carver {
 public:
  Carver(SolidGrid& grid, CrossedEdges& edges, bool inward) : grid_(grid), edges_(edges), inward_(inward) {}

  void pull(std::uint32_t number) {
    CrossedEdge& e = edges_.all()[number];
    if (e.moved) return;  // pulled already
    e.moved = true;
    e.pull = e.pull > 0.0 ? 2.0 * e.pull : kFirstPull;
    e.at += inward_ ? -e.pull : e.pull;
    if (e.at <= 0.0) flip(edges_.inner_end(e));
    if (e.at >= 1.0) flip(edges_.outer_end(e));
  }
  void flip(std::uint32_t vertex) { flipped_.push_back(vertex); }

  void finish() {
    for (const std::uint32_t v : flipped_) grid_.set_inside(v, !inward_);
    if (!flipped_.empty()) edges_.update(inward_ ? 1.0 - kStart : kStart, kStart / 2.0);
    flipped_.clear();
  }

 private:
  SolidGrid& grid_;
  CrossedEdges& edges_;
  bool inward_;
  std::vector<std::uint32_t> flipped_;
};

}  // namespace

void TriangleJudge::prove(std::span<const Triangle> triangles, std::vector<Verdict>& out) const {
  const LightFrame frame = light_frame(request_.light);
  Bounds all = request_.bound;
  all.add(tree_.bounds());
  const double extent = 2.0 * all.radius();
  const bool umbra = is_umbra(request_);
  tbb::enumerable_thread_specific<HiddenProof> proofs([&] { return HiddenProof(tree_, request_.light); });
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, triangles.size(), 64), [&](const auto& range) {
    std::uint32_t likely = CasterTree::kNoFace;
    HiddenProof& proof = proofs.local();
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      const Triangle& t = triangles[i];
      if (std::ranges::any_of(t, [&](const Vec3& p) { return is_behind(request_.light, p); })) continue;
      out[i].proved =
          umbra ? proof.holds(t, 0) : tree_.is_clear(LightShaft(request_.light, frame, t, extent), likely);
      out[i].good = out[i].proved;
    }
  });
}

std::vector<TriangleJudge::Verdict> TriangleJudge::judge(std::span<const Triangle> triangles, bool thorough,
                                                         std::size_t& evaluations) const {
  std::vector<Verdict> out(triangles.size());
  const bool umbra = is_umbra(request_);
  if (thorough || !umbra) prove(triangles, out);
  if (!umbra) return out;
  std::vector<Vec3> points;
  std::vector<std::size_t> asked;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    if (out[i].proved) continue;
    asked.push_back(i);
    append_points(triangles[i], thorough ? kManyPointsASide : kFewPointsASide, points);
  }
  const std::vector<float> seen = request_.judge(points);
  evaluations += points.size();
  const std::size_t each = asked.empty() ? 0 : points.size() / asked.size();
  for (std::size_t k = 0; k < asked.size(); ++k)
    out[asked[k]].good = std::all_of(seen.begin() + static_cast<std::ptrdiff_t>(k * each),
                                     seen.begin() + static_cast<std::ptrdiff_t>((k + 1) * each),
                                     [](float o) { return o == 0.0f; });
  return out;
}

GridSurface carve(SolidGrid& grid, CrossedEdges& edges, const SolidMeshRequest& request,
                  const TriangleJudge& judge, std::size_t& evaluations, const Progress& progress) {
  const bool umbra = is_umbra(request);
  Carver carver(grid, edges, umbra);
  for (bool thorough = !umbra;;) {
    GridSurface surface = grid_surface(edges);
    const std::size_t edge_count = edges.all().size();
    const std::size_t judged = umbra ? surface.triangles.size() : surface.inner_triangles;
    std::vector<TriangleJudge::Triangle> triangles;
    std::vector<std::size_t> numbers;
    for (std::size_t i = 0; i < judged; ++i) {
      const IndexedTriangle& t = surface.triangles[i];
      if (!std::ranges::any_of(t, [&](std::uint32_t v) { return v >= edge_count || edges.all()[v].moved; }))
        continue;
      numbers.push_back(i);
      triangles.push_back({surface.positions[t[0]], surface.positions[t[1]], surface.positions[t[2]]});
    }
    const std::vector<TriangleJudge::Verdict> verdicts = judge.judge(triangles, thorough, evaluations);
    if (getenv("SOLID_DEBUG")) {
      std::size_t pr = 0, bad = 0;
      for (auto& v : verdicts) {
        pr += v.proved;
        bad += !v.good;
      }
      fprintf(stderr, "carve: judged %zu proved %zu bad %zu\n", verdicts.size(), pr, bad);
    }
    report(progress, surface.triangles.empty() ? 1.0
                                               : 1.0 - static_cast<double>(triangles.size()) /
                                                           static_cast<double>(2 * surface.triangles.size()));
    for (CrossedEdge& e : edges.all()) e.moved = false;
    bool all_good = true;
    for (std::size_t k = 0; k < numbers.size(); ++k) {
      if (verdicts[k].good) continue;
      all_good = false;
      const IndexedTriangle& t = surface.triangles[numbers[k]];
      bool pulled = false;
      for (const std::uint32_t v : t)
        if (v < edge_count) {
          carver.pull(v);
          pulled = true;
        }
      if (!pulled)
        for (const std::uint32_t v : t) carver.flip(surface.cap_points[v - edge_count]);
    }
    if (all_good && thorough) return surface;
    carver.finish();
    if (all_good) {
      thorough = true;
      for (CrossedEdge& e : edges.all()) e.moved = true;
    }
  }
}

}  // namespace penumbra::detail
