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
/// The same disk at infinity, as the point below it sees it.
const DistantLight kSun{.direction = {0, -1, 0}, .angle_degrees = 28.072486935852957};

Pixels seen(const Scene& scene, const LightShape& light, const Viewpoint& from) {
  return disk_seen_from(scene, area_light(light), from, 96);
}

/// A plate under its half x > 0.
Scene half_covered() {
  Scene scene;
  scene.objects.push_back({"plate", make_box({5, 3, 0}, {5, 0.01, 10}), Vec3(0.8), true});
  return scene;
}

TEST(DiskView, HalfIsBlocked) {
  auto counts = colors_of(seen(half_covered(), kLight, {{0, 0, 0}, {0, 1, 0}}));
  EXPECT_NEAR(counts[kBlocked], counts[kFree], 0.1 * counts[kFree]);
  EXPECT_EQ(counts[kBelow], 0);
}

TEST(DiskView, TheHorizonCutsIt) {
  Scene scene = half_covered();
  scene.objects.clear();
  auto counts = colors_of(seen(scene, kLight, {{0, 0, 0}, {1, 0, 0}}));
  EXPECT_NEAR(counts[kBelow], counts[kFree], 0.1 * counts[kFree]);
  counts = colors_of(seen(scene, kLight, {{0, 0, 0}, {0, -1, 0}}));
  EXPECT_EQ(counts[kFree], 0);
  EXPECT_GT(counts[kBelow], 1'000);
}

TEST(DiskView, NothingIsSeenFromBehind) {
  EXPECT_TRUE(seen(half_covered(), kLight, {{0, 5, 0}, {0, 1, 0}}).rgb.empty());
}

TEST(DiskView, ADistantDiskLooksLikeANearOneOfItsAngle) {
  const auto near = seen(half_covered(), kLight, {{0, 0, 0}, {0.3, 1, 0}}).rgb;
  const auto far = seen(half_covered(), kSun, {{0, 0, 0}, {0.3, 1, 0}}).rgb;
  ASSERT_EQ(near.size(), far.size());
  std::size_t other = 0;
  for (std::size_t i = 0; i < near.size(); ++i) other += near[i] != far[i];
  EXPECT_LT(other, near.size() / 500);
  EXPECT_FALSE(seen(half_covered(), kSun, {{0, 5, 0}, {0, 1, 0}}).rgb.empty()) << "nothing is behind it";
}

// What is very near hides as much as it covers; the face on which the point lies hides nothing.
TEST(DiskView, NothingIsCutOffNearThePoint) {
  Scene scene;
  scene.objects.push_back({"plate", make_box({5, 1e-9, 0}, {5, 1e-10, 10}), Vec3(0.8), true});
  for (const LightShape& light : {LightShape(kLight), LightShape(kSun)}) {
    auto counts = colors_of(seen(scene, light, {{0, 0, 0}, {0, 1, 0}}));
    EXPECT_NEAR(counts[kBlocked], counts[kFree], 0.1 * counts[kFree]) << name_of(light);
  }
  scene.objects[0].mesh = make_plane(3.0);
  // A little below its own face, as points computed in double are.
  int free = 0, blocked = 0;
  for (const Vec3& x : {Vec3(0.5, -1e-12, -0.6), Vec3(-0.5, -1e-12, 0.6)})
    for (const std::uint32_t face : {0u, 1u}) {
      auto counts = colors_of(seen(scene, kSun, {x, {0, 1, 0}, 0, face}));
      free += counts[kBlocked] == 0;
      blocked += counts[kFree] == 0;
    }
  EXPECT_EQ(free, 2) << "each point lies below one of the faces";
  EXPECT_EQ(blocked, 2);
}

}  // namespace
}  // namespace penumbra::viewer
