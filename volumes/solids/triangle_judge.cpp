#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "volumes/solids/carve.h"
#include "volumes/solids/shafts/hidden_proof.h"

namespace penumbra::detail {
namespace {

/// Points on each side of a triangle that cannot be proved, corners included.
constexpr int kPointsASide = 7;
/// A point that sees light moves the corners that it lies nearer to than this, by barycentric coordinates.
constexpr double kNear = 0.25;
constexpr std::uint8_t kAll = 7;

using Corners = std::array<Vec3, 3>;

Corners corners_of(const TriangleJudge::Surface& surface, std::size_t i) {
  const IndexedTriangle& t = surface.triangles[i];
  return {surface.positions[t[0]], surface.positions[t[1]], surface.positions[t[2]]};
}

/// Points of triangles, each once: of corners, middles of sides, middles.
class SharedPoints {
 public:
  explicit SharedPoints(const TriangleJudge::Surface& surface) : surface_(surface) {
    for (const IndexedTriangle& t : surface.triangles)
      for (int k = 0; k < 3; ++k) {
        corners_.push_back(t[k]);
        sides_.push_back(side(t, k));
      }
    keep_one_each(corners_);
    keep_one_each(sides_);
    for (const std::uint32_t v : corners_) points_.push_back(surface.positions[v]);
    for (const auto& [a, b] : sides_) points_.push_back(0.5 * (surface.positions[a] + surface.positions[b]));
    for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
      const Corners c = corners_of(surface, i);
      points_.push_back((c[0] + c[1] + c[2]) / 3.0);
    }
  }

  const std::vector<Vec3>& points() const { return points_; }
  /// Corners of triangle i that points with faults move.
  template <class HasFault>
  std::uint8_t faults(std::size_t i, const HasFault& has_fault) const {
    const IndexedTriangle& t = surface_.triangles[i];
    unsigned out = 0;
    for (int k = 0; k < 3; ++k) {
      if (has_fault(place(corners_, t[k]))) out |= 1u << k;
      if (has_fault(corners_.size() + place(sides_, side(t, k)))) out |= 1u << k | 1u << (k + 1) % 3;
    }
    return has_fault(corners_.size() + sides_.size() + i) ? kAll : static_cast<std::uint8_t>(out);
  }

 private:
  static std::array<std::uint32_t, 2> side(const IndexedTriangle& t, int k) {
    return {std::min(t[k], t[(k + 1) % 3]), std::max(t[k], t[(k + 1) % 3])};
  }
  template <class T>
  static void keep_one_each(std::vector<T>& list) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  template <class T>
  static std::size_t place(const std::vector<T>& list, const T& item) {
    return static_cast<std::size_t>(std::lower_bound(list.begin(), list.end(), item) - list.begin());
  }

  const TriangleJudge::Surface& surface_;
  std::vector<std::uint32_t> corners_;
  std::vector<std::array<std::uint32_t, 2>> sides_;
  std::vector<Vec3> points_;
};

}  // namespace

TriangleJudge::Faults TriangleJudge::try_points(const Surface& surface, std::size_t& evaluations) const {
  const SharedPoints shared(surface);
  const std::vector<float> seen = request_.judge(shared.points());
  evaluations += seen.size();
  Faults out(surface.triangles.size());
  tbb::parallel_for(std::size_t{0}, out.size(), [&](std::size_t i) {
    out[i] = shared.faults(i, [&](std::size_t p) { return seen[p] != 0.0f; });
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

TriangleJudge::Faults TriangleJudge::try_proofs(const Surface& surface, std::size_t& evaluations) const {
  const std::vector<char> proved = prove(surface, 0);
  Faults out(proved.size(), 0);
  std::vector<std::size_t> asked;
  for (std::size_t i = 0; i < proved.size(); ++i)
    if (!proved[i]) asked.push_back(i);
  if (request_.region == ShadowRegion::kPenumbra) {
    for (const std::size_t i : asked) out[i] = kAll;
    return out;
  }
  constexpr int n = kPointsASide - 1;
  std::vector<std::array<double, 3>> weights;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; i + j <= n; ++j)
      weights.push_back(
          {static_cast<double>(i) / n, static_cast<double>(j) / n, static_cast<double>(n - i - j) / n});
  std::vector<Vec3> points;
  points.reserve(asked.size() * weights.size());
  for (const std::size_t i : asked) {
    const Corners c = corners_of(surface, i);
    for (const auto& w : weights) points.push_back(w[0] * c[0] + w[1] * c[1] + w[2] * c[2]);
  }
  const std::vector<float> seen = request_.judge(points);
  evaluations += points.size();
  for (std::size_t a = 0; a < asked.size(); ++a)
    for (std::size_t p = 0; p < weights.size(); ++p) {
      if (seen[a * weights.size() + p] == 0.0f) continue;
      for (int k = 0; k < 3; ++k)
        if (weights[p][k] > kNear) out[asked[a]] = static_cast<std::uint8_t>(out[asked[a]] | 1 << k);
    }
  return out;
}

}  // namespace penumbra::detail
