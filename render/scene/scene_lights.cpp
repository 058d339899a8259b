#include "render/scene/scene_lights.h"

#include <algorithm>
#include <cctype>
#include <glm/geometric.hpp>

#include "mesh/vectors.h"

namespace penumbra::detail {
namespace {

// Directions closer to parallel than this leave the other one of a frame to rounding.
constexpr double kParallel = 1e-9;

Vec3 read_normal(const SceneNode& node) {
  const SceneNode normal = node.required("normal");
  const Vec3 direction = normal.vec3();
  if (direction == Vec3(0.0)) normal.fail("has length 0; give the direction in which the light shines");
  return direction;
}

DiskLight read_disk(const SceneNode& node) {
  node.allow_only({"name", "shape", "center", "normal", "radius", "radiance"});
  DiskLight disk{.center = node.required("center").vec3(), .normal = read_normal(node), .radius = 0.0};
  const SceneNode radius = node.required("radius");
  disk.radius = radius.number();
  if (disk.radius < 0.0) radius.fail("is " + to_text(disk.radius) + "; must be 0 or more");
  return disk;
}

RectangleLight read_rectangle(const SceneNode& node) {
  node.allow_only({"name", "shape", "center", "normal", "tangent", "half_extents", "radiance"});
  RectangleLight light{.center = node.required("center").vec3(), .normal = read_normal(node)};
  const SceneNode tangent = node.required("tangent"), extents = node.required("half_extents");
  const std::vector<double> half = extents.numbers(2);
  light.tangent = tangent.vec3();
  light.half_extents = {half[0], half[1]};
  if (sine_between(light.tangent, light.normal) < kParallel)
    tangent.fail("is 0 or parallel to normal; give the direction of one side");
  if (!(half[0] > 0.0 && half[1] > 0.0)) extents.fail("must be greater than 0");
  return light;
}

LightShape read_shape(const SceneNode& node) {
  const SceneNode shape = node.required("shape");
  const std::string name = shape.text();
  if (name == "disk") return read_disk(node);
  if (name == "rectangle") return read_rectangle(node);
  shape.fail("is \"" + name + "\"; only \"disk\" and \"rectangle\" are supported");
}

std::string read_name(const SceneNode& node) {
  const auto name = node.find("name");
  if (!name) return {};
  std::string text = name->text();
  const auto fits = [](unsigned char c) { return std::isalnum(c) || c == '-' || c == '_'; };
  if (text.empty() || !std::all_of(text.begin(), text.end(), fits))
    name->fail("is \"" + text + "\"; use letters, digits, '-' and '_'");
  return text;
}

Light read_light(const SceneNode& node) {
  Light light{.name = read_name(node), .shape = read_shape(node)};
  if (const auto radiance = node.find("radiance")) {
    light.radiance = radiance->number_or_vec3();
    if (light.radiance.x < 0.0 || light.radiance.y < 0.0 || light.radiance.z < 0.0)
      radiance->fail("must not be negative");
  }
  return light;
}

}  // namespace

double sine_between(const Vec3& a, const Vec3& b) {
  return glm::length(glm::cross(unit(a), unit(b)));
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
