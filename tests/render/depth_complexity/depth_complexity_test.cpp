// The method depth-complexity: exact to its samples, which are those of the reference, for any caster.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <map>
#include <optional>

#include "penumbra/mesh/error.h"
#include "penumbra/render/visibility.h"
#include "render/light/area_light.h"
#include "render/light/light_samples.h"
#include "render/receivers/sample_key.h"
#include "tests/oracle/oracle.h"
#include "tests/render/render_support.h"

namespace penumbra {
namespace {

using testing::Random;
using testing::Values;

OptionValues samples(std::uint64_t count, std::uint64_t seed = 1) {
  return {{"samples", count}, {"seed", seed}};
}

/// Receivers that differ between the method and the reference, and by how many samples in all.
struct Difference {
  std::size_t partly = 0, receivers = 0;
  double samples = 0.0;
};

Difference differences(const Values& a, const Values& b, int count) {
  Difference out;
  EXPECT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    out.partly += b[i] > 0.0f && b[i] < 1.0f;
    out.receivers += a[i] != b[i];
    out.samples += std::abs(a[i] - b[i]) * static_cast<float>(count);
  }
  return out;
}

Difference from_reference(const std::vector<SceneObject>& objects, const LightShape& light,
                          const Receivers& receivers, int count, bool with_unoccluded = false) {
  const Casters casters(objects);
  const auto by = [&](const char* method) {
    return visibility(casters, light, receivers,
                      {.method = method,
                       .options = samples(static_cast<std::uint64_t>(count), 5),
                       .with_unoccluded = with_unoccluded});
  };
  const MethodResult ours = by("depth-complexity"), rays = by("reference");
  if (with_unoccluded) return differences(ours.unoccluded, rays.unoccluded, count);
  return differences(ours.visibility, rays.visibility, count);
}

/// What a camera sees of a scene.
SurfaceBuffer surface_of(const Scene& scene) {
  return make_surface_buffer(scene, RayScene(scene, 0), 160, 120);
}

// Float rays may pass an edge within 1e-7 on the other side: one receiver in a thousand, by a sample or two.
void expect_ties_only(const Difference& off, const std::string& name) {
  std::printf("%-28s %5zu in penumbra, %3zu differ, by %.0f samples\n", name.c_str(), off.partly,
              off.receivers, off.samples);
  EXPECT_LE(off.receivers, 1 + off.partly / 1000) << name;
  EXPECT_LE(off.samples, 2.0 * static_cast<double>(off.receivers)) << name;
}

TEST(DepthComplexity, IsTheReferenceBitForBit) {
  for (const char* name : {"cube-medium", "torus-large", "boxes-large", "foliage-small", "bunny-medium",
                           "knot1-large", "boxes-sun", "terrain-sun"}) {
    const Scene scene = testing::data_scene(name);
    const SurfaceBuffer surface = surface_of(scene);
    const Difference off = from_reference(scene.objects, scene.lights.front().shape, surface.receivers(), 64);
    EXPECT_GT(off.partly, 100u) << name;
    expect_ties_only(off, name);
  }
}

TEST(DepthComplexity, IsTheReferenceUnderRectangles) {
  for (const char* name : {"torus-large", "boxes-medium"}) {
    const Scene scene = testing::data_scene(name);
    const DiskLight disk = testing::light_of(scene);
    const LightFrame frame = light_frame(disk);
    const RectangleLight light{.center = disk.center,
                               .normal = disk.normal,
                               .tangent = frame.u + 0.3 * frame.v,
                               .half_extents = {0.5 * disk.radius, 1.5 * disk.radius}};
    const SurfaceBuffer surface = surface_of(scene);
    const Difference off = from_reference(scene.objects, light, surface.receivers(), 64);
    EXPECT_GT(off.partly, 500u) << name;
    expect_ties_only(off, name);
  }
}

TEST(DepthComplexity, IsTheReferenceWithoutTheHorizon) {
  const Scene scene = testing::data_scene("torus-large");
  const SurfaceBuffer surface = surface_of(scene);
  const Difference off =
      from_reference(scene.objects, scene.lights.front().shape, surface.receivers(), 64, true);
  EXPECT_GT(off.partly, 500u);
  expect_ties_only(off, "O of torus-large");
}

// Open, crossing each other, wound at random, and with edges of three faces.
TEST(DepthComplexity, IsTheReferenceForTrianglesThatAreNoSurface) {
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
  const DiskLight light{{0.2, 3, -0.1}, {0.1, -1, 0}, 0.8};
  std::vector<Vec3> receivers;
  for (int i = 0; i < 4'000; ++i)
    receivers.emplace_back(random.uniform(-2, 2), random.uniform(-2, 0.5), random.uniform(-2, 2));
  const Difference off = from_reference({{"soup", mesh, Vec3(0.8), true}}, light, {.points = receivers}, 64);
  EXPECT_GT(off.partly, 500u);
  expect_ties_only(off, "soup");
}

oracle::Light light_for_oracle(const LightShape& light) {
  if (const auto* disk = std::get_if<DiskLight>(&light)) return *disk;
  return std::get<DistantLight>(light);
}

/// The samples of a receiver, in the world; of a distant light directions.
std::vector<Vec3> samples_of(const LightShape& shape, std::uint32_t key, int count) {
  const AreaLight light = area_light(shape);
  const detail::Strata strata(count);
  std::vector<Vec3> out;
  for (int i = 0; i < strata.count(); ++i) {
    const auto column = static_cast<float>(i % strata.columns), row = static_cast<float>(i / strata.columns);
    const detail::DiskPoint p = detail::disk_sample(key, static_cast<std::uint32_t>(i), column, row,
                                                    1.0f / static_cast<float>(strata.columns),
                                                    1.0f / static_cast<float>(strata.rows));
    out.push_back(light.center + light.half.x * (double{p.x} * light.axes.u + double{p.y} * light.axes.v));
  }
  return out;
}

// Rays in double that share no code with the method or with the reference's rays, to the same points of the light.
TEST(DepthComplexity, CountsTheSamplesThatExactRaysReach) {
  constexpr int kSamples = 64;
  for (const char* name : {"cube-medium", "torus-medium", "boxes-large", "foliage-medium", "bunny-large"}) {
    const Scene scene = testing::data_scene(name);
    const LightShape& light = scene.lights.front().shape;
    const SurfaceBuffer surface = surface_of(scene);
    const Receivers receivers = surface.receivers();
    const Values seen = visibility(Casters(scene.objects), light, receivers,
                                   {.method = "depth-complexity", .options = samples(kSamples)})
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
      if (!surface.hit(i) || !(seen[i] > 0.0f && seen[i] < 1.0f)) continue;
      std::vector<oracle::CasterFace> own;
      if (const auto caster = caster_of.find(surface.object[i]); caster != caster_of.end())
        own.push_back({caster->second, FaceId{surface.face[i]}});
      int free = 0;
      for (const Vec3& q : samples_of(light, detail::sample_key_of(receivers, i, 1), kSamples))
        free += glm::dot(surface.normal[i], q - surface.position[i]) > 0.0 &&
                !judge.blocked(surface.position[i], q, own, light_for_oracle(light));
      ++looked_at;
      const int off = std::abs(static_cast<int>(std::lround(seen[i] * kSamples)) - free);
      if (off == 0) continue;
      ++differ, samples_that_differ += static_cast<std::size_t>(off);
      for (const Vec3& q : samples_of(light, detail::sample_key_of(receivers, i, 1), kSamples))
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

// Half of the light behind the edge of a large sheet: the share of samples on one side of a chord.
TEST(DepthComplexity, TendsToTheAreaBesideAChord) {
  const std::vector<TriangleMesh> sheet{testing::rectangle(0.1, 60, -60, 60, 1.0)};
  const DiskLight light{Vec3(0.0), {0, 0, 1}, 1.0};
  std::vector<Vec3> points;
  for (double x = -0.85; x < 1.05; x += 0.05) points.emplace_back(x, 0.3, 2.0);
  const Casters casters(sheet);
  const Values seen =
      visibility(casters, light, {.points = points}, {.method = "depth-complexity", .options = samples(4096)})
          .visibility;
  for (std::size_t i = 0; i < points.size(); ++i) {
    // The edge at x = 0.1 in z = 1, projected from height 2.
    const double chord = points[i].x + 2.0 * (0.1 - points[i].x);
    EXPECT_NEAR(seen[i], half_plane_area(chord), 0.004) << points[i].x;
  }
}

TEST(DepthComplexity, LightsBehindInsideAndFar) {
  const TriangleMesh box = make_box(Vec3(0.0), {1, 1, 1});
  const std::vector<SceneObject> objects{{"box", box, Vec3(0.8), true}};
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
  const std::vector<Vec3> behind{{0, 4, 0}, {0, 5, 0}};
  const Casters casters(objects);
  const VisibilityOptions options{.method = "depth-complexity"};
  EXPECT_EQ(
      visibility(casters, DiskLight{{0, 4, 0}, {0, -1, 0}, 0.5}, {.points = behind}, options).visibility,
      (Values{0, 0}));
  const std::vector<Vec3> below{{0, -3, 0}, {5, -3, 0}};
  EXPECT_EQ(visibility(casters, DiskLight{{0, 4, 0}, {0, -1, 0}, 0.0}, {.points = below}, options).visibility,
            (Values{0, 1}))
      << "a point light";
}

TEST(DepthComplexity, EmptyScenesAndBadSettings) {
  const std::vector<Vec3> points{{0, 1, 0}, {0.1, 1, 0}};
  const std::vector<std::int32_t> objects{-1, 0};
  const DiskLight light{{0, 4, 0}, {0, -1, 0}, 0.5};
  const VisibilityOptions options{.method = "depth-complexity"};
  const Casters none(std::vector<TriangleMesh>{});
  EXPECT_EQ(visibility(none, light, {.points = points}, options).visibility, (Values{1, 1}));
  EXPECT_TRUE(visibility(none, light, {}, options).visibility.empty());
  const Casters roof(std::vector<TriangleMesh>{make_box({0, 2, 0}, {3, 0.1, 3})});
  EXPECT_EQ(visibility(roof, light, {.points = points, .objects = objects}, options).visibility,
            (Values{1, 0}));
  for (const OptionValue& bad : {OptionValue(std::uint64_t{0}), OptionValue(16.0), OptionValue("many")})
    EXPECT_THROW(visibility(none, light, {.points = points},
                            {.method = "depth-complexity", .options = {{"samples", bad}}}),
                 UsageError);
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
