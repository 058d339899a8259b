// Silhouette method, one pass over groups of receivers: from the band's edges to V.
//
// In: a band of edges (all faces' or merged ones), a group of up to 64 receivers. Out: V and region of these
// receivers. A receiver for which the band's merged edges lie too far off the true ones gets no answer here:
// it waits for a later pass (passes.h).
//
// A group collects the blocks of edges that matter to it. It narrows the list down to parts of the group and
// to single receivers. Each receiver projects its edges, and integrates the area that they leave. Last come
// the group's rays.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "render/silhouette/areas/aim_room.h"
#include "render/silhouette/areas/visible_area.h"
#include "render/silhouette/collect/edge_blocks.h"
#include "render/silhouette/collect/shaft.h"
#include "render/silhouette/collect/tile_receivers.h"
#include "render/silhouette/collect/uncertain_edges.h"
#include "render/silhouette/light_rays.h"
#include "render/silhouette/passes.h"
#include "render/silhouette/silhouette_visibility.h"

namespace penumbra::detail {

/// What one thread keeps between tiles, and what it has counted.
struct Workspace {
  std::vector<TileReceiver> tile;        ///< all of a tile
  std::vector<TileReceiver> receivers;   ///< of it, those at hand
  std::vector<VisibleAreaResult> areas;  ///< one a receiver
  std::vector<char> certain;             ///< one a receiver
  std::vector<char> right;               ///< one a receiver: merged edges are known to be right at its aim
  std::vector<std::uint32_t> edges;
  UncertainEdges uncertain;                     ///< of merged edges
  std::array<std::vector<NodeMask>, 3> blocks;  ///< of the tile, and of its parts
  EdgeList list, part_list;                     ///< of the tile, and of the part at hand
  ProjectedEdges projected;
  ClippedSegments clipped;
  VisibleArea visible_area;
  std::vector<RayTask> tasks, second_tasks;
  double beside = 0.0;      ///< of the receivers at hand, see Mistaken
  double sliver = 0.0;      ///< of the receivers at hand, see VisibleArea::compute
  std::uint32_t later = 0;  ///< passes that some of the tile's receivers are left to, as bits
  std::vector<std::uint32_t> fallback, open;
  SilhouetteCounts counts;

  std::size_t bytes() const {
    std::size_t sum = receivers.capacity() * (sizeof(TileReceiver) + sizeof(VisibleAreaResult)) +
                      edges.capacity() * sizeof(edges[0]);
    for (const auto& b : blocks) sum += b.capacity() * sizeof(b[0]);
    return sum + list.bytes() + part_list.bytes();
  }
};

/// One frame: everything that tiles share, and the result they write to (each its own receivers).
class Evaluation {
 public:
  Evaluation(const Scene& scene, const RayScene& rays, const Receivers& receivers, Band band,
             const UnitLight& light, const SilhouetteOptions& options, const ReceiverSource& source,
             Passes& passes, SilhouetteResult& out)
      : scene_(scene),
        rays_(rays),
        receivers_(receivers),
        band_(std::move(band)),
        tree_(band_),
        blocks_(band_),
        light_(light),
        options_(options),
        source_(source),
        rounding_{certificate_slack(band_.extent), band_.extent},
        passes_(passes),
        out_(out) {}

  /// Answers the group's receivers that wait for the present pass. Returns the later passes that some of them
  /// then wait for: bit i stands for pass i.
  std::uint32_t tile(std::size_t group, Workspace& w) const;
  /// The same for a group that sees all of the light (lit_groups.h); `count`: how many of its receivers are
  /// present.
  void light_up(std::size_t group, std::size_t count, Workspace& w) const;
  /// What is known of the band.
  void add_counts(SilhouetteCounts& out) const {
    out.faces = band_.faces;
    out.mesh_edges = band_.mesh_edges;
    out.band_edges += band_.edges.size();
    out.cut_edges = band_.cut_edges;
    out.bytes += band_.bytes() + tree_.bytes() + blocks_.bytes();
  }

 private:
  void part(std::span<TileReceiver> receivers, Workspace& w) const;
  void leave(std::span<TileReceiver> receivers, int pass, Workspace& w) const;
  bool is_reached(const Shaft& shaft) const;
  Mistaken mistaken(const Shaft& shaft, const std::vector<NodeMask>& list) const;
  void look_around(const Shaft& shaft, Workspace& w) const;
  bool is_certain(std::size_t i, const DiskPart& part, Workspace& w) const;
  bool is_right_at(const glm::dvec2& point, std::size_t i, Workspace& w) const;
  bool aim_surely(std::size_t i, std::span<const Segment> segments, const DiskPart& part, Workspace& w) const;
  void wait(std::size_t i, Workspace& w) const;
  bool are_blocks_better(Workspace& w) const;
  bool is_too_long(std::size_t edges, std::size_t receivers) const;
  void open(std::size_t first, std::size_t last, Workspace& w) const;
  void divide(std::size_t first, std::size_t last, Workspace& w) const;
  void divide_blocks(std::size_t first, std::size_t last, std::size_t level, Workspace& w) const;
  void evaluate(std::size_t first, std::size_t last, const EdgeList& list, Workspace& w) const;
  void evaluate(std::size_t i, const EdgeList& list, Workspace& w) const;
  void evaluate_blocks(std::size_t i, const std::vector<NodeMask>& list, Workspace& w) const;
  void judge(std::size_t i, Workspace& w) const;
  void integrate(std::size_t i, const DiskPart& part, Workspace& w) const;
  void certify(const RayTask& task, Workspace& w) const;
  void decide(Workspace& w) const;
  void light_up(Workspace& w) const;

  const Scene& scene_;
  const RayScene& rays_;
  const Receivers& receivers_;
  const Band band_;
  const BandTree tree_;
  const EdgeBlocks blocks_;
  const UnitLight& light_;
  const SilhouetteOptions& options_;
  const ReceiverSource& source_;
  const Rounding rounding_;
  Passes& passes_;
  SilhouetteResult& out_;
};

}  // namespace penumbra::detail
