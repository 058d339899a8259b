#include "penumbra/render/bake/atlas_mesh.h"

#include <algorithm>
#include <map>
#include <ostream>
#include <tuple>
#include <utility>

#include "mesh/io/formats.h"
#include "mesh/io/little_endian.h"
#include "mesh/io/write_file.h"
#include "penumbra/mesh/error.h"
#include "render/scene/gltf/tiny_gltf.h"

namespace penumbra {
namespace {

/// Corners in the order in which they are written.
std::array<std::size_t, 3> corner_order(bool turned) {
  return turned ? std::array<std::size_t, 3>{0, 2, 1} : std::array<std::size_t, 3>{0, 1, 2};
}

struct Parts {
  const std::vector<SceneObject>& objects;
  const TextureAtlas& atlas;
  std::span<const std::size_t> backs;

  bool is_turned(std::size_t object) const { return std::ranges::find(backs, object) != backs.end(); }
  template <class Visit>
  void for_each_object(const Visit& visit) const {
    for (std::size_t i = 0; i < objects.size(); ++i)
      if (atlas.has(i)) visit(i);
  }
};

void write_obj(std::ostream& out, const Parts& parts) {
  out.precision(17);
  std::size_t first = 1, first_uv = 1;
  parts.for_each_object([&](std::size_t object) {
    const TriangleMesh& mesh = parts.objects[object].mesh;
    out << "o object" << object << "\n";
    for (const Vec3& p : mesh.positions()) out << "v " << p.x << " " << p.y << " " << p.z << "\n";
    for (const FaceUv& uv : parts.atlas.uv[object])
      for (const glm::dvec2& p : uv)
        out << "vt " << p.x / parts.atlas.width << " " << 1.0 - p.y / parts.atlas.height << "\n";
    for (std::size_t f = 0; f < mesh.triangles().size(); ++f) {
      out << "f";
      for (const std::size_t k : corner_order(parts.is_turned(object)))
        out << " " << mesh.triangles()[f][k] + first << "/" << 3 * f + k + first_uv;
      out << "\n";
    }
    first += mesh.positions().size();
    first_uv += 3 * mesh.triangles().size();
  });
}

/// One object's corners as vertices: one for each position and place in the texture.
struct Vertices {
  std::vector<std::pair<std::uint32_t, glm::dvec2>> list;
  std::vector<std::uint32_t> indices;

  Vertices(const TriangleMesh& mesh, const std::vector<FaceUv>& uv, bool turned) {
    std::map<std::tuple<std::uint32_t, double, double>, std::uint32_t> numbers;
    for (std::size_t f = 0; f < mesh.triangles().size(); ++f)
      for (const std::size_t k : corner_order(turned)) {
        const std::uint32_t v = mesh.triangles()[f][k];
        const auto [at, is_new] =
            numbers.try_emplace({v, uv[f][k].x, uv[f][k].y}, static_cast<std::uint32_t>(list.size()));
        if (is_new) list.emplace_back(v, uv[f][k]);
        indices.push_back(at->second);
      }
  }
};

class GlbWriter {
 public:
  explicit GlbWriter(const Parts& parts) : parts_(parts) {
    model_.asset.version = "2.0";
    model_.asset.generator = "Penumbra";
    model_.scenes.emplace_back();
    model_.defaultScene = 0;
    parts.for_each_object([this](std::size_t object) { add(object); });
    tinygltf::Buffer buffer;
    buffer.data.assign(data_.begin(), data_.end());
    model_.buffers.push_back(std::move(buffer));
  }

  void write(std::ostream& out) {
    tinygltf::TinyGLTF gltf;
    if (!gltf.WriteGltfSceneToStream(&model_, out, false, true))
      throw SystemError("the mesh cannot be encoded as glTF");
  }

