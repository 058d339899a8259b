#include "render/scene/default_scene.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>
#include <numbers>
#include <span>
#include <vector>

#include "penumbra/mesh/error.h"
#include "penumbra/mesh/shapes.h"
#include "render/light/light_integrals.h"
#include "render/scene/framing.h"

namespace penumbra::detail {
namespace {

// Lengths in camera_for are for a mesh whose bounding sphere has this radius, as that of a mesh in [-1, 1]³
// about has.
constexpr double kModelRadius = 1.5;

double scale_of(const Bounds& bounds) {
  return bounds.radius() / kModelRadius;
}

Vec3 foot_of(const Bounds& bounds) {
  return {bounds.center().x, bounds.low.y, bounds.center().z};
}

// What a bare mesh gets. Lengths are radii of its bounding sphere; numbers were chosen by looking at
// pictures.
constexpr double kLightDistance = 5.0, kLightElevation = 55.0, kLightRadius = 0.4;
// It aims beyond the mesh, so that the floor gets about as much on either side of it.
constexpr double kLightAim = 42.0;
// From the camera's left and a little from behind it, so that the shadow falls to the right, into view.
constexpr double kLightAzimuth = -72.0;
constexpr double kCameraElevation = 22.0, kCameraAzimuth = 32.0, kCameraFov = 30.0;
// Of the picture's sides, what mesh and shadow may fill.
constexpr double kFilled = 0.82;
constexpr double kAspect = 4.0 / 3.0;
// So that the mesh does not lie in the floor's plane.
constexpr double kFloorBelow = 1e-3;
// Of the radius of mesh and shadow on the floor: where the floor begins to fade, and where it has faded.
constexpr double kFadeFrom = 0.7, kFadeTo = 2.8;
// Linear RGB: the floor at the mesh's foot where no shadow is, and the sky. Together they nearly make the
// background.
constexpr double kFloorRadiance = 0.70, kAmbient = 0.11, kFloorAlbedo = 0.8;
// Bright enough beside the floor, and not clipped where it faces the light.
const Vec3 kMeshAlbedo{0.75, 0.66, 0.57};
constexpr int kAntialias = 2;

/// Azimuth from +z to +x.
Vec3 direction_to(double azimuth_degrees, double elevation_degrees) {
  const double a = azimuth_degrees * std::numbers::pi / 180.0,
               e = elevation_degrees * std::numbers::pi / 180.0;
  return {std::cos(e) * std::sin(a), std::sin(e), std::cos(e) * std::cos(a)};
}

DiskLight light_for(const Bounds& bounds) {
  const Vec3 towards = direction_to(kCameraAzimuth + kLightAzimuth, kLightElevation);
  return {.center = foot_of(bounds) + bounds.radius() * kLightDistance * towards,
          .normal = -direction_to(kCameraAzimuth + kLightAzimuth, kLightAim),
          .radius = bounds.radius() * kLightRadius};
}

double floor_height(const Bounds& bounds) {
  return bounds.low.y - kFloorBelow * bounds.radius();
}

struct Part {
  std::vector<Vec3> corners;
  Bounds bounds;
  double area = 0.0;
};

Part part_of(const TriangleMesh& mesh, const Component& component) {
  Part part;
  for (const FaceId face : component.faces) {
    const auto& [i, j, k] = mesh.triangles()[index(face)];
    const Vec3 &a = mesh.positions()[i], &b = mesh.positions()[j], &c = mesh.positions()[k];
    part.corners.insert(part.corners.end(), {a, b, c});
    part.area += 0.5 * glm::length(glm::cross(b - a, c - a));
  }
  part.bounds = bounds_of(part.corners);
  return part;
}

/// Points of all that a picture has to show. Scans come with specks, far off or below: parts smaller than a
/// share of the largest one do not count, where all of them together are little of the surface.
std::vector<Vec3> points_that_count(const TriangleMesh& mesh) {
  constexpr double kSpeck = 0.02, kLittle = 0.01;
  std::vector<Vec3> all(mesh.positions().begin(), mesh.positions().end());
  if (mesh.components().size() < 2) return all;
  std::vector<Part> parts;
  for (const Component& component : mesh.components()) parts.push_back(part_of(mesh, component));
  double largest = 0.0, area = 0.0, specks = 0.0;
  for (const Part& part : parts) largest = std::max(largest, part.bounds.radius());
  const auto is_speck = [&](const Part& part) { return part.bounds.radius() < kSpeck * largest; };
  for (const Part& part : parts) (is_speck(part) ? specks : area) += part.area;
  if (specks == 0.0 || !(specks < kLittle * area)) return all;
  all.clear();
  for (const Part& part : parts)
    if (!is_speck(part)) all.insert(all.end(), part.corners.begin(), part.corners.end());
  return all;
}

/// Where the points hide the light's center from the floor, after the points.
std::vector<Vec3> with_shadow(std::vector<Vec3> points, double floor, const Vec3& light) {
  const std::size_t count = points.size();
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 p = points[i];
    points.push_back(light + (p - light) * ((light.y - floor) / (light.y - p.y)));
  }
  return points;
}

/// Centered below the points, and as large as it takes to fade into the background.
SceneObject floor_for(const Bounds& bounds, std::span<const Vec3> points) {
  const Bounds reach = bounds_of(points);
  const double radius = 0.5 * std::hypot(reach.high.x - reach.low.x, reach.high.z - reach.low.z);
  const Vec3 middle{reach.center().x, floor_height(bounds), reach.center().z};
  const TriangleMesh plane = make_plane(kFadeTo * radius);
  std::vector<Vec3> positions(plane.positions().begin(), plane.positions().end());
  for (Vec3& p : positions) p += middle;
  return {.name = "floor",
          .mesh = TriangleMesh::build(positions, plane.triangles()),
          .albedo = Vec3(kFloorAlbedo),
          .casts = false,
          .fade = {kFadeFrom * radius, kFadeTo * radius}};
}

Camera camera_on(std::span<const Vec3> points) {
  const double half = std::tan(kCameraFov * std::numbers::pi / 360.0);
  Camera camera = camera_that_sees(points, -direction_to(kCameraAzimuth, kCameraElevation), {0.0, 1.0, 0.0},
                                   {kFilled * kAspect * half, kFilled * half});
  camera.fov_y_degrees = kCameraFov;
  return camera;
}

/// So that the floor at the mesh's foot has the radiance that it should.
Vec3 radiance_for(const DiskLight& light, const Bounds& bounds) {
  const double factor = disk_irradiance_factor(light, foot_of(bounds), {0.0, 1.0, 0.0});
  return Vec3(kFloorRadiance * std::numbers::pi / (kFloorAlbedo * factor));
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
      {"ambient", to_json(scene.picture.ambient)},
      {"antialias", scene.picture.antialias},
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
  std::vector<Vec3> shown = points_that_count(mesh);
  const Bounds bounds = bounds_of(shown);
  if (!(bounds.radius() > 0.0))
    throw MeshError(name + ": has no extent; a scene needs a mesh larger than a point");
  Scene scene;
  const DiskLight disk = light_for(bounds);
  const std::vector<Vec3> points = with_shadow(std::move(shown), floor_height(bounds), disk.center);
  scene.lights.push_back({.name = {}, .shape = disk, .radiance = radiance_for(disk, bounds)});
  scene.camera = camera_on(points);
  scene.picture = {.ambient = Vec3(kAmbient), .antialias = kAntialias};
  scene.objects.push_back(floor_for(bounds, points));
  scene.objects.push_back({.name = name, .mesh = mesh, .albedo = kMeshAlbedo, .casts = true});
  // A file's name may be anything but UTF-8.
  scene.document =
      document_of(scene, disk, name).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  return scene;
}

}  // namespace penumbra::detail
