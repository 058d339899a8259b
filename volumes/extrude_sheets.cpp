#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "mesh/error.h"
#include "volumes/detail/shadow_reach.h"
#include "volumes/extrude.h"
#include "volumes/predicates.h"
#include "volumes/tangent_planes.h"

namespace penumbra {

namespace {

constexpr std::size_t kEdgesPerReport = 4096;
constexpr double kTurn = 2.0 * std::numbers::pi;

/// Which kind of facet a tangent plane carries, by the sides of the one or two opposite vertices.
std::optional<ShadowKind> facet_kind(Sign left, std::optional<Sign> right) {
  const Sign low = right ? std::min(left, *right) : left, high = right ? std::max(left, *right) : left;
  if (low == Sign::kZero && high == Sign::kZero) {
    return right ? std::nullopt : std::optional(ShadowKind::kPenumbraFacet);
  }
  if (high != Sign::kPositive) return ShadowKind::kPenumbraFacet;
  if (low != Sign::kNegative) return ShadowKind::kUmbraFacet;
  return std::nullopt;
}

/// Where a facet leaves a vertex: the contact on the disk, and the far end of the ray from there through the
/// vertex.
struct FacetEnd {
  Vec3 contact;
  double angle;  ///< of the contact around the rim, in [0, 2π)
  std::uint32_t far;
  bool penumbra;
};

class SheetExtruder {
 public:
  SheetExtruder(const TriangleMesh& mesh, const DiskLight& light, const Silhouettes& silhouettes,
                const ExtrudeOptions& options)
      : mesh_(mesh),
        light_(light),
        silhouettes_(silhouettes),
        options_(options),
        reach_(detail::shadow_reach(mesh, light, options)),
        near_(mesh.positions().size(), kUnset),
        ends_(mesh.positions().size()) {}

  ShadowMesh run() {
    mark_band_vertices();
    for (std::size_t i = 0; i < silhouettes_.band.size(); ++i) {
      add_facets(silhouettes_.band[i]);
      if (i % kEdgesPerReport == 0)
        report(static_cast<double>(i) / static_cast<double>(silhouettes_.band.size()));
    }
    if (light_.radius > 0.0) {
      for (std::size_t v = 0; v < ends_.size(); ++v) {
        if (in_band_[v]) add_cone_patches(static_cast<std::uint32_t>(v));
      }
    }
    report(1.0);
    return std::move(out_);
  }

 private:
  static constexpr std::uint32_t kUnset = std::numeric_limits<std::uint32_t>::max();

  const Vec3& position(std::uint32_t v) const { return mesh_.positions()[v]; }

  /// Vertices of the band that are in front of the light, and all neighbours of those.
  void mark_band_vertices() {
    in_band_.assign(ends_.size(), false);
    for (const EdgeId id : silhouettes_.band) {
      const Edge& edge = mesh_.edges()[index(id)];
      for (const VertexId v : {edge.from, edge.to}) {
        in_band_[index(v)] = side_of_light_plane(mesh_.position(v), light_) == Sign::kPositive;
      }
    }
    neighbours_.resize(ends_.size());
    for (const Edge& edge : mesh_.edges()) {
      if (in_band_[index(edge.from)])
        neighbours_[index(edge.from)].push_back(static_cast<std::uint32_t>(index(edge.to)));
      if (in_band_[index(edge.to)])
        neighbours_[index(edge.to)].push_back(static_cast<std::uint32_t>(index(edge.from)));
    }
  }

  // ---- facets
  // -------------------------------------------------------------------------------------------------------

