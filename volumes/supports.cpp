// A plane that touches the disk of radius r at rim angle φ is n·p = r with n = (cos φ, sin φ, κ): the disk
// lies where n·p ≤ r. Through a vertex v it has κ = (r - cos φ v.x - sin φ v.y) / v.z, so that the side of q
// is, times v.z,
//   A cos φ + B sin φ + C,   A = d.x v.z - v.x d.z,  B = d.y v.z - v.y d.z,  C = r d.z,  d = q - v:
// positive beyond the plane, negative on the disk's side. Everything below is this one expression.
#include "volumes/supports.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <tuple>

namespace penumbra {
namespace {

constexpr double kPi = std::numbers::pi;

double wrap(double angle) {
  const double turned = std::fmod(angle, 2.0 * kPi);
  return turned < 0.0 ? turned + 2.0 * kPi : turned;
}

struct SideOfPlane {
  double a, b, c;
  SideOfPlane(const Vec3& v, const Vec3& q, double r) {
    const Vec3 d = q - v;
    a = d.x * v.z - v.x * d.z;
    b = d.y * v.z - v.y * d.z;
    c = r * d.z;
  }
  /// Positive: q is beyond the plane through v that touches the disk at angle; scaled to about the sine of
  /// q's elevation.
  double at(double angle) const {
    const double size = std::hypot(a, b) + std::abs(c);
    return size > 0.0 ? (a * std::cos(angle) + b * std::sin(angle) + c) / size : 0.0;
  }
};

/// Rounding in `SideOfPlane::at`, so that coplanar neighbours count as lying on the plane.
constexpr double kOnPlane = 1e-11;

constexpr double kSharpestTurn = 0.93 * kPi;

/// An end of a facet at a vertex.
struct FacetEnd {
  VertexId vertex;
  SupportKind kind;
  double angle;
  std::uint32_t facet;
  bool leaves;  ///< the directed facet begins here
};

class Finder {
 public:
  Finder(const TriangleMesh& mesh, const VertexRings& rings, const DiskLight& light,
         const Classification& classes)
      : mesh_(mesh),
        rings_(rings),
        classes_(classes),
        frame_(light_frame(light)),
        center_(light.center),
        r_(light.radius) {}

  Supports run(const Silhouettes& silhouettes) {
    for (EdgeId e : silhouettes.band) add_facets(e);
    link_vertices();
    fill_gaps();
    return std::move(out_);
  }

 private:
  Vec3 local(VertexId v) const {
    const Vec3 p = mesh_.position(v) - center_;
    return {glm::dot(p, frame_.u), glm::dot(p, frame_.v), glm::dot(p, frame_.w)};
  }

  void add_facets(EdgeId id) {
    const Edge& e = mesh_.edges()[index(id)];
    const Vec3 a = local(e.from), b = local(e.to);
    double angles[2];
    if (std::max(a.z, b.z) <= 0.0 || !tangent_angles(a, b, r_, angles)) return;
    if (angles[1] < angles[0]) std::swap(angles[0], angles[1]);
    const Vec3& v = a.z > b.z ? a : b;  // the end in front
    const SideOfPlane left(v, local(e.left_apex), r_);
    const SideOfPlane right = e.is_boundary() ? left : SideOfPlane(v, local(e.right_apex), r_);
    for (double angle : angles) {
      const double l = left.at(angle), r = right.at(angle);
      if (std::min(l, r) >= -kOnPlane)
        add_facet(id, SupportKind::kPenumbra, angle, a, b);
      else if (std::max(l, r) <= kOnPlane)
        add_facet(id, SupportKind::kUmbra, angle, a, b);
    }
  }

