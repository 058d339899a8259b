// Casters that hide nothing from the image: which are, which are not, and that leaving them out changes
// nothing.
#include "render/receivers/occluding_casters.h"

#include <gtest/gtest.h>

#include "render/d_buffer/d_buffer.h"
#include "render/silhouette/silhouette_visibility.h"
#include "tests/render/render_support.h"

namespace penumbra {
namespace {

TriangleMesh box() {
  return make_box(Vec3(0.0), Vec3(1.0));
}

bool cannot_occlude(const TriangleMesh& mesh, const DiskLight& light, const std::vector<Vec3>& receivers) {
  Scene scene;
  scene.objects.push_back({"caster", mesh, Vec3(0.8), true});
  return detail::find_casters_that_cannot_occlude(scene, light, {.points = receivers}).front() != 0;
}

TEST(OccludingCasters, AFloorSeenFromAboveIsOne) {
  const DiskLight above{{0, 5, 0}, {0, -1, 0}, 1.0}, aside{{5, 5, 0}, {-1, -1, 0}, 1.0},
      level{{5, 1.5, 0}, {-1, 0, 0}, 1.0}, below{{0, -5, 0}, {0, 1, 0}, 1.0};
  const std::vector<Vec3> over{{0, 1, 0}, {0.5, 1, 0.5}, {3, 2, 0}};
  EXPECT_TRUE(cannot_occlude(box(), above, over));
  EXPECT_TRUE(cannot_occlude(box(), aside, over));
  EXPECT_FALSE(cannot_occlude(box(), level, over)) << "some of the disk is below the top";
  EXPECT_FALSE(cannot_occlude(box(), below, over));
  for (const Vec3& hidden : {Vec3(0, -2, 0), {0, 0, 0}, {3, 0.99, 0}}) {
    std::vector<Vec3> with = over;
    with.push_back(hidden);
    EXPECT_FALSE(cannot_occlude(box(), above, with)) << hidden.x << " " << hidden.y;
  }
}

TEST(OccludingCasters, ARoomSeenFromInsideIsOne) {
  const DiskLight lamp{{0, 0.9, 0}, {0.1, -1, 0}, 0.3};
  const std::vector<Vec3> inside{{0, -1, 0}, {1, 0, 0.5}, {0.2, 0.3, 0.4}};
  EXPECT_TRUE(cannot_occlude(box(), lamp, inside));
  std::vector<Vec3> outside = inside;
  outside.push_back({0, -2, 0});
  EXPECT_FALSE(cannot_occlude(box(), lamp, outside));
}

TEST(OccludingCasters, AMeshOfManyFacesOrPlanesIsNotLookedAt) {
  const DiskLight above{{0, 50, 0}, {0, -1, 0}, 1.0};
  const Scene fine = testing::data_scene("bunny-small"), round = testing::data_scene("sphere-small");
  for (const Scene* scene : {&fine, &round})
    EXPECT_FALSE(cannot_occlude(scene->objects.back().mesh, above, {{0, 40, 0}}));
  EXPECT_FALSE(cannot_occlude(TriangleMesh(), above, {{0, 40, 0}}));
}

/// A floor, turned and moved, with receivers on it; and others a little below.
TEST(OccludingCasters, ReceiversOnAFloorAreNotBehindIt) {
  testing::Random random(61);
  for (int i = 0; i < 200; ++i) {
    const Vec3 y = random.direction(), x = glm::normalize(glm::cross(y, random.direction())),
               z = glm::cross(x, y), at = random.point(5.0);
    const auto place = [&](const Vec3& p) { return at + p.x * x + p.y * y + p.z * z; };
    const double half = random.spread(1.0, 1e6);
    const TriangleMesh floor = testing::mesh_of(
        {place({-half, 0, -half}), place({-half, 0, half}), place({half, 0, half}), place({half, 0, -half})},
        {{0, 1, 2}, {0, 2, 3}});
    const DiskLight light{place({1, 5, 2}), -y, 1.0};
    std::vector<Vec3> on;
    for (int k = 0; k < 3'000; ++k)
      on.push_back(place({random.uniform(-half, half), 0, random.uniform(-half, half)}));
    EXPECT_TRUE(cannot_occlude(floor, light, on)) << i;
    on[1'500] = place({0.3, -1e-9 * half, 0.2});
    EXPECT_FALSE(cannot_occlude(floor, light, on)) << i;
  }
}

TEST(OccludingCasters, AFloorThatCastsChangesNothingOfTheDBuffer) {
  const auto context = gl::make_context(gl::Backend::kOsMesa);
  for (const char* name : {"cube-medium", "torus-small", "boxes-large"}) {
    Scene scene = testing::data_scene(name);
    const auto render = [&](std::uint64_t& left_out) {
      const testing::View view(scene, 160, 120);
      DBuffer buffer(*context, scene, view.rays);
      buffer.set_surface(view.surface.receivers());
      DBufferFrame frame = buffer.render(testing::light_of(scene), {});
      left_out = testing::count_in(frame.counts, "casters_that_cannot_occlude");
      return frame.visibility;
    };
    std::uint64_t none = 99, one = 99;
    const testing::Values without = render(none);
    scene.objects.front().casts = true;
    const testing::Values with = render(one);
    EXPECT_EQ(none, 0u) << name;
    EXPECT_EQ(one, 1u) << name;
    std::size_t differ = 0;
    for (std::size_t i = 0; i < with.size(); ++i) differ += std::abs(with[i] - without[i]) > 1e-3f;
    EXPECT_LE(differ, with.size() / 1000) << name;
  }
}

TEST(OccludingCasters, AFloorThatCastsChangesNothingOfSilhouettes) {
  for (const char* name : {"cube-medium", "torus-small", "boxes-large", "foliage-medium"}) {
    Scene scene = testing::data_scene(name);
    const auto render = [&] {
      const testing::View view(scene, 160, 120);
      return view.see_silhouettes();
    };
    const SilhouetteResult without = render();
    scene.objects.front().casts = true;
    const SilhouetteResult with = render();
    EXPECT_EQ(without.counts.casters_that_cannot_occlude, 0u) << name;
    EXPECT_EQ(with.counts.casters_that_cannot_occlude, 1u) << name;
    EXPECT_EQ(with.counts.band_edges, without.counts.band_edges) << name;
    std::size_t differ = 0;
    for (std::size_t i = 0; i < with.visibility.size(); ++i) {
      differ += std::abs(with.visibility[i] - without.visibility[i]) > 1e-4f;
      EXPECT_EQ(with.region[i], without.region[i]) << name << ", pixel " << i;
    }
    EXPECT_EQ(differ, 0u) << name;
    for (std::size_t k = 1; k < scene.objects.size(); ++k) scene.objects[k].casts = false;
    for (const float v : render().visibility) EXPECT_GE(v, 0.0f) << name << ", the floor alone";
  }
}

}  // namespace
}  // namespace penumbra
