// The method view-samples: exact to its samples, which are those of the reference, for any caster.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "render/receivers/sample_key.h"
#include "tests/render/sample_support.h"

namespace penumbra {
namespace {

using testing::expect_ties_only;
using testing::light_samples;
using testing::MethodUnderTest;
using testing::Random;
using testing::SamplesOff;
using testing::Values;

const MethodUnderTest seen("view-samples");

SamplesOff from_reference(const std::vector<SceneObject>& objects, const LightShape& light,
                          const Receivers& receivers, int count, bool with_unoccluded = false) {
  return testing::off_reference("view-samples", objects, light, receivers, count, with_unoccluded);
}

/// What a camera sees of a scene.
SurfaceBuffer surface_of(const Scene& scene) {
  return make_surface_buffer(scene, RayScene(scene, 0), 128, 96);
}

TEST(ViewSamples, AreTheReferenceBitForBit) {
  for (const char* name : {"cube-medium", "torus-large", "boxes-large", "foliage-small", "bunny-medium",
                           "knot1-small", "boxes-sun"}) {
    const Scene scene = testing::data_scene(name);
    const SurfaceBuffer surface = surface_of(scene);
    const SamplesOff off = from_reference(scene.objects, scene.lights.front().shape, surface.receivers(), 64);
    EXPECT_GT(off.partly, 60u) << name;
    expect_ties_only(off, name);
  }
}

TEST(ViewSamples, AreTheReferenceUnderRectanglesAndWithoutTheHorizon) {
  const Scene scene = testing::data_scene("boxes-medium");
  const RectangleLight light = testing::rectangle_for(testing::light_of(scene));
  const SurfaceBuffer surface = surface_of(scene);
  for (const bool with_unoccluded : {false, true}) {
    const SamplesOff off = from_reference(scene.objects, light, surface.receivers(), 64, with_unoccluded);
    EXPECT_GT(off.partly, 300u);
    expect_ties_only(off, "rectangle");
  }
}

TEST(ViewSamples, AreTheReferenceForTrianglesThatAreNoSurface) {
  Random random(7);
  const TriangleMesh mesh = testing::triangles_that_are_no_surface(random);
  std::vector<Vec3> receivers;
  for (int i = 0; i < 3'000; ++i) receivers.push_back(random.point(2.0));
  const SamplesOff off =
      from_reference({{"soup", mesh, Vec3(0.8), true}}, DiskLight{{0.2, 3, -0.1}, {0.1, -1, 0}, 0.8},
                     {.points = receivers}, 64);
  EXPECT_GT(off.partly, 500u);
  expect_ties_only(off, "soup");
}

// Rays in double that share no code with the method or with the reference's rays, to the same points of the
// light.
TEST(ViewSamples, CountTheSamplesThatExactRaysReach) {
  constexpr int kSamples = 64;
  const Scene scene = testing::data_scene("boxes-large");
  const SurfaceBuffer surface = surface_of(scene);
  const Receivers receivers = surface.receivers();
  const Values visible = visibility(Casters(scene.objects), scene.lights.front().shape, receivers,
                                    {.method = "view-samples", .options = light_samples(kSamples)})
                             .visibility;
  std::size_t looked_at = 0;
  for (std::uint32_t i = 0; i < surface.size(); i += 7) {
    if (!surface.hit(i) || !(visible[i] > 0.0f && visible[i] < 1.0f)) continue;
    int free = 0, unclear = 0;
    for (const Vec3& q :
         testing::samples_of(scene.lights.front().shape, detail::sample_key_of(receivers, i, 1), kSamples)) {
      if (!(glm::dot(surface.normal[i], q - surface.position[i]) > 0.0)) continue;
      const auto ray =
          testing::is_blocked(scene, surface.position[i], q, 1e-6, surface.object[i], surface.face[i]);
      free += !ray.hidden;
      unclear += !ray.clear;
    }
    ++looked_at;
    EXPECT_LE(std::abs(static_cast<int>(std::lround(visible[i] * kSamples)) - free), unclear) << i;
  }
  EXPECT_GT(looked_at, 100u);
}

TEST(ViewSamples, TendToTheAreaBesideAChord) {
  testing::expect_area_beside_chord("view-samples");
}

TEST(ViewSamples, LightsBehindInsideAndFar) {
  testing::expect_reference_under_lights_anywhere("view-samples");
}

TEST(ViewSamples, EmptyScenesAndBadSettings) {
  seen.expect_empty_scenes_are_lit();
  seen.expect_are_refused({"samples"}, {std::uint64_t{0}, 16.0, "many"});
}

}  // namespace
}  // namespace penumbra
