// The reference's rays against the same segments in double.
#include <gtest/gtest.h>

#include "render/light/disk_samples.h"
#include "tests/render/render_support.h"

namespace penumbra {
namespace {

using testing::Pixels;
using testing::Random;
using testing::Values;

/// Samples of a pixel that reach the light in double, from the same points as the float rays. `unsure`: how
/// many pass a triangle's border so closely that float may differ.
struct DoubleCount {
  int visible = 0, unsure = 0;
};
DoubleCount count_in_double(const Scene& scene, const SurfaceBuffer& surface, std::uint32_t pixel,
                            int samples, std::uint64_t seed) {
  const LightFrame f = light_frame(testing::light_of(scene));
  const detail::Strata strata(samples);
  const Vec3& x = surface.position[pixel];
  DoubleCount out;
  for (int i = 0; i < strata.count(); ++i) {
    const detail::DiskPoint s = detail::disk_sample(
        detail::sample_key(seed, pixel), static_cast<std::uint32_t>(i),
        static_cast<float>(i % strata.columns), static_cast<float>(i / strata.columns),
        1.0f / static_cast<float>(strata.columns), 1.0f / static_cast<float>(strata.rows));
    const Vec3 p = testing::light_of(scene).center +
                   testing::light_of(scene).radius * (double{s.x} * f.u + double{s.y} * f.v);
    if (glm::dot(surface.normal[pixel], p - x) <= 0.0) continue;
    const testing::Blocked b =
        testing::is_blocked(scene, x, p, 1e-5, surface.object[pixel], surface.face[pixel]);
    out.visible += !b.hidden;
    out.unsure += !b.clear;
  }
  return out;
}

TEST(Reference, CountsWhatADoubleTestCounts) {
  const Scene scene = testing::data_scene("boxes-medium");
  const testing::View view(scene, 40, 30);
  const Pixels pixels = testing::every_pixel(view.surface);
  const Values v = view.trace(pixels, 64, 3);
  int partly = 0;
  for (const std::uint32_t i : pixels) {
    if (!view.surface.hit(i)) continue;
    const DoubleCount expected = count_in_double(scene, view.surface, i, 64, 3);
    ASSERT_NEAR(64.0 * v[i], expected.visible, expected.unsure) << "pixel " << i;
    partly += v[i] > 0.0f && v[i] < 1.0f;
  }
  EXPECT_GT(partly, 50);
}

TEST(Reference, NeverRisesWhenACasterIsAdded) {
  Scene scene;
  testing::light_of(scene) = {{0.3, 8, 0.2}, {0, -1, 0}, 0.8};
  scene.camera = {{6, 7, 8}, {0, 1.5, 0}, {0, 1, 0}, 45};
  scene.objects.push_back({"floor", make_plane(6.0, 2), Vec3(0.8), false});
  Random random(31);
  for (int k = 0; k < 8; ++k) {  // one after the other: the order of arguments is a compiler's own
    const Vec3 half{random.uniform(0.1, 0.6), random.uniform(0.1, 0.6), random.uniform(0.1, 0.6)};
    const Vec3 center{random.uniform(-2, 2), random.uniform(1, 4), random.uniform(-2, 2)};
    scene.objects.push_back({"box", make_box(center, half), Vec3(0.8), true});
  }
  Scene more = scene;
  more.objects.push_back({"added", make_icosphere({0.5, 2.2, 0.4}, 0.5, 2), Vec3(0.8), true});
  ASSERT_EQ(ray_frame(scene).scale, ray_frame(more).scale);
  ASSERT_EQ(ray_frame(scene).origin, ray_frame(more).origin);
  const testing::View before(scene, 320, 240), after(more, 320, 240);
  const Pixels pixels = testing::every_pixel(before.surface);
  const Values v0 = before.trace(pixels, 256, 6), v1 = after.trace(pixels, 256, 6);
  int compared = 0, fell = 0, rose = 0, confirmed = 0;
  for (const std::uint32_t i : pixels) {
    if (!before.surface.hit(i) || before.surface.object[i] != after.surface.object[i] ||
        before.surface.face[i] != after.surface.face[i])
      continue;
    ++compared;
    fell += v1[i] < v0[i];
    if (!(v1[i] > v0[i])) continue;
    ++rose;
    // Confirmed where double, too, says that fewer reach the light without the new caster than float says
    // with it.
    const DoubleCount expected = count_in_double(scene, before.surface, i, 256, 6);
    confirmed += 256.0 * v1[i] > expected.visible + expected.unsure;
  }
  std::printf("%d pixels compared, %d fell, %d rose, %d confirmed\n", compared, fell, rose, confirmed);
  EXPECT_GT(compared, 30'000);
  EXPECT_GT(fell, 1'000);
  EXPECT_EQ(confirmed, 0);
}

}  // namespace
}  // namespace penumbra
