// The silhouette method: visibility without noise, from the silhouette that each receiver sees.
//
// In: casters, a disk light, receivers. Out: V of each receiver, and for many of them a certificate.
//
//   edges/    hierarchies over all edges of the casters, made once, for every light
//   merge/    the same with merged edges, where casters are finer than a silhouette can tell
//   passes.h  which receivers look at which edges: merged ones first, all edges last
//   collect/  the light's band of edges; of these the edges that a group of receivers may see across the disk
//   areas/    per receiver: edges projected onto the disk, clipped to the part above the horizon, and the
//             area of the lowest depth complexity, exact where only two depth complexities occur
//   light_rays.h  one ray to that area: it tells whether the lowest depth complexity is 0
//
// Where no edge meets the disk the receiver is wholly lit or wholly in umbra: a certificate, which
// speaks of O.
//
// Integrating visible area from silhouettes seen from the receiver is the idea of E. Eisemann and X. Décoret,
// "Visibility sampling on GPU and applications" (2007), and of soft shadow volumes (S. Laine et al., 2005).
// They sample the disk. Here areas are exact, overlap is taken account of, and the band replaces their search
// for edges.
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
  /// Accuracy: scanlines across the disk where more than 20 edges cross it, 4 to 1024. Where edges are dense,
  /// three quarters of them in each of two directions; where these disagree, more or an exact sweep.
  int rows = 64;
  /// false: nothing lies below a horizon; visibility is then O.
  bool horizon = true;
  /// false: certificates only. Receivers without one are listed in `open`.
  bool integrate = true;
  /// Speed: receivers that more segments cross the disk for are left `open`, not integrated; 0: none is. No
  /// effect where `integrate` is false.
  std::size_t most_segments = 0;
  /// Speed: receivers that would have to look at more edges than this are left `open`, and so are groups
  /// whose lists take as long to narrow; 0: none is.
  std::size_t most_listed = 0;
  /// Accuracy: how far silhouettes of merged faces may lie off the true ones, light radii in the light's
  /// plane, 0 to 0.1; 0: no faces are merged. Visibility changes by 2.5 times that or less
  /// (merge/merged_edges.h). Faces are merged only in casters of 1,024 faces or more, and never where
  /// `integrate` is false.
  double tolerance = 4e-3;
  /// Rays a receiver where edges do not close up; no such case is known. SilhouetteCounts::fallback says how
  /// many there were.
  int fallback_samples = 1024;
};

/// What was done for one light. Sums are over receivers unless said otherwise.
struct SilhouetteCounts {
  /// Casters that hide nothing from any receiver. What follows leaves them out.
  std::size_t casters_that_cannot_occlude = 0;
  std::size_t faces = 0, mesh_edges = 0, band_edges = 0;
  /// Edges at which faces are cut by the light's plane.
  std::size_t cut_edges = 0;
  /// In front of the light, with some of it above the horizon.
  std::size_t receivers = 0;
  /// Of these, those that looked at merged edges.
  std::size_t merged_receivers = 0;
  std::size_t certified_lit = 0, certified_umbra = 0, behind_light = 0;
  /// Groups that have receivers; of these, groups without edges.
  std::size_t tiles = 0, empty_tiles = 0;
  /// Sum over groups: lengths of their lists, whole blocks included.
  std::size_t listed_edges = 0;
  /// Edges that receivers looked at.
  std::size_t projected_edges = 0;
  /// Segments across the disk.
  std::size_t segments = 0;
  /// Receivers whose area was integrated; of these by slabs, and by rows.
  std::size_t integrated = 0, slabs = 0, row_sweeps = 0;
  /// Of the integrated, those that met more than two depth complexities.
  std::size_t overlapping = 0;
  /// Of the integrated, those for which two families of rows still disagreed when there were the most of them
  /// (areas/visible_area.h): V may be off by more than .004.
  std::size_t unresolved = 0;
  std::size_t rays = 0, second_rays = 0;
  std::size_t fallback = 0;
  /// Of the band, its tree, and all threads' lists at their longest.
  std::size_t bytes = 0;
  /// How often receivers have been put into groups so far, this call and those before it.
  std::size_t groupings = 0;
  /// Of the hierarchies over edges, made once a frame and in no stage.
  std::size_t hierarchy_bytes = 0;
};

struct SilhouetteResult {
  /// One a receiver; 1 where there is none.
  std::vector<float> visibility;
  /// One a receiver: -1 not certified, 0 lit, 2 in umbra or behind the light.
  std::vector<std::int8_t> region;
  /// Receivers whose visibility is not known, ascending: none where all are integrated.
  std::vector<std::uint32_t> open;
  StageTimes stages;
  SilhouetteCounts counts;
};

/// Cost: vertices (their box), the band, the band edges near each group, per receiver its part's list (blocks
/// of eight edges where that is long and the surface is fine), and s log s for s segments across the disk. On
/// all threads of `rays`; the result does not depend on their number. Throws UsageError for a rectangle, a
/// light of radius 0 or options outside their range, Cancelled.
SilhouetteResult silhouette_visibility(const Scene& scene, const RayScene& rays,
                                       detail::EdgeHierarchies& hierarchies, const LightShape& light,
                                       const Receivers& receivers, const SilhouetteOptions& options = {},
                                       const Progress& progress = {});

}  // namespace penumbra
