// Silhouette method, step band: every edge that can bound what a receiver sees of the light.
//
// In: the casters under a light. Out: their edges of the silhouette band (volumes/silhouettes.h), in the
// light's frame, from the hierarchy that serves every light (edges/scene_edges.h); or the merged edges of a
// level of detail (merge/merged_edges.h).
//
// What lies behind the light's plane does not cast. So edges end there. Where a face crosses that plane the
// cut is one more edge, with a face on one side only.
#pragma once

#include <span>
#include <vector>

#include "render/silhouette/collect/lit_scene.h"
#include "render/silhouette/edges/band_edge.h"
#include "render/silhouette/edges/scene_edges.h"
#include "render/silhouette/merge/merged_edges.h"
#include "render/silhouette/merge/merged_lanes.h"
#include "render/support/large_array.h"

namespace penumbra::detail {

/// Edges in the light's frame; lengths are in light radii.
struct Band {
  /// Neighbors lie close together; edges of cut faces come last.
  LargeArray<BandEdge> edges;
  /// The box of each caster.
  std::vector<Bounds> casters;
  /// LitScene::extent.
  double extent = 1.0;
  /// LitScene::depth, scene units: what lies so close to the light's plane does not cast.
  double depth = 0.0;
  /// Of the casters; `cut_edges` of them are in `edges` in place of faces that cross the light's plane.
  std::size_t faces = 0, mesh_edges = 0, cut_edges = 0;

  // Of a band of merged edges, else empty.
  /// One a block of eight edges: the bounds of the edges and of the faces that they stand for.
  std::vector<BlockBounds> bounds;
  /// One a block: the edges in float.
  LargeArray<MergedLanes> lanes;
  /// One an edge: what its sides stand for.
  std::vector<MergedSides> sides;

  bool is_merged() const { return !sides.empty(); }
  std::size_t bytes() const {
    return edges.size() * sizeof(BandEdge) + sides.size() * sizeof(MergedSides) +
           bounds.size() * (sizeof(BlockBounds) + sizeof(MergedLanes));
  }
};

/// The band of all casters, and by rounding a few edges more. `edges` are the scene's. Where there are
/// `regions`, only those edges that may matter to them. Cost O(band edges), and O(faces) of casters that
/// are not wholly in front of the light. On all cores. Deterministic.
Band make_band(const LitScene& lit, const SceneEdges& edges, std::span<const ReceiverRegion> regions = {});
/// The merged edges of a level that may be in the band. Requires all casters in front of the light. On all
/// cores.
Band make_merged_band(const LitScene& lit, const MergedEdges& edges, const MergedLevel& level);

}  // namespace penumbra::detail
