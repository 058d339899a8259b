#include "penumbra/volumes/supports.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>

#include "penumbra/volumes/tangent_planes.h"

namespace penumbra {
namespace {

constexpr double kPi = std::numbers::pi;

double wrap(double angle) {
  const double turned = std::fmod(angle, 2.0 * kPi);
  return turned < 0.0 ? turned + 2.0 * kPi : turned;
}

/// Which kind of facet a tangent plane carries, by the sides of the one or two opposite vertices (positive:
/// the disk's). An edge between coplanar faces carries none.
std::optional<SupportKind> facet_kind(Sign left, std::optional<Sign> right) {
  const Sign low = right ? std::min(left, *right) : left, high = right ? std::max(left, *right) : left;
  if (low == Sign::kZero && high == Sign::kZero && right) return std::nullopt;
  if (high != Sign::kPositive) return SupportKind::kPenumbra;
  if (low != Sign::kNegative) return SupportKind::kUmbra;
  return std::nullopt;
}

class FacetFinder {
 public:
  FacetFinder(const TriangleMesh& mesh, const CircularLight& light)
      : mesh_(mesh), light_(light), frame_(light_frame(light)) {}

  /// The facets of one edge: its tangent planes that support the faces there.
  using EdgeFacets = std::array<std::optional<SupportFacet>, 2>;
  EdgeFacets facets_of(EdgeId id) const {
    EdgeFacets out;
    const Edge& e = mesh_.edges()[index(id)];
    const Vec3 &a = mesh_.position(e.from), &b = mesh_.position(e.to);
    if (is_behind(light_, a) && is_behind(light_, b)) return out;
    if (line_outside_disk(a, b, light_) != Sign::kPositive) return out;
    using Sides = std::array<Sign, 2>;
    const Sides left = sides_of_tangent_planes(a, b, mesh_.position(e.left_apex), light_);
    std::optional<Sides> right;
    if (!e.is_boundary()) right = sides_of_tangent_planes(a, b, mesh_.position(e.right_apex), light_);
    std::array<std::optional<SupportKind>, 2> kinds;
    for (std::size_t i = 0; i < 2; ++i)
      kinds[i] = facet_kind(left[i], right ? std::optional((*right)[i]) : std::nullopt);
    if (!kinds[0] && !kinds[1]) return out;
    const auto planes = tangent_planes(a, b, light_);
    if (!planes) return out;
    for (const Tangent which : {Tangent::kFirst, Tangent::kSecond}) {
      const auto i = static_cast<std::size_t>(which);
      if (kinds[i]) out[i] = facet_on(id, *kinds[i], which, (*planes)[i].normal);
    }
    return out;
  }

  /// `normal` is the plane's, towards the disk; the contact is where the rim goes farthest against it.
  SupportFacet facet_on(EdgeId id, SupportKind kind, Tangent which, const Vec3& normal) const {
    const double angle = wrap(std::atan2(-glm::dot(normal, frame_.v), -glm::dot(normal, frame_.u)));
    // The plane through the edge and a receiver beyond it has the normal (a - x) × (b - a), which is against
    // `normal` for kFirst. It has to point to the lit side: the disk's for a penumbra, the other for an
    // umbra.
    return {id, kind, (which == Tangent::kFirst) == (kind == SupportKind::kPenumbra), angle};
  }

 private:
  const TriangleMesh& mesh_;
  const CircularLight& light_;
  const LightFrame frame_;
};

}  // namespace

std::vector<SupportFacet> find_support_facets(const TriangleMesh& mesh, const CircularLight& light,
                                              const Silhouettes& silhouettes) {
  const FacetFinder finder(mesh, light);
  std::vector<FacetFinder::EdgeFacets> found(silhouettes.band.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, found.size(), 512), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i)
      found[i] = finder.facets_of(silhouettes.band[i]);
  });
  std::vector<SupportFacet> out;
  for (const auto& facets : found)
    for (const auto& facet : facets)
      if (facet) out.push_back(*facet);
  return out;
}

std::vector<GapFace> find_gap_faces(const TriangleMesh& mesh, const CircularLight& light,
                                    const Classification& classes, const Supports& supports) {
  std::vector<GapFace> gaps;
  std::vector<bool> seen(mesh.triangles().size(), false);
  const auto visit_beside = [&](EdgeId id, std::uint32_t facet) {
    const Edge& e = mesh.edges()[index(id)];
    for (FaceId f : {e.left, e.right}) {
      if (f == kNone<FaceId> || seen[index(f)] || classes.faces[index(f)] != FaceClass::kMixed) continue;
      seen[index(f)] = true;
      const IndexedTriangle& t = mesh.triangles()[index(f)];
      const Vec3 &a = mesh.positions()[t[0]], &b = mesh.positions()[t[1]], &c = mesh.positions()[t[2]];
      if (glm::dot(glm::cross(b - a, c - a), way_to_center(light, a)) < 0.0) gaps.push_back({f, facet});
    }
  };
  for (std::uint32_t i = 0; i < supports.facets.size(); ++i)
    if (supports.facets[i].kind == SupportKind::kUmbra) visit_beside(supports.facets[i].edge, i);
  for (std::size_t next = 0; next < gaps.size(); ++next) {
    const GapFace gap = gaps[next];
    for (EdgeId e : mesh.face_edges()[index(gap.face)]) visit_beside(e, gap.facet);
  }
  return gaps;
}

}  // namespace penumbra
