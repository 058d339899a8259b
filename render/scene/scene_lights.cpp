#include "render/scene/scene_lights.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <glm/geometric.hpp>

#include "mesh/vectors.h"
#include "render/support/nearest_word.h"

namespace penumbra::detail {
namespace {

// Directions closer to parallel than this leave the other one of a frame to rounding.
constexpr double kParallel = 1e-9;
// Of a distant light whose file gives neither irradiance nor radiance: a white surface that faces it then has
// a radiance of about 1.
constexpr double kDistantIrradiance = 3.0;

Vec3 read_direction(const SceneNode& node, const char* key) {
  const SceneNode value = node.required(key);
  const Vec3 direction = value.vec3();
  if (direction == Vec3(0.0)) value.fail("has length 0; give the direction in which the light shines");
  return direction;
}

DiskLight read_disk(const SceneNode& node) {
  node.allow_only({"name", "shape", "center", "normal", "radius", "radiance"});
  DiskLight disk{
      .center = node.required("center").vec3(), .normal = read_direction(node, "normal"), .radius = 0.0};
  const SceneNode radius = node.required("radius");
  disk.radius = radius.number();
  if (disk.radius < 0.0) radius.fail("is " + to_text(disk.radius) + "; must be 0 or more");
  return disk;
}

RectangleLight read_rectangle(const SceneNode& node) {
  node.allow_only({"name", "shape", "center", "normal", "tangent", "half_extents", "radiance"});
  RectangleLight light{.center = node.required("center").vec3(), .normal = read_direction(node, "normal")};
  const SceneNode tangent = node.required("tangent"), extents = node.required("half_extents");
  const std::vector<double> half = extents.numbers(2);
  light.tangent = tangent.vec3();
  light.half_extents = {half[0], half[1]};
  if (are_parallel(light.tangent, light.normal))
    tangent.fail("is 0 or parallel to normal; give the direction of one side");
  if (!(half[0] > 0.0 && half[1] > 0.0)) extents.fail("must be greater than 0");
  return light;
}

DistantLight read_distant(const SceneNode& node) {
  node.allow_only({"name", "shape", "direction", "angle_degrees", "irradiance", "radiance"});
  DistantLight light{.direction = read_direction(node, "direction")};
  if (const auto angle = node.find("angle_degrees")) {
    light.angle_degrees = angle->number();
    if (!(light.angle_degrees >= 0.0 && light.angle_degrees < 180.0))
      angle->fail("is " + to_text(light.angle_degrees) + "; must be from 0 to below 180");
  }
  return light;
}

LightShape read_shape(const SceneNode& node) {
  const SceneNode shape = node.required("shape");
  const std::string name = shape.text();
  if (name == "disk") return read_disk(node);
  if (name == "rectangle") return read_rectangle(node);
  if (name == "distant") return read_distant(node);
  const std::array<std::string, 3> known = {"disk", "rectangle", "distant"};
  shape.fail("is \"" + name + "\"" + did_you_mean(name, known) +
             "; only \"disk\", \"rectangle\" and \"distant\" are supported");
}

Vec3 read_color(const SceneNode& node) {
  const Vec3 color = node.number_or_vec3();
  if (color.x < 0.0 || color.y < 0.0 || color.z < 0.0) node.fail("must not be negative");
  return color;
}

/// From `irradiance` or `radiance`.
Vec3 read_distant_radiance(const SceneNode& node, const DistantLight& light) {
  const auto irradiance = node.find("irradiance"), radiance = node.find("radiance");
  if (irradiance && radiance) irradiance->fail("stands beside radiance; give one of them");
  if (radiance) {
    const Vec3 color = read_color(*radiance);
    if (light.angle_degrees == 0.0) radiance->fail("says nothing where angle_degrees is 0; give irradiance");
    return color;
  }
  const Vec3 facing = irradiance ? read_color(*irradiance) : Vec3(kDistantIrradiance);
  const Vec3 out = facing / irradiance_per_radiance(light);
  if (!(std::isfinite(out.x) && std::isfinite(out.y) && std::isfinite(out.z)))
    node.fail("needs more radiance than a number holds for this angle_degrees; give an angle of 0");
  return out;
}

std::string read_name(const SceneNode& node) {
  const auto name = node.find("name");
  if (!name) return {};
  std::string text = name->text();
  if (!is_light_name(text)) name->fail("is \"" + text + "\"; use letters, digits, '-' and '_', at most 200");
  return text;
}

Light read_light(const SceneNode& node) {
  Light light{.name = read_name(node), .shape = read_shape(node)};
  if (const auto* distant = std::get_if<DistantLight>(&light.shape))
    light.radiance = read_distant_radiance(node, *distant);
  else if (const auto radiance = node.find("radiance"))
    light.radiance = read_color(*radiance);
  return light;
}

}  // namespace

bool is_light_name(const std::string& name) {
  const auto fits = [](unsigned char c) { return std::isalnum(c) || c == '-' || c == '_'; };
  return !name.empty() && name.size() <= 200 && std::all_of(name.begin(), name.end(), fits);
}

bool are_parallel(const Vec3& a, const Vec3& b) {
  return !(glm::length(glm::cross(unit(a), unit(b))) >= kParallel);  // NaN is not
}

std::vector<Light> read_lights(const SceneNode& root) {
  const SceneNode list = root.required("lights");
  const std::vector<SceneNode> nodes = list.elements();
  if (nodes.empty()) list.fail("is empty; add a light");
  std::vector<Light> lights;
  for (const SceneNode& node : nodes) {
    Light light = read_light(node);
    if (nodes.size() > 1 && light.name.empty()) light.name = "light" + std::to_string(lights.size());
    const bool taken = std::any_of(lights.begin(), lights.end(),
                                   [&](const Light& other) { return other.name == light.name; });
    if (taken) node.fail("is the second light called \"" + light.name + "\"; give each a name of its own");
    lights.push_back(std::move(light));
  }
  return lights;
}

}  // namespace penumbra::detail
