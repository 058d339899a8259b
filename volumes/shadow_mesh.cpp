#include "penumbra/volumes/shadow_mesh.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <map>
#include <ostream>

#include "mesh/io/formats.h"
#include "mesh/io/little_endian.h"
#include "mesh/io/write_file.h"
#include "penumbra/mesh/error.h"
#include "volumes/shadow_glb.h"

namespace penumbra {

namespace {

using detail::append_little_endian;

void write_ply(std::ostream& out, const ShadowMesh& mesh) {
  out << "ply\nformat binary_little_endian 1.0\ncomment guarantee " << name_of(mesh.guarantee)
      << "\nelement vertex " << mesh.positions.size()
      << "\nproperty double x\nproperty double y\nproperty double z\nelement face " << mesh.triangles.size()
      << "\nproperty list uchar int vertex_indices\nproperty uchar kind\nproperty int source\nproperty int "
         "object\n"
         "end_header\n";
  std::string bytes;
  for (const Vec3& p : mesh.positions) {
    append_little_endian(bytes, p.x);
    append_little_endian(bytes, p.y);
    append_little_endian(bytes, p.z);
  }
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    append_little_endian(bytes, std::uint8_t{3});
    for (const std::uint32_t v : mesh.triangles[i]) append_little_endian(bytes, static_cast<std::int32_t>(v));
    append_little_endian(bytes, static_cast<std::uint8_t>(mesh.tags[i].kind));
    append_little_endian(bytes, static_cast<std::int32_t>(mesh.tags[i].source));
    append_little_endian(bytes, static_cast<std::int32_t>(mesh.tags[i].object));
  }
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

void write_obj(std::ostream& out, const ShadowMesh& mesh) {
  out << "# guarantee " << name_of(mesh.guarantee) << "\n";
  char line[128];
  for (const Vec3& p : mesh.positions) {
    std::snprintf(line, sizeof line, "v %.17g %.17g %.17g\n", p.x, p.y, p.z);
    out << line;
  }
  std::map<std::pair<std::uint32_t, ShadowKind>, std::vector<std::size_t>> groups;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    groups[{mesh.tags[i].object, mesh.tags[i].kind}].push_back(i);
  for (const auto& [key, triangles] : groups) {
    out << "g object_" << key.first << "_" << name_of(key.second) << "\n";
    for (const std::size_t i : triangles) {
      const IndexedTriangle& t = mesh.triangles[i];
      out << "f " << t[0] + 1 << " " << t[1] + 1 << " " << t[2] + 1 << "\n";
    }
  }
}

/// The one table of formats that hold a triangle's kind, source and object.
struct Format {
  std::string_view name, extension;
  void (*write)(std::ostream& out, const ShadowMesh& mesh);
};
constexpr std::array<Format, 3> kFormats = {
    {{"PLY", ".ply", write_ply}, {"OBJ", ".obj", write_obj}, {"glTF", ".glb", detail::write_glb}}};

std::vector<std::string_view> column(std::string_view Format::*member) {
  std::vector<std::string_view> values;
  for (const Format& format : kFormats) values.push_back(format.*member);
  return values;
}

/// What still holds of the union of two volumes. A union of umbras lies in the umbra of both casters
/// together, but is not all of it; a union of penumbra volumes contains the penumbra of both.
Guarantee of_union(Guarantee a, Guarantee b) {
  const auto is_solid = [](Guarantee g) { return g == Guarantee::kCertified || g == Guarantee::kWithin; };
  if (is_solid(a) && is_solid(b)) return a == b ? a : Guarantee::kWithin;
  const auto is_umbra = [](Guarantee g) { return g == Guarantee::kExact || g == Guarantee::kContained; };
  if (is_umbra(a) && is_umbra(b)) return Guarantee::kContained;
  return a == b ? a : Guarantee::kNone;
}

}  // namespace

const char* name_of(ShadowKind kind) {
  switch (kind) {
    case ShadowKind::kPenumbraFacet:
      return "penumbra_facet";
    case ShadowKind::kPenumbraCone:
      return "penumbra_cone";
    case ShadowKind::kUmbraFacet:
      return "umbra_facet";
    case ShadowKind::kUmbraCap:
      return "umbra_cap";
    case ShadowKind::kCell:
      return "cell";
    case ShadowKind::kFarCap:
      return "far_cap";
    case ShadowKind::kSolid:
      return "solid";
  }
  return "unknown";
}

const char* name_of(Guarantee guarantee) {
  switch (guarantee) {
    case Guarantee::kExact:
      return "exact";
    case Guarantee::kContained:
      return "contained";
    case Guarantee::kContains:
      return "contains";
    case Guarantee::kCertified:
      return "certified";
    case Guarantee::kWithin:
      return "within";
    case Guarantee::kNone:
      return "none";
  }
  return "unknown";
}

ShadowMesh merge(std::span<const ShadowMesh> parts) {
  ShadowMesh result;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const ShadowMesh& part = parts[i];
    result.guarantee = i == 0 ? part.guarantee : of_union(result.guarantee, part.guarantee);
    const auto first = static_cast<std::uint32_t>(result.positions.size());
    result.positions.insert(result.positions.end(), part.positions.begin(), part.positions.end());
    for (const IndexedTriangle& t : part.triangles)
      result.triangles.push_back({first + t[0], first + t[1], first + t[2]});
    result.tags.insert(result.tags.end(), part.tags.begin(), part.tags.end());
    result.cells += part.cells;
  }
  return result;
}

std::vector<std::string_view> shadow_mesh_extensions() {
  return column(&Format::extension);
}

std::string shadow_mesh_format_names() {
  return detail::one_of(column(&Format::name));
}

void write_shadow_mesh(const std::filesystem::path& path, const ShadowMesh& mesh) {
  const auto* format = std::ranges::find(kFormats, detail::lower_extension(path), &Format::extension);
  if (path == "-") format = kFormats.begin();
  if (format == kFormats.end()) {
    throw UsageError(path.string() + ": shadow meshes are written as " +
                     detail::one_of(shadow_mesh_extensions()) + "; choose one of these extensions");
  }
  write_file(path, [&](std::ostream& out) { format->write(out, mesh); });
}

}  // namespace penumbra
