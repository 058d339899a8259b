#include "volumes/solids/solid_mesher.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "volumes/solids/carve.h"
#include "volumes/solids/convex_solid.h"
#include "volumes/solids/hollow.h"
#include "volumes/solids/shafts/shadow_box.h"
#include "volumes/solids/simplify/simplify.h"

namespace penumbra::detail {
namespace {

constexpr int kBoxDepth = 5;          ///< the bound is halved so often to find where shadow may be
constexpr int kBisections = 8;        ///< of a crossed edge
constexpr double kLeast = 1.0 / 256;  ///< of an edge: vertices stay so far from its ends
/// Of the tolerance: grid points are at most so far apart, and at least. Between, their distance is
/// kThickness of the tolerance times (volume over area, in tolerances)^1.5. What is lost to the safe side is
/// a share of the volume that grows with distance over thickness; and thin solids lose more, since their
/// detail is as fine as the tolerance.
constexpr double kCoarsest = 2.0, kFinest = 0.95, kThickness = 0.097;
constexpr double kNearWall =
    4e-3;  ///< of the tolerance: grid points so near to the light's plane are outside
constexpr double kFirstLook = 4.0;     ///< of the tolerance: the grid that tells volume and area
constexpr double kSimplified = 0.075;  ///< of the spacing: so far may simplification move a point
constexpr HiddenProof::Effort kProof{.depth = 1, .thorough = true};  ///< of what is left at the end

class Mesher {
 public:
  explicit Mesher(const SolidMeshRequest& request)
      : request_(request), tree_(request.casters, request.light) {}

  SolidMesh run() {
    const LitBoxes boxes(tree_, request_.light, request_.bound);
    const Bounds box = boxes.shadow_box(kBoxDepth);
    clock_.finish("hierarchy");
    if (box.empty()) return finish();
    out_.spacing = spacing_for(box, boxes);
    SolidGrid grid(box, out_.spacing);
    judge_grid(grid, boxes);
    clock_.finish("grid");
    report(request_.progress, 0.3);
    if (request_.region == ShadowRegion::kPenumbra) {
      enclose_casters(grid);
      fill_cavities(grid);
    }
    CrossedEdges edges(grid, request_.region == ShadowRegion::kPenumbra ? wall() : std::nullopt);
    edges.update(0.5, 0.0);
    bisect(edges);
    clock_.finish("bisection");
    report(request_.progress, 0.4);
    GridSurface surface;
    if (request_.region == ShadowRegion::kLevel) {
      surface = grid_surface(edges, Diagonals::kLarger);
    } else {
      const TriangleJudge judge(request_, tree_);
      surface = carve(grid, edges, request_, judge, out_.evaluations, part_of(request_.progress, 0.4, 0.8));
      if (request_.region == ShadowRegion::kPenumbra && fill_cavities(grid)) {
        edges.update(0.5, 0.0);  // some are gone, none is new
        surface = grid_surface(edges, Diagonals::kLarger);
      }
    }
    clock_.finish("carving");
    if (request_.hollow) {
      leave_out_bodies(grid, edges, request_);
      surface = grid_surface(
          edges, request_.region == ShadowRegion::kUmbra ? Diagonals::kSmaller : Diagonals::kLarger);
      clock_.finish("bodies");
    }
    take(std::move(surface), grid.box());
    clock_.finish("simplification");
    out_.is_proved.assign(out_.triangles.size(), 0);
    if (request_.region != ShadowRegion::kLevel) prove();
    clock_.finish("proof");
    return finish();
  }

 private:
  /// The light's plane: the penumbra ends there.
  std::optional<GridWall> wall() const {
    if (request_.light.is_distant()) return std::nullopt;
    const Vec3 normal = light_frame(request_.light).w;
    return GridWall{normal, glm::dot(normal, request_.light.center)};
  }
  /// By little, behind it, or in it.
  bool is_at_the_wall(const Vec3& p, double little) const {
    const std::optional<GridWall> plane = wall();
    return plane && glm::dot(plane->normal, p) - plane->offset <= little;
  }

  bool is_inside(float seen) const {
    if (request_.region == ShadowRegion::kUmbra) return seen == 0.0f;
    if (request_.region == ShadowRegion::kPenumbra) return seen < 1.0f;
    return static_cast<double>(seen) <= request_.level;
  }

  /// In batches, so that a call can be stopped. Points on and behind the light's plane are outside.
  void judge_points(const std::vector<Vec3>& points, std::vector<char>& inside) {
    inside.assign(points.size(), 0);
    const std::vector<float> seen = request_.judge(points);
    out_.evaluations += points.size();
    for (std::size_t i = 0; i < points.size(); ++i)
      inside[i] = is_inside(seen[i]) && !is_behind(request_.light, points[i]) ? 1 : 0;
  }

