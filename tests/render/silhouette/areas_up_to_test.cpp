// rays --areas-up-to: receivers that see few edges have the silhouette method's areas, others have rays.
#include <gtest/gtest.h>

#include "penumbra/render/visibility.h"
#include "tests/render/render_support.h"

namespace penumbra {
namespace {

OptionValues rays(std::uint64_t samples, std::uint64_t up_to) {
  return {{"samples", samples}, {"areas-up-to", up_to}};
}

TEST(AreasUpTo, EachReceiverHasAnAreaOrRays) {
  const Scene scene = testing::data_scene("foliage-medium");
  const testing::View view(scene, 160, 120);
  const Casters casters(scene.objects);
  const auto by = [&](const char* method, const OptionValues& options) {
    return visibility(casters, scene.lights.front().shape, view.surface.receivers(),
                      {.method = method, .options = options});
  };
  const MethodResult areas = by("silhouette", {}), traced = by("rays", rays(16, 0)),
                     mixed = by("rays", rays(16, 12));
  std::size_t by_area = 0, by_rays = 0;
  for (std::size_t i = 0; i < mixed.visibility.size(); ++i) {
    const bool is_area = mixed.visibility[i] == areas.visibility[i];
    ASSERT_TRUE(is_area || mixed.visibility[i] == traced.visibility[i]) << i;
    if (areas.visibility[i] == traced.visibility[i]) continue;
    ++(is_area ? by_area : by_rays);
  }
  EXPECT_GT(by_area, 100u);
  EXPECT_GT(by_rays, 100u);
  EXPECT_GE(testing::count_in(mixed.counts, "open"), by_rays) << "those that rays were traced for";
  for (std::size_t i = 0; i < mixed.region.size(); ++i) {
    if (mixed.region[i] >= 0) {
      ASSERT_EQ(mixed.region[i], areas.region[i]) << i;
    }
  }
}

TEST(AreasUpTo, AllAreasAreThoseOfTheSilhouetteMethod) {
  const Scene scene = testing::data_scene("boxes-medium");
  const testing::View view(scene, 160, 120);
  const Casters casters(scene.objects);
  const auto by = [&](const char* method, const OptionValues& options) {
    return visibility(casters, scene.lights.front().shape, view.surface.receivers(),
                      {.method = method, .options = options})
        .visibility;
  };
  EXPECT_EQ(by("rays", rays(256, 65'536)), by("silhouette", {}));
}

// Where lists are long, few rays cost less than to look for certificates: those are then not looked for.
TEST(AreasUpTo, FewRaysLookAtFewEdges) {
  Scene scene = testing::data_scene("foliage-medium");
  scene.objects.push_back({.mesh = make_random_triangles({0, 3, 0}, 2.0, 0.2, 4000, 3)});
  const testing::View view(scene, 96, 72);
  const Casters casters(scene.objects);
  const auto edges = [&](std::uint64_t samples) {
    return testing::count_in(visibility(casters, scene.lights.front().shape, view.surface.receivers(),
                                        {.method = "rays", .options = rays(samples, 0)})
                                 .counts,
                             "projected_edges");
  };
  EXPECT_LT(4 * edges(4), edges(1024));
}

}  // namespace
}  // namespace penumbra
