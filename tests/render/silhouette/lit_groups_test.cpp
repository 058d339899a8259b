// Groups that their boxes tell to be lit are lit, and there are many of them.
#include "render/silhouette/lit_groups.h"

#include <gtest/gtest.h>

#include "tests/render/render_support.h"

namespace penumbra::detail {
namespace {

using testing::Random;

struct View {
  Scene scene;
  RayScene rays;
  SurfaceBuffer surface;
  explicit View(Scene of)
      : scene(std::move(of)), rays(scene, 2), surface(make_surface_buffer(scene, rays, 160, 120)) {}
};

/// The receivers of groups that are lit.
std::vector<std::uint32_t> lit_receivers(const View& view) {
  const Receivers receivers = view.surface.receivers();
  const BoxedGroups boxed(receivers);
  Bounds all = bounds_of_present(receivers);
  for (const SceneObject& object : view.scene.objects) all.add(object.mesh.bounds());
  const UnitLight light(testing::light_of(view.scene), all);
  const RayFrame frame = ray_frame(view.scene);
  const SceneEdges edges(view.scene, frame.origin, frame.scale);
  const LitScene lit(view.scene, light, edges, all);
  const CasterBoxes boxes(view.scene);
  const LitGroups lit_groups(boxed, boxes, lit, true);
  std::vector<std::uint32_t> out;
  for (std::size_t g = 0; g < boxed.boxes.size(); ++g) {
    if (!lit_groups.is_lit(g)) continue;
    boxed.groups.for_each(g, [&](std::uint32_t i) {
      if (receivers.is_present(i)) out.push_back(i);
    });
  }
  return out;
}

TEST(LitGroupsProperty, SeeAllOfTheLight) {
  constexpr std::uint64_t kSeed = 90'210;
  Random random(kSeed);
  std::size_t lit_in_all = 0;
  for (const char* name : {"cube-medium", "torus-large", "bunny-medium", "boxes-large"}) {
    for (int k = 0; k < 6; ++k) {
      Scene scene = testing::data_scene(name);
      DiskLight& light = testing::light_of(scene);
      light.center += random.point(0.3 * glm::length(light.center));
      light.normal = glm::normalize(light.normal + random.point(0.5));
      light.radius *= random.spread(0.3, 3.0);
      const View view(std::move(scene));
      const std::vector<std::uint32_t> lit = lit_receivers(view);
      lit_in_all += lit.size();
      const std::vector<float> v = trace_reference(view.rays, testing::light_of(view.scene),
                                                   view.surface.receivers(), lit, {.samples = 64})
                                       .visibility;
      for (std::size_t i = 0; i < lit.size(); ++i)
        ASSERT_EQ(v[i], 1.0f) << "seed " << kSeed << ", " << name << ", " << k << ", receiver " << lit[i];
    }
  }
  EXPECT_GT(lit_in_all, 20'000u);
}

}  // namespace
}  // namespace penumbra::detail