 private:
  void add(std::size_t object) {
    const SceneObject& from = parts_.objects[object];
    const Vertices vertices(from.mesh, parts_.atlas.uv[object], parts_.is_turned(object));
    const Vec3 middle = from.mesh.bounds().center();
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.material = add_material(from.albedo);
    primitive.attributes["POSITION"] = add_positions(from.mesh, vertices, middle);
    primitive.attributes["TEXCOORD_0"] = primitive.attributes["TEXCOORD_1"] = add_uv(vertices);
    primitive.indices = add_indices(vertices);
    tinygltf::Mesh mesh;
    mesh.primitives.push_back(std::move(primitive));
    model_.meshes.push_back(std::move(mesh));
    tinygltf::Node node;
    node.name = from.name;
    node.mesh = static_cast<int>(model_.meshes.size()) - 1;
    node.translation = {middle.x, middle.y, middle.z};
    model_.scenes[0].nodes.push_back(static_cast<int>(model_.nodes.size()));
    model_.nodes.push_back(std::move(node));
  }

  int add_material(const Vec3& albedo) {
    tinygltf::Material material;
    material.pbrMetallicRoughness.baseColorFactor = {albedo.x, albedo.y, albedo.z, 1.0};
    material.pbrMetallicRoughness.metallicFactor = 0.0;
    model_.materials.push_back(std::move(material));
    return static_cast<int>(model_.materials.size()) - 1;
  }
  int add_positions(const TriangleMesh& mesh, const Vertices& vertices, const Vec3& middle) {
    const std::size_t begin = data_.size();
    Bounds written;
    for (const auto& [v, uv] : vertices.list) {
      const glm::vec3 p(mesh.positions()[v] - middle);
      written.add(Vec3(p));
      for (int k = 0; k < 3; ++k) detail::append_little_endian(data_, p[k]);
    }
    const int accessor = add_accessor(begin, TINYGLTF_TARGET_ARRAY_BUFFER, TINYGLTF_COMPONENT_TYPE_FLOAT,
                                      TINYGLTF_TYPE_VEC3, vertices.list.size());
    auto& about = model_.accessors[static_cast<std::size_t>(accessor)];
    about.minValues = {written.low.x, written.low.y, written.low.z};
    about.maxValues = {written.high.x, written.high.y, written.high.z};
    return accessor;
  }
  int add_uv(const Vertices& vertices) {
    const std::size_t begin = data_.size();
    for (const auto& [v, uv] : vertices.list) {
      detail::append_little_endian(data_, static_cast<float>(uv.x / parts_.atlas.width));
      detail::append_little_endian(data_, static_cast<float>(uv.y / parts_.atlas.height));
    }
    return add_accessor(begin, TINYGLTF_TARGET_ARRAY_BUFFER, TINYGLTF_COMPONENT_TYPE_FLOAT,
                        TINYGLTF_TYPE_VEC2, vertices.list.size());
  }
  int add_indices(const Vertices& vertices) {
    const std::size_t begin = data_.size();
    for (const std::uint32_t i : vertices.indices) detail::append_little_endian(data_, i);
    return add_accessor(begin, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT,
                        TINYGLTF_TYPE_SCALAR, vertices.indices.size());
  }
  int add_accessor(std::size_t begin, int target, int component, int type, std::size_t count) {
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = begin;
    view.byteLength = data_.size() - begin;
    view.target = target;
    model_.bufferViews.push_back(std::move(view));
    tinygltf::Accessor accessor;
    accessor.bufferView = static_cast<int>(model_.bufferViews.size()) - 1;
    accessor.componentType = component;
    accessor.type = type;
    accessor.count = count;
    model_.accessors.push_back(std::move(accessor));
    return static_cast<int>(model_.accessors.size()) - 1;
  }

  const Parts& parts_;
  tinygltf::Model model_;
  std::string data_;
};

}  // namespace

void write_atlas_mesh(const std::filesystem::path& path, const std::vector<SceneObject>& objects,
                      const TextureAtlas& atlas, std::span<const std::size_t> backs) {
  const Parts parts{objects, atlas, backs};
  const std::string extension = detail::lower_extension(path);
  if (extension != ".obj" && extension != ".glb")
    throw UsageError(path.string() + ": meshes with texture coordinates are written as .glb or .obj");
  write_file(path, [&](std::ostream& out) {
    if (extension == ".obj") return write_obj(out, parts);
    GlbWriter(parts).write(out);
  });
}

}  // namespace penumbra
