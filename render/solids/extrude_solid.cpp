#include "penumbra/render/solids/extrude_solid.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "penumbra/mesh/error.h"
#include "penumbra/volumes/volumes.h"
#include "render/casters_impl.h"
#include "render/solids/tiled_points.h"
#include "volumes/solids/solid_mesher.h"

namespace penumbra {
namespace {

/// Of the casters' diagonal.
constexpr double kUsualTolerance = 0.01;
/// The umbra is judged at points by a light that is larger by this.
constexpr double kLarger = 1.0005;

/// A distant light by the tangent of half its angle, so that it stays below 180 degrees.
LightShape enlarged(LightShape light) {
  if (auto* disk = std::get_if<DiskLight>(&light)) disk->radius *= kLarger;
  if (auto* distant = std::get_if<DistantLight>(&light))
    distant->angle_degrees =
        glm::degrees(2.0 * std::atan(kLarger * std::tan(glm::radians(0.5 * distant->angle_degrees))));
  return light;
}

/// The whole call's progress, which calls inside ask whether to go on without a step forward.
class CallProgress {
 public:
  explicit CallProgress(const Progress& whole) : whole_(whole) {}

  Progress forward() {
    if (!whole_) return {};
    return [this](double fraction) {
      reached_ = fraction;
      return whole_(fraction);
    };
  }
  Progress at_rest() {
    if (!whole_) return {};
    return [this](double) { return whole_(reached_); };
  }

 private:
  const Progress& whole_;
  double reached_ = 0.0;
};

detail::JudgePoints judge_of(const Casters& casters, const LightShape& light, CallProgress& progress) {
  return [&casters, light, at_rest = progress.at_rest()](std::span<const Vec3> points) {
    return detail::seen_from(casters, light, points, at_rest);
  };
}

Bounds bound_of(std::span<const TriangleMesh> meshes, const SolidOptions& options) {
  Bounds casters;
  for (const TriangleMesh& mesh : meshes) casters.add(mesh.bounds());
  if (options.bound.empty()) {
    const Vec3 by(2.0 * casters.radius());
    return {casters.low - by, casters.high + by};
  }
  for (int k = 0; k < 3; ++k)
    if (!(options.bound.low[k] < casters.low[k] && casters.high[k] < options.bound.high[k]))
      throw UsageError("the bound of a solid does not hold all casters; give a larger one");
  return options.bound;
}

void measure(ShadowSolid& solid) {
  const auto& p = solid.mesh.positions;
  if (p.empty()) return;
  const Vec3 apex = p.front();
  for (const IndexedTriangle& t : solid.mesh.triangles) {
    const Vec3 a = p[t[0]] - apex, b = p[t[1]] - apex, c = p[t[2]] - apex;
    solid.volume += glm::dot(a, glm::cross(b, c)) / 6.0;
    solid.area += 0.5 * glm::length(glm::cross(b - a, c - a));
  }
}

ShadowSolid solid_of(detail::SolidMesh mesh, const SolidOptions& options) {
  ShadowSolid out;
  out.mesh.positions = std::move(mesh.positions);
  out.mesh.triangles = std::move(mesh.triangles);
  for (const char cap : mesh.is_cap)
    out.mesh.tags.push_back({cap ? ShadowKind::kFarCap : ShadowKind::kSolid, 0, options.object});
  out.is_proved = std::move(mesh.is_proved);
  out.proved = mesh.proved;
  out.to_prove = mesh.to_prove;
  out.mesh.guarantee = !options.hollow && out.to_prove > 0 && out.proved == out.to_prove
                           ? Guarantee::kCertified
                           : Guarantee::kWithin;
  out.grid_triangles = mesh.grid_triangles;
  out.spacing = mesh.spacing;
  out.grid_points = mesh.grid_points;
  out.evaluations = mesh.evaluations;
  out.stages = std::move(mesh.stages);
  measure(out);
  return out;
}

}  // namespace

ShadowSolid extrude_solid(const Casters& casters, const LightShape& light, const ShadowLevel& level,
                          const SolidOptions& options) {
  const CircularLight circular = require_circular(light, "solids");
  require_valid(circular);
  if (!(options.tolerance >= 0.0 && std::isfinite(options.tolerance)))
    throw UsageError("the tolerance of a solid must be a number of scene units from 0 on");
  if (!(level.fraction > 0.0 && level.fraction < 1.0))
    throw UsageError("the level of a solid must be a fraction of the light above 0 and below 1");
  const std::vector<TriangleMesh> meshes = detail::casting_meshes(casters);
  if (meshes.empty()) return {};
  const Bounds bound = bound_of(meshes, options);
  Bounds box;
  for (const TriangleMesh& mesh : meshes) box.add(mesh.bounds());
  const double tolerance = options.tolerance > 0.0 ? options.tolerance : kUsualTolerance * 2.0 * box.radius();
  const bool umbra = level.kind == ShadowLevel::Kind::kUmbra;
  CallProgress progress(options.progress);
  const detail::SolidMeshRequest request{
      .casters = meshes,
      .light = circular,
      .region = static_cast<detail::ShadowRegion>(level.kind),
      .level = level.fraction,
      .bound = bound,
      .tolerance = tolerance,
      .hollow = options.hollow,
      .judge = judge_of(casters, umbra ? enlarged(light) : light, progress),
      .progress = progress.forward()};
  ShadowSolid out =
      casters.impl().threads->execute([&] { return solid_of(detail::mesh_shadow(request), options); });
  out.tolerance = tolerance;
  return out;
}

}  // namespace penumbra
