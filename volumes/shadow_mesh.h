// What extrusion produces: an indexed triangle mesh whose triangles say where they come from.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "penumbra/mesh/types.h"

namespace penumbra {

enum class ShadowKind : std::uint8_t {
  kPenumbraFacet,  ///< plane through an edge with caster and light on opposite sides; source: edge
  kPenumbraCone,   ///< chorded or circumscribed cone at a vertex; source: vertex
  kUmbraFacet,     ///< plane through an edge with caster and light on the same side; source: edge
  kUmbraCap,       ///< part of a caster's face that bounds its umbra; source: face
  /// Boundary of a penumbra cell, or of the umbra of a star-shaped component's kernel; source: the face, or
  /// the first face of the component, it belongs to.
  kCell,
  kFarCap,  ///< where a volume is cut off beyond the scene's bound; source as for kCell
};
const char* name_of(ShadowKind kind);

struct ShadowTag {
  ShadowKind kind;
  std::uint32_t source;      ///< edge, vertex or face index in the caster's mesh, by kind
  std::uint32_t object = 0;  ///< scene index of the caster
};

/// How an umbra volume relates to {O = 0}, or a penumbra volume to {O < 1}.
enum class Guarantee : std::uint8_t {
  kExact,      ///< umbra: equal to {O = 0} of this caster, up to rounding
  kContained,  ///< umbra: inside {O = 0}; perhaps empty
  kContains,   ///< penumbra: {O < 1} is inside it
  kNone,       ///< sheets: a set of facets, not a volume
};
const char* name_of(Guarantee guarantee);

struct ShadowMesh {
  std::vector<Vec3> positions;
  std::vector<IndexedTriangle>
      triangles;                ///< volumes: oriented outward, every half-edge matched by its opposite
  std::vector<ShadowTag> tags;  ///< one per triangle
  Guarantee guarantee = Guarantee::kNone;
  std::size_t cells = 0;  ///< volumes: number of convex pieces
};

/// Joins meshes, keeping tags (object numbers must be set already). The guarantee is what holds of the union
/// against the casters together: several umbras are `kContained` even if each is exact, penumbras stay
/// `kContains`.
ShadowMesh merge(std::span<const ShadowMesh> parts);

/// The extensions that write_shadow_mesh knows: lower case, with the dot.
std::vector<std::string_view> shadow_mesh_extensions();
/// The formats' names in the same order, for help texts: "PLY or OBJ".
std::string shadow_mesh_format_names();

/// Writes the format that the extension names; PLY for the path "-", which is standard output. PLY is binary, little
/// endian, in double, with the properties `kind`, `source` and `object` of each face. OBJ has a group for each object
/// and kind. The file is written whole or not at all. Throws UsageError for another extension, SystemError where
/// writing fails. Cost O(triangles).
void write_shadow_mesh(const std::filesystem::path& path, const ShadowMesh& mesh);

}  // namespace penumbra
