#include "penumbra/volumes/convex_umbra.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <utility>

#include "mesh/vectors.h"
#include "penumbra/mesh/error.h"
#include "penumbra/volumes/predicates/predicates.h"
#include "penumbra/volumes/tangent_planes.h"
#include "volumes/cells/convex_hull.h"
#include "volumes/cells/half_spaces.h"
#include "volumes/cells/shadow_reach.h"
#include "volumes/cells/solid_shape.h"
#include "volumes/predicates/predicate_tiers.h"

namespace penumbra {

namespace {

using detail::HalfSpace;
using detail::HalfSpaceCell;
using detail::SolidKind;
using detail::SolidShape;

// Between two calls of progress.
constexpr std::size_t kComponentsPerStep = 256;
// Accuracy: how far a kernel's corners are moved inward, as a fraction of the way to its middle. Far more
// than they are rounded.
constexpr double kInward = 0x1p-40;

/// The half-spaces whose intersection is one body's umbra, and where each comes from.
struct UmbraBounds {
  std::vector<HalfSpace> half_spaces;
  std::vector<ShadowTag> tags;

  void add(const HalfSpace& h, ShadowKind kind, std::uint32_t source) {
    half_spaces.push_back(h);
    tags.push_back({kind, source, 0});
  }
};

/// Turns the plane through three points so that the average of `inside` is below it. False where rounding
/// cannot tell that point from the plane; the intersection decides exactly.
bool turn_outward(HalfSpace& h, const std::array<Vec3, 4>& inside) {
  const Vec3 normal = glm::cross(h[1] - h[0], h[2] - h[0]);
  double height = 0.0;
  for (const Vec3& p : inside) height += glm::dot(normal, p - h[0]);
  if (height > 0.0) std::swap(h[1], h[2]);
  return height != 0.0;
}

/// One convex body in front of the light: a component of a mesh, with the classes of its faces.
class UmbraOfBody {
 public:
  UmbraOfBody(const TriangleMesh& mesh, const Component& component, const CircularLight& light,
              const Classification& classes, const detail::ShadowReach& reach, const Bounds& box)
      : mesh_(mesh), component_(component), light_(light), classes_(classes), reach_(reach), box_(box) {}

  /// A cap for each face that looks at some of the disk, the tangent plane of each edge between such a face
  /// and one that does not, and a box beyond the bound.
  UmbraBounds bounds(const std::array<Vec3, 4>& inside) const {
    UmbraBounds result;
    for (const FaceId f : component_.faces) {
      if (!looks_away(f)) result.add(corners(f), ShadowKind::kUmbraCap, static_cast<std::uint32_t>(f));
      for (const EdgeId e : mesh_.face_edges()[index(f)]) {
        const Edge& edge = mesh_.edges()[index(e)];
        if (edge.left != f || looks_away(edge.left) == looks_away(edge.right)) continue;
        result.add(tangent_half_space(edge, inside), ShadowKind::kUmbraFacet, static_cast<std::uint32_t>(e));
      }
    }
    add_box(result);
    return result;
  }

 private:
  bool looks_away(FaceId f) const { return classes_.faces[index(f)] == FaceClass::kNoneFront; }
  HalfSpace corners(FaceId f) const {
    const IndexedTriangle& t = mesh_.triangles()[index(f)];
    return {mesh_.positions()[t[0]], mesh_.positions()[t[1]], mesh_.positions()[t[2]]};
  }

  /// A face that looks away has its third vertex on the disk's side of kFirst along its own direction of the
  /// edge (predicates.h). A convex body is on one side with it. Its third point lies on the way to the
  /// contact, as far from the edge as the edge is from the origin or further, so that rounding turns the
  /// plane by some 2^-53. Where rounding takes that point onto the edge's line, the plane of the face that
  /// looks away is taken: it is the limit, and takes away too much rather than too little.
  HalfSpace tangent_half_space(const Edge& edge, const std::array<Vec3, 4>& inside) const {
    const bool left_away = looks_away(edge.left);
    const Vec3 &from = mesh_.position(edge.from), &to = mesh_.position(edge.to);
    const auto planes = tangent_planes(from, to, light_);
    HalfSpace h{from, to, from};
    if (planes) {
      const Vec3& way = (*planes)[left_away ? 0 : 1].way;
      const double far = detail::largest_component(from) / detail::largest_component(way);
      h[2] += (far > 1.0 ? far : 1.0) * way;
    }
    if (detail::collinear(h[0], h[1], h[2]) || !turn_outward(h, inside))
      return corners(left_away ? edge.left : edge.right);
    return h;
  }

  void add_box(UmbraBounds& bounds) const {
    const auto source = static_cast<std::uint32_t>(component_.faces.front());
    if (!box_.empty()) {
      for (const HalfSpace& h : detail::half_spaces_of(box_)) bounds.add(h, ShadowKind::kFarCap, source);
      return;
    }
    double half = reach_.bound_radius;
    for (const FaceId f : component_.faces) {
      for (const Vec3& p : corners(f)) half = std::max(half, glm::length(p - reach_.bound_center));
    }
    half *= 2.0;
    for (const double side : {-half, half}) {
      for (int axis = 0; axis < 3; ++axis) {
        const auto at = [&](double y, double z) {
          const std::array<const Vec3*, 3> axes{&reach_.frame.u, &reach_.frame.v, &reach_.frame.w};
          return reach_.bound_center + side * *axes[axis] + y * *axes[(axis + 1) % 3] +
                 z * *axes[(axis + 2) % 3];
        };
        HalfSpace h{at(-half, -half), at(half, -half), at(-half, half)};
        if (side < 0.0) std::swap(h[1], h[2]);
        bounds.add(h, ShadowKind::kFarCap, source);
      }
    }
  }

