#include "render/scene/gltf/gltf_mesh.h"

#include <algorithm>
#include <cmath>
#include <glm/vec2.hpp>
#include <limits>
#include <numeric>

#include "render/scene/gltf/gltf_accessors.h"

namespace penumbra::detail {
namespace {

/// Three corners a triangle.
std::vector<std::uint32_t> triangles_of(int mode, const std::vector<std::uint32_t>& corners) {
  std::vector<std::uint32_t> out;
  if (mode == TINYGLTF_MODE_TRIANGLES || mode == -1) {
    out.assign(corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(corners.size() / 3 * 3));
    return out;
  }
  for (std::size_t i = 0; i + 2 < corners.size(); ++i) {
    if (mode == TINYGLTF_MODE_TRIANGLE_FAN)
      out.insert(out.end(), {corners[i + 1], corners[i + 2], corners[0]});
    else  // a strip turns every other triangle round
      out.insert(out.end(), {corners[i], corners[i + 1 + i % 2], corners[i + 2 - i % 2]});
  }
  return out;
}

/// Joins primitives, each with vertices of its own.
class Joiner {
 public:
  Joiner(const GltfFile& file, std::optional<int> uv_set, GltfNotes& notes)
      : file_(file), uv_set_(uv_set), notes_(notes) {
    soup_.first_corner.push_back(0);
    for (const tinygltf::Material& m : file.model.materials) soup_.materials.push_back(material_of(m));
  }

  void add(const tinygltf::Primitive& primitive, const std::string& where) {
    if (primitive.extensions.contains("KHR_draco_mesh_compression"))
      file_.fail(where, "is compressed by Draco (KHR_draco_mesh_compression), which is not read",
                 "export it without compression");
    if (primitive.mode >= TINYGLTF_MODE_POINTS && primitive.mode < TINYGLTF_MODE_TRIANGLES)
      return notes_.ignore("points and lines");
    if (primitive.mode > TINYGLTF_MODE_TRIANGLE_FAN)
      file_.fail(where, "has the unknown mode " + std::to_string(primitive.mode), "export it again");
    const auto positions = primitive.attributes.find("POSITION");
    if (positions == primitive.attributes.end()) return notes_.ignore("primitives without positions");
    const std::vector<Vec3> points = read_vectors(file_, positions->second, where + " POSITION");
    std::vector<std::uint32_t> corners(points.size());
    std::iota(corners.begin(), corners.end(), 0u);
    if (primitive.indices >= 0)
      corners = read_indices(file_, primitive.indices, points.size(), where + " indices");
    corners = triangles_of(primitive.mode, corners);
    if (corners.size() + soup_.corners.size() > 0xFFFFFFF0u ||
        points.size() + soup_.positions.size() > 0xFFFFFFF0u)
      file_.fail(where, "makes the mesh too large", "divide it");
    add_normals(primitive, where, points.size(), corners);
    if (uv_set_) add_uv(primitive, where, points.size(), corners);
    const auto first = static_cast<std::uint32_t>(soup_.positions.size());
    for (const std::uint32_t corner : corners) soup_.corners.push_back(first + corner);
    soup_.positions.insert(soup_.positions.end(), points.begin(), points.end());
    while (soup_.first_corner.back() < soup_.corners.size()) {
      soup_.first_corner.push_back(soup_.first_corner.back() + 3);
      soup_.polygon_material.push_back(material_number(primitive.material, where));
    }
    name_ignored(primitive);
  }

  std::optional<MeshCache::Entry> take() && {
    if (soup_.corners.empty()) return std::nullopt;
    if (soup_.materials.empty()) soup_.polygon_material.clear();
    if (has_normals_)
      soup_.corner_normals.resize(soup_.corners.size(), PolygonSoup::kNoNormal);
    else
      soup_.corner_normals.clear();
    MeshCache::Entry entry = MeshCache::entry_of(std::move(soup_));
    if (has_uv_) entry.corner_uv = std::move(uv_);
    return entry;
  }

