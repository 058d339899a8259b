#include "penumbra/volumes/volumes.h"

#include <cmath>

#include "penumbra/mesh/error.h"
#include "volumes/cells/shadow_reach.h"

namespace penumbra {

namespace {

bool is_finite(const Vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

}  // namespace

void require_valid(const CircularLight& light) {
  const std::string normal = light.is_distant() ? "direction" : "normal";
  if (!is_finite(light.normal) || light.normal == Vec3(0.0)) {
    throw UsageError("the light's " + normal +
                     " is zero or not finite: give the direction in which it shines");
  }
  if (!is_finite(light.center)) throw UsageError("the light's center is not finite");
  if (light.is_distant() && !(light.radius >= 0.0)) {
    throw UsageError("the light's angle is not a number of degrees from 0 to below 180");
  }
  if (!std::isfinite(light.radius) || light.radius < 0.0) {
    throw UsageError("the light's radius is negative or not finite: give 0 for a point light");
  }
}

ShadowVolumes build_shadow_volumes(const TriangleMesh& mesh, const CircularLight& light,
                                   const VolumeOptions& options) {
  require_valid(light);
  detail::require_valid(options.extrude);
  if (mesh.empty()) throw MeshError("the caster has no faces: there is nothing to cast a shadow");
  report(options.extrude.progress, 0.0);
  ShadowVolumes result;
  StageClock clock;
  result.classes = classify_faces(mesh, light);
  clock.finish("classify");
  result.silhouettes = find_silhouettes(mesh, result.classes);
  clock.finish("silhouettes");

  const double products = options.sheets + options.penumbra + options.umbra;
  int finished = 0;
  const auto extrude = [&](const char* name, const auto& make) {
    ExtrudeOptions part = options.extrude;
    part.progress = part_of(options.extrude.progress, finished / products, (finished + 1) / products);
    ShadowMesh product = make(part);
    ++finished;
    clock.finish(name);
    return product;
  };
  if (options.sheets) {
    result.sheets = extrude("sheets", [&](const ExtrudeOptions& part) {
      return extrude_sheets(mesh, light, result.silhouettes, part);
    });
  }
  if (options.penumbra) {
    result.penumbra = extrude("penumbra", [&](const ExtrudeOptions& part) {
      return extrude_penumbra(mesh, light, result.classes, part);
    });
  }
  if (options.umbra) {
    result.umbra = extrude(
        "umbra", [&](const ExtrudeOptions& part) { return convex_umbra(mesh, light, result.classes, part); });
  }
  result.stages = clock.stages();
  return result;
}

}  // namespace penumbra