  void add_facets(EdgeId id) {
    const Edge& edge = mesh_.edges()[index(id)];
    if (!in_band_[index(edge.from)] || !in_band_[index(edge.to)]) return;
    const Vec3 &a = mesh_.position(edge.from), &b = mesh_.position(edge.to);
    if (line_outside_disk(a, b, light_) != Sign::kPositive) return;
    const auto planes = tangent_planes(a, b, light_);
    if (!planes) return;
    for (const Tangent which : {Tangent::kFirst, Tangent::kSecond}) {
      const Sign left = side_of_tangent_plane(a, b, mesh_.position(edge.left_apex), which, light_);
      std::optional<Sign> right;
      if (!edge.is_boundary())
        right = side_of_tangent_plane(a, b, mesh_.position(edge.right_apex), which, light_);
      if (const auto kind = facet_kind(left, right))
        add_facet(id, *kind, (*planes)[static_cast<std::size_t>(which)]);
    }
  }

  /// The quad between the rays from the contact through both vertices. The disk is on the positive side of
  /// the plane; so the penumbra, beyond the edge as seen from the disk, is on the negative one, and the umbra
  /// on the positive.
  void add_facet(EdgeId id, ShadowKind kind, const TangentPlane& plane) {
    const Edge& edge = mesh_.edges()[index(id)];
    const auto from = static_cast<std::uint32_t>(index(edge.from)),
               to = static_cast<std::uint32_t>(index(edge.to));
    const bool penumbra = kind == ShadowKind::kPenumbraFacet;
    const std::uint32_t far_from = end_at(from, plane.contact, penumbra),
                        far_to = end_at(to, plane.contact, penumbra);
    const Vec3 outward = penumbra ? plane.normal : -plane.normal;
    const ShadowTag tag{kind, static_cast<std::uint32_t>(index(id)), options_.object};
    add_triangle({near(from), near(to), far_to}, outward, tag);
    add_triangle({near(from), far_to, far_from}, outward, tag);
  }

  std::uint32_t end_at(std::uint32_t vertex, const Vec3& contact, bool penumbra) {
    for (const FacetEnd& end : ends_[vertex]) {
      if (end.contact == contact && end.penumbra == penumbra) return end.far;
    }
    const Vec3 d = contact - reach_.center;
    double angle = std::atan2(glm::dot(d, reach_.frame.v), glm::dot(d, reach_.frame.u));
    if (angle < 0.0) angle += kTurn;
    ends_[vertex].push_back({contact, angle, add_far_point(vertex, contact), penumbra});
    return ends_[vertex].back().far;
  }

  // ---- cone patches
  // -------------------------------------------------------------------------------------------------

  void add_cone_patches(std::uint32_t vertex) {
    std::vector<FacetEnd> ends;
    for (const FacetEnd& end : ends_[vertex]) {
      if (end.penumbra) ends.push_back(end);
    }
    std::sort(ends.begin(), ends.end(),
              [](const FacetEnd& a, const FacetEnd& b) { return a.angle < b.angle; });
    if (ends.empty()) {
      if (separates(vertex, 0.0)) add_full_cone(vertex);
      return;
    }
    for (std::size_t i = 0; i < ends.size(); ++i) {
      const FacetEnd &a = ends[i], &b = ends[(i + 1) % ends.size()];
      const double arc = i + 1 < ends.size() ? b.angle - a.angle : b.angle + kTurn - a.angle;
      if (arc > 0.0 && separates(vertex, a.angle + 0.5 * arc)) add_cone(vertex, a, b, arc);
    }
  }

  Vec3 rim_direction(double angle) const {
    return std::cos(angle) * reach_.frame.u + std::sin(angle) * reach_.frame.v;
  }

  /// Normal of the plane through the vertex that touches the rim at `angle`, the disk on its positive side.
  Vec3 tangent_normal(std::uint32_t vertex, double angle) const {
    const Vec3 contact = reach_.center + reach_.radius * rim_direction(angle);
    const Vec3 normal = glm::cross(rim_direction(angle + 0.25 * kTurn), contact - position(vertex));
    return glm::dot(normal, reach_.center - contact) < 0.0 ? -normal : normal;
  }

