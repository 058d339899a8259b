#include "mesh/io/formats.h"

#include <algorithm>
#include <array>
#include <vector>

#include "mesh/io/cursor.h"
#include "penumbra/mesh/error.h"

namespace penumbra {
namespace {

using Bytes = std::span<const std::byte>;
using detail::MeshFormat;

bool never(Bytes) {
  return false;
}

constexpr std::array<MeshFormat, 4> kFormats = {{
    {.name = "PLY",
     .extension = ".ply",
     .magic = "ply",
     .has_magic = detail::begins_like_ply,
     .magic_decides = true,
     .has_size = never,
     .read = detail::read_ply,
     .write = detail::write_ply},
    {.name = "OBJ",
     .extension = ".obj",
     .magic = "",
     .has_magic = never,
     .magic_decides = false,
     .has_size = never,
     .read = detail::read_obj,
     .write = detail::write_obj},
    {.name = "OFF",
     .extension = ".off",
     .magic = "OFF",
     .has_magic = detail::begins_like_off,
     .magic_decides = false,
     .has_size = never,
     .read = detail::read_off,
     .write = detail::write_off},
    {.name = "STL",
     .extension = ".stl",
     .magic = "solid",
     .has_magic = detail::begins_like_stl,
     .magic_decides = false,
     .has_size = detail::has_binary_stl_size,
     .read = detail::read_stl,
     .write = detail::write_stl},
}};

const MeshFormat* format_of_extension(const std::filesystem::path& path) {
  const auto* found = std::ranges::find(kFormats, detail::lower_extension(path), &MeshFormat::extension);
  return found == kFormats.end() ? nullptr : found;
}

std::vector<std::string_view> column(std::string_view MeshFormat::*member) {
  std::vector<std::string_view> values;
  for (const MeshFormat& format : kFormats) values.push_back(format.*member);
  return values;
}

}  // namespace

std::span<const detail::MeshFormat> detail::mesh_formats() {
  return kFormats;
}

const MeshFormat& detail::recognize_format(Bytes bytes, const std::string& name) {
  for (const MeshFormat& format : kFormats)
    if (format.magic_decides && format.has_magic(bytes)) return format;
  const MeshFormat* named = format_of_extension(name);
  if (named != nullptr && !named->magic_decides) return *named;
  for (const MeshFormat& format : kFormats)
    if (format.has_magic(bytes)) return format;
  if (named == nullptr)
    for (const MeshFormat& format : kFormats)
      if (format.has_size(bytes)) return format;
  fail_reading(name, "",
               named != nullptr ? "does not begin with '" + std::string(named->magic) + "'"
                                : "is in no known mesh format",
               "use a file in " + mesh_format_names() + " format, named so");
}

const MeshFormat& detail::format_to_write(const std::filesystem::path& path) {
  if (path == "-") return kFormats.front();
  if (const MeshFormat* format = format_of_extension(path)) return *format;
  throw UsageError(path.string() + ": the extension names no mesh format; use " + one_of(mesh_extensions()));
}

std::string detail::lower_extension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  return extension;
}

std::string detail::one_of(std::span<const std::string_view> names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
    text.append(i == 0 ? "" : i + 1 < names.size() ? ", " : " or ").append(names[i]);
  return text;
}

std::vector<std::string_view> mesh_extensions() {
  return column(&MeshFormat::extension);
}

std::string mesh_format_names() {
  return detail::one_of(column(&MeshFormat::name));
}

}  // namespace penumbra
