#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>
#include <tuple>

#include "penumbra/mesh/error.h"
#include "penumbra/volumes/extrude.h"
#include "penumbra/volumes/supports.h"
#include "volumes/cells/shadow_reach.h"

namespace penumbra {

namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
// Accuracy: a ray that would have to be longer than this many times the way to its vertex to reach the far
// plane ends outside the bound instead. Longer ones would lose too many digits.
constexpr double kGreatestScale = 1e4;

class SheetExtruder {
 public:
  SheetExtruder(const TriangleMesh& mesh, const CircularLight& light, const Supports& supports,
                const ExtrudeOptions& options)
      : mesh_(mesh),
        supports_(supports),
        options_(options),
        reach_(detail::shadow_reach(mesh, light, options)),
        near_(mesh.positions().size(), kUnset) {}

  ShadowMesh run() {
    for (const SupportFacet& facet : supports_.facets) add_facet(facet);
    report(options_.progress, 0.5);
    for (const ConeSector& cone : supports_.cones)
      if (cone.kind == SupportKind::kPenumbra && reach_.light.radius > 0.0) add_cone(cone);
    report(options_.progress, 1.0);
    return std::move(out_);
  }

 private:
  static constexpr std::uint32_t kUnset = std::numeric_limits<std::uint32_t>::max();

  const Vec3& position(std::uint32_t v) const { return mesh_.positions()[v]; }
  Vec3 rim_direction(double angle) const {
    return std::cos(angle) * reach_.frame.u + std::sin(angle) * reach_.frame.v;
  }

  /// From the disk's center to the rim.
  Vec3 rim_offset(double angle) const { return reach_.light.radius * rim_direction(angle); }

  /// Normal, away from the disk, of the plane through the vertex that touches the rim at `angle`.
  Vec3 away_from_disk(std::uint32_t vertex, double angle) const {
    const Vec3 to_contact = rim_offset(angle) - reach_.from_center(position(vertex));
    const Vec3 normal = glm::cross(rim_direction(angle + 0.25 * kTurn), to_contact);
    return glm::dot(normal, rim_direction(angle)) < 0.0 ? -normal : normal;
  }

  /// The quad between the rays from the contact through both vertices. A penumbra facet looks towards the
  /// disk, an umbra facet away from it. Facets that reach the light's plane are left to the volume.
  void add_facet(const SupportFacet& facet) {
    const Edge& edge = mesh_.edges()[index(facet.edge)];
    const auto from = static_cast<std::uint32_t>(index(edge.from)),
               to = static_cast<std::uint32_t>(index(edge.to));
    if (!(reach_.depth(position(from)) > 0.0) || !(reach_.depth(position(to)) > 0.0)) return;
    const bool penumbra = facet.kind == SupportKind::kPenumbra;
    const std::uint32_t far_from = far_end(from, facet.rim_angle, facet.kind),
                        far_to = far_end(to, facet.rim_angle, facet.kind);
    const Vec3 away = away_from_disk(from, facet.rim_angle), outward = penumbra ? -away : away;
    const ShadowTag tag{penumbra ? ShadowKind::kPenumbraFacet : ShadowKind::kUmbraFacet,
                        static_cast<std::uint32_t>(index(facet.edge)), options_.object};
    add_triangle({near(from), near(to), far_to}, outward, tag);
    add_triangle({near(from), far_to, far_from}, outward, tag);
  }

  /// Facets and cones that meet along a ray share its far point. From a point light there is one ray a
  /// vertex.
  std::uint32_t far_end(std::uint32_t vertex, double angle, SupportKind kind) {
    if (reach_.light.radius == 0.0) angle = 0.0;
    const auto [at, is_new] = far_ends_.try_emplace({vertex, kind, angle}, 0u);
    if (is_new) at->second = add_far_point(vertex, rim_offset(angle));
    return at->second;
  }