  /// Whether all neighbours of the vertex are beyond that plane.
  bool separates(std::uint32_t vertex, double angle) const {
    constexpr double kSlack = 1e-12;  // angles lie between facets, so only rounding needs room
    const Vec3 normal = tangent_normal(vertex, angle);
    return std::all_of(neighbours_[vertex].begin(), neighbours_[vertex].end(), [&](std::uint32_t w) {
      const Vec3 d = position(w) - position(vertex);
      return glm::dot(normal, d) <= kSlack * glm::length(normal) * glm::length(d);
    });
  }

  /// Corners where tangents of the rim at evenly spaced angles meet: the patch lies outside of the true cone
  /// and touches it along its two ends' rays, in the planes of their facets.
  void add_cone(std::uint32_t vertex, const FacetEnd& a, const FacetEnd& b, double arc) {
    const int steps = std::max(1, static_cast<int>(std::ceil(arc / kTurn * options_.cone_segments)));
    std::uint32_t previous = a.far;
    for (int i = 0; i <= steps; ++i) {
      const double from = a.angle + arc * i / steps, middle = a.angle + arc * (i + 0.5) / steps;
      const std::uint32_t next = i < steps ? add_tangent_corner(vertex, middle, arc / steps) : b.far;
      add_triangle({near(vertex), previous, next}, tangent_normal(vertex, from), cone_tag(vertex));
      previous = next;
    }
  }

  void add_full_cone(std::uint32_t vertex) {
    const double step = kTurn / options_.cone_segments;
    const std::uint32_t first = add_tangent_corner(vertex, 0.0, step);
    std::uint32_t previous = first;
    for (int i = 1; i <= options_.cone_segments; ++i) {
      const std::uint32_t next =
          i < options_.cone_segments ? add_tangent_corner(vertex, i * step, step) : first;
      add_triangle({near(vertex), previous, next}, tangent_normal(vertex, (i - 0.5) * step),
                   cone_tag(vertex));
      previous = next;
    }
  }

  std::uint32_t add_tangent_corner(std::uint32_t vertex, double angle, double step) {
    const double distance = reach_.radius / std::cos(0.5 * step);
    return add_far_point(vertex, reach_.center + distance * rim_direction(angle));
  }

  ShadowTag cone_tag(std::uint32_t vertex) const {
    return {ShadowKind::kPenumbraCone, vertex, options_.object};
  }

  // ---- output
  // -------------------------------------------------------------------------------------------------------

  std::uint32_t near(std::uint32_t vertex) {
    if (near_[vertex] == kUnset) near_[vertex] = add_position(position(vertex));
    return near_[vertex];
  }

  /// On the ray from p through the vertex, at the far plane; for rays that graze the light's plane, at least
  /// outside of the bound.
  std::uint32_t add_far_point(std::uint32_t vertex, const Vec3& p) {
    constexpr double kGreatestScale = 1e4;
    const Vec3 ray = position(vertex) - p;
    const double depth = reach_.depth(position(vertex));
    const double scale = std::max(2.0, reach_.far_depth / depth);
    const double leave = std::max(2.0, 2.0 * reach_.distance() / glm::length(ray));
    return add_position(p + (depth > 0.0 && scale <= kGreatestScale ? scale : leave) * ray);
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

  void report(double fraction) const {
    if (options_.progress && !options_.progress(fraction)) throw Cancelled();
  }

  const TriangleMesh& mesh_;
  const DiskLight& light_;
  const Silhouettes& silhouettes_;
  const ExtrudeOptions& options_;
  detail::ShadowReach reach_;
  ShadowMesh out_;
  std::vector<std::uint32_t> near_;          ///< per vertex of the caster: its place in the output
  std::vector<std::vector<FacetEnd>> ends_;  ///< per vertex of the caster
  std::vector<bool> in_band_;
  std::vector<std::vector<std::uint32_t>> neighbours_;  ///< of band vertices
};

}  // namespace

ShadowMesh extrude_sheets(const TriangleMesh& mesh, const DiskLight& light, const Silhouettes& silhouettes,
                          const ExtrudeOptions& options) {
  return SheetExtruder(mesh, light, silhouettes, options).run();
}

}  // namespace penumbra
