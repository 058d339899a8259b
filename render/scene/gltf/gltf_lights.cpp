#include "render/scene/gltf/gltf_lights.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "mesh/vectors.h"
#include "render/scene/gltf/gltf_area_lights.h"
#include "render/scene/scene_node.h"

namespace penumbra::detail {
namespace {

constexpr double kUsualAngle = 0.53;
constexpr double kShareOfScene = 0.02;
constexpr const char* kExtension = "KHR_lights_punctual";

/// A number that the extras of either have.
std::optional<double> extra(const tinygltf::Value& light, const tinygltf::Value& node, const char* name) {
  for (const tinygltf::Value* extras : {&light, &node})
    if (extras->Has(name) && extras->Get(name).IsNumber()) return extras->Get(name).GetNumberAsDouble();
  return std::nullopt;
}

/// Letters, digits, '-' and '_', unlike the names before.
std::string fit_name(const std::string& name, const std::vector<Light>& others) {
  std::string fit;
  for (const char c : name) fit += std::isalnum(static_cast<unsigned char>(c)) || c == '_' ? c : '-';
  if (fit.empty()) fit = "light";
  fit.resize(std::min<std::size_t>(fit.size(), 64));
  const auto is_taken = [&](const std::string& text) {
    return std::ranges::find(others, text, &Light::name) != others.end();
  };
  for (std::size_t k = 1; is_taken(fit); ++k)
    if (const std::string numbered = fit + "-" + std::to_string(k); !is_taken(numbered)) return numbered;
  return fit;
}

/// nullptr where the node has none.
const tinygltf::Light* punctual_light_of(const GltfFile& file, const tinygltf::Node& node,
                                         const std::string& where) {
  const auto extension = node.extensions.find(kExtension);
  if (extension == node.extensions.end() || !extension->second.Has("light")) return nullptr;
  const tinygltf::Value& light = extension->second.Get("light");
  const int i = light.IsNumber() ? light.GetNumberAsInt() : -1;
  if (i < 0 || static_cast<std::size_t>(i) >= file.model.lights.size())
    file.fail(where, "has a light that does not exist", "export it again");
  return &file.model.lights[static_cast<std::size_t>(i)];
}

/// Lights of nodes, made for a scene.
class LightMaker {
 public:
  LightMaker(const GltfFile& file, const Bounds& casters, const SceneOptions& options, GltfNotes& notes,
             std::vector<std::string>& warnings)
      : file_(file), casters_(casters), options_(options), notes_(notes), warnings_(warnings) {}

  void add(Light light, const tinygltf::Node& node) {
    light.name = fit_name(light.name.empty() ? node.name : light.name, lights);
    lights.push_back(std::move(light));
  }
  void add(const tinygltf::Light& light, const tinygltf::Node& node, const Transform& world) {
    Light made{.name = fit_name(light.name.empty() ? node.name : light.name, lights), .shape = {}};
    Vec3 color(1.0);
    for (std::size_t k = 0; k < 3 && light.color.size() == 3; ++k)
      color[static_cast<int>(k)] = std::max(light.color[k], 0.0);
    color *= std::max(light.intensity, 0.0);
    if (!(largest_component(color) <= 1e30)) color = Vec3(1.0);  // NaN, too
    if (light.type == "directional") {
      const DistantLight sun{forward(world), angle_of(light, node, made.name)};
      made.shape = sun;
      made.radiance = color / irradiance_per_radiance(sun);
    } else if (light.type == "point" || light.type == "spot") {
      const DiskLight disk{world.translation,
                           light.type == "spot" ? forward(world) : to_casters(world.translation),
                           radius_of(light, node, made.name)};
      if (light.type == "spot") notes_.ignore("cones of spot lights");
      made.shape = disk;
      made.radiance = disk.radius > 0.0 ? color / (std::numbers::pi * disk.radius * disk.radius) : color;
    } else {
      return notes_.ignore("lights of unknown types");
    }
    if (!(largest_component(made.radiance) <= std::numeric_limits<double>::max()))  // NaN, too
      file_.fail("light " + made.name, "is so small that its radiance is no number", "make it larger, or 0");
    lights.push_back(std::move(made));
  }

  std::vector<Light> lights{};