 private:
  Material material_of(const tinygltf::Material& m) {
    const std::vector<double>& color = m.pbrMetallicRoughness.baseColorFactor;
    Vec3 albedo(1.0);
    for (std::size_t k = 0; k < 3 && k < color.size(); ++k)
      albedo[static_cast<int>(k)] = std::isfinite(color[k]) ? std::clamp(color[k], 0.0, 1.0) : 1.0;
    if (m.pbrMetallicRoughness.baseColorTexture.index >= 0 || m.normalTexture.index >= 0 ||
        m.emissiveTexture.index >= 0)
      notes_.ignore("textures");
    if (!m.alphaMode.empty() && m.alphaMode != "OPAQUE") notes_.ignore("transparency");
    if (m.emissiveFactor.size() == 3 &&
        std::ranges::any_of(m.emissiveFactor, [](double x) { return x > 0.0; }))
      notes_.ignore("emission");
    return {.name = m.name, .color = albedo};
  }

  std::uint32_t material_number(int material, const std::string& where) const {
    if (material < 0) return PolygonSoup::kNoMaterial;
    if (static_cast<std::size_t>(material) >= soup_.materials.size())
      file_.fail(where, "has a material that does not exist", "export it again");
    return static_cast<std::uint32_t>(material);
  }

  /// Before positions and corners are added.
  void add_normals(const tinygltf::Primitive& primitive, const std::string& where, std::size_t points,
                   const std::vector<std::uint32_t>& corners) {
    const auto given = primitive.attributes.find("NORMAL");
    if (given == primitive.attributes.end()) return;
    const std::vector<Vec3> normals = read_vectors(file_, given->second, where + " NORMAL");
    if (normals.size() != points)
      file_.fail(
          where,
          "has " + std::to_string(normals.size()) + " normals for " + std::to_string(points) + " vertices",
          "export it again");
    has_normals_ = true;
    soup_.corner_normals.resize(soup_.corners.size(), PolygonSoup::kNoNormal);
    const auto first = static_cast<std::uint32_t>(soup_.normals.size());
    for (const std::uint32_t corner : corners) {
      const Vec3& n = normals[corner];
      const double sum = std::abs(n.x) + std::abs(n.y) + std::abs(n.z);
      const bool good = sum > 0.0 && sum - sum == 0.0;
      soup_.corner_normals.push_back(good ? first + corner : PolygonSoup::kNoNormal);
    }
    soup_.normals.insert(soup_.normals.end(), normals.begin(), normals.end());
  }

  void add_uv(const tinygltf::Primitive& primitive, const std::string& where, std::size_t points,
              const std::vector<std::uint32_t>& corners) {
    const std::string name = "TEXCOORD_" + std::to_string(*uv_set_);
    const auto given = primitive.attributes.find(name);
    if (given == primitive.attributes.end()) {
      uv_.resize(uv_.size() + corners.size(), glm::dvec2(std::numeric_limits<double>::quiet_NaN()));
      return;
    }
    const std::vector<double> uv = read_numbers(file_, given->second, 2, where + " " + name);
    if (uv.size() != 2 * points)
      file_.fail(where,
                 "has " + std::to_string(uv.size() / 2) + " texture coordinates for " +
                     std::to_string(points) + " vertices",
                 "export it again");
    has_uv_ = true;
    for (const std::size_t corner : corners) uv_.emplace_back(uv[2 * corner], uv[2 * corner + 1]);
  }

  void name_ignored(const tinygltf::Primitive& primitive) {
    if (!primitive.targets.empty()) notes_.ignore("morph targets");
    for (const auto& [name, accessor] : primitive.attributes)
      if (name.starts_with("COLOR_")) notes_.ignore("vertex colors");
  }

  const GltfFile& file_;
  const std::optional<int> uv_set_;
  GltfNotes& notes_;
  PolygonSoup soup_;
  std::vector<glm::dvec2> uv_;
  bool has_normals_ = false, has_uv_ = false;
};

}  // namespace

std::optional<MeshCache::Entry> read_gltf_mesh(const GltfFile& file, std::size_t mesh,
                                               std::optional<int> uv_set, GltfNotes& notes) {
  Joiner joiner(file, uv_set, notes);
  const std::vector<tinygltf::Primitive>& primitives = file.model.meshes[mesh].primitives;
  for (std::size_t i = 0; i < primitives.size(); ++i)
    joiner.add(primitives[i], "meshes[" + std::to_string(mesh) + "].primitives[" + std::to_string(i) + "]");
  return std::move(joiner).take();
}

}  // namespace penumbra::detail