  void add_facet(EdgeId id, SupportKind kind, double angle, const Vec3& a, const Vec3& b) {
    const Vec3& v = a.z > b.z ? a : b;
    const Vec3 contact{r_ * std::cos(angle), r_ * std::sin(angle), 0.0};
    const double kappa = (r_ - std::cos(angle) * v.x - std::sin(angle) * v.y) / v.z;
    const Vec3 beyond{std::cos(angle), std::sin(angle), kappa};
    // Of the plane through the edge and a point beyond it, seen from the contact: its positive side must be
    // lit.
    const double turn = glm::dot(glm::cross(contact - v, b - a), beyond);
    const bool lit_is_beyond = kind == SupportKind::kUmbra;
    out_.facets.push_back({id, kind, (turn > 0.0) != lit_is_beyond, wrap(angle)});
    const auto facet = static_cast<std::uint32_t>(out_.facets.size() - 1);
    const Edge& e = mesh_.edges()[index(id)];
    const bool flipped = out_.facets.back().flipped;
    ends_.push_back({e.from, kind, wrap(angle), facet, !flipped});
    ends_.push_back({e.to, kind, wrap(angle), facet, flipped});
  }

  void link_vertices() {
    std::sort(ends_.begin(), ends_.end(), [](const FacetEnd& x, const FacetEnd& y) {
      return std::tie(x.vertex, x.kind, x.angle, x.facet) < std::tie(y.vertex, y.kind, y.angle, y.facet);
    });
    for (std::size_t first = 0; first < ends_.size();) {
      std::size_t last = first;
      while (last < ends_.size() && ends_[last].vertex == ends_[first].vertex &&
             ends_[last].kind == ends_[first].kind)
        ++last;
      const std::span<const FacetEnd> here(ends_.data() + first, last - first);
      link_ends(here);
      if (local(here[0].vertex).z > 0.0) add_cones(here);
      first = last;
    }
  }

  /// Facets that arrive at the vertex go on with facets that leave it, the smallest turns first. Beyond
  /// kSharpestTurn two ends belong to different parts of the contour (the far sides of a saddle), not to one
  /// corner.
  void link_ends(std::span<const FacetEnd> ends) {
    links_.clear();
    for (const FacetEnd& arriving : ends)
      for (const FacetEnd& leaving : ends) {
        if (arriving.leaves || !leaving.leaves) continue;
        if (out_.facets[arriving.facet].edge == out_.facets[leaving.facet].edge)
          continue;  // both sides of a knife edge
        const double turn = std::abs(std::remainder(leaving.angle - arriving.angle, 2.0 * kPi));
        if (turn < kSharpestTurn) links_.push_back({turn, arriving.facet, leaving.facet});
      }
    std::sort(links_.begin(), links_.end());
    for (const auto& [turn, arriving, leaving] : links_) {
      if (out_.facets[arriving].next != kNoFacet || out_.facets[leaving].previous != kNoFacet) continue;
      out_.facets[arriving].next = leaving;
      out_.facets[leaving].previous = arriving;
    }
  }

  void add_cones(std::span<const FacetEnd> ends) {
    if (ends.size() < 2) return;
    for (std::size_t i = 0; i < ends.size(); ++i) {
      const FacetEnd& from = ends[i];
      const FacetEnd& to = ends[(i + 1) % ends.size()];
      const double to_angle = i + 1 < ends.size() ? to.angle : to.angle + 2.0 * kPi;
      if (to_angle - from.angle <= 1e-12) continue;
      const double middle = 0.5 * (from.angle + to_angle);
      const bool supported = from.kind == SupportKind::kPenumbra ? ring_is_beyond(from.vertex, middle)
                                                                 : star_covers_disk_side(from.vertex, middle);
      if (supported)
        out_.cones.push_back({from.vertex, from.kind, from.angle, to_angle, from.facet, to.facet});
    }
  }

  /// Breadth first from the umbra facets over the mixed faces turned away from the center.
  void fill_gaps() {
    std::vector<bool> seen(mesh_.triangles().size(), false);
    for (std::uint32_t i = 0; i < out_.facets.size(); ++i)
      if (out_.facets[i].kind == SupportKind::kUmbra) visit_gaps_beside(out_.facets[i].edge, i, seen);
    for (std::size_t next = 0; next < out_.gaps.size(); ++next) {
      const GapFace gap = out_.gaps[next];
      for (EdgeId e : mesh_.face_edges()[index(gap.face)]) visit_gaps_beside(e, gap.facet, seen);
    }
  }

