#include <tbb/parallel_for.h>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "penumbra/mesh/error.h"
#include "penumbra/volumes/extrude.h"
#include "volumes/cells/convex_component.h"
#include "volumes/cells/convex_patches.h"
#include "volumes/cells/inverted_folds.h"
#include "volumes/cells/penumbra_cell.h"
#include "volumes/predicates/predicate_tiers.h"

namespace penumbra {

namespace {

// Between two calls of progress.
constexpr std::size_t kCellsPerStep = 512, kFacesPerStep = 2048;
// The share of the time that choosing bodies takes, for progress.
constexpr double kChoosing = 0.5;
// Accuracy: how far behind the light's plane a face that crosses it is cut, as a fraction of the edge.
// Rounding then takes nothing from the part in front.
constexpr double kBehind = 1e-12;

/// A convex body to be extruded: the hull of some vertices, or one face.
struct Body {
  FaceId source;
  std::vector<std::uint32_t> vertices{};  ///< none: the face alone, of which some may be behind the light
};

class PenumbraExtruder {
 public:
  PenumbraExtruder(const TriangleMesh& mesh, const CircularLight& light, const Classification& classes,
                   const ExtrudeOptions& options)
      : mesh_(mesh),
        classes_(classes),
        options_(options),
        reach_(detail::shadow_reach(mesh, light, options)),
        polygon_(options.cone_segments) {
    depth_signs_.reserve(mesh.positions().size());
    for (const Vec3& p : mesh.positions()) depth_signs_.push_back(side_of_light_plane(p, light));
  }

  ShadowMesh run() {
    const std::vector<Body> bodies = choose_bodies();
    ShadowMesh result;
    result.guarantee = Guarantee::kContains;
    std::vector<detail::Cell> cells;
    for (std::size_t begin = 0; begin < bodies.size(); begin += kCellsPerStep) {
      const std::size_t end = std::min(bodies.size(), begin + kCellsPerStep);
      cells.assign(end - begin, {});
      tbb::parallel_for(begin, end, [&](std::size_t i) { cells[i - begin] = cell_of(bodies[i]); });
      for (std::size_t i = begin; i < end; ++i) append(cells[i - begin], bodies[i].source, result);
      report(options_.progress, kChoosing + (1.0 - kChoosing) * share(end, bodies.size()));
    }
    return result;
  }

 private:
  bool in_front(const IndexedTriangle& t) const {
    return std::all_of(t.begin(), t.end(),
                       [&](std::uint32_t v) { return depth_signs_[v] == Sign::kPositive; });
  }
  bool reaches_front(const IndexedTriangle& t) const {
    return std::any_of(t.begin(), t.end(),
                       [&](std::uint32_t v) { return depth_signs_[v] == Sign::kPositive; });
  }
  const IndexedTriangle& triangle(FaceId f) const { return mesh_.triangles()[index(f)]; }

  std::vector<Body> choose_bodies() const {
    std::vector<Body> bodies;
    std::size_t patched = 0;  // faces
    const auto report_some = [&](const detail::ConvexPatch& patch) {
      const std::size_t steps = patched / kFacesPerStep;
      patched += patch.faces.size();
      if (patched / kFacesPerStep > steps)
        report(options_.progress, kChoosing * share(patched, mesh_.triangles().size()));
    };
    std::optional<detail::PatchFinder> finder;
    for (const Component& component : mesh_.components()) {
      const bool front = std::all_of(component.faces.begin(), component.faces.end(),
                                     [&](FaceId f) { return in_front(triangle(f)); });
      const bool solid = front && component.closed && component.signed_volume > 0.0;
      if (solid && options_.split_convex && detail::is_convex(mesh_, component)) {
        bodies.push_back({component.faces.front(), vertices_of(component)});
        continue;
      }
      if (!solid || !options_.assume_solid) {
        add_faces(component.faces, false, bodies);
        continue;
      }
      const detail::FaceTree tree(mesh_, component.faces);
      const std::vector<FaceId> folds = detail::faces_of_inverted_folds(mesh_, component, tree);
      std::vector<FaceId> others;
      std::set_difference(component.faces.begin(), component.faces.end(), folds.begin(), folds.end(),
                          std::back_inserter(others));
      add_faces(folds, false, bodies);
      if (!options_.merge_faces) {
        add_faces(others, true, bodies);
        continue;
      }
      std::erase_if(others, [&](FaceId f) { return !casts(f, true); });
      if (!finder) finder.emplace(mesh_);
      add_patches(finder->find(tree, others, report_some), bodies);
    }
    return bodies;
  }

