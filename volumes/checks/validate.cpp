#include "penumbra/volumes/checks/validate.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <map>
#include <tuple>

#include "penumbra/volumes/predicates/predicates.h"
#include "volumes/cells/shadow_reach.h"
#include "volumes/checks/piece_list.h"
#include "volumes/checks/surface_queries.h"
#include "volumes/predicates/predicate_tiers.h"

namespace penumbra {

namespace {

/// Corners renumbered so that equal positions have equal numbers: their first.
std::vector<std::uint32_t> welded_numbers(std::span<const Vec3> positions) {
  const auto less = [&](std::uint32_t a, std::uint32_t b) {
    const Vec3 &p = positions[a], &q = positions[b];
    return std::tie(p.x, p.y, p.z, a) < std::tie(q.x, q.y, q.z, b);
  };
  std::vector<std::uint32_t> order(positions.size()), number(positions.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(), less);
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool same = i > 0 && positions[order[i]] == positions[order[i - 1]];
    number[order[i]] = same ? number[order[i - 1]] : order[i];
  }
  return number;
}

std::size_t count_unmatched(std::span<const IndexedTriangle> triangles) {
  std::vector<std::array<std::uint32_t, 2>> forward, backward;
  for (const IndexedTriangle& t : triangles) {
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3];
      forward.push_back({a, b});
      backward.push_back({b, a});
    }
  }
  std::sort(forward.begin(), forward.end());
  std::sort(backward.begin(), backward.end());
  std::vector<std::array<std::uint32_t, 2>> unmatched;
  std::set_difference(forward.begin(), forward.end(), backward.begin(), backward.end(),
                      std::back_inserter(unmatched));
  return unmatched.size();
}

class SurfaceChecker {
 public:
  SurfaceChecker(std::span<const Vec3> positions, std::span<const IndexedTriangle> triangles,
                 const SurfaceCheckOptions& options)
      : positions_(positions), triangles_(triangles), options_(options), number_(welded_numbers(positions)) {}

  SurfaceFindings run() {
    findings_.triangles = triangles_.size();
    findings_.unmatched_half_edges = count_unmatched(triangles_);
    for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
      const IndexedTriangle& t = triangles_[i];
      if (detail::collinear(positions_[t[0]], positions_[t[1]], positions_[t[2]]))
        findings_.degenerate.push_back(i);
    }
    check_pieces();
    list_intersections();
    findings_.bounds_a_volume = findings_.pieces > 0 && sound_pieces_ == findings_.pieces &&
                                findings_.self_intersections.empty() &&
                                detail::does_bound_a_volume(positions_, triangles_);
    return std::move(findings_);
  }

 private:
  bool is_degenerate(std::uint32_t i) const {
    return std::binary_search(findings_.degenerate.begin(), findings_.degenerate.end(), i);
  }

  /// Triangles with area, welded.
  std::vector<IndexedTriangle> welded(std::span<const std::uint32_t> which) const {
    std::vector<IndexedTriangle> result;
    for (const std::uint32_t i : which) {
      const IndexedTriangle& t = triangles_[i];
      result.push_back({number_[t[0]], number_[t[1]], number_[t[2]]});
    }
    return result;
  }

  void check_pieces() {
    for (const auto& piece : detail::connected_pieces(positions_.size(), triangles_)) {
      ++findings_.pieces;
      std::vector<Vec3> positions;
      const std::vector<IndexedTriangle> local = with_own_numbers(piece, positions);
      const bool flat = local.size() != piece.size();
      const bool crossed = !detail::self_intersections(positions, local, 1).empty();
      findings_.crossed_pieces += crossed;
      if (flat || crossed || count_unmatched(local) > 0) continue;
      ++sound_pieces_;
      findings_.solid_pieces += detail::does_bound_a_volume(positions, local);
    }
  }

  /// A piece's triangles with area over its own welded positions.
  std::vector<IndexedTriangle> with_own_numbers(const std::vector<std::uint32_t>& piece,
                                                std::vector<Vec3>& positions) const {
    std::vector<std::uint32_t> kept;
    for (const std::uint32_t i : piece) {
      if (!is_degenerate(i)) kept.push_back(i);
    }
    std::map<std::uint32_t, std::uint32_t> own;
    std::vector<IndexedTriangle> local = welded(kept);
    for (IndexedTriangle& t : local) {
      for (std::uint32_t& v : t) {
        const auto [at, is_new] = own.try_emplace(v, static_cast<std::uint32_t>(positions.size()));
        if (is_new) positions.push_back(positions_[v]);
        v = at->second;
      }
    }
    return local;
  }

  void list_intersections() {
    std::vector<std::uint32_t> kept;
    for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
      if (!is_degenerate(i)) kept.push_back(i);
    }
    auto pairs = detail::self_intersections(positions_, welded(kept), options_.most_intersections + 1);
    findings_.all_listed = pairs.size() <= options_.most_intersections;
    if (!findings_.all_listed) pairs.pop_back();
    for (const auto& [a, b] : pairs) findings_.self_intersections.push_back({kept[a], kept[b]});
  }

  std::span<const Vec3> positions_;
  std::span<const IndexedTriangle> triangles_;
  SurfaceCheckOptions options_;
  std::vector<std::uint32_t> number_;
  std::size_t sound_pieces_ = 0;  ///< that CGAL's test may be asked about
  SurfaceFindings findings_;
};

