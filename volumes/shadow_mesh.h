// What extrusion makes: an indexed triangle mesh whose triangles say where they come from.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "penumbra/mesh/types.h"

namespace penumbra {

/// What a triangle is part of. Each kind has a source: an edge, a vertex or a face of the caster.
enum class ShadowKind : std::uint8_t {
  /// A plane through an edge, with caster and light on opposite sides. Source: the edge.
  kPenumbraFacet,
  /// A cone with its apex at a vertex, as a pyramid around it. Source: the vertex.
  kPenumbraCone,
  /// A plane through an edge, with caster and light on the same side. Source: the edge.
  kUmbraFacet,
  /// Part of a face of the caster that bounds its umbra. Source: the face.
  kUmbraCap,
  /// The boundary of a penumbra cell, or of the umbra of a star-shaped component's kernel. Source: the face
  /// that it belongs to, or the first face of the patch or component.
  kCell,
  /// Where a volume is cut off beyond the bound. Source: as for kCell.
  kFarCap,
  /// The boundary of a solid. Source: 0.
  kSolid,
};
/// As files have it: "penumbra_facet", "far_cap" and so on.
const char* name_of(ShadowKind kind);

struct ShadowTag {
  ShadowKind kind;
  /// The number of an edge, vertex or face of the caster's mesh; the kind tells which.
  std::uint32_t source;
  /// The caster's number in its scene.
  std::uint32_t object = 0;
};

/// How a volume relates to O, the fraction of the disk's area that a point sees.
enum class Guarantee : std::uint8_t {
  /// An umbra: it is {O = 0} of this caster, but for rounding.
  kExact,
  /// An umbra: it lies inside {O = 0}. It may be empty.
  kContained,
  /// A penumbra: {O < 1} lies inside it.
  kContains,
  /// A solid: it lies inside {O = 0}, or {O < 1} inside it. Each of its triangles is proved to be on the safe
  /// side.
  kCertified,
  /// A solid that is meant to be on the safe side, as far as points tell, and lies within its tolerance.
  kWithin,
  /// Sheets: facets that are no volume. Also what was not made.
  kNone,
};
/// "exact", "contained", "contains", "certified", "within" or "none".
const char* name_of(Guarantee guarantee);

struct ShadowMesh {
  std::vector<Vec3> positions;
  /// In a volume: oriented outward, and every half-edge is matched by its opposite.
  std::vector<IndexedTriangle> triangles;
  /// One per triangle.
  std::vector<ShadowTag> tags;
  Guarantee guarantee = Guarantee::kNone;
  /// In a volume: of how many convex pieces it is the sum.
  std::size_t cells = 0;
};

/// Joins meshes. Tags are kept, so object numbers have to be set already. The guarantee is what holds of the
/// union for all casters together: of several umbras it is kContained even if each is exact, of penumbra
/// volumes it stays kContains, of a mixture it is kNone. Cost O(triangles).
ShadowMesh merge(std::span<const ShadowMesh> parts);

/// The extensions that write_shadow_mesh knows: lower case, with the dot.
std::vector<std::string_view> shadow_mesh_extensions();
/// The formats' names in the same order, for help texts: "PLY, OBJ or glTF".
std::string shadow_mesh_format_names();

/// Writes the format that the extension names; PLY for the path "-", which is standard output. PLY is binary,
/// little endian, in double, with the properties `kind`, `source` and `object` of each face. OBJ has a group
/// for each object and kind. glTF is binary (.glb), in float around the middle of each object's part. The
/// file is written whole or not at all. Throws UsageError for another extension, SystemError where writing
/// fails. Cost O(triangles).
void write_shadow_mesh(const std::filesystem::path& path, const ShadowMesh& mesh);

}  // namespace penumbra