  /// A body for each face that casts.
  void add_faces(std::span<const FaceId> faces, bool solid, std::vector<Body>& bodies) const {
    for (const FaceId f : faces)
      if (casts(f, solid)) bodies.push_back({f});
  }

  void add_patches(std::vector<detail::ConvexPatch> patches, std::vector<Body>& bodies) const {
    for (detail::ConvexPatch& patch : patches) {
      if (patch.faces.size() > 1 && detail::is_cut_by_depth(positions_of(patch.vertices), reach_)) {
        bodies.push_back({patch.faces.front(), std::move(patch.vertices)});
      } else {
        for (const FaceId f : patch.faces) bodies.push_back({f});
      }
    }
  }

  /// A solid in front of the light needs no cells for faces that look away from the whole disk, but for those
  /// of inverted folds. Proof: let x be shaded from p, a point of the disk, which is outside the solid. On
  /// the way from x to p the winding number of the surface changes somewhere, and in the end it is 0. If it
  /// falls somewhere, the path leaves there through a face that looks at p. That is so from a point x inside
  /// the solid, too, so the cells hold the solid itself. If it only rises, it is negative at first, and the
  /// face where it rises to 0 has a negative winding number in front of it: that face belongs to a fold and
  /// has a cell.
  bool casts(FaceId f, bool solid) const {
    if (solid && classes_.faces[index(f)] == FaceClass::kNoneFront) return false;
    const IndexedTriangle& t = triangle(f);
    if (!reaches_front(t)) return false;
    const std::span<const Vec3> p = mesh_.positions();
    return !detail::collinear(p[t[0]], p[t[1]], p[t[2]]);
  }

  detail::Cell cell_of(const Body& body) const {
    return detail::make_penumbra_cell(
        body.vertices.empty() ? corners_in_front(body.source) : positions_of(body.vertices), reach_,
        polygon_);
  }

  std::vector<std::uint32_t> vertices_of(const Component& component) const {
    std::vector<std::uint32_t> vertices;
    for (const FaceId f : component.faces) {
      for (const std::uint32_t v : triangle(f)) vertices.push_back(v);
    }
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    return vertices;
  }

  std::vector<Vec3> positions_of(std::span<const std::uint32_t> vertices) const {
    std::vector<Vec3> positions;
    for (const std::uint32_t v : vertices) positions.push_back(mesh_.positions()[v]);
    return positions;
  }

  /// The part of a face with depth ≥ 0, cut a hair behind the light's plane.
  std::vector<Vec3> corners_in_front(FaceId f) const {
    const IndexedTriangle& t = triangle(f);
    std::vector<Vec3> corners;
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t v = t[i], w = t[(i + 1) % 3];
      const Vec3 &p = mesh_.positions()[v], &q = mesh_.positions()[w];
      if (depth_signs_[v] != Sign::kNegative) corners.push_back(p);
      const bool crosses = depth_signs_[v] != Sign::kZero && depth_signs_[w] != Sign::kZero &&
                           depth_signs_[v] != depth_signs_[w];
      if (!crosses) continue;
      const bool leaves = depth_signs_[v] == Sign::kPositive;
      const Vec3 &front = leaves ? p : q, &back = leaves ? q : p;
      const double above = std::abs(reach_.depth(front)), below = std::abs(reach_.depth(back));
      const double s = std::min(1.0, above / (above + below) + kBehind);
      corners.push_back(front + s * (back - front));
    }
    return corners;
  }

  void append(const detail::Cell& cell, FaceId source, ShadowMesh& out) const {
    if (cell.triangles.empty()) return;
    const auto first = static_cast<std::uint32_t>(out.positions.size());
    out.positions.insert(out.positions.end(), cell.positions.begin(), cell.positions.end());
    for (std::size_t i = 0; i < cell.triangles.size(); ++i) {
      const IndexedTriangle& t = cell.triangles[i];
      out.triangles.push_back({first + t[0], first + t[1], first + t[2]});
      out.tags.push_back({cell.kinds[i], static_cast<std::uint32_t>(index(source)), options_.object});
    }
    ++out.cells;
  }

  static double share(std::size_t part, std::size_t all) {
    return static_cast<double>(part) / static_cast<double>(all);
  }

  const TriangleMesh& mesh_;
  const Classification& classes_;
  const ExtrudeOptions& options_;
  detail::ShadowReach reach_;
  detail::UnitPolygon polygon_;
  std::vector<Sign> depth_signs_;  ///< per vertex: before, in, or behind the light's plane
};

}  // namespace

ShadowMesh extrude_penumbra(const TriangleMesh& mesh, const CircularLight& light,
                            const Classification& classes, const ExtrudeOptions& options) {
  return PenumbraExtruder(mesh, light, classes, options).run();
}

}  // namespace penumbra
