#include "volumes/solids/convex_solid.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "penumbra/volumes/classify.h"
#include "penumbra/volumes/convex_umbra.h"
#include "penumbra/volumes/predicates/predicates.h"
#include "volumes/cells/convex_component.h"
#include "volumes/cells/half_spaces.h"
#include "volumes/cells/penumbra_cell.h"
#include "volumes/cells/shadow_reach.h"
#include "volumes/cells/solid_shape.h"
#include "volumes/predicates/predicate_tiers.h"
#include "volumes/solids/rounded_corners.h"
#include "volumes/solids/simplify/face_boxes.h"
#include "volumes/solids/simplify/triangle_conflict.h"

namespace penumbra::detail {
namespace {

/// Of the tolerance: how far the polygon around the disk may reach beyond it, as magnified by the bound's
/// distance.
constexpr double kPolygon = 0.25;
constexpr int kFewestCorners = 16, kMostCorners = 512;
/// Other polygons are tried where rounding has spoiled a penumbra.
constexpr int kTries = 5;

bool is_one_convex_body(const TriangleMesh& mesh, const CircularLight& light) {
  return mesh.components().size() == 1 && mesh.components()[0].closed &&
         is_convex(mesh, mesh.components()[0]) && std::ranges::all_of(mesh.positions(), [&](const Vec3& p) {
           return side_of_light_plane(p, light) == Sign::kPositive;
         });
}

/// So many that r(1/cos(π/n) - 1), at the far end of the bound, stays below a part of the tolerance.
int corners_for(const SolidMeshRequest& request) {
  const double size = 2.0 * request.bound.radius();
  const CircularLight& light = request.light;
  double spread = light.radius * size;
  if (!light.is_distant()) {
    const Vec3 axis = light_frame(light).w;
    double nearest = size;
    for (const Vec3& p : request.casters[0].positions())
      nearest = std::min(nearest, glm::dot(axis, p - light.center));
    spread = light.radius * size / std::max(nearest, 1e-6 * size);
  }
  const double n = std::numbers::pi * std::sqrt(spread / (2.0 * kPolygon * request.tolerance));
  return std::clamp(static_cast<int>(std::ceil(std::min(n, 1e6))), kFewestCorners, kMostCorners);
}

void add_umbra(const SolidMeshRequest& request, SolidMesh& out) {
  const TriangleMesh& mesh = request.casters[0];
  ExtrudeOptions options;
  options.box = request.bound;
  const ShadowMesh umbra = convex_umbra(mesh, request.light, classify_faces(mesh, request.light), options);
  out.positions = umbra.positions;
  out.triangles = umbra.triangles;
  for (const ShadowTag& tag : umbra.tags) out.is_cap.push_back(tag.kind == ShadowKind::kFarCap ? 1 : 0);
}

void add_penumbra(const SolidMeshRequest& request, int corners, SolidMesh& out) {
  const TriangleMesh& mesh = request.casters[0];
  const SolidShape shape = shape_of_solid(mesh, mesh.components()[0]);
  if (shape.kind == SolidKind::kOther) return;
  ExtrudeOptions options;
  options.bound_center = request.bound.center();
  options.bound_radius = 1.01 * request.bound.radius();
  const ShadowReach reach = shadow_reach(mesh, request.light, options);
  const std::vector<Vec3> body(mesh.positions().begin(), mesh.positions().end());
  const Cell cell = make_penumbra_cell(body, reach, UnitPolygon(corners));
  std::vector<HalfSpace> half_spaces;
  for (const IndexedTriangle& t : cell.triangles)
    half_spaces.push_back({cell.positions[t[0]], cell.positions[t[1]], cell.positions[t[2]]});
  const std::size_t own = half_spaces.size();
  for (const HalfSpace& h : half_spaces_of(request.bound)) half_spaces.push_back(h);
  HalfSpaceCell cut = intersect_half_spaces(half_spaces, shape.inside);
  out.positions = std::move(cut.positions);
  out.triangles = std::move(cut.triangles);
  for (const std::uint32_t h : cut.half_spaces) out.is_cap.push_back(h >= own ? 1 : 0);
}

/// Vertices are rounded: triangles may have lost their area, or meet.
bool is_spoiled(const SolidMesh& mesh) {
  const auto corners = [&](std::size_t i) {
    const IndexedTriangle& t = mesh.triangles[i];
    return std::array<Vec3, 3>{mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]};
  };
  std::vector<Bounds> boxes(mesh.triangles.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const auto c = corners(i);
    if (collinear(c[0], c[1], c[2])) return true;
    for (const Vec3& p : c) boxes[i].add(p);
  }
  const FaceBoxes tree(boxes);
  for (std::uint32_t i = 0; i < boxes.size(); ++i) {
    const auto c = corners(i);
    if (!tree.for_each(boxes[i], [&](std::uint32_t k) {
          return k == i || !are_in_conflict(c, mesh.triangles[i], corners(k), mesh.triangles[k]);
        }))
      return true;
  }
  return false;
}

}  // namespace

std::optional<SolidMesh> mesh_convex_shadow(const SolidMeshRequest& request) {
  if (request.region == ShadowRegion::kLevel || request.casters.size() != 1 ||
      !is_one_convex_body(request.casters[0], request.light))
    return std::nullopt;
  StageClock clock;
  SolidMesh out;
  const bool umbra = request.region == ShadowRegion::kUmbra;
  const int corners = corners_for(request);
  for (int more = 0; more < (umbra ? 1 : kTries); ++more) {
    out = {};
    if (umbra)
      add_umbra(request, out);
    else
      add_penumbra(request, corners + more, out);
    merge_rounded_corners(out);
    if (!out.triangles.empty() && !is_spoiled(out)) break;
    out.triangles.clear();
  }
  clock.finish("convex");
  if (out.triangles.empty()) return std::nullopt;
  for (const char cap : out.is_cap) out.is_proved.push_back(cap ? 0 : 1);
  out.to_prove = out.proved = static_cast<std::size_t>(std::ranges::count(out.is_cap, char{0}));
  out.stages = clock.stages();
  return out;
}

}  // namespace penumbra::detail
