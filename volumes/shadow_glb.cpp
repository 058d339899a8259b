#include "volumes/shadow_glb.h"

#include <algorithm>
#include <limits>
#include <map>
#include <ostream>
#include <sstream>
#include <string>
#include <unordered_map>

#include "mesh/io/little_endian.h"
#include "penumbra/mesh/error.h"
#include "penumbra/mesh/triangle_mesh.h"

namespace penumbra::detail {
namespace {

/// The triangles of one object, over vertices of their own.
struct Part {
  std::vector<std::uint32_t> vertices;  ///< of the mesh
  std::vector<std::uint32_t> indices;   ///< into `vertices`
};

std::map<std::uint32_t, Part> parts_of(const ShadowMesh& mesh) {
  std::map<std::uint32_t, Part> parts;
  std::map<std::uint32_t, std::unordered_map<std::uint32_t, std::uint32_t>> numbers;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const std::uint32_t object = mesh.tags[i].object;
    Part& part = parts[object];
    std::unordered_map<std::uint32_t, std::uint32_t>& number = numbers[object];  // 0: not met; else one more
    for (const std::uint32_t v : mesh.triangles[i]) {
      if (number[v] == 0) {
        part.vertices.push_back(v);
        number[v] = static_cast<std::uint32_t>(part.vertices.size());
      }
      part.indices.push_back(number[v] - 1);
    }
  }
  return parts;
}

/// JSON and binary data, part by part.
class Writer {
 public:
  explicit Writer(const ShadowMesh& mesh) : mesh_(mesh) {
    for (auto* list : {&nodes_, &meshes_, &accessors_, &views_}) list->precision(17);
  }

  void add(std::uint32_t object, const Part& part) {
    Bounds box;
    for (const std::uint32_t v : part.vertices) box.add(mesh_.positions[v]);
    const Vec3 middle = box.center(), half = box.high - middle;
    if (!(std::max({half.x, half.y, half.z}) <= std::numeric_limits<float>::max()))
      throw UsageError("the volume is too large for the single precision of a .glb; write .ply");
    const std::size_t positions = data_.size();
    Bounds written;
    for (const std::uint32_t v : part.vertices) {
      const glm::vec3 p(mesh_.positions[v] - middle);
      written.add(Vec3(p));
      for (int k = 0; k < 3; ++k) append_little_endian(data_, p[k]);
    }
    const std::size_t indices = data_.size();
    for (const std::uint32_t i : part.indices) append_little_endian(data_, i);
    const char* comma = count_ > 0 ? "," : "";
    nodes_ << comma << R"({"name":"object )" << object << R"(","mesh":)" << count_ << R"(,"translation":)"
           << text(middle) << R"(,"extras":{"object":)" << object << R"(,"guarantee":")"
           << name_of(mesh_.guarantee) << R"("}})";
    meshes_ << comma << R"({"primitives":[{"attributes":{"POSITION":)" << 2 * count_ << R"(},"indices":)"
            << 2 * count_ + 1 << R"(,"material":0}]})";
    accessors_ << comma << R"({"bufferView":)" << 2 * count_
               << R"(,"componentType":5126,"type":"VEC3","count":)" << part.vertices.size() << R"(,"min":)"
               << text(written.low) << R"(,"max":)" << text(written.high) << R"(},{"bufferView":)"
               << 2 * count_ + 1 << R"(,"componentType":5125,"type":"SCALAR","count":)" << part.indices.size()
               << "}";
    views_ << comma << R"({"buffer":0,"target":34962,"byteOffset":)" << positions << R"(,"byteLength":)"
           << indices - positions << R"(},{"buffer":0,"target":34963,"byteOffset":)" << indices
           << R"(,"byteLength":)" << data_.size() - indices << "}";
    ++count_;
  }

  void write(std::ostream& out) const {
    std::string json = document();
    json.append((4 - json.size() % 4) % 4, ' ');
    const std::size_t length = 20 + json.size() + (data_.empty() ? 0 : 8 + data_.size());
    if (length > 0xFFFFFFFFu)
      throw UsageError(
          "the volume needs more than the 4 GiB of a .glb; write .ply, or take a coarser tolerance");
    std::string head = "glTF";
    for (const std::size_t word : {std::size_t{2}, length, json.size(), std::size_t{0x4E4F534A}})
      append_little_endian(head, static_cast<std::uint32_t>(word));
    out << head << json;
    if (data_.empty()) return;
    std::string chunk;
    for (const std::size_t word : {data_.size(), std::size_t{0x004E4942}})
      append_little_endian(chunk, static_cast<std::uint32_t>(word));
    out << chunk << data_;
  }

 private:
  static std::string text(const Vec3& v) {
    std::ostringstream out;
    out.precision(17);
    out << "[" << v.x << "," << v.y << "," << v.z << "]";
    return out.str();
  }

  std::string document() const {
    std::string json = R"({"asset":{"version":"2.0","generator":"Penumbra"},"scene":0,"scenes":[{)";
    if (count_ == 0) return json + "}]}";  // lists of glTF are not empty
    json += R"("nodes":[)";
    for (std::size_t i = 0; i < count_; ++i) {
      if (i > 0) json += ',';
      json += std::to_string(i);
    }
    return json + R"(]}],"nodes":[)" + nodes_.str() + R"(],"meshes":[)" + meshes_.str() +
           R"(],"accessors":[)" + accessors_.str() + R"(],"bufferViews":[)" + views_.str() +
           R"(],"buffers":[{"byteLength":)" + std::to_string(data_.size()) +
           R"(}],"materials":[{"name":"shadow","alphaMode":"BLEND","doubleSided":true,"pbrMetallicRoughness":)"
           R"({"baseColorFactor":[0.2,0.25,0.4,0.5],"metallicFactor":0,"roughnessFactor":1}}]})";
  }

  const ShadowMesh& mesh_;
  std::ostringstream nodes_, meshes_, accessors_, views_;
  std::string data_;
  std::size_t count_ = 0;
};

}  // namespace

void write_glb(std::ostream& out, const ShadowMesh& mesh) {
  Writer writer(mesh);
  for (const auto& [object, part] : parts_of(mesh)) writer.add(object, part);
  writer.write(out);
}

}  // namespace penumbra::detail
