// The method view-samples: exact to its samples, which are those of the reference, for any caster.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "penumbra/mesh/error.h"
#include "penumbra/render/visibility.h"
#include "render/light/area_light.h"
#include "render/light/light_samples.h"
#include "render/receivers/sample_key.h"
#include "tests/render/render_support.h"

namespace penumbra {
namespace {

using testing::Random;
using testing::Values;

OptionValues samples(std::uint64_t count, std::uint64_t seed = 1) {
  return {{"samples", count}, {"seed", seed}};
}

struct Difference {
  std::size_t partly = 0, receivers = 0;
  double samples = 0.0;
};

Difference from_reference(const std::vector<SceneObject>& objects, const LightShape& light,
                          const Receivers& receivers, int count, bool with_unoccluded = false) {
  const Casters casters(objects);
  const auto by = [&](const char* method) {
    const MethodResult result = visibility(casters, light, receivers,
                                           {.method = method,
                                            .options = samples(static_cast<std::uint64_t>(count), 5),
                                            .with_unoccluded = with_unoccluded});
    return with_unoccluded ? result.unoccluded : result.visibility;
  };
  const Values ours = by("view-samples"), rays = by("reference");
  Difference out;
  EXPECT_EQ(ours.size(), rays.size());
  for (std::size_t i = 0; i < ours.size(); ++i) {
    out.partly += rays[i] > 0.0f && rays[i] < 1.0f;
    out.receivers += ours[i] != rays[i];
    out.samples += std::abs(ours[i] - rays[i]) * static_cast<float>(count);
  }
  return out;
}

SurfaceBuffer surface_of(const Scene& scene) {
  return make_surface_buffer(scene, RayScene(scene, 0), 128, 96);
}

// Float rays may pass an edge within 1e-7 on the other side: one receiver in a thousand, by a sample or two.
void expect_ties_only(const Difference& off, const std::string& name) {
  std::printf("%-28s %5zu in penumbra, %3zu differ, by %.0f samples\n", name.c_str(), off.partly,
              off.receivers, off.samples);
  EXPECT_LE(off.receivers, 1 + off.partly / 1000) << name;
  EXPECT_LE(off.samples, 2.0 * static_cast<double>(off.receivers)) << name;
}

TEST(ViewSamples, AreTheReferenceBitForBit) {
  for (const char* name : {"cube-medium", "torus-large", "boxes-large", "foliage-small", "bunny-medium",
                           "knot1-small", "boxes-sun"}) {
    const Scene scene = testing::data_scene(name);
    const SurfaceBuffer surface = surface_of(scene);
    const Difference off = from_reference(scene.objects, scene.lights.front().shape, surface.receivers(), 64);
    EXPECT_GT(off.partly, 60u) << name;
    expect_ties_only(off, name);
  }
}

TEST(ViewSamples, AreTheReferenceUnderRectanglesAndWithoutTheHorizon) {
  const Scene scene = testing::data_scene("boxes-medium");
  const DiskLight disk = testing::light_of(scene);
  const LightFrame frame = light_frame(disk);
  const RectangleLight light{.center = disk.center,
                             .normal = disk.normal,
                             .tangent = frame.u + 0.3 * frame.v,
                             .half_extents = {0.5 * disk.radius, 1.5 * disk.radius}};
  const SurfaceBuffer surface = surface_of(scene);
  for (const bool with_unoccluded : {false, true}) {
    const Difference off = from_reference(scene.objects, light, surface.receivers(), 64, with_unoccluded);
    EXPECT_GT(off.partly, 300u);
    expect_ties_only(off, "rectangle");
  }
}

// Open, crossing each other, wound at random, and with edges of three faces.
TEST(ViewSamples, AreTheReferenceForTrianglesThatAreNoSurface) {
  Random random(7);
  std::vector<Vec3> points;
  std::vector<IndexedTriangle> triangles;
  for (std::uint32_t i = 0; i < 60; ++i) {
    const Vec3 at = random.point(0.8);
    for (int k = 0; k < 5; ++k) points.push_back(at + random.point(0.4));
    const std::uint32_t v = 5 * i;
    triangles.push_back({v, v + 1, v + 2});
    triangles.push_back(i % 2 == 0 ? IndexedTriangle{v, v + 1, v + 3} : IndexedTriangle{v + 1, v, v + 3});
    if (i % 3 == 0) triangles.push_back({v + 1, v, v + 4});
  }
  const TriangleMesh mesh = TriangleMesh::build(points, triangles);
  std::vector<Vec3> receivers;
  for (int i = 0; i < 3'000; ++i) receivers.push_back(random.point(2.0));
  const Difference off =
      from_reference({{"soup", mesh, Vec3(0.8), true}}, DiskLight{{0.2, 3, -0.1}, {0.1, -1, 0}, 0.8},
                     {.points = receivers}, 64);
  EXPECT_GT(off.partly, 500u);
  expect_ties_only(off, "soup");
}

// Rays in double that share no code with the method or with the reference's rays, to the same points of the light.
TEST(ViewSamples, CountTheSamplesThatExactRaysReach) {
  constexpr int kSamples = 64;
  const Scene scene = testing::data_scene("boxes-large");
  const AreaLight light = area_light(scene.lights.front().shape);
  const SurfaceBuffer surface = surface_of(scene);
  const Receivers receivers = surface.receivers();
  const Values seen = visibility(Casters(scene.objects), scene.lights.front().shape, receivers,
                                 {.method = "view-samples", .options = samples(kSamples)})
                          .visibility;
  const detail::Strata strata(kSamples);
  std::size_t looked_at = 0;
  for (std::uint32_t i = 0; i < surface.size(); i += 7) {
    if (!surface.hit(i) || !(seen[i] > 0.0f && seen[i] < 1.0f)) continue;
    int free = 0, unclear = 0;
    for (int k = 0; k < kSamples; ++k) {
      const detail::DiskPoint p = detail::disk_sample(
          detail::sample_key_of(receivers, i, 1), static_cast<std::uint32_t>(k),
          static_cast<float>(k % strata.columns), static_cast<float>(k / strata.columns),
          1.0f / static_cast<float>(strata.columns), 1.0f / static_cast<float>(strata.rows));
      const Vec3 q = light.center + light.half.x * (double{p.x} * light.axes.u + double{p.y} * light.axes.v);
      if (!(glm::dot(surface.normal[i], q - surface.position[i]) > 0.0)) continue;
      const auto ray =
          testing::is_blocked(scene, surface.position[i], q, 1e-6, surface.object[i], surface.face[i]);
      free += !ray.hidden;
      unclear += !ray.clear;
    }
    ++looked_at;
    EXPECT_LE(std::abs(static_cast<int>(std::lround(seen[i] * kSamples)) - free), unclear) << i;
  }
  EXPECT_GT(looked_at, 100u);
}

// Half of the light behind the edge of a large sheet: the share of samples on one side of a chord.
TEST(ViewSamples, TendToTheAreaBesideAChord) {
  const Casters casters(std::vector<TriangleMesh>{testing::rectangle(0.1, 60, -60, 60, 1.0)});
  std::vector<Vec3> points;
  for (double x = -0.85; x < 1.05; x += 0.05) points.emplace_back(x, 0.3, 2.0);
  const Values seen = visibility(casters, DiskLight{Vec3(0.0), {0, 0, 1}, 1.0}, {.points = points},
                                 {.method = "view-samples", .options = samples(4096)})
                          .visibility;
  for (std::size_t i = 0; i < points.size(); ++i)
    EXPECT_NEAR(seen[i], half_plane_area(points[i].x + 2.0 * (0.1 - points[i].x)), 0.004) << points[i].x;
}

TEST(ViewSamples, LightsBehindInsideAndFar) {
  const std::vector<SceneObject> objects{{"box", make_box(Vec3(0.0), {1, 1, 1}), Vec3(0.8), true}};
  Random random(3);
  std::vector<Vec3> around;
  for (int i = 0; i < 2'000; ++i) around.push_back(random.point(4.0));
  const LightShape lights[] = {DiskLight{{0, 0.3, 0}, {0.2, -1, 0.1}, 0.4},    // inside
                               DiskLight{{0.9, 0.2, 0.1}, {0.3, -1, 0}, 0.5},  // through a side
                               DiskLight{{0, 1e7, 0}, {0, -1, 0}, 1e6},        // far
                               DiskLight{{0, 3, 0}, {0, -1, 0}, 30.0},         // wide
                               DiskLight{{0, 3, 0}, {0, -1, 0}, 1e-6},         // small
                               DistantLight{{0.3, -1, 0.2}, 5.0}};
  for (const LightShape& light : lights)
    expect_ties_only(from_reference(objects, light, {.points = around}, 64), name_of(light));
  const Casters casters(objects);
  const VisibilityOptions options{.method = "view-samples"};
  const std::vector<Vec3> behind{{0, 4, 0}, {0, 5, 0}}, below{{0, -3, 0}, {5, -3, 0}};
  EXPECT_EQ(
      visibility(casters, DiskLight{{0, 4, 0}, {0, -1, 0}, 0.5}, {.points = behind}, options).visibility,
      (Values{0, 0}));
  EXPECT_EQ(visibility(casters, DiskLight{{0, 4, 0}, {0, -1, 0}, 0.0}, {.points = below}, options).visibility,
            (Values{0, 1}))
      << "a point light";
}

TEST(ViewSamples, EmptyScenesAndBadSettings) {
  const std::vector<Vec3> points{{0, 1, 0}, {0.1, 1, 0}};
  const std::vector<std::int32_t> objects{-1, 0};
  const DiskLight light{{0, 4, 0}, {0, -1, 0}, 0.5};
  const VisibilityOptions options{.method = "view-samples"};
  const Casters none(std::vector<TriangleMesh>{});
  EXPECT_EQ(visibility(none, light, {.points = points}, options).visibility, (Values{1, 1}));
  EXPECT_TRUE(visibility(none, light, {}, options).visibility.empty());
  const Casters roof(std::vector<TriangleMesh>{make_box({0, 2, 0}, {3, 0.1, 3})});
  EXPECT_EQ(visibility(roof, light, {.points = points, .objects = objects}, options).visibility,
            (Values{1, 0}));
  for (const OptionValue& bad : {OptionValue(std::uint64_t{0}), OptionValue(16.0), OptionValue("many")})
    EXPECT_THROW(visibility(none, light, {.points = points},
                            {.method = "view-samples", .options = {{"samples", bad}}}),
                 UsageError);
}

}  // namespace
}  // namespace penumbra
