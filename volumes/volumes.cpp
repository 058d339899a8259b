#include "penumbra/volumes/volumes.h"

#include <cmath>

#include "penumbra/mesh/error.h"

namespace penumbra {

namespace {

bool is_finite(const Vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

}  // namespace

void require_valid(const DiskLight& light) {
  if (!is_finite(light.center)) throw UsageError("the light's center is not finite");
  if (!is_finite(light.normal) || light.normal == Vec3(0.0)) {
    throw UsageError("the light's normal is zero or not finite: give the direction in which it shines");
  }
  if (!std::isfinite(light.radius) || light.radius < 0.0) {
    throw UsageError("the light's radius is negative or not finite: give 0 for a point light");
  }
}

ShadowVolumes build_shadow_volumes(const TriangleMesh& mesh, const DiskLight& light,
                                   const VolumeOptions& options) {
  require_valid(light);
  if (mesh.empty()) throw MeshError("the caster has no faces: there is nothing to cast a shadow");
  ShadowVolumes result;
  result.classes = classify_faces(mesh, light);
  result.silhouettes = find_silhouettes(mesh, result.classes);
  if (options.sheets) result.sheets = extrude_sheets(mesh, light, result.silhouettes, options.extrude);
  result.penumbra = extrude_penumbra(mesh, light, result.classes, options.extrude);
  result.umbra = extrude_umbra(mesh, light, result.classes, options.extrude);
  return result;
}

}  // namespace penumbra
