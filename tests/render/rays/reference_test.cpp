#include "render/rays/reference.h"

#include <gtest/gtest.h>

#include "penumbra/mesh/error.h"
#include "render/light/light_integrals.h"
#include "render/rays/hard.h"
#include "tests/render/render_support.h"

namespace penumbra {
namespace {

using testing::kPi;
using testing::Pixels;
using testing::Random;
using testing::Values;

const Vec3 kToLight{0, 0, -1};  // of receivers on a plane z = const

// A chord crosses at most about two strata a column of a 32×32 grid, and only those are uncertain, each with
// a variance of at most 1/4 of a sample: √(64/4)/1024. (Measured: about .0024.)
constexpr double kNoiseOfOneChord = 0.0039;

/// A half-plane x ≤ 0 at depth `z`, wide enough for every receiver of these tests.
TriangleMesh half_plane(double z) {
  return testing::mesh_of({{0, -60, z}, {0, 60, z}, {-60, 0, z}}, {{0, 1, 2}});
}

/// Receivers from x0 to x1 on the plane z.
SurfaceBuffer line_of_receivers(double x0, double x1, double z, int count) {
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i)
    points.push_back({x0 + (x1 - x0) * (i + 0.5) / count, 0.0137 * (i % 31), z});
  return testing::receivers(points, kToLight, count);
}

ReferenceResult trace(const Scene& scene, const SurfaceBuffer& surface, int samples, std::uint64_t seed = 1) {
  const RayScene rays(scene, 0);
  return trace_reference(rays, scene.lights.front().shape, surface.receivers(), testing::every_pixel(surface),
                         {.samples = samples, .seed = seed});
}

template <class Truth>
double rms_against(const SurfaceBuffer& surface, const Values& values, const Truth& truth) {
  std::vector<double> expected;
  for (const Vec3& p : surface.position) expected.push_back(truth(p));
  return testing::rms_difference(values, expected);
}

/// The distance, in radii, of the disk's center from the shadow that the line x = edge at depth z throws from
/// p; positive where the center is on the side of larger x.
double delta_of_line(const Vec3& p, double edge, double z, double r) {
  return -(p.x + (edge - p.x) * p.z / (p.z - z)) / r;
}

TEST(Reference, HalfPlaneIsTheChordFormula) {
  const double r = 0.8, z = 5.0, depth = 10.0;
  const Scene scene = testing::scene_in_light_frame(r, {half_plane(z)});
  const SurfaceBuffer surface = line_of_receivers(-1.0, 1.0, depth, 4'000);
  const ReferenceResult v = trace(scene, surface, 1024);
  EXPECT_EQ(v.samples, 1024);
  const double rms = rms_against(surface, v.visibility,
                                 [&](const Vec3& p) { return half_plane_area(delta_of_line(p, 0.0, z, r)); });
  std::printf("RMS difference %.4f\n", rms);
  EXPECT_LE(rms, kNoiseOfOneChord);
  EXPECT_GE(rms, 1e-4) << "1024 rays are noisy";
}

// A tilted edge: δ by the library's own plane, which has its own test.
TEST(Reference, TiltedEdgeIsTheChordFormula) {
  const double r = 0.8;
  const Vec3 a{-20, -3, 2}, b{20, 5, 7};
  const Scene scene = testing::scene_in_light_frame(r, {make_triangle(a, b, {0, -60, 4})});
  std::vector<Vec3> points;
  Random random(11);
  for (int i = 0; i < 4'000; ++i) points.push_back({random.uniform(-2, 2), random.uniform(1, 3), 10});
  const SurfaceBuffer surface = testing::receivers(points, kToLight, 4'000);
  const double rms = rms_against(surface, trace(scene, surface, 1024).visibility, [&](const Vec3& p) {
    const Chord c = chord_of_plane(edge_plane(p, a, b), p, r);
    const bool free_is_positive = glm::dot(edge_plane(p, a, b), Vec3(0, -60, 4) - p) < 0.0;
    return half_plane_area(free_is_positive ? c.delta : -c.delta);
  });
  std::printf("RMS difference %.4f\n", rms);
  EXPECT_LE(rms, kNoiseOfOneChord);
}

TEST(Reference, SlabLeavesTheDiskWithoutAStrip) {
  const double r = 0.8, z = 5.0, depth = 10.0, half = 0.15;
  const Scene scene = testing::scene_in_light_frame(r, {testing::rectangle(-half, half, -60, 60, z)});
  const SurfaceBuffer surface = line_of_receivers(-1.5, 1.5, depth, 4'000);
  const double rms = rms_against(surface, trace(scene, surface, 1024).visibility, [&](const Vec3& p) {
    return 1.0 - half_plane_area(delta_of_line(p, -half, z, r)) +
           half_plane_area(delta_of_line(p, half, z, r));
  });
  std::printf("RMS difference %.4f\n", rms);
  EXPECT_LE(rms, kNoiseOfOneChord * std::sqrt(2.0)) << "two chords";
}

/// Area common to two circles of radii r and s at distance d.
double lens(double r, double s, double d) {
  if (d >= r + s) return 0.0;
  if (d <= std::abs(r - s)) return kPi * std::min(r, s) * std::min(r, s);
  const double a = std::acos((d * d + r * r - s * s) / (2 * d * r)),
               b = std::acos((d * d + s * s - r * r) / (2 * d * s));
  return r * r * (a - 0.5 * std::sin(2 * a)) + s * s * (b - 0.5 * std::sin(2 * b));
}

TEST(Reference, DiskOverTheCenterIsTheLensOfTwoCircles) {
  const double r = 0.8, depth = 10.0, z = 4.0, caster = 0.3;
  std::vector<Vec3> points{{0, 0, z}};
  std::vector<IndexedTriangle> triangles;
  for (std::uint32_t k = 0; k < 512; ++k) {
    points.push_back({caster * std::cos(2 * kPi * k / 512), caster * std::sin(2 * kPi * k / 512), z});
    triangles.push_back({0, k + 1, (k + 1) % 512 + 1});
  }
  const Scene scene = testing::scene_in_light_frame(r, {testing::mesh_of(points, triangles)});
  const SurfaceBuffer surface = line_of_receivers(-2.5, 2.5, depth, 4'000);
  const double grow = depth / (depth - z);  // the caster's picture in the light's plane
  const double rms = rms_against(surface, trace(scene, surface, 1024).visibility, [&](const Vec3& p) {
    return 1.0 - lens(r, caster * grow, std::hypot(p.x, p.y) * (grow - 1.0)) / (kPi * r * r);
  });
  std::printf("RMS difference %.4f\n", rms);
  EXPECT_LE(rms, kNoiseOfOneChord) << "the circle's arc crosses no more strata than a chord";
  const SurfaceBuffer axis = testing::receivers({{0, 0, depth}}, kToLight, 1);
  EXPECT_NEAR(trace(scene, axis, 4096).visibility[0], 1.0 - std::pow(caster * grow / r, 2), 0.003);
}

// Past a line along y the share of a rectangle is linear, whatever its length across.
TEST(Reference, RectangleIsSampledEvenly) {
  const double z = 5.0, depth = 10.0;
  Scene scene = testing::scene_in_light_frame(1.0, {half_plane(z)});
  RectangleLight light{.center = {}, .normal = {0, 0, 1}, .tangent = {1, 0, 0}, .half_extents = {0.8, 0.3}};
  scene.lights.front().shape = light;
  const SurfaceBuffer surface = line_of_receivers(-1.0, 1.0, depth, 4'000);
  const double along = rms_against(surface, trace(scene, surface, 1024).visibility, [&](const Vec3& p) {
    return std::clamp(0.5 + 0.5 * delta_of_line(p, 0.0, z, 0.8), 0.0, 1.0);
  });
  light.tangent = {0, 1, 0};
  scene.lights.front().shape = light;
  const double across = rms_against(surface, trace(scene, surface, 1024).visibility, [&](const Vec3& p) {
    return std::clamp(0.5 + 0.5 * delta_of_line(p, 0.0, z, 0.3), 0.0, 1.0);
  });
  std::printf("RMS difference %.4f, %.4f\n", along, across);
  // 32 strata on the line: √(32/4)/1024, at worst.
  EXPECT_LE(std::max(along, across), 0.0028);
}

TEST(Reference, PenumbraHasTheWidthOfTwoCones) {
  const double r = 0.5, depth = 10.0;
  for (const double z : {2.0, 5.0, 9.0}) {
    const Scene scene = testing::scene_in_light_frame(r, {half_plane(z)});
    const double width = 2.0 * r * (depth - z) / z;
    const SurfaceBuffer surface = line_of_receivers(-0.75 * width, 0.75 * width, depth, 1'500);
    const Values v = trace(scene, surface, 1024).visibility;
    double first = 1e9, last = -1e9;
    for (std::size_t i = 0; i < v.size(); ++i) {
      const double x = surface.position[i].x;
      if (v[i] > 0.0f && v[i] < 1.0f) first = std::min(first, x), last = std::max(last, x);
      if (std::abs(x) > 0.501 * width) {
        ASSERT_EQ(v[i], x > 0.0 ? 1.0f : 0.0f) << x << " of " << width;
      }
    }
    // The last thousandth of the disk is 1.5% of its radius, and a row of receivers finds it now and then.
    EXPECT_LE(last - first, 1.002 * width) << z;
    EXPECT_GE(last - first, 0.97 * width) << z;
    EXPECT_NEAR(first + last, 0.0, 0.02 * width) << z;
  }
}

TEST(Reference, OfRadiusZeroIsTheHardShadow) {
  Scene scene = testing::data_scene("boxes-medium");
  testing::light_of(scene).radius = 0.0;
  const testing::View view(scene, 160, 120);
  const Pixels pixels = testing::every_pixel(view.surface);
  const Values hard =
      trace_hard(view.rays, testing::light_of(scene), view.surface.receivers(), pixels).visibility;
  EXPECT_EQ(view.trace(pixels, 16, 5), hard);
  EXPECT_GT(std::count(hard.begin(), hard.end(), 0.0f), 500);
  // And it is what a tiny disk tends to, but for the few pixels on a boundary.
  testing::light_of(scene).radius = 1e-6;
  const Values tiny = view.trace(pixels, 16, 5);
  std::size_t differing = 0;
  for (std::size_t i = 0; i < hard.size(); ++i) differing += hard[i] != tiny[i];
  EXPECT_LE(differing, 5u);
}

TEST(Reference, NothingIsLitOnOrBehindTheLightsPlane) {
  const Scene scene = testing::scene_in_light_frame(0.5, {half_plane(5)});
  const SurfaceBuffer surface =
      testing::receivers({{3, 0, 0}, {3, 0, -1e-9}, {0, 0, -4}, {9, 9, -2}, {3, 0, 1e-3}}, Vec3(-1, 0, 0), 5);
  const RayScene rays(scene, 1);
  const Pixels pixels = testing::every_pixel(surface);
  const ReferenceResult v =
      trace_reference(rays, testing::light_of(scene), surface.receivers(), pixels, {.samples = 64}, true);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(v.visibility[i], 0.0f) << i;
    EXPECT_EQ(v.unoccluded[i], 0.0f) << i;
    EXPECT_EQ(trace_hard(rays, testing::light_of(scene), surface.receivers(), pixels).visibility[i], 0.0f)
        << i;
  }
  EXPECT_EQ(v.visibility[4], 1.0f);
}

TEST(Reference, WithoutCastersIsTheHorizonsFraction) {
  Scene scene = testing::scene_in_light_frame(0.8, {half_plane(5)});
  scene.objects[0].casts = false;
  constexpr std::uint64_t kSeed = 42;
  Random random(kSeed);
  std::vector<Vec3> points, normals;
  while (points.size() < 4'000) {
    const Vec3 x{random.uniform(-1, 1), random.uniform(-1, 1), random.spread(0.3, 10)},
        n = random.direction();
    points.push_back(x);
    normals.push_back(n);
  }
  const SurfaceBuffer surface = testing::receivers(points, normals, 4'000);
  const RayScene rays(scene, 0);
  const ReferenceResult v = trace_reference(rays, testing::light_of(scene), surface.receivers(),
                                            testing::every_pixel(surface), {.samples = 1024}, true);
  double sum = 0.0;
  int cut = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double expected = fraction_above_horizon(testing::light_of(scene), points[i], normals[i]);
    if (expected == 0.0 || expected == 1.0) {
      ASSERT_EQ(v.visibility[i], static_cast<float>(expected)) << "seed " << kSeed << ", receiver " << i;
    } else {
      sum += (v.visibility[i] - expected) * (v.visibility[i] - expected);
      ++cut;
    }
    ASSERT_EQ(v.unoccluded[i], 1.0f) << "no caster, and O knows no horizon; seed " << kSeed << ", receiver "
                                     << i;
  }
  EXPECT_GT(cut, 300);
  EXPECT_LE(std::sqrt(sum / cut), kNoiseOfOneChord);
}

TEST(Reference, IsTheSameForAnyNumberOfThreads) {
  const Scene scene = testing::data_scene("foliage-medium");
  Values first;
  for (const int threads : {1, 2, 3}) {
    const testing::View view(scene, 100, 75, threads);
    const Values v = view.trace(testing::every_pixel(view.surface), 64, 9);
    if (first.empty()) first = v;
    EXPECT_EQ(v, first) << threads << " threads";
  }
}

TEST(Reference, SeedsAndPixelsHaveTheirOwnSamples) {
  const Scene scene = testing::scene_in_light_frame(0.8, {half_plane(5)});
  // The same point again and again: pixels differ by their noise alone.
  const SurfaceBuffer surface = testing::receivers(std::vector<Vec3>(400, {0.1, 0, 10}), kToLight, 400);
  const Values one = trace(scene, surface, 64, 1).visibility, two = trace(scene, surface, 64, 2).visibility;
  EXPECT_EQ(one, trace(scene, surface, 64, 1).visibility);
  double mean = 0.0, variance = 0.0, covariance = 0.0;
  const double truth = half_plane_area(delta_of_line({0.1, 0, 10}, 0.0, 5.0, 0.8));
  for (std::size_t i = 0; i < 400; ++i) {
    mean += one[i] / 400;
    variance += (one[i] - truth) * (one[i] - truth) / 400;
    covariance += (one[i] - truth) * (two[i] - truth) / 400;
  }
  EXPECT_NEAR(mean, truth, 4.0 * std::sqrt(variance / 400)) << "unbiased";
  EXPECT_GT(variance, 1e-5);
  EXPECT_LE(std::abs(covariance), 0.2 * variance) << "independent: four standard errors";
}

TEST(Reference, SinglesAreThePacketsRays) {
  const Scene scene = testing::data_scene("torus-medium");
  const testing::View view(scene, 80, 60);
  const Pixels pixels = testing::every_pixel(view.surface);
  const auto with = [&](bool packets) {
    return trace_reference(view.rays, testing::light_of(scene), view.surface.receivers(), pixels,
                           {.samples = 64, .packets = packets});
  };
  const ReferenceResult packets = with(true), singles = with(false);
  EXPECT_EQ(packets.rays, singles.rays);
  std::size_t differing = 0;
  for (std::size_t i = 0; i < pixels.size(); ++i) differing += packets.visibility[i] != singles.visibility[i];
  EXPECT_LE(differing, 2u) << "a ray through an edge may fall either way";
}

TEST(Reference, SamplesOutsideTheirRangeAreRefused) {
  const Scene scene = testing::scene_in_light_frame(0.8, {half_plane(5)});
  const SurfaceBuffer surface = line_of_receivers(-1, 1, 10, 4);
  EXPECT_THROW(trace(scene, surface, 0), UsageError);
  EXPECT_THROW(trace(scene, surface, (1 << 20) + 1), UsageError);
  for (const auto& [asked, used] : {std::pair{1, 1}, {2, 2}, {3, 3}, {5, 6}, {16, 16}, {17, 20}, {256, 256}})
    EXPECT_EQ(trace(scene, surface, asked).samples, used);
}

}  // namespace
}  // namespace penumbra
