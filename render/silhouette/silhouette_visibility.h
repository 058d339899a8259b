// The silhouette method: visibility without noise, from the silhouette each receiver sees.
//
// In: surface points. Out: V per pixel, and for many of them a certificate. Five steps, one header each:
//
//   light_band.h       casters → the silhouette band in the light's frame, by a hierarchy over their edges that
//                      serves every light (scene_edges.h)
//   passes.h           the same with merged edges first, where casters are finer than a silhouette can tell
//                      (merged_edges.h, face_patches.h)
//   shaft.h            band, 8×8 receivers → the edges they may see across the disk, by a tree over blocks of
//                      edges (band_tree.h)
//   projected_edges.h  edges, receiver → segments across the disk; none: wholly lit or wholly in umbra
//   clip_segments.h    segments → exact integral of the number of hiding faces
//   visible_area.h     segments → area of the lowest depth complexity, exact where only two occur
//
// and one ray to the lowest depth complexity, which tells whether that is 0. Receivers are the surface buffer's
// points, moved by the same offset as the origins of rays; what is certified is O of the moved point. The idea of
// integrating visible area from silhouettes seen from the receiver is that of E. Eisemann and X. Décoret,
// "Visibility sampling on GPU and applications" (2007), and of soft shadow volumes (S. Laine et al., 2005),
// which sample; here areas are exact, overlap is fused, and the band replaces their edge searches.
#pragma once

#include <cstdint>
#include <vector>

#include "penumbra/mesh/progress.h"
#include "penumbra/mesh/stage_clock.h"
#include "penumbra/render/receivers/receivers.h"
#include "render/rays/ray_scene.h"

namespace penumbra {

namespace detail {
class EdgeHierarchies;
}

struct SilhouetteOptions {
  int rows = 64;  ///< scanlines where more than two depth complexities may occur, 4 to 1024; three quarters
                  ///< of them where fewer than 256 edges cross the disk
  /// false: nothing lies below a horizon; visibility is then O.
  bool horizon = true;
  bool integrate = true;    ///< false: certificates only; pixels without one are listed in `open`, and
                            ///< such that would have to look at more than some 8,000 edges are not tried
  double tolerance = 4e-3;  ///< how far silhouettes of merged faces may lie from the true ones, in light
                            ///< radii in the light's plane (merged_edges.h), 0 to 0.1; 0: no faces are
                            ///< merged. Only for casters of 1,024 faces or more, and never for `integrate`
                            ///< false
  int fallback_samples = 1024;  ///< rays a pixel where edges do not close up (none are known) or the offset
                                ///< moves a receiver behind the light's plane; counted
};

struct SilhouetteCounts {
  /// They hide nothing from any receiver, and are not among the following.
  std::size_t casters_that_cannot_occlude = 0;
  std::size_t faces = 0, mesh_edges = 0, band_edges = 0, cut_edges = 0;
  std::size_t receivers = 0;         ///< in front of the light, with some of it above the horizon
  std::size_t merged_receivers = 0;  ///< of these, that saw merged faces
  std::size_t certified_lit = 0, certified_umbra = 0, behind_light = 0;
  std::size_t tiles = 0, empty_tiles = 0;  ///< with receivers; of these, without edges
  std::size_t listed_edges = 0;            ///< sum over tiles of their lists' lengths, whole blocks included
  std::size_t projected_edges = 0;         ///< sum over receivers of the edges they looked at
  std::size_t segments = 0;                ///< sum over receivers of the segments across the disk
  std::size_t integrated = 0;              ///< receivers whose area was integrated
  std::size_t slabs = 0;                   ///< of these, by slabs
  std::size_t row_sweeps = 0;              ///< of these, by rows
  std::size_t overlapping = 0;             ///< of these, where more than two depth complexities were met
  std::size_t rays = 0, second_rays = 0;
  std::size_t fallback = 0;         ///< receivers left to rays, see fallback_samples
  std::size_t bytes = 0;            ///< of the band, its tree and all threads' lists at their longest
  std::size_t hierarchy_bytes = 0;  ///< of the hierarchies over edges (scene_edges.h, merged_edges.h), made
                                    ///< once a frame and in no stage
};

struct SilhouetteResult {
  std::vector<float> visibility;    ///< one a pixel; 1 where no surface is seen
  std::vector<std::int8_t> region;  ///< -1 not certified, 0 lit, 2 umbra or behind the light
  std::vector<std::uint32_t>
      open;  ///< with `integrate` false: pixels whose visibility is not known, ascending
  std::vector<StageTime> stages;
  SilhouetteCounts counts;
};

/// Cost: vertices (their box), plus the band, plus band edges near each tile, plus per receiver its part's
/// list (blocks of eight edges where it is long and the surface is fine) and s log s for s segments across
/// the disk. On all cores of `rays`; the result does not depend on their number. Requires a light of radius >
/// 0 (UsageError). Throws Cancelled.
SilhouetteResult silhouette_visibility(const Scene& scene, const RayScene& rays,
                                       detail::EdgeHierarchies& hierarchies, const DiskLight& light,
                                       const Receivers& receivers, const SilhouetteOptions& options = {},
                                       const Progress& progress = {});

}  // namespace penumbra
