// Method soft-shadow-volumes, step wedges: from a patch's silhouette to what receivers see of the patch, tile
// by tile.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "render/silhouette/collect/tile_edges.h"
#include "render/silhouette/edges/projected_segment.h"
#include "render/soft_shadow_volumes/center_silhouette.h"
#include "render/soft_shadow_volumes/layers.h"
#include "render/soft_shadow_volumes/light_patches.h"
#include "render/soft_shadow_volumes/soft_shadow_volumes.h"

namespace penumbra::detail {

/// What a call is asked, and its light.
struct WedgeCall {
  const RayScene& rays;
  const AreaLight& light;
  const Receivers& receivers;
  const std::vector<double>& layers;  ///< of a face, one an object
};

/// What is known of a receiver's patch before the ray to its center.
struct CenterTask {
  std::uint32_t index;
  /// On the unit disk: where the ray goes, the patch's center unless that is below the horizon.
  glm::dvec2 aim;
  /// Of the patch above the horizon; what the wedges add to what is hidden of it.
  double area, hidden;
  /// It lies in some wedge.
  bool in_wedge;
};

/// An edge across the light, as a receiver sees it, and how many layers more its left side has.
struct WedgeEdge {
  glm::dvec2 a, b;
  double step;
};

/// What one thread keeps between tiles, and what it has counted.
struct WedgeMemory {
  std::vector<TileReceiver> tile;
  TileEdgesMemory edges;
  TestedEdges tested;
  Polygon outline, inner, behind, other;
  std::vector<WedgeEdge> wedges;
  std::vector<CenterTask> tasks;
  SoftShadowVolumeCounts counts;
};

/// One patch of the light.
class Wedges {
 public:
  /// Refers to its arguments, but for the band.
  Wedges(const WedgeCall& call, const UnitLight& unit, const LightPatches& patches, const LightPatch& patch,
         const LayeredBand& band);

  /// Adds to V what each receiver of a tile sees of the patch; receivers change their order.
  void add(std::span<TileReceiver> tile, WedgeMemory& memory, std::span<float> visibility) const;
  std::size_t silhouette_edges() const { return silhouette_.band.edges.size(); }

 private:
  CenterTask begin(const TileReceiver& receiver, WedgeMemory& memory) const;
  double area_behind_edge(const glm::dvec2& a, const glm::dvec2& b, const CenterTask& task, bool cut,
                          WedgeMemory& memory) const;
  void aim_beside_edges(const TileReceiver& receiver, CenterTask& task, WedgeMemory& memory) const;
  void add_wedges(const TileReceiver& receiver, const EdgeList& list, CenterTask& task,
                  WedgeMemory& memory) const;
  Ray ray_of(const CenterTask& task) const;
  void settle(const CenterTask& task, double layers, std::span<float> visibility) const;
  void trace(WedgeMemory& memory, std::span<float> visibility) const;

  const WedgeCall& call_;
  const UnitLight& unit_;
  const LightPatches& patches_;
  const LightPatch& patch_;
  const CenterSilhouette silhouette_;
  const TileEdges edges_;
  const Rounding rounding_;
};

}  // namespace penumbra::detail
