// Entries that contradict each other: which pixels are sampled, and what the samples do for the picture.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>

#include "render/d_buffer/center_rays.h"
#include "render/d_buffer/d_buffer.h"
#include "render/d_buffer/resampler.h"
#include "render/d_buffer/visibility_pass.h"
#include "render/light/disk_area.h"
#include "tests/render/error_support.h"
#include "tests/render/render_support.h"

namespace penumbra {
namespace {

using testing::at_pixels;
using testing::Pixels;
using testing::Values;
using testing::View;

/// Receivers under a plate that hides the disk's half x < 0 from the middle one, all of it from the left one
/// and nothing from the right one.
struct HalfPlate {
  Scene scene = testing::scene_in_light_frame(1.0, {testing::rectangle(-20, 0, -20, 20, 2)});
  RayScene rays{scene, 0};
  SurfaceBuffer surface =
      testing::receivers({{-8, 0, 4}, {-0.2, 0, 4}, {0.2, 0, 4}, {8, 0, 4}}, Vec3(0, 0, -1), 4);
  CenterRays center{surface.receivers(), rays};
};

TEST(Resampler, SixteenRaysFindAHalfPlane) {
  const HalfPlate under;
  const std::uint32_t pixels[] = {3, 1, 0, 2};
  Values seen;
  for (const SeenPoints& points : under.center.seen_points(testing::light_of(under.scene), pixels)) {
    EXPECT_EQ(points.traced, 0xffff);
    seen.push_back(static_cast<float>(std::popcount(points.seen)) / 16.0f);
  }
  EXPECT_EQ(seen[0], 1.0f);
  EXPECT_EQ(seen[2], 0.0f);
  // The plate at half the height hides x < -δ of the disk, δ = -0.2 and 0.2.
  EXPECT_NEAR(seen[1], half_plane_area(-0.2), 0.145);
  EXPECT_NEAR(seen[3], half_plane_area(0.2), 0.145);
}

/// An image of one plane, seen from above.
struct Plane {
  Plane(int columns, int rows) : width(columns), height(rows) {
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) positions.emplace_back(x, y, 0.0);
    normals.assign(positions.size(), Vec3(0.0, 0.0, 1.0));
    objects.assign(positions.size(), 0);
    open.assign(positions.size(), 1.0f);
  }
  detail::ImageSurface image() const {
    return {{.points = positions, .normals = normals, .objects = objects, .width = width, .height = height},
            open};
  }
  int width, height;
  std::vector<Vec3> positions, normals;
  std::vector<std::int32_t> objects;
  Values open;
};

/// Samples what is true and remembers which pixels were sampled. Samples deny entries that they differ from
/// by `least`.
struct Oracle {
  Values truth;
  float least = 1e-6f;
  std::vector<std::uint32_t> sampled{}, thoroughly{};
  /// What all points say; empty: the same.
  Values by_all{};
  /// `entries` stay as they are.
  detail::SampleVisibility sample(const Values& entries) {
    return [this, entries](std::span<const std::uint32_t> pixels, detail::SamplePoints points) {
      const bool all = points == detail::SamplePoints::kAll;
      auto& list = all ? thoroughly : sampled;
      list.insert(list.end(), pixels.begin(), pixels.end());
      const Values& seen = all && !by_all.empty() ? by_all : truth;
      std::vector<detail::RaySample> out;
      for (const std::uint32_t i : pixels) {
        const bool denies = std::abs(seen[i] - entries[i]) > least;
        out.push_back({denies ? seen[i] : entries[i], denies});
      }
      return out;
    };
  }
};

TEST(Resampler, AHoleInAPenumbraIsFilledFromItsBorder) {
  const Plane plane(24, 20);
  Oracle oracle{Values(24 * 20)};
  for (std::size_t i = 0; i < oracle.truth.size(); ++i) oracle.truth[i] = static_cast<float>(i % 24) / 24.0f;
  Values v = oracle.truth;
  for (std::size_t y = 5; y < 15; ++y)
    for (std::size_t x = 6; x < 18; ++x) v[y * 24 + x] = 0.0f;
  const std::size_t count = detail::Resampler().resample(plane.image(), {}, oracle.sample(v), v);
  for (std::size_t i = 0; i < v.size(); ++i)
    EXPECT_NEAR(v[i], oracle.truth[i], detail::kDiscontinuity) << "pixel " << i;
  EXPECT_EQ(count, oracle.sampled.size());
  std::sort(oracle.sampled.begin(), oracle.sampled.end());
  EXPECT_EQ(std::unique(oracle.sampled.begin(), oracle.sampled.end()), oracle.sampled.end())
      << "sampled twice";
  EXPECT_LE(count, 14u * 12u + 6u) << "the hole, what is around it, and probe pixels";
}

/// Samples an oracle that agrees with the entries: nothing but probe pixels, which change nothing.
void expect_no_jump(const Plane& plane, const Values& entries) {
  Oracle oracle{entries};
  Values v = entries;
  detail::Resampler().resample(plane.image(), {}, oracle.sample(v), v);
  for (const std::uint32_t i : oracle.sampled)
    EXPECT_TRUE(i % 24 % 8 == 4 && i / 24 % 8 == 4) << "pixel " << i << " is no probe pixel";
  EXPECT_EQ(v, entries);
}

TEST(Resampler, SlopesAndEdgesOfSurfacesAreNoJumps) {
  Plane plane(24, 20);
  Values slope(24 * 20), edge(24 * 20);
  for (std::size_t i = 0; i < slope.size(); ++i) {
    slope[i] = std::clamp(0.15f * static_cast<float>(i % 24) - 1.0f, 0.0f, 1.0f);
    edge[i] = i % 24 < 12 ? 0.0f : 1.0f;
  }
  expect_no_jump(plane, slope);
  for (std::size_t i = 0; i < edge.size(); ++i)
    if (edge[i] > 0.0f) plane.positions[i].z = 7.0;  // another surface
  expect_no_jump(plane, edge);
}

TEST(Resampler, AJumpOfTheHorizonAloneIsNone) {
  Plane plane(24, 20);
  for (std::size_t i = 0; i < plane.open.size(); ++i) plane.open[i] = i % 24 < 12 ? 0.4f : 1.0f;
  expect_no_jump(plane, plane.open);
}

TEST(Resampler, SamplesThatAgreeChangeNothing) {
  const Plane plane(24, 20);
  Values edge(24 * 20);
  for (std::size_t i = 0; i < edge.size(); ++i) edge[i] = i % 24 < 12 ? 0.0f : 0.9f;
  Oracle oracle{edge, 0.05f};
  for (float& value : oracle.truth) value += 0.01f;
  Values v = edge;
  EXPECT_EQ(detail::Resampler().resample(plane.image(), {}, oracle.sample(v), v), 2u * 20u + 4u)
      << "both sides of the jump, and probe pixels";
  EXPECT_EQ(v, edge);
}

TEST(Resampler, EntriesThatAreWrongAllOverAreFound) {
  const Plane plane(24, 20);
  for (const float entry : {0.0f, 0.5f, 1.0f}) {
    Oracle oracle{Values(24 * 20, 0.75f)};
    Values v(24 * 20, entry);
    EXPECT_EQ(detail::Resampler().resample(plane.image(), {}, oracle.sample(v), v), v.size());
    for (std::size_t y = 1; y < 19; ++y)
      for (std::size_t x = 1; x < 23; ++x) EXPECT_FLOAT_EQ(v[y * 24 + x], 0.75f) << "from " << entry;
  }
}

TEST(Resampler, AProbePixelThatErrsByItsNoiseChangesNothing) {
  const Plane plane(24, 20);
  Oracle oracle{Values(24 * 20, 0.5f)};
  oracle.by_all = oracle.truth;
  oracle.truth[12 * 24 + 12] = 0.6f;
  Values v(24 * 20, 0.5f);
  EXPECT_EQ(detail::Resampler().resample(plane.image(), {}, oracle.sample(v), v), 6u + 8u)
      << "all, and the neighbors of one";
  for (std::size_t i = 0; i < v.size(); ++i) EXPECT_NEAR(v[i], 0.5f, 0.025f) << "pixel " << i;
}

/// What each of three by three pixels errs by, 0 in sum.
float noise_of(std::size_t x, std::size_t y) {
  constexpr float kNoise[9] = {0.06f, -0.05f, 0.02f, -0.07f, 0.03f, 0.05f, -0.03f, -0.05f, 0.04f};
  return kNoise[y % 3 * 3 + x % 3];
}

/// A slope under a plate's edge, entries that deny it, and noisy samples: how far the picture is off then,
/// away from its border and on either side of the edge's ends.
float worst_after_noisy_samples(const Plane& plane, const Values& truth) {
  Oracle oracle{truth};
  const auto width = static_cast<std::size_t>(plane.width);
  for (std::size_t i = 0; i < truth.size(); ++i) oracle.truth[i] += noise_of(i % width, i / width);
  Values v(truth.size());
  for (std::size_t i = 0; i < v.size(); ++i) v[i] = i % width < width / 2 ? 0.2f : 0.8f;
  detail::Resampler().resample(plane.image(), {}, oracle.sample(v), v);
  float worst = 0.0f;
  for (std::size_t y = 2; y + 2 < static_cast<std::size_t>(plane.height); ++y)
    for (std::size_t x = width / 2 - 4; x < width / 2 + 4; ++x)
      worst = std::max(worst, std::abs(v[y * width + x] - truth[y * width + x]));
  return worst;
}

TEST(Resampler, NoiseOfSamplesIsAveragedOnFlatGroundOnly) {
  Plane plane(24, 20);
  Values slope(24 * 20);
  for (std::size_t i = 0; i < slope.size(); ++i) slope[i] = 0.02f * static_cast<float>(i % 24) + 0.27f;
  EXPECT_LT(worst_after_noisy_samples(plane, slope), 0.01f);
  for (std::size_t i = 0; i < plane.normals.size(); ++i) {
    const double turn = 0.1 * static_cast<double>(i % 24) + 0.1 * static_cast<double>(i / 24 % 2);
    plane.normals[i] = Vec3(0.0, std::sin(turn), std::cos(turn));
  }
  EXPECT_GT(worst_after_noisy_samples(plane, slope), 0.05f);
}

// Without neighbors to average with it takes more points.
TEST(Resampler, ThePicturesBorderIsNoNoisierThanTheInside) {
  const Plane plane(24, 20);
  const Values truth(24 * 20, 0.5f);
  Oracle oracle{truth};
  oracle.by_all = truth;
  for (std::size_t i = 0; i < truth.size(); ++i) oracle.truth[i] += noise_of(i % 24, i / 24);
  Values v(24 * 20, 0.8f);
  detail::Resampler().resample(plane.image(), {}, oracle.sample(v), v);
  for (std::size_t y = 0; y < 20; ++y)
    for (std::size_t x = 0; x < 24; ++x) {
      const bool at_border = x == 0 || x == 23 || y == 0 || y == 19;
      EXPECT_NEAR(v[y * 24 + x], 0.5f, at_border ? 1e-5f : 0.015f) << x << ", " << y;
    }
  EXPECT_EQ(oracle.thoroughly.size(), 2u * 24u + 2u * 18u) << "the border alone";
}

TEST(Resampler, WhatNoNeighborCanContradictIsSampledAlways) {
  Plane plane(24, 20);
  const auto turn = [&](std::uint32_t pixel) { plane.normals[pixel] = Vec3(1.0, 0.0, 0.0); };
  EXPECT_TRUE(detail::isolated_pixels(plane.image()).empty());
  const std::uint32_t leaf = 5 * 24 + 7, twig = 12 * 24 + 3;
  turn(leaf);
  for (std::uint32_t k = 0; k < 3; ++k) {  // one above the other: the middle one has two neighbors
    turn(twig + k * 24);
    plane.positions[twig + k * 24].x = 3.0;
  }
  plane.objects[0] = -1;
  const std::vector<std::uint32_t> isolated{leaf, twig, twig + 2 * 24};
  EXPECT_EQ(detail::isolated_pixels(plane.image()), isolated);
  Oracle oracle{Values(24 * 20, 0.3f)};
  Values v(24 * 20, 0.3f);
  v[leaf] = 1.0f;
  EXPECT_EQ(detail::Resampler().resample(plane.image(), isolated, oracle.sample(v), v), isolated.size() + 6u)
      << "these, and probe pixels";
  EXPECT_EQ(v, oracle.truth);
}

TEST(UncertainPixels, AreThoseOfEitherEntry) {
  const auto use = [](bool uncertain) { return detail::EntryUse{uncertain ? 0x5au : 0x52u}; };
  const std::vector<detail::EntryUse> uses{use(false), {}, use(true), {}, {}, {}, use(false), use(true)};
  EXPECT_EQ(detail::uncertain_pixels(uses), (std::vector<std::uint32_t>{1, 3}));
}

TEST(Resampler, LessensTheError) {
  const auto context = gl::make_context(gl::Backend::kOsMesa);
  for (const char* name : {"bunny-small", "knot1-medium", "armadillo-medium", "foliage-medium"}) {
    const Scene scene = testing::data_scene(name);
    const View view(scene, 240, 180);
    DBuffer buffer(*context, scene, view.rays);
    buffer.set_surface(view.surface.receivers());
    const Pixels near = view.near_penumbra(testing::every_pixel(view.surface));
    const Values one = view.trace(near, 256, 21), two = view.trace(near, 256, 22);
    const auto rmse = [&](EntryCheck check, int entries) {
      const Values v =
          buffer.render(testing::light_of(scene), {.entries = entries, .check = check}).visibility;
      return testing::penumbra_error(at_pixels(v, near), one, two).rmse;
    };
    const double with = rmse(EntryCheck::kRays, 1), without = rmse(EntryCheck::kNone, 1);
    const double by_two = rmse(EntryCheck::kRays, 2);
    std::printf("%-18s RMSE %.4f, without: %.4f; two entries %.4f\n", name, with, without, by_two);
    EXPECT_LT(with, 0.5 * without) << name;
    EXPECT_LT(by_two, 1.2 * with) << name;
  }
}

// Where penumbras are a few pixels wide samples are noisier than entries that are exact.
TEST(Resampler, NeverMakesAPictureWorse) {
  const auto context = gl::make_context(gl::Backend::kOsMesa);
  for (const char* name : {"triangle-small", "speck-small", "cube-small", "sphere-small", "torus-small",
                           "boxes-small", "figure7", "cube-medium"}) {
    const Scene scene = testing::data_scene(name);
    const View view(scene, 160, 120);
    DBuffer buffer(*context, scene, view.rays);
    buffer.set_surface(view.surface.receivers());
    const Values truth = view.see_silhouettes().visibility;
    const auto rmse = [&](EntryCheck check) {
      const Values v = buffer.render(testing::light_of(scene), {.check = check}).visibility;
      double squares = 0.0;
      std::size_t count = 0;
      for (std::size_t i = 0; i < v.size(); ++i) {
        if (!(truth[i] > 0.0f && truth[i] < 1.0f)) continue;
        squares += (v[i] - truth[i]) * (v[i] - truth[i]);
        ++count;
      }
      return std::sqrt(squares / static_cast<double>(count));
    };
    const double with = rmse(EntryCheck::kRays), without = rmse(EntryCheck::kNone);
    std::printf("%-18s RMSE %.5f, without: %.5f\n", name, with, without);
    EXPECT_LE(with, 1.05 * without + 1e-6) << name;
  }
}

}  // namespace
}  // namespace penumbra
