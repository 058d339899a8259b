#include "apps/cli/study/study_case.h"

#include <cmath>
#include <numbers>

#include "apps/cli/digest.h"
#include "apps/cli/made_by.h"
#include "penumbra/mesh/error.h"
#include "penumbra/mesh/shapes.h"

namespace penumbra::apps {
namespace {

struct Scaled {
  double factor;

  LightShape operator()(DiskLight light) const {
    light.radius *= factor;
    return light;
  }
  LightShape operator()(RectangleLight light) const {
    light.half_extents *= factor;
    return light;
  }
  LightShape operator()(DistantLight light) const {
    const double half = light.angle_degrees / 360.0 * std::numbers::pi;
    light.angle_degrees = std::atan(factor * std::tan(half)) * 360.0 / std::numbers::pi;
    return light;
  }
};

std::size_t faces_of(const Scene& scene, bool casters_only) {
  std::size_t faces = 0;
  for (const SceneObject& object : scene.objects)
    if (object.casts || !casters_only) faces += object.mesh.triangles().size();
  return faces;
}

}  // namespace

std::string StudyCase::id() const {
  std::string text = scene_name + " " + std::to_string(view.width) + "x" + std::to_string(view.height);
  if (view.light_scale != 1.0) text += " light x" + penumbra::to_text(OptionValue(view.light_scale));
  return text;
}

std::string StudyCase::digest() const {
  Digest digest;
  for (const auto& [key, value] : metadata_of(scene)) digest.add(key + value);
  for (const SceneObject& object : scene.objects) {
    digest.add(std::uint64_t{object.casts});
    for (const Vec3& p : object.mesh.positions())
      for (const double value : {p.x, p.y, p.z}) digest.add(value);
    for (const IndexedTriangle& t : object.mesh.triangles())
      for (const auto corner : t) digest.add(static_cast<std::uint64_t>(corner));
  }
  return digest.text();
}

nlohmann::json StudyCase::to_json() const {
  const Metadata about = metadata_of(scene);
  return {{"id", id()},
          {"scene", scene_name},
          {"digest", digest()},
          {"width", view.width},
          {"height", view.height},
          {"light_scale", view.light_scale},
          {"light", nlohmann::json::parse(about.at("penumbraLights")).front()},
          {"sweep", sweep},
          {"group", group},
          {"faces", faces_of(scene, false)},
          {"caster_faces", faces_of(scene, true)}};
}

StudyCase make_case(const std::string& name, const Scene& scene, const StudyView& view) {
  if (scene.lights.size() != 1)
    throw UsageError(name + ": has " + std::to_string(scene.lights.size()) +
                     " lights; a study needs scenes that have one");
  StudyCase out{.scene_name = name, .scene = scene, .view = view, .group = name};
  LightShape& shape = out.scene.lights.front().shape;
  if (view.light_scale != 1.0) shape = std::visit(Scaled{view.light_scale}, shape);
  return out;
}

std::vector<GrowthView> growth_views(const StudyView& view) {
  std::vector<GrowthView> out;
  for (const double scale : {0.125, 0.25, 0.5, 2.0, 4.0})
    out.push_back({{view.width, view.height, scale}, "light"});
  for (const double side : {0.25, 0.5, 2.0})
    out.push_back({{static_cast<int>(side * view.width), static_cast<int>(side * view.height)}, "size"});
  return out;
}

StudyCase sphere_case(int level, const StudyView& view) {
  constexpr int kSplits[] = {3, 5, 7, 8};  // 20 · 4^splits faces
  const int splits = kSplits[level];
  Scene scene;
  scene.lights = {{.shape = DiskLight{.center = {0, 10, 0}, .normal = {0, -1, 0}, .radius = 0.8}}};
  scene.camera = {.eye = {6.5, 7.5, 9}, .target = {0, 2.6, 0}, .up = {0, 1, 0}, .fov_y_degrees = 52};
  scene.objects = {{.name = "floor", .mesh = make_plane(12.0), .casts = false},
                   {.name = "sphere", .mesh = make_icosphere({-0.3, 5, 0.1}, 1.0, splits)}};
  StudyCase out = make_case("sphere-" + std::to_string(20 * (1 << (2 * splits))), scene, view);
  out.sweep = "faces";
  out.group = "sphere";
  return out;
}

}  // namespace penumbra::apps