  void judge_grid(SolidGrid& grid, const LitBoxes& boxes) {
    std::vector<char> lit(grid.block_count());
    tbb::parallel_for(0u, static_cast<std::uint32_t>(grid.block_count()), [&](std::uint32_t b) {
      const GridIndex low = grid.place(b * 64), high = grid.place(b * 64 + 63);
      Bounds box;
      box.add(grid.point(low));
      box.add(grid.point(high));
      lit[b] = boxes.is_lit(box) ? 1 : 0;
    });
    std::vector<Vec3> points;
    std::vector<std::uint32_t> vertices;
    for (std::uint32_t b = 0; b < lit.size(); ++b) {
      if (lit[b]) continue;
      for (std::uint32_t v = b * 64; v < (b + 1) * 64; ++v) {
        vertices.push_back(v);
        points.push_back(grid.point(v));
      }
    }
    std::vector<char> inside;
    judge_points(points, inside);
    const double little = kNearWall * request_.tolerance;
    for (std::size_t i = 0; i < vertices.size(); ++i)
      grid.set_inside(vertices[i], inside[i] != 0 && !is_at_the_wall(points[i], little));
    out_.grid_points = grid.size();
  }

  /// Volume over area, by a coarse grid: by how many points are inside, and how many of its sides lead
  /// outside. The sides that a plane crosses have 3/2 of its area on average over its directions.
  double spacing_for(const Bounds& box, const LitBoxes& boxes) {
    const double coarsest = kCoarsest * request_.tolerance;
    SolidGrid grid(box, kFirstLook * request_.tolerance);
    judge_grid(grid, boxes);
    const Vec3& step = grid.step();
    const std::array<double, 3> areas{step.y * step.z, step.z * step.x, step.x * step.y};
    double volume = 0.0, area = 0.0;
    for (std::uint32_t v = 0; v < grid.size(); ++v) {
      if (grid.is_inside(v)) volume += step.x * step.y * step.z;
      for (unsigned k = 0; k < 3; ++k) {
        const std::uint32_t next = grid.beyond(v, 1u << k);
        if (next != SolidGrid::kNone && grid.is_inside(v) != grid.is_inside(next)) area += areas[k] / 1.5;
      }
    }
    if (!(volume > 0.0 && area > 0.0)) return coarsest;
    const double thickness = volume / area / request_.tolerance;
    return request_.tolerance * std::clamp(kThickness * std::pow(thickness, 1.5), kFinest, kCoarsest);
  }

  /// What is lit sees the light, so that it hangs together with what lies outside of the grid. What does not
  /// is a fault of the grid, or a body that is open at a hole finer than it.
  static bool fill_cavities(SolidGrid& grid) {
    std::vector<char> reached(grid.size(), 0);
    std::vector<std::uint32_t> waiting;
    const auto reach = [&](std::uint32_t v) {
      if (reached[v] || grid.is_inside(v)) return;
      reached[v] = 1;
      waiting.push_back(v);
    };
    const GridIndex& n = grid.counts();
    for (std::uint32_t v = 0; v < grid.size(); ++v) {
      const GridIndex at = grid.place(v);
      for (int k = 0; k < 3; ++k)
        if (at[k] == 0 || at[k] + 1 == n[k]) reach(v);
    }
    while (!waiting.empty()) {
      const std::uint32_t v = waiting.back();
      waiting.pop_back();
      for_each_edge_at(grid, v, [&](std::uint32_t, unsigned, std::uint32_t next) { reach(next); });
    }
    bool any = false;
    for (std::uint32_t v = 0; v < grid.size(); ++v) {
      if (reached[v] || grid.is_inside(v)) continue;
      grid.set_inside(v, true);
      any = true;
    }
    return any;
  }

  /// The tetrahedron of the grid that holds a point: its diagonal's cube is entered by the largest coordinate
  /// first.
  static std::array<std::uint32_t, 4> tetrahedron_at(const SolidGrid& grid, const Vec3& p) {
    const GridIndex cube = grid.cube_of(p);
    const Vec3 from = (p - grid.point(cube)) / grid.step();
    std::array<int, 3> axes{0, 1, 2};
    std::sort(axes.begin(), axes.end(), [&](int a, int b) { return from[a] > from[b]; });
    std::array<std::uint32_t, 4> corners;
    unsigned bits = 0;
    for (int k = 0; k < 4; ++k) {
      corners[k] = grid.beyond(grid.vertex(cube), bits);
      if (k < 3) bits |= 1u << axes[k];
    }
    return corners;
  }

