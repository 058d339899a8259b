// The certificate for merged edges, against all true edges.
#include "render/silhouette/collect/uncertain_edges.h"

#include <gtest/gtest.h>

#include "render/silhouette/edges/projected_segment.h"
#include "tests/render/render_support.h"
#include "tests/render/silhouette/fine_meshes.h"

namespace penumbra::detail {
namespace {

using penumbra::testing::fine_meshes;
using penumbra::testing::merged_edges_of;
using penumbra::testing::Random;
using penumbra::testing::scene_of;
using penumbra::testing::Stage;

/// On the way from light into penumbra, where the certificate only just holds, no true edge is across the
/// disk.
TEST(UncertainEdges, CertificatesHoldToTheLast) {
  Random random(76);
  std::size_t checked = 0;
  for (const auto& [name, mesh] : fine_meshes(6)) {
    const Scene scene = scene_of(mesh);
    const Stage stage(scene);
    const auto& [frame, light, edges, lit, exact] = stage;
    const double slack = certificate_slack(lit.extent);
    const MergedEdges merged = merged_edges_of(scene);
    for (const MergedLevel& level : merged.levels()) {
      const Band band = make_merged_band(lit, merged, level);
      const auto receiver_at = [&light = stage.light](const Vec3& world) {
        TileReceiver r;
        r.x = light.point(world), r.normal = Vec3(0, 0, -1), r.horizon = no_horizon();
        return r;
      };
      const auto is_certain = [&](const Vec3& world) {
        const TileReceiver r = receiver_at(world);
        for (std::size_t i = 0; i < band.edges.size(); ++i)
          if (!is_certainly_no_silhouette(band, i, r, DiskSpot{}, slack)) return false;
        return true;
      };
      const Vec3 middle = scene.bounds().center();
      const double size = scene.bounds().radius();
      for (int k = 0; k < 12; ++k) {
        const glm::dvec2 way = random.unit2();
        const double depth = random.uniform(1.5, 4.0) * size;
        const auto at = [&](double t) { return middle + Vec3(t * size * way, -depth); };
        double inside = 8.0;
        while (inside > 0.0 && is_certain(at(inside))) inside -= 0.05;
        double outside = inside + 0.05;
        if (inside <= 0.0 || outside >= 8.0) continue;
        for (int step = 0; step < 40; ++step) {
          const double half = 0.5 * (inside + outside);
          (is_certain(at(half)) ? outside : inside) = half;
        }
        const TileReceiver r = receiver_at(at(outside));
        ++checked;
        for (const BandEdge& e : exact.edges) {
          const Projection p = project_edge(e, r.x, {0.0});
          ASSERT_FALSE(p.near && p.segment.jump != 0) << name << ", level of " << level.edges.size();
        }
      }
    }
  }
  EXPECT_GT(checked, 100u);
}

}  // namespace
}  // namespace penumbra::detail
