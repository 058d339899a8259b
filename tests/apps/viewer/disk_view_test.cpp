// The probe's picture of the light without a window.
#include "apps/viewer/pictures/disk_view.h"

#include <gtest/gtest.h>

#include <array>
#include <map>

#include "penumbra/mesh/shapes.h"

namespace penumbra::viewer {
namespace {

using Color = std::array<unsigned char, 3>;
constexpr Color kFree{255, 246, 214}, kBlocked{28, 34, 70}, kBelow{92, 62, 40};

std::map<Color, int> colors_of(const Pixels& pixels) {
  std::map<Color, int> counts;
  for (std::size_t i = 0; i < pixels.rgb.size(); i += 3)
    ++counts[{pixels.rgb[i], pixels.rgb[i + 1], pixels.rgb[i + 2]}];
  return counts;
}

/// A disk of radius 1 at height 4 that looks down.
const DiskLight kLight{{0, 4, 0}, {0, -1, 0}, 1.0};

/// A plate under its half x > 0.
Scene half_covered() {
  Scene scene;
  scene.objects.push_back({"plate", make_box({5, 3, 0}, {5, 0.01, 10}), Vec3(0.8), true});
  return scene;
}

TEST(DiskView, HalfIsBlocked) {
  auto counts = colors_of(disk_seen_from(half_covered(), kLight, {0, 0, 0}, {0, 1, 0}, 96));
  EXPECT_NEAR(counts[kBlocked], counts[kFree], 0.1 * counts[kFree]);
  EXPECT_EQ(counts[kBelow], 0);
}

TEST(DiskView, TheHorizonCutsIt) {
  Scene scene = half_covered();
  scene.objects.clear();
  auto counts = colors_of(disk_seen_from(scene, kLight, {0, 0, 0}, {1, 0, 0}, 96));
  EXPECT_NEAR(counts[kBelow], counts[kFree], 0.1 * counts[kFree]);
  counts = colors_of(disk_seen_from(scene, kLight, {0, 0, 0}, {0, -1, 0}, 96));
  EXPECT_EQ(counts[kFree], 0);
  EXPECT_GT(counts[kBelow], 1'000);
}

TEST(DiskView, NothingIsSeenFromBehind) {
  EXPECT_TRUE(disk_seen_from(half_covered(), kLight, {0, 5, 0}, {0, 1, 0}, 96).rgb.empty());
}

}  // namespace
}  // namespace penumbra::viewer
