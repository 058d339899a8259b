// The edge test for blocks: vectors against one edge at a time, and against the definition.
#include "render/silhouette/collect/edge_blocks.h"

#include <gtest/gtest.h>

#include "render/silhouette/areas/disk_part.h"
#include "render/silhouette/areas/projected_edges.h"
#include "tests/render/render_support.h"
#include "tests/render/silhouette/random_bands.h"

namespace penumbra::detail {
namespace {

using penumbra::testing::add_place;
using penumbra::testing::expect_same_places;
using penumbra::testing::expect_same_segments;
using penumbra::testing::Random;
using penumbra::testing::random_band;
using penumbra::testing::random_receivers;
using penumbra::testing::sphere_band;

/// What is above the horizon of the edges near the disk, by the definition.
std::vector<Segment> seen_edges(const Band& band, const TileReceiver& r, const Rounding& rounding,
                                bool& certain) {
  std::vector<Segment> out;
  certain = true;
  for (const BandEdge& e : band.edges) {
    const Projection p = project_edge(e, r.x, rounding);
    if (!p.near) continue;
    const bool above = height(r.horizon, p.segment.a) > 0.0 || height(r.horizon, p.segment.b) > 0.0;
    certain = certain && !above;
    if (p.segment.jump != 0 && above) out.push_back(p.segment);
  }
  return out;
}

TEST(EdgeBlocks, VectorsAgreeWithOneEdgeAtATimeAndLoseNothing) {
  Random random(37);
  std::size_t kept = 0, near = 0, listed = 0, looked_into = 0, horizons = 0;
  for (int round = 0; round < 80; ++round) {
    const Band band = round % 4 == 3 ? sphere_band(random) : random_band(random, 60, round % 2 == 0);
    const BandTree tree(band);
    const EdgeBlocks blocks(band);
    const std::vector<TileReceiver> receivers = random_receivers(random, 16);
    Shaft shaft(receivers, band.extent);
    shaft.tighten(receivers);
    std::vector<NodeMask> list, few;
    ProjectedEdges projected;
    tree.collect(shaft, list);
    tree.narrow(list, std::span(receivers).first(4), few);
    for (std::size_t r = 0; r < receivers.size(); ++r) {
      const TileReceiver& receiver = receivers[r];
      TestedEdges tested, singly;
      EXPECT_TRUE(blocks.test_edges(tree, r < 4 ? few : list, receiver, blocks.count(), tested));
      for (std::size_t b = 0; b < tested.looked_into; ++b)
        for (std::uint32_t lane = 0; lane < 8; ++lane) {
          const std::uint32_t i = 8 * static_cast<std::uint32_t>(tested.blocks[b]) + lane;
          const int jump = blocks.test_edge(i, receiver.x);
          if (jump == 0) continue;
          add_place(static_cast<std::int32_t>(i), jump, singly);
          ASSERT_LT(i, band.edges.size()) << "no edge";
          if (jump != TestedEdges::kUnsure) {
            ASSERT_EQ(jump, jump_at(band.edges[i], receiver.x));
          }
        }
      expect_same_places(tested, singly);
      project_edges(band, tested, receiver.x, receiver.horizon, {1e-6}, projected);
      bool certain = false;
      const std::vector<Segment> segments = seen_edges(band, receiver, {1e-6}, certain);
      expect_same_segments(projected.segments, segments);
      if (!receiver.horizon_cuts) {
        ASSERT_EQ(projected.certain, certain);
      }
      kept += tested.count, near += segments.size(), looked_into += tested.looked_into;
      listed += count_blocks(list), horizons += receiver.horizon_cuts ? 1 : 0;
    }
  }
  std::printf("%zu blocks listed, %zu looked into, %zu edges tested, %zu near; %zu horizons\n", listed,
              looked_into, kept, near, horizons);
  EXPECT_GT(near, 1000u);
  EXPECT_GT(horizons, 50u);
  EXPECT_LT(looked_into, listed);
}

}  // namespace
}  // namespace penumbra::detail
