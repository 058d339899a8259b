// The method backprojection: right where texels are the caster, a flat one that is parallel to the light.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "render/backprojection/light_masks.h"
#include "tests/render/method_support.h"

namespace penumbra {
namespace {

using testing::kUnitDisk;
using testing::MethodUnderTest;
using testing::RowOfReceivers;
using testing::Values;

const MethodUnderTest seen("backprojection");

TEST(LightMasks, AreTheSamplesInARectangle) {
  testing::Random random(2);
  for (const int samples : {16, 64, 100, 256}) {
    const detail::LightMasks masks(true, samples, 1);
    for (int i = 0; i < 200; ++i) {
      const glm::dvec2 low(random.uniform(-1.2, 1), random.uniform(-1.2, 1));
      const detail::LightRectangle r{low, low + glm::dvec2(random.uniform(0, 1.5), random.uniform(0, 1.5))};
      std::vector<detail::MaskWord> mask(masks.words(), 0);
      masks.add(r, mask);
      std::size_t inside = 0;
      for (std::size_t k = 0; k < masks.count(); ++k) {
        const glm::dvec2& s = masks.samples()[k];
        const bool is_inside = s.x >= r.low.x && s.x < r.high.x && s.y >= r.low.y && s.y < r.high.y;
        inside += is_inside;
        EXPECT_EQ((mask[k / 64] >> (k % 64) & 1) != 0, is_inside) << samples << ", " << k;
      }
      EXPECT_EQ(masks.is_full(mask), inside == masks.count());
    }
  }
}

TEST(Backprojection, IsRightForAFlatCasterParallelToTheLight) {
  const RowOfReceivers floor(-1.4, 1.4, 0.1);
  const std::vector<TriangleMesh> sheet{testing::rectangle(0, 6, -6, 6, 1.0)};
  const OptionValues fine{{"patch-map-size", std::uint64_t{256}}, {"mask-samples", std::uint64_t{1024}}};
  const Values values = seen(sheet, kUnitDisk, floor.receivers(), fine);
  for (std::size_t i = 0; i < values.size(); ++i)
    EXPECT_NEAR(values[i], half_plane_area(-floor.points[i].x), 0.03) << floor.points[i].x;
  const RectangleLight light{
      .center = Vec3(0.0), .normal = {0, 0, 1}, .tangent = {1, 0, 0}, .half_extents = {0.5, 1.5}};
  const Values of_rectangle = seen(sheet, light, floor.receivers(), fine);
  for (std::size_t i = 0; i < values.size(); ++i)
    EXPECT_NEAR(of_rectangle[i], std::clamp(0.5 - floor.points[i].x, 0.0, 1.0), 0.03) << floor.points[i].x;
}

// What hides the light twice hides it once, unlike what areas added up would say.
TEST(Backprojection, FusesOccluders) {
  const std::vector<TriangleMesh> two{testing::rectangle(0, 6, -6, 6, 1.0),
                                      testing::rectangle(-0.02, 6, -6, 6, 1.2)};
  const std::vector<Vec3> points{{0, 0.3, 2}}, normals{{0, 0, -1}};
  const Receivers receivers{.points = points, .normals = normals};
  EXPECT_NEAR(seen(two, kUnitDisk, receivers,
                   {{"patch-map-size", std::uint64_t{512}}, {"map-layers", std::uint64_t{2}}})[0],
              0.48, 0.03);
}

// A small plate near the light hides a part of the large one from the map; a second layer has it.
TEST(Backprojection, LayersCloseLeaks) {
  const std::vector<TriangleMesh> plates{testing::rectangle(-0.1, 0.1, -0.1, 0.1, 0.2),
                                         testing::rectangle(-3, 3, -3, 3, 1.8)};
  const std::vector<Vec3> points{{0, 0, 2}}, normals{{0, 0, -1}};
  const Receivers receivers{.points = points, .normals = normals};
  EXPECT_EQ(visibility(Casters(plates), kUnitDisk, receivers).visibility[0], 0.0f) << "umbra";
  EXPECT_GT(seen(plates, kUnitDisk, receivers)[0], 0.5f);
  EXPECT_EQ(seen(plates, kUnitDisk, receivers, {{"map-layers", std::uint64_t{2}}})[0], 0.0f);
}

// A slope towards the light has gaps between its texels.
TEST(Backprojection, FillsGaps) {
  const TriangleMesh slope =
      testing::mesh_of({{-3, -3, 0.5}, {3, -3, 1.7}, {3, 3, 1.7}, {-3, 3, 0.5}}, {{0, 1, 2}, {0, 2, 3}});
  const std::vector<Vec3> points{{0.3, 0.1, 2}}, normals{{0, 0, -1}};
  const Receivers receivers{.points = points, .normals = normals};
  const OptionValue coarse = std::uint64_t{64};
  EXPECT_GT(seen({slope}, kUnitDisk, receivers,
                 {{"patch-map-size", coarse}, {"gap-filling", std::string("off")}})[0],
            0.01f);
  EXPECT_EQ(seen({slope}, kUnitDisk, receivers, {{"patch-map-size", coarse}})[0], 0.0f);
}

TEST(Backprojection, EmptyScenesBadSettingsAndLightsAnywhere) {
  seen.expect_empty_scenes_are_lit();
  seen.expect_lights_anywhere_do(300, {{"patch-map-size", std::uint64_t{32}}});
  seen.expect_are_refused({"patch-map-size", "map-layers", "mask-samples", "gap-filling", "map-bias"},
                          {-1.0, std::uint64_t{100'000}, "many"});
}

}  // namespace
}  // namespace penumbra
