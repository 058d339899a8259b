#include "render/scene/gltf/gltf_file.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string_view>

#include "penumbra/mesh/error.h"

namespace penumbra::detail {
namespace {

constexpr int kMaxDepth = 64;
constexpr std::size_t kMaxJson = 256u << 20;
constexpr std::uint32_t kJsonChunk = 0x4E4F534A;
constexpr const char* kExport = "export it again as glTF 2.0";

/// What may be required and changes no position: textures and looks are not used.
constexpr std::array<std::string_view, 7> kHarmless = {
    "KHR_lights_punctual",   "EXT_lights_area",    "KHR_mesh_quantization", "EXT_mesh_gpu_instancing",
    "KHR_texture_transform", "KHR_texture_basisu", "EXT_texture_webp"};

std::uint32_t word(std::span<const std::byte> bytes, std::size_t at) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

/// The JSON of a .glb, and all chunks that follow it.
struct GlbParts {
  std::string_view json;
  std::span<const std::byte> rest;
};
GlbParts parts_of(std::span<const std::byte> bytes, const GltfFile& file) {
  if (bytes.size() < 20) file.fail("byte 0", "is shorter than a .glb's header", "copy or export it again");
  if (word(bytes, 4) != 2)
    file.fail("byte 4", "is version " + std::to_string(word(bytes, 4)) + " of the format", kExport);
  const std::size_t length = word(bytes, 12);
  if (word(bytes, 16) != kJsonChunk || length > bytes.size() - 20)
    file.fail("byte 12", "has no whole chunk of JSON", "it is truncated; copy or export it again");
  const auto rest = bytes.subspan(20 + length);
  if (word(bytes, 8) > bytes.size() ||
      (!rest.empty() && (rest.size() < 8 || word(rest, 0) > rest.size() - 8)))
    file.fail("byte " + std::to_string(bytes.size()), "ends in the middle of its data",
              "it is truncated; copy or export it again");
  return {{reinterpret_cast<const char*>(bytes.data()) + 20, length}, rest};
}

nlohmann::json parse_json(std::string_view text, const GltfFile& file) {
  if (text.size() > kMaxJson) file.fail("", "has more than 256 MiB of JSON", "keep data in buffers");
  const auto limit = [&file](int depth, nlohmann::json::parse_event_t, nlohmann::json&) {
    if (depth > kMaxDepth) file.fail("", "nests deeper than 64 levels", "flatten its extras");
    return true;
  };
  try {
    return nlohmann::json::parse(text, limit);
  } catch (const nlohmann::json::exception& e) {
    std::string reason = e.what();
    if (const auto end = reason.find("] "); end != std::string::npos) reason.erase(0, end + 2);
    file.fail("", reason, kExport);
  }
}

void refuse_unknown(const nlohmann::json& json, const GltfFile& file) {
  const auto required = json.find("extensionsRequired");
  if (required == json.end() || !required->is_array()) return;
  for (const nlohmann::json& entry : *required) {
    if (!entry.is_string()) continue;
    const auto& name = entry.get_ref<const std::string&>();
    if (name.find("draco") != std::string::npos)
      file.fail("extensionsRequired", "is compressed by Draco (" + name + "), which is not read",
                "export it without compression");
    if (name.find("meshopt") != std::string::npos)
      file.fail("extensionsRequired", "is compressed by meshopt (" + name + "), which is not read",
                "export it without compression");
    if (std::ranges::find(kHarmless, name) == kHarmless.end() && !name.starts_with("KHR_materials_"))
      file.fail("extensionsRequired", "needs the extension " + name + ", which is not known",
                "export it without");
  }
}

bool exists(const std::string& path, void*) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(path, ignored);
}
std::string unchanged(const std::string& path, void*) {
  return path;
}
/// Regular files alone: a path may name anything.
bool read(std::vector<unsigned char>* out, std::string* error, const std::string& path, void* file) {
  std::ifstream in(path, std::ios::binary);
  if (!exists(path, nullptr) || !in) {
    *error += path + ": cannot be read";
    return false;
  }
  out->assign(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
  static_cast<GltfFile*>(file)->files.emplace_back(path);
  return true;
}
bool refuse_to_write(std::string*, const std::string&, const std::vector<unsigned char>&, void*) {
  return false;
}

std::string first_line(const std::string& text) {
  return text.substr(0, std::min(text.find('\n'), std::size_t{200}));
}

/// A .glb of another JSON and the same chunks behind.
std::vector<unsigned char> glb_of(std::string json, std::span<const std::byte> rest) {
  json.append((4 - json.size() % 4) % 4, ' ');
  const std::array<std::uint32_t, 5> head = {0x46546C67, 2,
                                             static_cast<std::uint32_t>(20 + json.size() + rest.size()),
                                             static_cast<std::uint32_t>(json.size()), kJsonChunk};
  std::vector<unsigned char> out(sizeof head + json.size() + rest.size());
  std::memcpy(out.data(), head.data(), sizeof head);
  std::memcpy(out.data() + sizeof head, json.data(), json.size());
  if (!rest.empty()) std::memcpy(out.data() + sizeof head + json.size(), rest.data(), rest.size());
  return out;
}

}  // namespace

void GltfFile::fail(const std::string& where, const std::string& what, const std::string& advice) const {
  throw SceneError(name + ": " + (where.empty() ? "" : where + ": ") + what + "; " + advice);
}

bool begins_like_glb(std::span<const std::byte> bytes) {
  return bytes.size() >= 4 && std::memcmp(bytes.data(), "glTF", 4) == 0;
}

GltfFile read_gltf_file(std::span<const std::byte> bytes, const std::filesystem::path& folder,
                        const std::string& name) {
  GltfFile file{.name = name, .model = {}, .files = {}};
  if (bytes.size() > 0xFFFFFFFFu) file.fail("", "is larger than 4 GiB", "keep data in buffers of their own");
  const bool binary = begins_like_glb(bytes);
  GlbParts parts{{reinterpret_cast<const char*>(bytes.data()), bytes.size()}, {}};
  if (binary) parts = parts_of(bytes, file);
  nlohmann::json json = parse_json(parts.json, file);
  if (!json.is_object() || !json.contains("asset"))
    file.fail("", "has no key \"asset\"", "it is no glTF 2.0; name a .gltf or .glb");
  refuse_unknown(json, file);
  file.has_images = json.contains("images");
  json.erase("images");

  tinygltf::TinyGLTF reader;
  reader.SetFsCallbacks({exists, unchanged, read, refuse_to_write, &file});
  std::string error, warning;
  const std::string text = json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  bool good = false;
  try {
    if (binary) {
      const std::vector<unsigned char> whole = glb_of(text, parts.rest);
      good = reader.LoadBinaryFromMemory(&file.model, &error, &warning, whole.data(),
                                         static_cast<unsigned int>(whole.size()), folder.string());
    } else {
      good = reader.LoadASCIIFromString(&file.model, &error, &warning, text.data(),
                                        static_cast<unsigned int>(text.size()), folder.string());
    }
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& e) {  // of JSON that has another type than the format says
    error = e.what();
  }
  if (!good) file.fail("", error.empty() ? "cannot be read" : first_line(error), kExport);
  return file;
}

}  // namespace penumbra::detail
