#include "render/scene/gltf/gltf_nodes.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "mesh/vectors.h"
#include "render/scene/gltf/gltf_accessors.h"

namespace penumbra::detail {
namespace {

constexpr const char* kAdvice = "export it again";

/// parent · child.
Transform product(const Transform& parent, const Transform& child) {
  Transform out;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3& c = child.columns[k];
    out.columns[k] = parent.columns[0] * c.x + parent.columns[1] * c.y + parent.columns[2] * c.z;
  }
  out.translation = parent.apply(child.translation);
  return out;
}

bool is_finite(const Transform& t) {
  const Vec3 sum = t.columns[0] + t.columns[1] + t.columns[2] + t.translation;
  return std::isfinite(sum.x) && std::isfinite(sum.y) && std::isfinite(sum.z);
}

/// translation · rotation · scale; a rotation of length 0 is none.
Transform composed(const Vec3& translation, const std::array<double, 4>& rotation, const Vec3& scale) {
  auto [x, y, z, w] = rotation;
  const double length = std::sqrt(x * x + y * y + z * z + w * w);
  if (length > 0.0)
    x /= length, y /= length, z /= length, w /= length;
  else
    x = y = z = 0.0, w = 1.0;
  return {{Vec3(1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)) * scale.x,
           Vec3(2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)) * scale.y,
           Vec3(2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)) * scale.z},
          translation};
}

Transform local_of(const tinygltf::Node& node) {
  if (node.matrix.size() == 16) {
    const auto column = [&](std::size_t k) {
      return Vec3(node.matrix[4 * k], node.matrix[4 * k + 1], node.matrix[4 * k + 2]);
    };
    return {{column(0), column(1), column(2)}, column(3)};
  }
  const auto vector = [](const std::vector<double>& v, double usual) {
    return v.size() == 3 ? Vec3(v[0], v[1], v[2]) : Vec3(usual);
  };
  std::array<double, 4> rotation{0, 0, 0, 1};
  if (node.rotation.size() == 4) std::ranges::copy(node.rotation, rotation.begin());
  return composed(vector(node.translation, 0.0), rotation, vector(node.scale, 1.0));
}

class Walk {
 public:
  Walk(const GltfFile& file, GltfNotes& notes)
      : file_(file), notes_(notes), seen_(file.model.nodes.size(), false) {}

  /// With a stack of its own: chains of nodes may be as long as the file.
  void start(int root) {
    std::vector<std::pair<int, Transform>> waiting{{root, {}}};
    while (!waiting.empty()) {
      const auto [node, parent] = waiting.back();
      waiting.pop_back();
      const Transform world = visit(node, parent);
      const std::vector<int>& children = file_.model.nodes[static_cast<std::size_t>(node)].children;
      for (std::size_t i = children.size(); i-- > 0;) waiting.emplace_back(children[i], world);
    }
  }
  std::vector<PlacedNode> take() && { return std::move(placed_); }

 private:
  Transform visit(int index, const Transform& parent) {
    const std::string where = "nodes[" + std::to_string(index) + "]";
    if (index < 0 || static_cast<std::size_t>(index) >= seen_.size())
      file_.fail(where, "does not exist", kAdvice);
    const auto i = static_cast<std::size_t>(index);
    if (seen_[i]) file_.fail(where, "has two parents, or is its own ancestor", kAdvice);
    seen_[i] = true;
    const tinygltf::Node& node = file_.model.nodes[i];
    PlacedNode placed{i, product(parent, local_of(node)), {}};
    if (!is_finite(placed.world)) file_.fail(where, "has a place that is not finite", kAdvice);
    placed.instances = instances_of(node, placed.world, where);
    if (node.skin >= 0) notes_.ignore("skins");
    placed_.push_back(placed);
    return placed.world;
  }

  std::vector<Transform> instances_of(const tinygltf::Node& node, const Transform& world,
                                      const std::string& where) const {
    const auto extension = node.extensions.find("EXT_mesh_gpu_instancing");
    if (extension == node.extensions.end()) return {world};
    const auto numbers = [&](const char* name, int components) {
      const tinygltf::Value& attributes = extension->second.Get("attributes");
      if (!attributes.Has(name) || !attributes.Get(name).IsNumber()) return std::vector<double>();
      return read_numbers(file_, attributes.Get(name).GetNumberAsInt(), components, where + " " + name);
    };
    if (!extension->second.Has("attributes")) return {world};
    const std::vector<double> t = numbers("TRANSLATION", 3), r = numbers("ROTATION", 4),
                              s = numbers("SCALE", 3);
    const std::size_t count = std::max({t.size() / 3, r.size() / 4, s.size() / 3});
    const auto fits = [&](const std::vector<double>& v, std::size_t per) {
      return v.empty() || v.size() == count * per;
    };
    if (!fits(t, 3) || !fits(r, 4) || !fits(s, 3))
      file_.fail(where, "has instances whose attributes differ in number", kAdvice);
    std::vector<Transform> out;
    for (std::size_t i = 0; i < count; ++i) {
      const auto vector = [i](const std::vector<double>& v, double usual) {
        return v.empty() ? Vec3(usual) : Vec3(v[3 * i], v[3 * i + 1], v[3 * i + 2]);
      };
      std::array<double, 4> rotation{0, 0, 0, 1};
      if (!r.empty()) std::copy_n(r.begin() + static_cast<std::ptrdiff_t>(4 * i), 4, rotation.begin());
      out.push_back(product(world, composed(vector(t, 0.0), rotation, vector(s, 1.0))));
      if (!is_finite(out.back())) file_.fail(where, "has an instance whose place is not finite", kAdvice);
    }
    return out;
  }

  const GltfFile& file_;
  GltfNotes& notes_;
  std::vector<bool> seen_;
  std::vector<PlacedNode> placed_;
};

}  // namespace

Vec3 forward(const Transform& world) {
  const Vec3 z = scaled_to_one(world.columns[2]);
  return glm::length(z) > 0.0 ? -unit(z) : Vec3(0, 0, -1);
}

std::vector<PlacedNode> place_nodes(const GltfFile& file, GltfNotes& notes) {
  const tinygltf::Model& model = file.model;
  Walk walk(file, notes);
  if (model.scenes.size() > 1) notes.ignore("other scenes");
  if (!model.scenes.empty()) {
    const auto scene = static_cast<std::size_t>(std::max(model.defaultScene, 0));
    if (scene >= model.scenes.size()) file.fail("scene", "does not exist", kAdvice);
    for (const int root : model.scenes[scene].nodes) walk.start(root);
    return std::move(walk).take();
  }
  std::vector<bool> is_child(model.nodes.size(), false);
  for (const tinygltf::Node& node : model.nodes)
    for (const int child : node.children)
      if (child >= 0 && static_cast<std::size_t>(child) < is_child.size())
        is_child[static_cast<std::size_t>(child)] = true;
  for (std::size_t i = 0; i < is_child.size(); ++i)
    if (!is_child[i]) walk.start(static_cast<int>(i));
  return std::move(walk).take();
}

}  // namespace penumbra::detail