 private:
  double angle_of(const tinygltf::Light& light, const tinygltf::Node& node, const std::string& name) {
    if (options_.sun_angle) return *options_.sun_angle;
    const std::optional<double> given = extra(light.extras, node.extras, "angle_degrees");
    if (!given) {
      warn(name, "extras.angle_degrees", to_text(kUsualAngle) + " degrees", "--sun-angle");
      return kUsualAngle;
    }
    if (!(*given >= 0.0 && *given < 180.0))
      file_.fail("light " + name, "has an angle of " + to_text(*given) + " degrees", "give 0 to below 180");
    return *given;
  }
  double radius_of(const tinygltf::Light& light, const tinygltf::Node& node, const std::string& name) {
    if (options_.light_radius) return *options_.light_radius;
    const std::optional<double> given = extra(light.extras, node.extras, "radius");
    if (!given) {
      const double usual = casters_.empty() ? 0.1 : kShareOfScene * 2.0 * casters_.radius();
      warn(name, "extras.radius", "a radius of " + to_text(usual), "--light-radius");
      return usual;
    }
    if (!(*given >= 0.0 && *given <= 1e30))
      file_.fail("light " + name, "has a radius of " + to_text(*given), "give 0 or more");
    return *given;
  }
  void warn(const std::string& name, const std::string& key, const std::string& usual,
            const std::string& option) {
    warnings_.push_back(file_.name + ": light " + name + " has no size (" + key + "); it gets " + usual +
                        " (" + option + " says another)");
  }
  Vec3 to_casters(const Vec3& from) const {
    const Vec3 way = casters_.empty() ? Vec3(0.0) : casters_.center() - from;
    return glm::length(way) > 0.0 ? unit(way) : Vec3(0, -1, 0);
  }

  const GltfFile& file_;
  const Bounds& casters_;
  const SceneOptions& options_;
  GltfNotes& notes_;
  std::vector<std::string>& warnings_;
};

}  // namespace

std::vector<Light> read_gltf_lights(const GltfFile& file, std::span<const PlacedNode> nodes,
                                    const Bounds& casters, const SceneOptions& options, GltfNotes& notes,
                                    std::vector<std::string>& warnings) {
  constexpr std::size_t kMost = 1000;
  LightMaker maker(file, casters, options, notes, warnings);
  for (const PlacedNode& placed : nodes) {
    const tinygltf::Node& node = file.model.nodes[placed.node];
    const std::string where = "nodes[" + std::to_string(placed.node) + "]";
    if (const tinygltf::Light* light = punctual_light_of(file, node, where))
      maker.add(*light, node, placed.world);
    if (std::optional<Light> light = read_gltf_area_light(file, node, where, placed.world, notes))
      maker.add(std::move(*light), node);
    if (maker.lights.size() > kMost) file.fail(where, "is one light more than a thousand", "leave some out");
  }
  return std::move(maker.lights);
}

std::optional<Camera> read_gltf_camera(const GltfFile& file, std::span<const PlacedNode> nodes,
                                       const Bounds& bounds, GltfNotes& notes) {
  std::optional<Camera> found;
  for (const PlacedNode& placed : nodes) {
    const int camera = file.model.nodes[placed.node].camera;
    if (camera < 0) continue;
    if (static_cast<std::size_t>(camera) >= file.model.cameras.size())
      file.fail("nodes[" + std::to_string(placed.node) + "]", "has a camera that does not exist",
                "export it again");
    const tinygltf::Camera& c = file.model.cameras[static_cast<std::size_t>(camera)];
    const double fov = c.perspective.yfov * 180.0 / std::numbers::pi;
    if (c.type != "perspective" || !(fov > 0.0 && fov < 180.0)) {
      notes.ignore("orthographic cameras");
      continue;
    }
    if (found) {
      notes.ignore("other cameras");
      break;
    }
    const Vec3 eye = placed.world.translation;
    const double away = glm::length(bounds.center() - eye);
    const Vec3 up = scaled_to_one(placed.world.columns[1]);
    if (!(glm::length(glm::cross(forward(placed.world), up)) > 1e-9)) {
      notes.ignore("flattened cameras");
      continue;
    }
    found = Camera{eye, eye + forward(placed.world) * (away > 0.0 ? away : 1.0), unit(up), fov};
  }
  return found;
}

}  // namespace penumbra::detail