  /// Corners where tangents of the rim at evenly spaced angles meet: the patch lies outside of the true cone
  /// and touches it along its two ends' rays, in the planes of their facets.
  void add_cone(const ConeSector& cone) {
    const auto vertex = static_cast<std::uint32_t>(index(cone.vertex));
    const bool full = cone.from_facet == kNoFacet;
    const double arc = cone.to_angle - cone.from_angle;
    const int steps =
        std::max(full ? 3 : 1, static_cast<int>(std::ceil(arc / kTurn * options_.cone_segments)));
    const double half = 0.5 * arc / steps;
    const std::uint32_t start = full ? add_tangent_corner(vertex, cone.from_angle - half, half)
                                     : far_end(vertex, cone.from_angle, cone.kind);
    std::uint32_t previous = start;
    for (int i = 0; i < steps + (full ? 0 : 1); ++i) {
      const std::uint32_t next = i < steps
                                     ? add_tangent_corner(vertex, cone.from_angle + (2 * i + 1) * half, half)
                                     : far_end(vertex, supports_.facets[cone.to_facet].rim_angle, cone.kind);
      const std::uint32_t corner = full && i + 1 == steps ? start : next;
      add_triangle({near(vertex), previous, corner}, -away_from_disk(vertex, cone.from_angle + 2 * i * half),
                   {ShadowKind::kPenumbraCone, vertex, options_.object});
      previous = corner;
    }
  }

  std::uint32_t add_tangent_corner(std::uint32_t vertex, double angle, double half_step) {
    return add_far_point(vertex, rim_offset(angle) / std::cos(half_step));
  }

  std::uint32_t near(std::uint32_t vertex) {
    if (near_[vertex] == kUnset) near_[vertex] = add_position(position(vertex));
    return near_[vertex];
  }

  /// On the ray from the point center + q of the light's plane through the vertex, at the far plane, or
  /// beyond the vertex by the caster's size where that is further; for rays that graze the light's plane, at
  /// least outside of the bound.
  std::uint32_t add_far_point(std::uint32_t vertex, const Vec3& q) {
    const Vec3& k = position(vertex);
    const double gain = std::max(mesh_.bounds().radius(), reach_.far_height - reach_.height(k));
    if (reach_.light.is_distant() || gain <= kGreatestScale * reach_.depth(k))
      return add_position(k + gain * reach_.ray(k, q));
    const Vec3 way = reach_.from_center(k) - q;
    return add_position(k + std::max(1.0, 2.0 * reach_.distance() / glm::length(way)) * way);
  }

  std::uint32_t add_position(const Vec3& p) {
    out_.positions.push_back(p);
    return static_cast<std::uint32_t>(out_.positions.size() - 1);
  }

  void add_triangle(IndexedTriangle t, const Vec3& outward, const ShadowTag& tag) {
    const Vec3 &a = out_.positions[t[0]], &b = out_.positions[t[1]], &c = out_.positions[t[2]];
    if (glm::dot(glm::cross(b - a, c - a), outward) < 0.0) std::swap(t[1], t[2]);
    out_.triangles.push_back(t);
    out_.tags.push_back(tag);
  }

  const TriangleMesh& mesh_;
  const Supports& supports_;
  const ExtrudeOptions& options_;
  detail::ShadowReach reach_;
  ShadowMesh out_;
  std::vector<std::uint32_t> near_;  ///< per vertex of the caster: its place in the output
  std::map<std::tuple<std::uint32_t, SupportKind, double>, std::uint32_t> far_ends_;
};

}  // namespace

ShadowMesh extrude_sheets(const TriangleMesh& mesh, const CircularLight& light,
                          const Silhouettes& silhouettes, const ExtrudeOptions& options) {
  const Supports supports = find_supports(mesh, VertexRings(mesh), light, silhouettes);
  return SheetExtruder(mesh, light, supports, options).run();
}

}  // namespace penumbra
