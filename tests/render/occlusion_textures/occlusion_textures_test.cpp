#include "render/occlusion_textures/occlusion_textures.h"

#include <gtest/gtest.h>

#include <cmath>

#include "penumbra/mesh/error.h"
#include "penumbra/render/renderer.h"
#include "render/light/light_integrals.h"
#include "tests/render/error_support.h"
#include "tests/render/render_support.h"

namespace penumbra {
namespace {

using testing::Pixels;
using testing::Random;
using testing::Values;
using testing::View;

gl::Context& context() {
  static const std::unique_ptr<gl::Context> shared = gl::make_context(gl::Backend::kOsMesa);
  return *shared;
}

Values draw(const Scene& scene, const SurfaceBuffer& surface, const OcclusionOptions& options = {},
            int threads = 0) {
  const RayScene rays(scene, threads);
  OcclusionTextures textures(context(), scene, rays);
  return textures.render(area_light(scene.lights.front().shape), surface.receivers(), options).visibility;
}

/// A rectangular light in z = 0 that shines towards +z, and casters.
Scene scene_under_rectangle(const glm::dvec2& half, const Vec3& tangent, std::vector<TriangleMesh> casters) {
  Scene scene = testing::scene_in_light_frame(glm::length(half), std::move(casters));
  scene.lights.front().shape =
      RectangleLight{.center = {}, .normal = {0, 0, 1}, .tangent = tangent, .half_extents = half};
  return scene;
}

/// Receivers on the plane z, facing the light.
SurfaceBuffer plane_of_receivers(double half, double z, int side) {
  std::vector<Vec3> points;
  for (int j = 0; j < side; ++j)
    for (int i = 0; i < side; ++i)
      points.push_back({half * (2.0 * (i + 0.5) / side - 1.0), half * (2.0 * (j + 0.5) / side - 1.0), z});
  return testing::receivers(points, Vec3(0, 0, -1), side);
}

double overlap(double a0, double a1, double b0, double b1) {
  return std::max(0.0, std::min(a1, b1) - std::max(a0, b0));
}

/// The light seen past the rectangle |x| ≤ 1, |y| ≤ 0.7 at depth b, by the box that it covers there.
double visibility_past_rectangle(const Vec3& p, double b, const glm::dvec2& half) {
  const double near = b / p.z;
  const glm::dvec2 k = half * (1.0 - near), c = glm::dvec2(p) * near;
  return 1.0 - overlap(c.x - k.x, c.x + k.x, -1.0, 1.0) * overlap(c.y - k.y, c.y + k.y, -0.7, 0.7) /
                   (4.0 * k.x * k.y);
}

/// RMSE over the penumbra of that rectangle at depth 5, on receivers at depth 10.
double error_of_planar_occluder(const Scene& scene, const glm::dvec2& half, const OcclusionOptions& options) {
  const SurfaceBuffer surface = plane_of_receivers(3.2, 10.0, 160);
  const Values v = draw(scene, surface, options);
  double sum = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < v.size(); ++i) {
    const double truth = visibility_past_rectangle(surface.position[i], 5.0, half);
    if (truth > 0.0 && truth < 1.0) {
      sum += (v[i] - truth) * (v[i] - truth);
      ++count;
    } else {
      EXPECT_NEAR(v[i], truth, 0.01) << i;
    }
  }
  EXPECT_GT(count, 1'500);
  return std::sqrt(sum / count);
}

// The kernel is at least 200 texels wide; a texel's border that is off by half is worth a 400th.
TEST(OcclusionTextures, PlanarOccluderInItsSlicesPlaneIsExact) {
  const glm::dvec2 half(0.5, 0.41);  // other proportions than the occluder's: its borders cross texels
  const TriangleMesh occluder = testing::rectangle(-1, 1, -0.7, 0.7, 5.0);
  Scene fitted = scene_under_rectangle(half, {2, 0, 0}, {occluder});
  Scene sliced = fitted;  // 16 slices of 0.5: depth 5 is a slice's plane
  sliced.objects.push_back({"range", make_triangle({0, 0, 1}, {0.1, 0, 1}, {0, 0, 9}), Vec3(0.8), false});
  OcclusionOptions options{.texture_size = 1024, .range = SliceRange::kCasters};
  const double by_fitted = error_of_planar_occluder(fitted, half, options);
  options.range = SliceRange::kScene;
  const double by_sliced = error_of_planar_occluder(sliced, half, options);
  options.coverage = SliceCoverage::kArea;
  const double by_area = error_of_planar_occluder(sliced, half, options);
  options.filter = OcclusionFilter::kNBuffer;
  const double by_n_buffer = error_of_planar_occluder(sliced, half, options);
  std::printf("RMSE: casters' range %.5f, scene's range %.5f, area coverage %.5f, N-buffer %.5f\n", by_fitted,
              by_sliced, by_area, by_n_buffer);
  EXPECT_LE(by_fitted, 0.003);
  EXPECT_LE(by_sliced, 0.003);
  EXPECT_LE(by_area, 0.003);
  EXPECT_LE(by_n_buffer, 0.003) << "a single edge is kind to interpolation";
}

TEST(OcclusionTextures, TangentTurnsTheRectangle) {
  const TriangleMesh occluder = testing::rectangle(-1, 1, -0.7, 0.7, 5.0);
  const Scene along = scene_under_rectangle({0.8, 0.2}, {1, 0, 0.3}, {occluder}),
              across = scene_under_rectangle({0.2, 0.8}, {0, -3, 0}, {occluder});
  const SurfaceBuffer surface = plane_of_receivers(3.2, 10.0, 60);
  const Values a = draw(along, surface), b = draw(across, surface);
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 0.02) << i;
}

::testing::AssertionResult all_in_range(const Values& visibility) {
  for (std::size_t i = 0; i < visibility.size(); ++i)
    if (!(visibility[i] >= 0.0f && visibility[i] <= 1.0f))
      return ::testing::AssertionFailure() << "visibility " << visibility[i] << " at pixel " << i;
  return ::testing::AssertionSuccess();
}

struct HardCase {
  const char* name;
  Scene scene;
};

std::vector<HardCase> hard_cases() {
  const auto disk = [](double radius, std::vector<TriangleMesh> casters) {
    return testing::scene_in_light_frame(radius, std::move(casters));
  };
  std::vector<HardCase> cases;
  cases.push_back({"light behind everything: the casters are behind its plane",
                   disk(0.5, {make_box({0, 0, -4}, {1, 1, 1})})});
  cases.push_back({"light inside a box", disk(0.5, {make_box({0, 0, 0}, {2, 2, 2})})});
  cases.push_back({"light on a box's side", disk(0.5, {make_box({0, 0, 1}, {1, 1, 1})})});
  cases.push_back({"caster through the light", disk(0.5, {make_box({0.2, 0, 0}, {0.1, 3, 3})})});
  cases.push_back({"nothing casts", disk(0.5, {})});
  cases.push_back({"slices between two casters are empty",
                   disk(0.5, {make_box({0, 0, 2}, {0.5, 0.5, 0.1}), make_box({0, 0, 9}, {0.5, 0.5, 0.1})})});
  cases.push_back({"thinner than a slice", disk(0.5, {testing::rectangle(-1, 1, -1, 1, 5.0)})});
  cases.push_back({"kernels larger than the texture", disk(6.0, {make_box({0, 0, 5}, {0.01, 0.01, 0.01})})});
  cases.push_back({"a caster that is a line from the light",
                   disk(0.5, {make_triangle({0, 0, 4}, {1e-12, 0, 4}, {0, 0, 6})})});
  cases.push_back({"tiny light", disk(1e-9, {make_box({0, 0, 5}, {1, 1, 1})})});
  cases.push_back({"huge light", disk(1e6, {make_box({0, 0, 5}, {1, 1, 1})})});
  cases.push_back(
      {"narrow rectangle", scene_under_rectangle({3, 1e-4}, {1, 1, 0}, {make_box({0, 0, 5}, {1, 1, 1})})});
  return cases;
}

SurfaceBuffer scattered_receivers(std::uint64_t seed, int count) {
  Random random(seed);
  std::vector<Vec3> points, normals;
  for (int i = 0; i < count; ++i) {
    points.push_back(random.point(i % 3 ? 6.0 : 0.5) + Vec3(0, 0, i % 3 ? 4.0 : 0.0));
    normals.push_back(random.direction());
  }
  return testing::receivers(points, normals, count);
}

TEST(OcclusionTextures, HardCasesStayInRange) {
  constexpr std::uint64_t kSeed = 17;
  const SurfaceBuffer surface = scattered_receivers(kSeed, 2'000);
  int renders = 0;
  for (const HardCase& hard : hard_cases()) {
    const RayScene rays(hard.scene, 0);
    OcclusionTextures textures(context(), hard.scene, rays);
    for (const auto& filter : occlusion_filters())
      for (const auto& combine : occlusion_combines())
        for (const auto& kernel : occlusion_kernels())
          for (const double offset : {0.0, 1e-6, 1.0, HUGE_VAL}) {
            OcclusionOptions options{.slices = 8,
                                     .texture_size = 128,
                                     .filter = filter.value,
                                     .combine = combine.value,
                                     .kernel = kernel.value,
                                     .thin_fix = ThinFix::kAuto};
            if (offset > 0.0) options.cop_offset = offset;
            options.range = renders % 2 ? SliceRange::kScene : SliceRange::kCasters;
            options.coverage = renders % 3 ? SliceCoverage::kBinary : SliceCoverage::kArea;
            ASSERT_TRUE(all_in_range(
                textures.render(area_light(hard.scene.lights.front().shape), surface.receivers(), options)
                    .visibility))
                << hard.name << ", " << filter.name << ", " << combine.name << ", offset " << offset
                << ", seed " << kSeed;
            ++renders;
          }
  }
  EXPECT_EQ(renders, 12 * 3 * 3 * 2 * 4);
}

// What does not lie between a receiver and the light hides nothing, wherever its texels end.
TEST(OcclusionTextures, NothingWrapsAround) {
  const Scene scene = testing::scene_in_light_frame(0.5, {make_box({0, 0, 5}, {1, 1, 1})});
  std::vector<Vec3> points;
  for (int i = 0; i < 400; ++i) {
    const double angle = 2.0 * testing::kPi * i / 400, away = 3.5 + 0.2 * (i % 100);
    points.push_back({away * std::cos(angle), away * std::sin(angle), 8.0});
  }
  const SurfaceBuffer surface = testing::receivers(points, Vec3(0, 0, -1), 400);
  for (const auto& filter : occlusion_filters()) {
    const Values v = draw(scene, surface, {.filter = filter.value});
    for (std::size_t i = 0; i < v.size(); ++i) EXPECT_EQ(v[i], 1.0f) << filter.name << " " << i;
  }
}

TEST(OcclusionTextures, BehindTheLightIsDarkAndWithoutCastersIsTheHorizon) {
  Scene scene = testing::scene_in_light_frame(0.5, {make_box({0, 0, 5}, {1, 1, 1})});
  scene.objects[0].casts = false;
  const SurfaceBuffer surface = scattered_receivers(3, 1'000);
  const Values v = draw(scene, surface);
  int behind = 0;
  for (std::size_t i = 0; i < v.size(); ++i) {
    EXPECT_EQ(v[i], static_cast<float>(fraction_above_horizon(testing::light_of(scene), surface.position[i],
                                                              surface.normal[i])));
    behind += surface.position[i].z <= 0.0 && v[i] == 0.0f;
  }
  EXPECT_GT(behind, 100);
}

// Casters that stand on what they shadow need slices of their own; those far above it do not.
TEST(OcclusionTextures, AutomaticRangeIsTheCastersWhereTheyTouch) {
  for (const auto& [name, range] :
       {std::pair("torus-medium", SliceRange::kScene), {"knot1-medium", SliceRange::kCasters}}) {
    const Scene scene = testing::data_scene(name);
    const View view(scene, 80, 60);
    const Values automatic = draw(scene, view.surface, {.range = SliceRange::kAuto});
    const auto other = range == SliceRange::kScene ? SliceRange::kCasters : SliceRange::kScene;
    EXPECT_EQ(automatic, draw(scene, view.surface, {.range = range})) << name;
    EXPECT_NE(automatic, draw(scene, view.surface, {.range = other})) << name;
  }
}

TEST(OcclusionTextures, SumHidesMoreThanProductAndMaximumLess) {
  const Scene scene = testing::data_scene("foliage-medium");
  const View view(scene, 160, 120);
  const Values sum = draw(scene, view.surface, {.combine = OcclusionCombine::kSum}),
               product = draw(scene, view.surface, {.combine = OcclusionCombine::kProduct}),
               maximum = draw(scene, view.surface, {.combine = OcclusionCombine::kMaximum});
  int apart = 0;
  for (std::size_t i = 0; i < sum.size(); ++i) {
    ASSERT_LE(sum[i], product[i] + 1e-6f) << i;
    ASSERT_LE(product[i], maximum[i] + 1e-6f) << i;
    apart += maximum[i] - sum[i] > 0.05f;
  }
  EXPECT_GT(apart, 200);
}

TEST(OcclusionTextures, IsTheSameEveryTimeAndForAnyNumberOfThreads) {
  const Scene scene = testing::data_scene("torus-medium");
  const View view(scene, 160, 120);
  for (const auto& filter : occlusion_filters()) {
    const OcclusionOptions options{.filter = filter.value, .coverage = SliceCoverage::kArea};
    const Values first = draw(scene, view.surface, options, 1);
    EXPECT_EQ(draw(scene, view.surface, options, 1), first) << filter.name;
    EXPECT_EQ(draw(scene, view.surface, options, 3), first) << filter.name;
  }
}

TEST(OcclusionTextures, OptionsOutsideTheirRangeAreRefused) {
  const Scene scene = testing::scene_in_light_frame(0.5, {make_box({0, 0, 5}, {1, 1, 1})});
  const SurfaceBuffer surface = scattered_receivers(3, 4);
  for (const int slices : {0, 3, 5, 20, -4})
    EXPECT_THROW(draw(scene, surface, {.slices = slices}), UsageError);
  for (const int size : {0, 64, 500, 2048})
    EXPECT_THROW(draw(scene, surface, {.texture_size = size}), UsageError);
  for (const double offset : {0.0, -1.0, std::nan("")})
    EXPECT_THROW(draw(scene, surface, {.cop_offset = offset}), UsageError);
}

TEST(RectangleLight, IsRefusedByMethodsThatNeedADisk) {
  const Scene scene = scene_under_rectangle({1, 1}, {1, 0, 0}, {make_box({0, 0, 5}, {1, 1, 1})});
  RenderOptions options;
  options.width = 16;
  options.height = 12;
  for (const char* method : {"silhouette", "rays", "dbuffer"}) {
    options.method = method;
    EXPECT_THROW(render(scene, options), UsageError) << method;
  }
  for (const char* method : {"none", "hard", "occlusion-textures", "reference"}) {
    options.method = method;
    EXPECT_NO_THROW(render(scene, options)) << method;
  }
}

struct Threshold {
  const char* scene;
  double rmse;
};

// A quarter above what a prototype of this method reached on the floor.
TEST(OcclusionTextures, ErrorOnTheFloor) {
  const Threshold thresholds[] = {{"cube-small", .121},     {"cube-medium", .135},  {"sphere-small", .134},
                                  {"sphere-medium", .130},  {"torus-small", .126},  {"torus-medium", .0825},
                                  {"boxes-small", .135},    {"boxes-medium", .159}, {"foliage-small", .049},
                                  {"foliage-medium", .0325}};
  for (const auto& [name, bound] : thresholds) {
    const Scene scene = testing::data_scene(name);
    const View view(scene, 320, 240);
    const Values v = draw(scene, view.surface);
    const Pixels near = view.near_penumbra(testing::pixels_of(view.surface, 0));
    const ErrorFigures floor = testing::penumbra_error(testing::at_pixels(v, near), view.trace(near, 256, 21),
                                                       view.trace(near, 256, 22));
    std::printf("%-14s floor: %zu pixels, RMSE %.4f (at most %.4f)\n", name, floor.pixels, floor.rmse, bound);
    EXPECT_LE(floor.rmse, bound) << name;
  }
}

}  // namespace
}  // namespace penumbra