/// Points are tried inside of the bound alone: volumes end differently beyond it.
class ContainmentChecker {
 public:
  ContainmentChecker(const CircularLight& light, const detail::ShadowReach& reach,
                     const ValidateOptions& options)
      : light_(light), reach_(reach), options_(options), random_(options.seed) {}

  ContainmentFindings run(const ShadowMesh& inner, const ShadowMesh& outer, const Progress& progress) {
    ContainmentFindings findings;
    if (inner.triangles.empty()) return findings;
    const detail::PieceList from(inner), into(outer);
    constexpr std::size_t kTries = 100;  // a point, since most of a volume may be beyond the bound
    for (std::size_t i = 0; i < kTries * options_.points && findings.points < options_.points; ++i) {
      const Vec3 x = from.point_inside(random_);
      if (!is_of_interest(x) || !from.contains(x)) continue;
      ++findings.points;
      report(progress, static_cast<double>(findings.points) / static_cast<double>(options_.points));
      if (into.contains(x)) continue;
      ++findings.outside;
      findings.example = x;
    }
    return findings;
  }

 private:
  bool is_of_interest(const Vec3& x) const {
    return glm::length(x - reach_.bound_center) <= reach_.bound_radius &&
           side_of_light_plane(x, light_) == Sign::kPositive;
  }

  CircularLight light_;
  detail::ShadowReach reach_;
  ValidateOptions options_;
  std::mt19937_64 random_;
};

}  // namespace

SurfaceFindings check_surface(std::span<const Vec3> positions, std::span<const IndexedTriangle> triangles,
                              const SurfaceCheckOptions& options) {
  return SurfaceChecker(positions, triangles, options).run();
}

bool VolumeFindings::good() const {
  return umbra.closed() && penumbra.closed() && umbra_in_hard.outside == 0 && hard_in_penumbra.outside == 0 &&
         umbra_in_penumbra.outside == 0;
}

VolumeFindings validate(const TriangleMesh& mesh, const CircularLight& light, const ShadowMesh& umbra,
                        const ShadowMesh& penumbra, const ExtrudeOptions& extrude,
                        const ValidateOptions& options) {
  CircularLight center = light;
  center.radius = 0.0;
  ExtrudeOptions quiet = extrude;
  quiet.progress = {};
  const ShadowMesh hard = extrude_penumbra(mesh, center, classify_faces(mesh, center), quiet);
  ContainmentChecker containment(light, detail::shadow_reach(mesh, light, extrude), options);
  // Shares of the time by eye; they only steer the progress that is reported.
  const auto part = [&](double begin, double end) { return part_of(options.progress, begin, end); };
  report(options.progress, 0.1);
  VolumeFindings findings;
  findings.umbra = check_surface(umbra.positions, umbra.triangles, options.surface);
  report(options.progress, 0.2);
  findings.penumbra = check_surface(penumbra.positions, penumbra.triangles, options.surface);
  findings.umbra_in_hard = containment.run(umbra, hard, part(0.4, 0.6));
  findings.hard_in_penumbra = containment.run(hard, penumbra, part(0.6, 0.8));
  findings.umbra_in_penumbra = containment.run(umbra, penumbra, part(0.8, 1.0));
  return findings;
}

}  // namespace penumbra
