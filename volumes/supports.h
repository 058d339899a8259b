// Supports: where shadow boundaries touch the caster. These are the edges whose tangent plane to the disk
// supports the caster locally, and the sectors of cones by which the boundaries go round vertices.
//
// In: a mesh, a light and silhouettes. Out: facets and cone sectors, in terms of mesh elements and angles on
// the disk's rim. Sheets (extrude.h) and the D-buffer are made of them.
//
// "Umbra and penumbra volumes" (2004), section 2.1, with its rule for which edges carry facets replaced. Its
// "all-frontfacing beside one that is not" misses edges between two mixed faces. Here an edge carries a facet
// for each of its two tangent planes that has both opposite vertices on one side. With the disk on the other
// side it is a penumbra facet, with the disk on the same side an umbra facet. This is local and necessary
// (exact for convex casters), not sufficient.
#pragma once

#include <span>
#include <vector>

#include "penumbra/mesh/vertex_rings.h"
#include "penumbra/volumes/silhouettes.h"

namespace penumbra {

enum class SupportKind : std::uint8_t {
  kPenumbra,  ///< where a receiver that goes into the shadow begins to lose light
  kUmbra,     ///< where a receiver that comes out of the umbra begins to get light
};

inline constexpr std::uint32_t kNoFacet = 0xffffffffu;

struct SupportFacet {
  EdgeId edge;
  SupportKind kind;
  /// The facet runs along its edge from a to b: from `from` to `to`, or, if flipped, from `to` to `from`. Its
  /// direction is such that of the plane through the edge and a receiver x beyond it, with normal (a - x) ×
  /// (b - a), the lit side is the positive one.
  bool flipped;
  /// Where its plane touches the disk: center + radius (cos·u + sin·v), u and v of light_frame; radians in
  /// [0, 2π). Of a distant light that is a direction, the center being -w.
  double rim_angle;
  /// The facets of the same kind that end at a and begin at b.
  std::uint32_t previous = kNoFacet, next = kNoFacet;
};

/// Part of the cone over the disk with its apex at a vertex, between the contacts of two facets. Where every
/// edge at the vertex points into the disk it is the whole cone, without facets.
struct ConeSector {
  VertexId vertex;
  SupportKind kind;
  /// Angles on the rim, from < to ≤ from + 2π.
  double from_angle, to_angle;
  std::uint32_t from_facet, to_facet;
};

/// A mixed face that is turned away from the disk's center, between the umbra silhouette and the center's
/// own. Seen from the center, no umbra facet covers it. The 2004 paper (section 3.3) calls such faces
/// silhouette faces and draws them as part of the umbra volume.
struct GapFace {
  FaceId face;
  /// The umbra facet that is nearest to it, in steps from face to face.
  std::uint32_t facet;
};

struct Supports {
  /// In order of edge, then angle.
  std::vector<SupportFacet> facets;
  /// In order of vertex, then angle.
  std::vector<ConeSector> cones;
};

/// Finds all facets and cone sectors. The exact predicates decide which facets there are. Angles, and which
/// sectors cones fill, are found in double. Only edges in front of the light's plane count (all of them,
/// where the light is distant); one that crosses it counts with its part in front. Cost O(band · ring).
Supports find_supports(const TriangleMesh& mesh, const VertexRings& rings, const CircularLight& light,
                       const Silhouettes& silhouettes);

/// The first half of find_supports, for callers that can tell which facets are of use: the facets, not linked
/// yet. Cost O(band).
std::vector<SupportFacet> find_support_facets(const TriangleMesh& mesh, const CircularLight& light,
                                              const Silhouettes& silhouettes);
/// The second half: links, and cone sectors, at the vertices where a facet ends that is in use. `in_use` has
/// one number for each facet, 0 for no. Other vertices get none, and there are no whole cones. Cost O(facets
/// in use · ring).
void link_support_facets(const TriangleMesh& mesh, const VertexRings& rings, const CircularLight& light,
                         std::span<const char> in_use, Supports& supports);

/// Gap faces in the order of their steps from the umbra facets, then of facets. Cost O(F).
std::vector<GapFace> find_gap_faces(const TriangleMesh& mesh, const CircularLight& light,
                                    const Classification& classes, const Supports& supports);

}  // namespace penumbra
