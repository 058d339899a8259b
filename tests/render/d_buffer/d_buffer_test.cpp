#include "render/d_buffer/d_buffer.h"

#include <gtest/gtest.h>

#include "penumbra/mesh/error.h"
#include "penumbra/render/renderer.h"
#include "tests/render/d_buffer/d_buffer_support.h"

namespace penumbra {
namespace {

using testing::draw_d_buffer;
using testing::Values;
using testing::View;

TEST(DBuffer, OfRadiusZeroIsTheHardShadow) {
  Scene scene = testing::data_scene("boxes-medium");
  testing::light_of(scene).radius = 0.0;
  RenderOptions options;
  options.width = 160, options.height = 120;
  options.method = "dbuffer";
  const Values soft = render(scene, options).image.at("visibility");
  options.method = "hard";
  EXPECT_EQ(soft, render(scene, options).image.at("visibility"));
  EXPECT_GT(std::count(soft.begin(), soft.end(), 0.0f), 500);
}

TEST(DBuffer, FramesDoNotDependOnTheFrameBefore) {
  const Scene scene = testing::data_scene("torus-medium");
  const View view(scene, 160, 120);
  DBuffer buffer(testing::d_buffer_context(), scene, view.rays);
  buffer.set_surface(view.surface.receivers());
  const Values first = buffer.render(testing::light_of(scene), {.size = 256}).visibility;
  DiskLight other = testing::light_of(scene);
  other.center.x += 3.0;
  other.radius *= 3.0;
  EXPECT_NE(buffer.render(other, {.size = 128}).visibility, first);
  EXPECT_EQ(buffer.render(testing::light_of(scene), {.size = 256}).visibility, first);
}

TEST(DBuffer, SizesOutsideTheirRangeAreRefused) {
  const Scene scene = testing::data_scene("cube-medium");
  const RayScene rays(scene, 0);
  DBuffer buffer(testing::d_buffer_context(), scene, rays);
  buffer.set_surface(testing::receivers({{0, 0, 0}}, Vec3(0, 1, 0), 1).receivers());
  for (const int size : {-1, 1, 15, 8193})
    EXPECT_THROW(buffer.render(testing::light_of(scene), {.size = size}), UsageError) << size;
  EXPECT_NO_THROW(buffer.render(testing::light_of(scene), {.size = 16}));
}

TEST(DBuffer, ZeroIsASizeByTheImage) {
  EXPECT_EQ(d_buffer_size_for(640, 480), 576);
  EXPECT_EQ(d_buffer_size_for(32, 24), 512);
  EXPECT_EQ(d_buffer_size_for(3840, 2160), 2880);
  EXPECT_EQ(d_buffer_size_for(20'000, 20'000), 4096);
  const Scene scene = testing::data_scene("torus-medium");
  const View view(scene, 160, 120);
  const DBufferFrame by_image = draw_d_buffer(scene, view.surface, {.size = 0}),
                     by_number = draw_d_buffer(scene, view.surface, {.size = 512});
  EXPECT_EQ(by_image.visibility, by_number.visibility);
  EXPECT_EQ(testing::count_in(by_image.counts, "buffer_size"), 512u);
}

}  // namespace
}  // namespace penumbra
