// Levels of detail: closed as the surface was, and of few edges.
#include "render/silhouette/merge/merged_edges.h"

#include <gtest/gtest.h>

#include <map>

#include "tests/render/render_support.h"
#include "tests/render/silhouette/fine_meshes.h"

namespace penumbra::detail {
namespace {

using penumbra::testing::divided;
using penumbra::testing::fine_meshes;
using penumbra::testing::merged_edges_of;
using penumbra::testing::scene_of;

TEST(MergedEdges, CloseUpAsTheSurfaceDid) {
  std::size_t levels = 0;
  for (const auto& [name, mesh] : fine_meshes(6)) {
    const Scene scene = scene_of(mesh);
    const MergedEdges merged = merged_edges_of(scene);
    for (const MergedLevel& level : merged.levels()) {
      ++levels;
      // Round each side edges lead as often to a vertex as from it.
      std::map<std::pair<std::uint32_t, VertexId>, int> ends;
      for (const MergedEdge& e : level.edges) {
        ++ends[{e.left, e.from}], --ends[{e.left, e.to}];
        if (e.right != MergedEdge::kNoSide) --ends[{e.right, e.from}], ++ends[{e.right, e.to}];
      }
      for (const auto& [end, sum] : ends) ASSERT_EQ(sum, 0) << name;
    }
  }
  EXPECT_GE(levels, 8u);
}

/// A sheet's boundary closes up without a vertex that it has to begin at.
TEST(MergedEdges, OfASheetAreItsSides) {
  const Scene scene = scene_of(divided(testing::rectangle(-1, 1, -1, 2, 0.5), 5));
  const MergedEdges merged = merged_edges_of(scene);
  ASSERT_FALSE(merged.levels().empty());
  EXPECT_LE(merged.levels()[0].edges.size(), 5u) << "of 128";
  EXPECT_EQ(merged.levels()[0].deviation, 0.0);
}

TEST(MergedEdges, LeaveFewEdgesOfFineSurfaces) {
  const Scene scene = scene_of(make_icosphere({0, 0, 0}, 1.0, 7));
  const MergedEdges merged = merged_edges_of(scene);
  ASSERT_GE(merged.levels().size(), 4u);
  for (std::size_t i = 0; i < merged.levels().size(); ++i) {
    const MergedLevel& level = merged.levels()[i];
    EXPECT_GT(level.deviation, 0.0);
    if (i > 0) {
      EXPECT_LT(level.edges.size(), 0.75 * static_cast<double>(merged.levels()[i - 1].edges.size()));
      EXPECT_GT(level.deviation, merged.levels()[i - 1].deviation);
    }
  }
  EXPECT_LT(merged.levels().back().edges.size(), 491'520u / 200);
  const Scene flat = scene_of(fine_meshes(5)["box"]);
  ASSERT_EQ(merged_edges_of(flat).levels().size(), 1u);
  EXPECT_EQ(merged_edges_of(flat).levels()[0].edges.size(), 12u);
  EXPECT_EQ(merged_edges_of(flat).levels()[0].deviation, 0.0);
  EXPECT_TRUE(merged_edges_of(scene_of(make_icosphere({0, 0, 0}, 1.0, 3))).levels().empty()) << "few faces";
}

}  // namespace
}  // namespace penumbra::detail
