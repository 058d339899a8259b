// The edges that few receivers ask a whole scene for.
#include "render/silhouette/edges/receiver_region.h"

#include <gtest/gtest.h>

#include <array>
#include <set>

#include "render/silhouette/collect/shaft.h"
#include "render/silhouette/edges/projected_segment.h"
#include "tests/render/render_support.h"
#include "tests/render/silhouette/fine_meshes.h"

namespace penumbra::detail {
namespace {

using penumbra::testing::fine_meshes;
using penumbra::testing::Random;
using penumbra::testing::scene_of;
using penumbra::testing::Stage;

/// What few tiles ask for: every edge that one of their receivers sees across the disk.
TEST(ReceiverRegion, LoseNothingThatAReceiverSees) {
  Random random(75);
  for (const auto& [name, mesh] : fine_meshes(5)) {
    const Scene scene = scene_of(mesh);
    const Stage stage(scene);
    const auto& [frame, light, edges, lit, all] = stage;
    std::size_t seen = 0;
    for (int round = 0; round < 40; ++round) {
      const Vec3 place =
          scene.bounds().center() + scene.bounds().radius() * (random.point(1.5) - Vec3(0, 0, 1));
      std::vector<TileReceiver> receivers;
      for (int i = 0; i < 12; ++i) {
        TileReceiver r;
        r.x = light.point(place + random.spread(1e-4, 0.1) * random.point());
        r.normal = light.direction(random.direction());
        if (!(r.x.z > 0.0)) continue;
        receivers.push_back(r);
      }
      if (receivers.empty()) continue;
      Shaft shaft(receivers, all.extent);
      shaft.tighten(receivers);
      const std::vector<ReceiverRegion> regions{shaft.region(receivers, light, frame)};
      const Band found = make_band(lit, edges, regions);
      const auto key = [](const BandEdge& e) { return std::array{e.a.x, e.a.y, e.a.z, e.b.x, e.b.y, e.b.z}; };
      std::set<std::array<double, 6>> keys;
      for (const BandEdge& e : found.edges) keys.insert(key(e));
      for (const TileReceiver& r : receivers)
        for (const BandEdge& e : all.edges) {
          const bool below = glm::dot(r.normal, e.a - r.x) < 0.0 && glm::dot(r.normal, e.b - r.x) < 0.0;
          if (below || !project_edge(e, r.x, {certificate_slack(all.extent)}).near) continue;
          ++seen;
          ASSERT_TRUE(keys.contains(key(e))) << name;
        }
    }
    EXPECT_GT(seen, 100u) << name;
  }
}

}  // namespace
}  // namespace penumbra::detail
