#include "render/scene/default_scene.h"

#include <nlohmann/json.hpp>
#include <vector>

#include "penumbra/mesh/error.h"
#include "penumbra/mesh/shapes.h"

namespace penumbra::detail {
namespace {

// Lengths below are for a mesh whose bounding sphere has this radius, as that of a mesh in [-1, 1]³ about
// has.
constexpr double kModelRadius = 1.5;

double scale_of(const Bounds& bounds) {
  return bounds.radius() / kModelRadius;
}

Vec3 foot_of(const Bounds& bounds) {
  return {bounds.center().x, bounds.low.y, bounds.center().z};
}

DiskLight light_for(const Bounds& bounds) {
  const double scale = scale_of(bounds);
  return {.center = foot_of(bounds) + scale * Vec3(1.2, 5.0, 1.6),
          .normal = Vec3(-0.22, -0.93, -0.29),
          .radius = scale * 0.5};
}

// A little below the lowest point, so that the mesh does not lie in the floor's plane.
TriangleMesh floor_for(const Bounds& bounds) {
  const double scale = scale_of(bounds);
  const TriangleMesh plane = make_plane(scale * 12.0);
  std::vector<Vec3> positions(plane.positions().begin(), plane.positions().end());
  for (Vec3& p : positions) p += foot_of(bounds) - scale * Vec3(0.0, 0.01, 0.0);
  return TriangleMesh::build(positions, plane.triangles());
}

nlohmann::json to_json(const Vec3& v) {
  return {v.x, v.y, v.z};
}

nlohmann::json document_of(const Scene& scene, const DiskLight& disk, const std::string& name) {
  const nlohmann::json light = {{"shape", "disk"},
                                {"center", to_json(disk.center)},
                                {"normal", to_json(disk.normal)},
                                {"radius", disk.radius},
                                {"radiance", to_json(scene.lights[0].radiance)}};
  const nlohmann::json camera = {{"eye", to_json(scene.camera.eye)},
                                 {"target", to_json(scene.camera.target)},
                                 {"up", to_json(scene.camera.up)},
                                 {"fov_y_degrees", scene.camera.fov_y_degrees}};
  return {
      {"version", 1},
      {"lights", nlohmann::json::array({light})},
      {"camera", camera},
      {"objects", nlohmann::json::array({{{"mesh", name}, {"albedo", to_json(scene.objects[1].albedo)}}})},
      {"x-made-for", name}};
}

}  // namespace

Camera camera_for(const Bounds& bounds) {
  const double scale = scale_of(bounds);
  const double height = bounds.high.y - bounds.low.y;
  return {.eye = foot_of(bounds) + scale * Vec3(2.6, 3.0, 4.2),
          .target = foot_of(bounds) + Vec3(0.0, 0.45 * height, 0.0),
          .up = Vec3(0.0, 1.0, 0.0),
          .fov_y_degrees = 42.0};
}

Scene scene_around(const TriangleMesh& mesh, const std::string& name) {
  const Bounds bounds = bounds_of(mesh.positions());
  if (!(bounds.radius() > 0.0))
    throw MeshError(name + ": has no extent; a scene needs a mesh larger than a point");
  Scene scene;
  const DiskLight disk = light_for(bounds);
  // With this radiance a PNG without exposure is neither dark nor clipped.
  scene.lights.push_back({.name = {}, .shape = disk, .radiance = Vec3(60.0)});
  scene.camera = camera_for(bounds);
  scene.objects.push_back({.name = "floor", .mesh = floor_for(bounds), .albedo = Vec3(0.8), .casts = false});
  scene.objects.push_back({.name = name, .mesh = mesh, .albedo = Vec3(0.8, 0.7, 0.6), .casts = true});
  scene.document = document_of(scene, disk, name).dump();
  return scene;
}

}  // namespace penumbra::detail