  const TriangleMesh& mesh_;
  const Component& component_;
  const CircularLight& light_;
  const Classification& classes_;
  const detail::ShadowReach& reach_;
  const Bounds& box_;
};

class UmbraExtruder {
 public:
  UmbraExtruder(const TriangleMesh& mesh, const CircularLight& light, const Classification& classes,
                const ExtrudeOptions& options)
      : mesh_(mesh),
        light_(light),
        classes_(classes),
        options_(options),
        reach_(detail::shadow_reach(mesh, light, options)) {}

  ShadowMesh run() {
    const std::span<const Component> components = mesh_.components();
    std::vector<Piece> pieces(components.size());
    bool exact = components.size() == 1;
    for (std::size_t begin = 0, end = 0; begin < components.size(); begin = end) {
      end = std::min(components.size(), begin + kComponentsPerStep);
      tbb::parallel_for(begin, end, [&](std::size_t i) { pieces[i] = umbra_of(components[i]); });
      for (std::size_t i = begin; i < end; ++i) exact = append(std::exchange(pieces[i], {})) && exact;
      report(options_.progress, static_cast<double>(end) / static_cast<double>(components.size()));
    }
    result_.guarantee = exact ? Guarantee::kExact : Guarantee::kContained;
    return std::move(result_);
  }

 private:
  /// A component's part of the umbra.
  struct Piece {
    HalfSpaceCell cell;
    std::vector<ShadowTag> tags;  ///< per half-space
    bool whole = false;           ///< all that the component hides
  };

  Piece umbra_of(const Component& component) const {
    if (!is_in_front(component)) return {};
    const SolidShape shape = detail::shape_of_solid(mesh_, component);
    if (shape.kind == SolidKind::kOther) return {};
    if (shape.kind == SolidKind::kStarShaped) return umbra_of_kernel(component, shape.inside);
    UmbraBounds bounds =
        UmbraOfBody(mesh_, component, light_, classes_, reach_, options_.box).bounds(shape.inside);
    return {detail::intersect_half_spaces(bounds.half_spaces, shape.inside), std::move(bounds.tags), true};
  }

  bool is_in_front(const Component& component) const {
    return std::all_of(component.faces.begin(), component.faces.end(), [&](FaceId f) {
      const IndexedTriangle& t = mesh_.triangles()[index(f)];
      return std::all_of(t.begin(), t.end(), [&](std::uint32_t v) {
        return side_of_light_plane(mesh_.positions()[v], light_) == Sign::kPositive;
      });
    });
  }

  Piece umbra_of_kernel(const Component& component, const std::array<Vec3, 4>& inside) const {
    const TriangleMesh kernel = kernel_of(component, inside);
    if (kernel.components().size() != 1 || !is_in_front_whole(kernel)) return {};
    const SolidShape shape = detail::shape_of_solid(kernel, kernel.components().front());
    if (shape.kind != SolidKind::kConvex) return {};
    const Classification classes = classify_faces(kernel, light_);
    UmbraBounds bounds =
        UmbraOfBody(kernel, kernel.components().front(), light_, classes, reach_, options_.box)
            .bounds(shape.inside);
    for (ShadowTag& tag : bounds.tags) {
      if (tag.kind != ShadowKind::kFarCap) tag.kind = ShadowKind::kCell;
      tag.source = static_cast<std::uint32_t>(component.faces.front());
    }
    return {detail::intersect_half_spaces(bounds.half_spaces, shape.inside), std::move(bounds.tags), false};
  }

  bool is_in_front_whole(const TriangleMesh& kernel) const {
    return std::all_of(kernel.positions().begin(), kernel.positions().end(),
                       [&](const Vec3& p) { return side_of_light_plane(p, light_) == Sign::kPositive; });
  }

  /// What is below all faces of a star-shaped component: a convex body inside it.
  TriangleMesh kernel_of(const Component& component, const std::array<Vec3, 4>& inside) const {
    std::vector<HalfSpace> half_spaces;
    for (const FaceId f : component.faces) {
      const IndexedTriangle& t = mesh_.triangles()[index(f)];
      half_spaces.push_back({mesh_.positions()[t[0]], mesh_.positions()[t[1]], mesh_.positions()[t[2]]});
    }
    HalfSpaceCell cell = detail::intersect_half_spaces(half_spaces, inside);
    const Vec3 middle = 0.25 * (inside[0] + inside[1] + inside[2] + inside[3]);
    for (Vec3& p : cell.positions) p += kInward * (middle - p);
    return TriangleMesh::build(cell.positions, detail::convex_hull(cell.positions));
  }

  /// True where nothing of the umbra is missing.
  bool append(const Piece& piece) {
    const HalfSpaceCell& cell = piece.cell;
    if (cell.triangles.empty()) return false;
    const auto first = static_cast<std::uint32_t>(result_.positions.size());
    result_.positions.insert(result_.positions.end(), cell.positions.begin(), cell.positions.end());
    for (std::size_t i = 0; i < cell.triangles.size(); ++i) {
      const IndexedTriangle& t = cell.triangles[i];
      result_.triangles.push_back({first + t[0], first + t[1], first + t[2]});
      result_.tags.push_back(piece.tags[cell.half_spaces[i]]);
      result_.tags.back().object = options_.object;
    }
    ++result_.cells;
    return piece.whole;
  }

  const TriangleMesh& mesh_;
  const CircularLight& light_;
  const Classification& classes_;
  const ExtrudeOptions& options_;
  detail::ShadowReach reach_;
  ShadowMesh result_;
};

}  // namespace

ShadowMesh convex_umbra(const TriangleMesh& mesh, const CircularLight& light, const Classification& classes,
                        const ExtrudeOptions& options) {
  return UmbraExtruder(mesh, light, classes, options).run();
}

}  // namespace penumbra
