// A plane that touches the disk of radius r at rim angle φ is n·p = r with n = (cos φ, sin φ, κ): the disk
// lies where n·p ≤ r. Through a vertex v it has κ = (r - cos φ v.x - sin φ v.y) / v.z, so that the side of q
// is, times v.z,
//   A cos φ + B sin φ + C,   A = d.x v.z - v.x d.z,  B = d.y v.z - v.y d.z,  C = r d.z,  d = q - v:
// positive beyond the plane, negative on the disk's side. Everything below is this one expression.
#include "volumes/supports.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <numbers>
#include <optional>
#include <tuple>

#include "volumes/tangent_planes.h"

namespace penumbra {
namespace {

constexpr double kPi = std::numbers::pi;

double wrap(double angle) {
  const double turned = std::fmod(angle, 2.0 * kPi);
  return turned < 0.0 ? turned + 2.0 * kPi : turned;
}

/// Rounding in `SideOfPlane`, so that coplanar neighbours count as lying on the plane: the sine of an
/// elevation.
constexpr double kOnPlane = 1e-11;

struct SideOfPlane {
  double a, b, c;
  SideOfPlane(const Vec3& v, const Vec3& q, double r) {
    const Vec3 d = q - v;
    a = d.x * v.z - v.x * d.z;
    b = d.y * v.z - v.y * d.z;
    c = r * d.z;
  }
  /// Whether q is on the disk's side of the plane through v that touches the disk at the angle of this
  /// direction; what rounding cannot tell from the plane is not.
  bool is_on_disk_side(const glm::dvec2& direction) const {
    const double size = std::sqrt(a * a + b * b) + std::abs(c);
    return a * direction.x + b * direction.y + c < -kOnPlane * size;
  }
};

constexpr double kSharpestTurn = 0.7 * kPi;

/// Which kind of facet a tangent plane carries, by the sides of the one or two opposite vertices (positive:
/// the disk's). An edge between coplanar faces carries none.
std::optional<SupportKind> facet_kind(Sign left, std::optional<Sign> right) {
  const Sign low = right ? std::min(left, *right) : left, high = right ? std::max(left, *right) : left;
  if (low == Sign::kZero && high == Sign::kZero && right) return std::nullopt;
  if (high != Sign::kPositive) return SupportKind::kPenumbra;
  if (low != Sign::kNegative) return SupportKind::kUmbra;
  return std::nullopt;
}

/// Grows with the angle of (x, y) from -kHalfTurn to kHalfTurn, opposite directions differ by kHalfTurn, and
/// no transcendental function is called.
constexpr double kHalfTurn = 2.0;
double diamond_angle(double x, double y) {
  const double size = std::abs(x) + std::abs(y);
  if (!(size > 0.0)) return 0.0;
  return x >= 0.0 ? y / size : y >= 0.0 ? 2.0 - y / size : -2.0 - y / size;
}

/// A vertex and what is around it, in the light's frame.
struct Star {
  struct Spoke {
    Vec3 end, left;
    std::optional<Vec3> right;  ///< apexes of the faces beside it
  };
  Vec3 center{0.0};
  std::vector<Spoke> spokes;
};

/// Memory that one thread uses again for every vertex.
struct Scratch {
  Star star;
  std::vector<std::array<double, 2>> wedges;
  std::vector<std::tuple<double, std::uint32_t, std::uint32_t>> links;
};

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
  Finder(const TriangleMesh& mesh, const VertexRings& rings, const DiskLight& light)
      : mesh_(mesh),
        rings_(rings),
        light_(light),
        frame_(light_frame(light)),
        r_(light.radius),
        local_(mesh.positions().size()) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, local_.size(), 4096), [&](const auto& range) {
      for (std::size_t i = range.begin(); i < range.end(); ++i) {
        const Vec3 p = mesh.positions()[i] - light.center;
        local_[i] = {glm::dot(p, frame_.u), glm::dot(p, frame_.v), glm::dot(p, frame_.w)};
      }
    });
  }

  Supports run(const Silhouettes& silhouettes) {
    find_facets(silhouettes.band);
    find_corners();
    add_full_cones(silhouettes);
    return std::move(out_);
  }

 private:
  const Vec3& local(VertexId v) const { return local_[index(v)]; }

  /// The facets of one edge: its tangent planes that support the faces there.
  struct EdgeFacets {
    std::array<std::optional<SupportKind>, 2> kinds;
    std::array<Vec3, 2> normals;
  };
  EdgeFacets facets_of(EdgeId id) const {
    EdgeFacets out;
    const Edge& e = mesh_.edges()[index(id)];
    const Vec3 &a = mesh_.position(e.from), &b = mesh_.position(e.to);
    if (is_behind(light_, a) && is_behind(light_, b)) return out;
    if (line_outside_disk(a, b, light_) != Sign::kPositive) return out;
    const auto planes = tangent_planes(a, b, light_);
    if (!planes) return out;
    for (const Tangent which : {Tangent::kFirst, Tangent::kSecond}) {
      const auto i = static_cast<std::size_t>(which);
      const Sign left = side_of_tangent_plane(a, b, mesh_.position(e.left_apex), which, light_);
      std::optional<Sign> right;
      if (!e.is_boundary()) right = side_of_tangent_plane(a, b, mesh_.position(e.right_apex), which, light_);
      out.kinds[i] = facet_kind(left, right);
      out.normals[i] = (*planes)[i].normal;
    }
    return out;
  }

  void find_facets(std::span<const EdgeId> band) {
    std::vector<EdgeFacets> found(band.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, band.size(), 512), [&](const auto& range) {
      for (std::size_t i = range.begin(); i < range.end(); ++i) found[i] = facets_of(band[i]);
    });
    for (std::size_t i = 0; i < band.size(); ++i)
      for (const Tangent which : {Tangent::kFirst, Tangent::kSecond})
        if (const auto kind = found[i].kinds[static_cast<std::size_t>(which)])
          add_facet(band[i], *kind, which, found[i].normals[static_cast<std::size_t>(which)]);
  }

  /// `normal` is the plane's, towards the disk; the contact is where the rim goes farthest against it.
  void add_facet(EdgeId id, SupportKind kind, Tangent which, const Vec3& normal) {
    const double angle = wrap(std::atan2(-glm::dot(normal, frame_.v), -glm::dot(normal, frame_.u)));
    // The plane through the edge and a receiver beyond it has the normal (a - x) × (b - a), which is against
    // `normal` for kFirst. It has to point to the lit side: the disk's for a penumbra, the other for an
    // umbra.
    const bool flipped = (which == Tangent::kFirst) == (kind == SupportKind::kPenumbra);
    const auto facet = static_cast<std::uint32_t>(out_.facets.size());
    out_.facets.push_back({id, kind, flipped, angle});
    const Edge& e = mesh_.edges()[index(id)];
    ends_.push_back({e.from, kind, angle, facet, !flipped});
    ends_.push_back({e.to, kind, angle, facet, flipped});
  }

  /// Links facets and finds cones, vertex by vertex.
  void find_corners() {
    tbb::parallel_sort(ends_.begin(), ends_.end(), [](const FacetEnd& x, const FacetEnd& y) {
      return std::tie(x.vertex, x.kind, x.angle, x.facet) < std::tie(y.vertex, y.kind, y.angle, y.facet);
    });
    std::vector<std::span<const FacetEnd>> corners;
    for (std::size_t first = 0; first < ends_.size();) {
      std::size_t last = first;
      while (last < ends_.size() && ends_[last].vertex == ends_[first].vertex &&
             ends_[last].kind == ends_[first].kind)
        ++last;
      corners.emplace_back(ends_.data() + first, last - first);
      first = last;
    }
    // A facet has one end at each vertex, so that no two corners write to the same link.
    std::vector<std::vector<ConeSector>> cones(corners.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, corners.size(), 256), [&](const auto& range) {
      Scratch scratch;
      for (std::size_t i = range.begin(); i < range.end(); ++i) {
        link_ends(corners[i], scratch);
        if (local(corners[i][0].vertex).z > 0.0) find_cones(corners[i], scratch, cones[i]);
      }
    });
    for (const auto& found : cones) out_.cones.insert(out_.cones.end(), found.begin(), found.end());
  }

  /// Facets that arrive at the vertex go on with facets that leave it, the smallest turns first. Beyond
  /// kSharpestTurn two ends belong to different parts of the contour (the far sides of a saddle), not to one
  /// corner.
  void link_ends(std::span<const FacetEnd> ends, Scratch& scratch) {
    auto& links = scratch.links;
    links.clear();
    for (const FacetEnd& arriving : ends)
      for (const FacetEnd& leaving : ends) {
        if (arriving.leaves || !leaving.leaves) continue;
        if (out_.facets[arriving.facet].edge == out_.facets[leaving.facet].edge)
          continue;  // both sides of a knife edge
        const double turn = std::abs(std::remainder(leaving.angle - arriving.angle, 2.0 * kPi));
        if (turn < kSharpestTurn) links.push_back({turn, arriving.facet, leaving.facet});
      }
    std::sort(links.begin(), links.end());
    for (const auto& [turn, arriving, leaving] : links) {
      if (out_.facets[arriving].next != kNoFacet || out_.facets[leaving].previous != kNoFacet) continue;
      out_.facets[arriving].next = leaving;
      out_.facets[leaving].previous = arriving;
    }
  }

  void find_cones(std::span<const FacetEnd> ends, Scratch& scratch, std::vector<ConeSector>& cones) const {
    if (ends.size() < 2) return;
    find_star(ends[0].vertex, scratch.star);
    for (std::size_t i = 0; i < ends.size(); ++i) {
      const FacetEnd& from = ends[i];
      const FacetEnd& to = ends[(i + 1) % ends.size()];
      const double to_angle = i + 1 < ends.size() ? to.angle : to.angle + 2.0 * kPi;
      if (to_angle <= from.angle) continue;
      const double middle = 0.5 * (from.angle + to_angle);
      const bool supported = from.kind == SupportKind::kPenumbra ? ring_is_beyond(scratch.star, middle)
                                                                 : star_covers_disk_side(middle, scratch);
      if (supported) cones.push_back({from.vertex, from.kind, from.angle, to_angle, from.facet, to.facet});
    }
  }

  /// Vertices of the band at which no facet ends, since every edge there points into the disk: cones all
  /// round.
  void add_full_cones(const Silhouettes& silhouettes) {
    std::vector<bool> done(mesh_.positions().size(), false);
    for (const FacetEnd& end : ends_)
      if (end.kind == SupportKind::kPenumbra) done[index(end.vertex)] = true;
    Star star;
    for (EdgeId id : silhouettes.band) {
      const Edge& e = mesh_.edges()[index(id)];
      for (VertexId v : {e.from, e.to}) {
        if (done[index(v)]) continue;
        done[index(v)] = true;
        if (!(local(v).z > 0.0) || !(r_ > 0.0)) continue;
        find_star(v, star);
        if (ring_is_beyond(star, 0.0))
          out_.cones.push_back({v, SupportKind::kPenumbra, 0.0, 2.0 * kPi, kNoFacet, kNoFacet});
      }
    }
  }

  void find_star(VertexId v, Star& star) const {
    star.center = local(v);
    star.spokes.clear();
    for (EdgeId id : rings_.edges(v)) {
      const Edge& e = mesh_.edges()[index(id)];
      Star::Spoke spoke{local(e.from == v ? e.to : e.from), local(e.left_apex), std::nullopt};
      if (!e.is_boundary()) spoke.right = local(e.right_apex);
      star.spokes.push_back(spoke);
    }
  }

  /// All neighbours lie beyond the center's tangent plane at the angle: nothing of the star hides the disk's
  /// first point.
  bool ring_is_beyond(const Star& star, double angle) const {
    const glm::dvec2 direction(std::cos(angle), std::sin(angle));
    return std::none_of(star.spokes.begin(), star.spokes.end(), [&](const Star::Spoke& s) {
      return SideOfPlane(star.center, s.end, r_).is_on_disk_side(direction);
    });
  }

  /// Looking from behind the star towards the contact, it covers the whole half on the disk's side: the
  /// corner is reflex, and the first of the light appears at the vertex.
  bool star_covers_disk_side(double angle, Scratch& scratch) const {
    const Vec3 p = scratch.star.center;
    const Vec3 contact{r_ * std::cos(angle), r_ * std::sin(angle), 0.0};
    const Vec3 beyond{std::cos(angle), std::sin(angle),
                      (r_ - std::cos(angle) * p.x - std::sin(angle) * p.y) / p.z};
    const Vec3 along = glm::cross(p - contact, beyond);
    const Vec3 across = beyond * glm::length(along), ahead = along * glm::length(beyond);
    const auto bearing = [&](const Vec3& q) {
      return diamond_angle(glm::dot(ahead, q - p), glm::dot(across, q - p));
    };
    auto& wedges = scratch.wedges;
    wedges.clear();
    for (const Star::Spoke& s : scratch.star.spokes) {
      const double end = bearing(s.end);
      add_wedge(end, bearing(s.left), wedges);
      if (s.right) add_wedge(end, bearing(*s.right), wedges);
    }
    std::sort(wedges.begin(), wedges.end());
    double covered = -kHalfTurn;  // the disk's side is (-kHalfTurn, 0)
    for (const auto& [low, high] : wedges)
      if (low <= covered + 1e-9) covered = std::max(covered, high);
    const bool covers_all =
        covered >= kHalfTurn - 1e-9;  // an inner vertex of the star's picture: no boundary at all
    return covered >= -1e-9 && !covers_all;
  }

  /// The wedge between two bearings, the short way round.
  static void add_wedge(double from, double to, std::vector<std::array<double, 2>>& wedges) {
    if (to < from) std::swap(from, to);
    if (to - from <= kHalfTurn) {
      wedges.push_back({from, to});
    } else {
      wedges.push_back({-kHalfTurn, from});
      wedges.push_back({to, kHalfTurn});
    }
  }

  const TriangleMesh& mesh_;
  const VertexRings& rings_;
  const DiskLight& light_;
  const LightFrame frame_;
  const double r_;
  std::vector<Vec3> local_;  ///< vertices in the light's frame
  std::vector<FacetEnd> ends_;
  Supports out_;
};

}  // namespace

Supports find_supports(const TriangleMesh& mesh, const VertexRings& rings, const DiskLight& light,
                       const Silhouettes& silhouettes) {
  return Finder(mesh, rings, light).run(silhouettes);
}

std::vector<GapFace> find_gap_faces(const TriangleMesh& mesh, const DiskLight& light,
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
      if (glm::dot(glm::cross(b - a, c - a), a - light.center) > 0.0) gaps.push_back({f, facet});
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