  /// A surface that meets no caster encloses all of a set of faces that hang together or none of it. So one
  /// corner of each set has to be inside for certain: in a tetrahedron whose corners all are.
  void enclose_casters(SolidGrid& grid) const {
    std::vector<char> enclosed(tree_.component_count(), 0);
    const auto corners_inside = [&](const std::array<std::uint32_t, 4>& t) {
      return std::ranges::count_if(t, [&](std::uint32_t v) { return grid.is_inside(v); });
    };
    for (const CasterTree::Face& face : tree_.faces())
      if (!enclosed[face.component] && corners_inside(tetrahedron_at(grid, face.corners[0])) == 4)
        enclosed[face.component] = 1;
    for (const CasterTree::Face& face : tree_.faces()) {
      if (enclosed[face.component]) continue;
      const auto lit = std::ranges::find_if(
          face.corners, [&](const Vec3& corner) { return !is_behind(request_.light, corner); });
      if (lit == face.corners.end()) continue;
      for (const std::uint32_t v : tetrahedron_at(grid, *lit)) grid.set_inside(v, true);
      enclosed[face.component] = 1;
    }
  }

  void bisect(CrossedEdges& edges) {
    std::vector<CrossedEdge>& all = edges.all();
    std::vector<double> low(all.size(), 0.0), high(all.size(), 1.0);
    std::vector<Vec3> points(all.size());
    std::vector<char> inside;
    for (int round = 0; round < kBisections; ++round) {
      for (std::size_t i = 0; i < all.size(); ++i) {
        if (!all[i].in_wall) all[i].at = 0.5 * (low[i] + high[i]);
        points[i] = edges.position(all[i]);
      }
      judge_points(points, inside);
      for (std::size_t i = 0; i < all.size(); ++i) (inside[i] ? low : high)[i] = all[i].at;
    }
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (all[i].in_wall) continue;
      const double at = request_.region == ShadowRegion::kUmbra      ? low[i]
                        : request_.region == ShadowRegion::kPenumbra ? high[i]
                                                                     : 0.5 * (low[i] + high[i]);
      all[i].at = std::clamp(at, kLeast, 1.0 - kLeast);
    }
  }

  void take(GridSurface surface, const Bounds& box) {
    out_.grid_triangles = surface.triangles.size();
    SimplifyOptions options{.tolerance = kSimplified * out_.spacing,
                            .box = box,
                            .spacing = out_.spacing,
                            .progress = part_of(request_.progress, 0.8, 1.0)};
    options.side = request_.region == ShadowRegion::kUmbra      ? SimplifyOptions::Side::kInward
                   : request_.region == ShadowRegion::kPenumbra ? SimplifyOptions::Side::kOutward
                                                                : SimplifyOptions::Side::kEither;
    IndexedSurface simple = simplify({std::move(surface.positions), std::move(surface.triangles)}, options);
    out_.positions = std::move(simple.positions);
    out_.triangles = std::move(simple.triangles);
    const double little = 2.0 * kSimplified * out_.spacing;
    for (const IndexedTriangle& t : out_.triangles) {
      const bool in_wall =
          std::ranges::all_of(t, [&](std::uint32_t v) { return is_at_the_wall(out_.positions[v], little); });
      out_.is_cap.push_back(in_wall || lies_in_a_side(t, box) ? 1 : 0);
    }
  }

  void prove() {
    std::vector<IndexedTriangle> triangles;
    std::vector<std::size_t> which;
    for (std::size_t i = 0; i < out_.triangles.size(); ++i) {
      if (out_.is_cap[i]) continue;
      which.push_back(i);
      triangles.push_back(out_.triangles[i]);
    }
    const std::vector<char> proved =
        TriangleJudge(request_, tree_).prove({out_.positions, triangles}, kProof);
    for (std::size_t i = 0; i < which.size(); ++i) out_.is_proved[which[i]] = proved[i];
    out_.to_prove = triangles.size();
    out_.proved = static_cast<std::size_t>(std::count(proved.begin(), proved.end(), char{1}));
  }

  bool lies_in_a_side(const IndexedTriangle& t, const Bounds& box) const {
    const auto all = [&](int k, double at) {
      return std::ranges::all_of(t, [&](std::uint32_t v) { return out_.positions[v][k] == at; });
    };
    for (int k = 0; k < 3; ++k)
      if (all(k, box.low[k]) || all(k, box.high[k])) return true;
    return false;
  }

  SolidMesh finish() {
    out_.stages = clock_.stages();
    report(request_.progress, 1.0);
    return std::move(out_);
  }

  const SolidMeshRequest& request_;
  CasterTree tree_;
  StageClock clock_;
  SolidMesh out_;
};

}  // namespace

SolidMesh mesh_shadow(const SolidMeshRequest& request) {
  if (!request.hollow)
    if (std::optional<SolidMesh> convex = mesh_convex_shadow(request)) return std::move(*convex);
  return Mesher(request).run();
}

}  // namespace penumbra::detail
