// Silhouette method, before edges are collected: in which order receivers are served, and by which edges.
//
// Casters may have levels of merged edges (merged_edges.h). The first pass has the coarsest level that may
// do. Receivers for which its edges lie too far off the true ones wait for a later pass. The last pass has
// the edges of all faces. A pass makes a band, then goes over the groups that wait for it.
#pragma once

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <mutex>
#include <span>
#include <vector>

#include "penumbra/mesh/error.h"
#include "penumbra/mesh/progress.h"
#include "render/rays/ray_scene.h"
#include "render/silhouette/collect/tile_receivers.h"

namespace penumbra::detail {

/// A quarter of a tile: narrowing lists for fewer costs what it saves.
inline constexpr std::size_t kFewReceivers = 16;

/// Which edges each receiver looks at: those of merged faces first, coarsest levels first, and those
/// of all faces last.
struct Passes {
  std::vector<const MergedLevel*> levels;
  std::vector<double> deviation;  ///< of the levels; light radii
  std::vector<std::uint8_t> of;   ///< pixels that are not done: their pass
  std::size_t band_size = 0;      ///< edges of the band of all faces, about; known where there are levels
  int now = 0;

  int last() const { return static_cast<int>(levels.size()); }
  /// The next pass whose edges nearly all have a deviation within `allowed` (light radii).
  int next(double allowed) const {
    constexpr double kSpread = 1.5;
    int pass = now + 1;
    while (pass < last() && deviation[pass] * kSpread > allowed) ++pass;
    return pass;
  }
};

/// By the merged edges (or none) and how far they may be moved (light radii); `receivers`: how many there
/// are. None but the last where nothing is to be merged or a caster crosses the light's plane.
Passes make_passes(const LitScene& lit, const SceneEdges& edges, const MergedEdges* merged, double tolerance,
                   std::size_t receivers);

/// Groups of receivers, and for which passes they wait.
class Tiles {
 public:
  /// Some groups of so many; they wait for the first pass.
  Tiles(std::size_t count, const std::vector<std::uint32_t>& groups, const Progress& progress)
      : waiting_(count, 0u), size_(groups.size()), progress_(progress) {
    for (const std::uint32_t group : groups) waiting_[group] = 1u;
  }

  /// Those that wait for a pass.
  std::vector<std::uint32_t> waiting_for(int pass) const {
    std::vector<std::uint32_t> out;
    for (std::size_t i = 0; i < waiting_.size(); ++i)
      if (waiting_[i] >> pass & 1) out.push_back(static_cast<std::uint32_t>(i));
    return out;
  }
  /// So few that it is cheaper to look for the edges that matter to them than for all of a band.
  bool are_few(const std::vector<std::uint32_t>& tiles, std::size_t band_size) const {
    return tiles.size() <= std::max(size_ / kFewTiles, band_size / kEdgesOfTile);
  }

  /// Runs `body(tile, workspace)` for some tiles of a pass, reporting progress; it returns for which
  /// passes they wait next. Throws Cancelled.
  template <class Spaces, class Body>
  void run(int pass, const std::vector<std::uint32_t>& tiles, tbb::task_arena& threads, Spaces& spaces,
           const Body& body) {
    std::atomic<bool> stop{false};
    std::mutex reporting;
    const auto finish = [&](std::uint32_t& waiting, std::uint32_t next) {
      waiting = (waiting & ~(1u << pass)) | next;
      if (waiting != 0) return;
      ++done_;
      if (!progress_) return;
      const std::unique_lock lock(reporting, std::try_to_lock);
      if (lock && !progress_(static_cast<double>(done_) / static_cast<double>(size_))) stop = true;
    };
    threads.execute([&] {
      tbb::parallel_for(tbb::blocked_range<std::size_t>(0, tiles.size(), 1), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end() && !stop; ++i)
          finish(waiting_[tiles[i]], body(tiles[i], spaces.local()));
      });
    });
    if (stop) throw Cancelled();
  }

 private:
  // Speed. Seen in the benchmark `growth`.
  static constexpr std::size_t kFewTiles = 32;  // one in so many
  static constexpr std::size_t kEdgesOfTile =
      1000;                             // of a band, made in the time that a tile's edges are found in
  std::vector<std::uint32_t> waiting_;  ///< one a group: passes as bits
  std::size_t size_;
  const Progress& progress_;
  std::atomic<std::size_t> done_{0};
};

/// Of the receivers of some tiles that wait for this pass, by parts that lie close together.
std::vector<ReceiverRegion> regions_of(const std::vector<std::uint32_t>& tiles, const Passes& passes,
                                       const ReceiverSource& source, const UnitLight& light,
                                       const RayFrame& frame);

}  // namespace penumbra::detail
