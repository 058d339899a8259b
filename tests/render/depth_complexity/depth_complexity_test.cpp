// The method depth-complexity: exact to its samples, which are those of the reference, for any caster.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <map>

#include "render/receivers/sample_key.h"
#include "tests/render/oracle_support.h"
#include "tests/render/sample_support.h"

namespace penumbra {
namespace {

using testing::expect_ties_only;
using testing::light_samples;
using testing::MethodUnderTest;
using testing::Random;
using testing::SamplesOff;
using testing::Values;

const MethodUnderTest seen("depth-complexity");

SamplesOff from_reference(const std::vector<SceneObject>& objects, const LightShape& light,
                          const Receivers& receivers, int count, bool with_unoccluded = false) {
  return testing::off_reference("depth-complexity", objects, light, receivers, count, with_unoccluded);
}

/// What a camera sees of a scene.
SurfaceBuffer surface_of(const Scene& scene) {
  return make_surface_buffer(scene, RayScene(scene, 0), 160, 120);
}

TEST(DepthComplexity, IsTheReferenceBitForBit) {
  for (const char* name : {"cube-medium", "torus-large", "boxes-large", "foliage-small", "bunny-medium",
                           "knot1-large", "boxes-sun", "terrain-sun"}) {
    const Scene scene = testing::data_scene(name);
    const SurfaceBuffer surface = surface_of(scene);
    const SamplesOff off = from_reference(scene.objects, scene.lights.front().shape, surface.receivers(), 64);
    EXPECT_GT(off.partly, 100u) << name;
    expect_ties_only(off, name);
  }
}

TEST(DepthComplexity, IsTheReferenceUnderRectangles) {
  for (const char* name : {"torus-large", "boxes-medium"}) {
    const Scene scene = testing::data_scene(name);
    const RectangleLight light = testing::rectangle_for(testing::light_of(scene));
    const SurfaceBuffer surface = surface_of(scene);
    const SamplesOff off = from_reference(scene.objects, light, surface.receivers(), 64);
    EXPECT_GT(off.partly, 500u) << name;
    expect_ties_only(off, name);
  }
}

TEST(DepthComplexity, IsTheReferenceWithoutTheHorizon) {
  const Scene scene = testing::data_scene("torus-large");
  const SurfaceBuffer surface = surface_of(scene);
  const SamplesOff off =
      from_reference(scene.objects, scene.lights.front().shape, surface.receivers(), 64, true);
  EXPECT_GT(off.partly, 500u);
  expect_ties_only(off, "O of torus-large");
}

TEST(DepthComplexity, IsTheReferenceForTrianglesThatAreNoSurface) {
  Random random(7);
  const TriangleMesh mesh = testing::triangles_that_are_no_surface(random);
  const DiskLight light{{0.2, 3, -0.1}, {0.1, -1, 0}, 0.8};
  std::vector<Vec3> receivers;
  for (int i = 0; i < 4'000; ++i)
    receivers.emplace_back(random.uniform(-2, 2), random.uniform(-2, 0.5), random.uniform(-2, 2));
  const SamplesOff off = from_reference({{"soup", mesh, Vec3(0.8), true}}, light, {.points = receivers}, 64);
  EXPECT_GT(off.partly, 500u);
  expect_ties_only(off, "soup");
}

// Rays in double that share no code with the method or with the reference's rays, to the same points of the
// light.
TEST(DepthComplexity, CountsTheSamplesThatExactRaysReach) {
  constexpr int kSamples = 64;
  for (const char* name : {"cube-medium", "torus-medium", "boxes-large", "foliage-medium", "bunny-large"}) {
    const Scene scene = testing::data_scene(name);
    const LightShape& light = scene.lights.front().shape;
    const oracle::Light given = testing::oracle_light(light);
    const SurfaceBuffer surface = surface_of(scene);
    const Receivers receivers = surface.receivers();
    const Values visible = visibility(Casters(scene.objects), light, receivers,
                                      {.method = "depth-complexity", .options = light_samples(kSamples)})
                               .visibility;
    std::vector<TriangleMesh> casters;
    std::map<std::int32_t, std::uint32_t> caster_of;
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
      if (!scene.objects[i].casts) continue;
      caster_of[static_cast<std::int32_t>(i)] = static_cast<std::uint32_t>(casters.size());
      casters.push_back(scene.objects[i].mesh);
    }
    const oracle::Oracle judge(casters);
    std::size_t looked_at = 0, differ = 0, samples_that_differ = 0, unclear = 0;
    for (std::uint32_t i = 0; i < surface.size(); i += 3) {
      if (!surface.hit(i) || !(visible[i] > 0.0f && visible[i] < 1.0f)) continue;
      std::vector<oracle::CasterFace> own;
      if (const auto caster = caster_of.find(surface.object[i]); caster != caster_of.end())
        own.push_back({caster->second, FaceId{surface.face[i]}});
      int free = 0;
      for (const Vec3& q : testing::samples_of(light, detail::sample_key_of(receivers, i, 1), kSamples))
        free += glm::dot(surface.normal[i], q - surface.position[i]) > 0.0 &&
                !judge.blocked(surface.position[i], q, own, given);
      ++looked_at;
      const int off = std::abs(static_cast<int>(std::lround(visible[i] * kSamples)) - free);
      if (off == 0) continue;
      ++differ, samples_that_differ += static_cast<std::size_t>(off);
      for (const Vec3& q : testing::samples_of(light, detail::sample_key_of(receivers, i, 1), kSamples))
        unclear +=
            !testing::is_blocked(scene, surface.position[i], q, 1e-4, surface.object[i], surface.face[i])
                 .clear;
    }
    std::printf("%-16s %zu receivers, %zu differ by %zu samples, %zu of which graze an edge\n", name,
                looked_at, differ, samples_that_differ, unclear);
    EXPECT_GT(looked_at, 100u) << name;
    EXPECT_LE(samples_that_differ, unclear) << name << ": only what grazes an edge may differ";
    EXPECT_LE(differ, looked_at / 1000) << name;
  }
}

TEST(DepthComplexity, TendsToTheAreaBesideAChord) {
  testing::expect_area_beside_chord("depth-complexity");
}

TEST(DepthComplexity, LightsBehindInsideAndFar) {
  testing::expect_reference_under_lights_anywhere("depth-complexity");
}

TEST(DepthComplexity, EmptyScenesAndBadSettings) {
  seen.expect_empty_scenes_are_lit();
  seen.expect_are_refused({"samples"}, {std::uint64_t{0}, 16.0, "many"});
}

// One sample, and numbers that are no squares.
TEST(DepthComplexity, TakesAnyNumberOfSamples) {
  const Scene scene = testing::data_scene("torus-medium");
  const SurfaceBuffer surface = surface_of(scene);
  for (const int count : {1, 2, 7, 100, 1000})
    expect_ties_only(from_reference(scene.objects, scene.lights.front().shape, surface.receivers(), count),
                     std::to_string(count) + " samples");
}

}  // namespace
}  // namespace penumbra
