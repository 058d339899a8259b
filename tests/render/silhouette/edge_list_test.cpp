// The edge test for lists: vectors against one edge at a time, and against the definition.
#include "render/silhouette/collect/edge_list.h"

#include <gtest/gtest.h>

#include "render/silhouette/areas/projected_edges.h"
#include "render/silhouette/collect/edge_blocks.h"
#include "tests/render/render_support.h"
#include "tests/render/silhouette/random_bands.h"

namespace penumbra::detail {
namespace {

using penumbra::testing::add_place;
using penumbra::testing::expect_same_places;
using penumbra::testing::expect_same_segments;
using penumbra::testing::Random;
using penumbra::testing::random_band;

TEST(EdgeList, VectorsAgreeWithOneEdgeAtATimeAndLoseNothing) {
  Random random(31);
  std::size_t kept = 0, near = 0, listed = 0;
  for (int round = 0; round < 40; ++round) {
    const Band band = random_band(random, 60, round % 2 == 0);
    const BandTree tree(band);
    std::vector<TileReceiver> receivers;
    const Vec3 middle{random.uniform(-6, 6), random.uniform(-6, 6), random.uniform(3, 10)};
    for (int i = 0; i < 16; ++i)
      receivers.push_back(
          {middle + random.point(round % 3 == 0 ? 2.0 : 0.1), {0, 0, -1}, no_horizon(), false, 0});
    Shaft shaft(receivers, band.extent);
    shaft.tighten(receivers);
    std::vector<NodeMask> blocks;
    std::vector<std::uint32_t> edges, narrowed;
    TestedEdges tested;
    ProjectedEdges projected;
    tree.collect(shaft, blocks);
    EdgeBlocks(band).collect(blocks, shaft, edges);
    EdgeList list, half;
    list.assign(band, edges, shaft.middle());
    const std::span<const TileReceiver> few(receivers.data(), 4);
    Shaft narrow_shaft(few, band.extent);
    narrow_shaft.tighten(few);
    narrow(list, narrow_shaft, narrowed);
    half.assign(list, narrowed);
    for (std::size_t r = 0; r < receivers.size(); ++r) {
      const Vec3& x = receivers[r].x;
      const EdgeList& l = r < 4 ? half : list;
      test_edges(l, x, tested);
      TestedEdges singly;
      for (std::uint32_t i = 0; i < l.size(); ++i) {
        const int jump = test_edge(l, i, x);
        if (jump == 0) continue;
        add_place(l.place(i), jump, singly);
      }
      expect_same_places(tested, singly);
      std::vector<Segment> segments;
      std::size_t found = 0, expected = 0;
      for (std::size_t i = 0; i < tested.count; ++i) {
        const BandEdge& e = l.edge(tested.places[i]);
        if (tested.jumps[i] != TestedEdges::kUnsure) {
          ASSERT_EQ(tested.jumps[i], jump_at(e, x));
        }
        const Projection p = project_edge(e, x, {1e-6});
        found += p.near ? 1 : 0;
        if (p.near && p.segment.jump != 0) segments.push_back(p.segment);
      }
      project_edges(l, x, no_horizon(), {1e-6}, projected);
      expect_same_segments(projected.segments, segments);
      ASSERT_EQ(projected.certain, found == 0);
      for (std::size_t i = 0; i < projected.segments.size(); ++i) {
        const Segment& s = projected.segments[i];
        ASSERT_TRUE(i >= projected.inside || (glm::dot(s.a, s.a) < 1.0 && glm::dot(s.b, s.b) < 1.0));
      }
      for (const BandEdge& e : band.edges) expected += project_edge(e, x, {1e-6}).near ? 1 : 0;
      ASSERT_EQ(found, expected) << "round " << round;
      kept += tested.count, near += found, listed += l.size();
    }
  }
  std::printf("%zu listed, %zu tested, %zu near\n", listed, kept, near);
  EXPECT_GT(near, 1000u);
  EXPECT_LT(kept, listed);
}

}  // namespace
}  // namespace penumbra::detail
