// Where facets of a shadow boundary meet: which goes on with which, and the sectors of cones between them.
//
// A plane that touches the disk of radius r at rim angle φ is n·p = r with n = (cos φ, sin φ, κ): the disk
// lies where n·p ≤ r. Through a vertex v it has κ = (r - cos φ v.x - sin φ v.y) / v.z, so that the side of q
// is, times v.z,
//   A cos φ + B sin φ + C,   A = d.x v.z - v.x d.z,  B = d.y v.z - v.y d.z,  C = r d.z,  d = q - v:
// positive beyond the plane, negative on the disk's side. Everything below is this one expression. v is the
// way from the light's center to the vertex; of a distant light it is (0, 0, 1), and the expression is still
// right. d is the difference of two vertices as they are, which a light far away does not round.
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

#include "penumbra/volumes/supports.h"

namespace penumbra {
namespace {

constexpr double kPi = std::numbers::pi;

// Accuracy; held by supports_test.cpp.

/// A point this little off a plane, as the sine of an angle, counts as lying on it. So coplanar neighbors do,
/// in spite of rounding.
constexpr double kOnPlane = 1e-11;
/// Radians. Where the boundary would turn further at a vertex, the two facet ends belong to different parts
/// of the contour (the far sides of a saddle).
constexpr double kSharpestTurn = 0.7 * kPi;

struct SideOfPlane {
  double a, b, c;
  SideOfPlane(const Vec3& v, const Vec3& d, double r) {
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

/// Grows with the angle of (x, y) from -kHalfTurn to kHalfTurn, opposite directions differ by kHalfTurn, and
/// no transcendental function is called.
constexpr double kHalfTurn = 2.0;
double diamond_angle(double x, double y) {
  const double size = std::abs(x) + std::abs(y);
  if (!(size > 0.0)) return 0.0;
  return x >= 0.0 ? y / size : y >= 0.0 ? 2.0 - y / size : -2.0 - y / size;
}

/// A vertex and what is around it, along the axes of the light's frame.
struct Star {
  /// The ways from the vertex to the other end of an edge and to the apexes of the faces beside it.
  struct Spoke {
    Vec3 end, left;
    std::optional<Vec3> right;
  };
  /// The way from the light's center to the vertex.
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

/// Marks of both ends of every facet for which `counts(facet)`.
template <class Counts>
std::vector<char> ends_of_facets(const TriangleMesh& mesh, const Supports& supports, const Counts& counts) {
  std::vector<char> marks(mesh.positions().size(), 0);
  for (std::size_t i = 0; i < supports.facets.size(); ++i) {
    if (!counts(i)) continue;
    const Edge& e = mesh.edges()[index(supports.facets[i].edge)];
    marks[index(e.from)] = marks[index(e.to)] = 1;
  }
  return marks;
}

class CornerFinder {
 public:
  CornerFinder(const TriangleMesh& mesh, const VertexRings& rings, const CircularLight& light,
               Supports& supports)
      : mesh_(mesh),
        rings_(rings),
        light_(light),
        frame_(light_frame(light)),
        r_(light.radius),
        out_(supports) {}

  /// Links facets and finds cones, vertex by vertex, where `is_wanted(vertex)`.
  template <class IsWanted>
  void find_corners(const IsWanted& is_wanted) {
    const std::vector<FacetEnd> ends = sorted_ends(is_wanted);
    std::vector<std::span<const FacetEnd>> corners;
    for (std::size_t first = 0; first < ends.size();) {
      std::size_t last = first;
      while (last < ends.size() && ends[last].vertex == ends[first].vertex &&
             ends[last].kind == ends[first].kind)
        ++last;
      corners.emplace_back(ends.data() + first, last - first);
      first = last;
    }
    // A facet has one end at each vertex, so that no two corners write to the same link.
    std::vector<std::vector<ConeSector>> cones(corners.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, corners.size(), 256), [&](const auto& range) {
      Scratch scratch;
      for (std::size_t i = range.begin(); i < range.end(); ++i) {
        link_ends(corners[i], scratch);
        if (from_light(corners[i][0].vertex).z > 0.0) find_cones(corners[i], scratch, cones[i]);
      }
    });
    for (const auto& found : cones) out_.cones.insert(out_.cones.end(), found.begin(), found.end());
  }

  /// Vertices of the band at which no facet ends, since every edge there points into the disk: cones all
  /// round.
  void add_full_cones(const Silhouettes& silhouettes) {
    std::vector<char> done = ends_of_facets(
        mesh_, out_, [&](std::size_t i) { return out_.facets[i].kind == SupportKind::kPenumbra; });
    Star star;
    for (EdgeId id : silhouettes.band) {
      const Edge& e = mesh_.edges()[index(id)];
      for (VertexId v : {e.from, e.to}) {
        if (done[index(v)]) continue;
        done[index(v)] = 1;
        if (!(from_light(v).z > 0.0) || !(r_ > 0.0)) continue;
        find_star(v, star);
        if (ring_is_beyond(star, 0.0))
          out_.cones.push_back({v, SupportKind::kPenumbra, 0.0, 2.0 * kPi, kNoFacet, kNoFacet});
      }
    }
  }

 private:
  Vec3 along_axes(const Vec3& d) const {
    return {glm::dot(d, frame_.u), glm::dot(d, frame_.v), glm::dot(d, frame_.w)};
  }
  Vec3 from_light(VertexId v) const { return along_axes(-way_to_center(light_, mesh_.position(v))); }
  Vec3 between(VertexId from, VertexId to) const {
    return along_axes(mesh_.position(to) - mesh_.position(from));
  }

  template <class IsWanted>
  std::vector<FacetEnd> sorted_ends(const IsWanted& is_wanted) const {
    std::vector<FacetEnd> ends;
    for (std::uint32_t i = 0; i < out_.facets.size(); ++i) {
      const SupportFacet& f = out_.facets[i];
      const Edge& e = mesh_.edges()[index(f.edge)];
      if (is_wanted(e.from)) ends.push_back({e.from, f.kind, f.rim_angle, i, !f.flipped});
      if (is_wanted(e.to)) ends.push_back({e.to, f.kind, f.rim_angle, i, f.flipped});
    }
    tbb::parallel_sort(ends.begin(), ends.end(), [](const FacetEnd& x, const FacetEnd& y) {
      return std::tie(x.vertex, x.kind, x.angle, x.facet) < std::tie(y.vertex, y.kind, y.angle, y.facet);
    });
    return ends;
  }

  /// Facets that arrive at the vertex go on with facets that leave it, the smallest turns first.
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

  void find_star(VertexId v, Star& star) const {
    star.center = from_light(v);
    star.spokes.clear();
    for (EdgeId id : rings_.edges(v)) {
      const Edge& e = mesh_.edges()[index(id)];
      Star::Spoke spoke{between(v, e.from == v ? e.to : e.from), between(v, e.left_apex), std::nullopt};
      if (!e.is_boundary()) spoke.right = between(v, e.right_apex);
      star.spokes.push_back(spoke);
    }
  }

  /// All neighbors lie beyond the center's tangent plane at the angle: nothing of the star hides the disk's
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
    const auto bearing = [&](const Vec3& d) {
      return diamond_angle(glm::dot(ahead, d), glm::dot(across, d));
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
  const CircularLight light_;
  const LightFrame frame_;
  const double r_;
  Supports& out_;
};

}  // namespace

Supports find_supports(const TriangleMesh& mesh, const VertexRings& rings, const CircularLight& light,
                       const Silhouettes& silhouettes) {
  Supports out{find_support_facets(mesh, light, silhouettes), {}};
  CornerFinder finder(mesh, rings, light, out);
  finder.find_corners([](VertexId) { return true; });
  finder.add_full_cones(silhouettes);
  return out;
}

void link_support_facets(const TriangleMesh& mesh, const VertexRings& rings, const CircularLight& light,
                         std::span<const char> in_use, Supports& supports) {
  const std::vector<char> wanted =
      ends_of_facets(mesh, supports, [&](std::size_t i) { return in_use[i] != 0; });
  CornerFinder(mesh, rings, light, supports).find_corners([&](VertexId v) { return wanted[index(v)] != 0; });
}

}  // namespace penumbra
