// Pipeline step 2½: where shadow boundaries touch the caster. Edges whose tangent plane to the disk supports
// the caster locally, and the sectors of cones by which boundaries go round vertices.
//
// In: mesh, light, silhouettes. Out: facets and cone sectors, in terms of mesh elements and rim angles. Both
// the sheets (extrude.h) and the D-buffer are made of them.
//
// "Umbra and penumbra volumes" (2004), section 2.1, with its rule for which edges carry facets replaced:
// "all-frontfacing beside one that is not" misses edges between two mixed faces. Here an edge carries a facet
// for each of its two tangent planes that has both opposite vertices on one side; the disk on the other side
// makes it a penumbra facet, on the same side an umbra facet. That is local and necessary (exact for convex
// casters), not sufficient.
#pragma once

#include <span>
#include <vector>

#include "penumbra/mesh/vertex_rings.h"
#include "penumbra/volumes/silhouettes.h"

namespace penumbra {

enum class SupportKind : std::uint8_t {
  kPenumbra,  ///< entering it, the first of the light disappears
  kUmbra,     ///< leaving it, the first of the light appears
};

inline constexpr std::uint32_t kNoFacet = 0xffffffffu;

struct SupportFacet {
  EdgeId edge;
  SupportKind kind;
  bool flipped;  ///< runs to → from instead of from → to; directed so that of the plane through a receiver x
      ///< beyond it and the edge a → b, with normal (a - x) × (b - a), the lit side is the positive
  double rim_angle;  ///< contact with the disk: center + radius (cos·u + sin·v), radians in [0, 2π)
  std::uint32_t previous = kNoFacet, next = kNoFacet;  ///< facets of the same kind that end at a, begin at b
};

/// Part of the cone over the disk with its apex at a vertex, between the contacts of two facets; or all of
/// it, without facets, where every edge at the vertex points into the disk.
struct ConeSector {
  VertexId vertex;
  SupportKind kind;
  double from_angle, to_angle;  ///< rim angles, from < to ≤ from + 2π
  std::uint32_t from_facet, to_facet;
};

/// A mixed face turned away from the disk's center, between the umbra silhouette and the center's own: seen
/// from the center, no umbra facet covers it. The 2004 paper (section 3.3) calls these silhouette faces and
/// draws them as part of the umbra volume.
struct GapFace {
  FaceId face;
  std::uint32_t facet;  ///< the umbra facet nearest to it, in steps from face to face
};

struct Supports {
  std::vector<SupportFacet> facets;  ///< in order of edge, then angle
  std::vector<ConeSector> cones;     ///< in order of vertex, then angle
};

/// Facets are decided by the exact predicates; angles, and which sectors cones fill, in double. Only edges in
/// front of the light's plane count; one that crosses it counts with its part in front. Cost O(band · ring).
Supports find_supports(const TriangleMesh& mesh, const VertexRings& rings, const DiskLight& light,
                       const Silhouettes& silhouettes);

/// The same in two steps, for callers that can tell which facets are of use. First the facets, not linked
/// yet. Cost O(band).
std::vector<SupportFacet> find_support_facets(const TriangleMesh& mesh, const DiskLight& light,
                                              const Silhouettes& silhouettes);
/// Then links and cone sectors at the vertices where a facet ends that is in use (not 0; one number each);
/// none at other vertices, and no cones all round. Cost O(facets in use · ring).
void link_support_facets(const TriangleMesh& mesh, const VertexRings& rings, const DiskLight& light,
                         std::span<const char> in_use, Supports& supports);

/// In order of steps from the umbra facets, then of facet. Cost O(F).
std::vector<GapFace> find_gap_faces(const TriangleMesh& mesh, const DiskLight& light,
                                    const Classification& classes, const Supports& supports);

}  // namespace penumbra