  void visit_gaps_beside(EdgeId id, std::uint32_t facet, std::vector<bool>& seen) {
    const Edge& e = mesh_.edges()[index(id)];
    for (FaceId f : {e.left, e.right}) {
      if (f == kNone<FaceId> || seen[index(f)] || classes_.faces[index(f)] != FaceClass::kMixed) continue;
      seen[index(f)] = true;
      const IndexedTriangle& t = mesh_.triangles()[index(f)];
      const Vec3 a = mesh_.positions()[t[0]] - center_;
      const Vec3 n = glm::cross(mesh_.positions()[t[1]] - mesh_.positions()[t[0]],
                                mesh_.positions()[t[2]] - mesh_.positions()[t[0]]);
      if (glm::dot(n, a) > 0.0) out_.gaps.push_back({f, facet});
    }
  }

  /// All neighbours of v lie beyond its tangent plane at the angle: nothing of the star hides the disk's
  /// first point.
  bool ring_is_beyond(VertexId v, double angle) const {
    const Vec3 p = local(v);
    for (EdgeId id : rings_.edges(v)) {
      const Edge& e = mesh_.edges()[index(id)];
      if (SideOfPlane(p, local(e.from == v ? e.to : e.from), r_).at(angle) < -kOnPlane) return false;
    }
    return true;
  }

  /// Looking from behind v towards the contact, the star of v covers the whole half on the disk's side: the
  /// corner is reflex, and the first of the light appears at the vertex.
  bool star_covers_disk_side(VertexId v, double angle) {
    const Vec3 p = local(v);
    const Vec3 contact{r_ * std::cos(angle), r_ * std::sin(angle), 0.0};
    const Vec3 beyond{std::cos(angle), std::sin(angle),
                      (r_ - std::cos(angle) * p.x - std::sin(angle) * p.y) / p.z};
    const Vec3 along = glm::cross(p - contact, beyond);
    const auto bearing = [&](VertexId q) {
      const Vec3 d = local(q) - p;
      return std::atan2(glm::dot(beyond, d) * glm::length(along), glm::dot(along, d) * glm::length(beyond));
    };
    wedges_.clear();
    for (EdgeId id : rings_.edges(v)) {
      const Edge& e = mesh_.edges()[index(id)];
      const VertexId q = e.from == v ? e.to : e.from;
      add_wedge(bearing(q), bearing(e.left_apex));
      if (!e.is_boundary()) add_wedge(bearing(q), bearing(e.right_apex));
    }
    std::sort(wedges_.begin(), wedges_.end());
    double covered = -kPi;  // the disk's side is (-π, 0)
    for (const auto& [low, high] : wedges_)
      if (low <= covered + 1e-9) covered = std::max(covered, high);
    const bool covers_all =
        covered >= kPi - 1e-9;  // an inner vertex of the star's picture: no boundary at all
    return covered >= -1e-9 && !covers_all;
  }

  /// The part of the wedge between two bearings, the short way round, that lies on the disk's side.
  void add_wedge(double from, double to) {
    if (to < from) std::swap(from, to);
    if (to - from <= kPi) {
      wedges_.push_back({from, to});
    } else {
      wedges_.push_back({-kPi, from});
      wedges_.push_back({to, kPi});
    }
  }

  const TriangleMesh& mesh_;
  const VertexRings& rings_;
  const Classification& classes_;
  const LightFrame frame_;
  const Vec3 center_;
  const double r_;
  std::vector<FacetEnd> ends_;
  std::vector<std::tuple<double, std::uint32_t, std::uint32_t>> links_;
  std::vector<std::array<double, 2>> wedges_;
  Supports out_;
};

}  // namespace

bool tangent_angles(const Vec3& a, const Vec3& b, double r, double angles[2]) {
  const Vec3& v = a.z > b.z ? a : b;
  const SideOfPlane side(v, a.z > b.z ? b : a, r);
  const double size = std::hypot(side.a, side.b);
  if (!(size > 0.0) || std::abs(side.c) > size) return false;
  const double middle = std::atan2(side.b, side.a), spread = std::acos(-side.c / size);
  angles[0] = wrap(middle - spread);
  angles[1] = wrap(middle + spread);
  return true;
}

Supports find_supports(const TriangleMesh& mesh, const VertexRings& rings, const DiskLight& light,
                       const Classification& classes, const Silhouettes& silhouettes) {
  return Finder(mesh, rings, light, classes).run(silhouettes);
}

}  // namespace penumbra
