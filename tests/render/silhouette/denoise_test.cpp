// rays --denoise: what it may change, what it must not, and what it gains.
#include "render/silhouette/denoise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

#include "penumbra/mesh/error.h"
#include "penumbra/render/renderer.h"
#include "tests/render/error_support.h"

namespace penumbra {
namespace {

constexpr int kSide = 48;

/// Pixels that see the plane z = 0 from above; object 1 in the right half.
struct Plane {
  std::vector<Vec3> points, normals;
  std::vector<std::int32_t> objects;
  std::vector<std::uint32_t> faces, all;

  Plane() {
    for (int y = 0; y < kSide; ++y)
      for (int x = 0; x < kSide; ++x) {
        points.emplace_back(x, y, 0.0);
        normals.emplace_back(0.0, 0.0, 1.0);
        objects.push_back(x < kSide / 2 ? 0 : 1);
        faces.push_back(0);
        all.push_back(static_cast<std::uint32_t>(all.size()));
      }
  }
  Receivers receivers() const { return {points, normals, objects, faces, kSide, kSide, 0}; }
};

std::vector<float> filtered(const Receivers& receivers, const std::vector<float>& noisy,
                            const std::vector<std::uint32_t>& open, const DenoiseOptions& options = {}) {
  tbb::task_arena threads(2);
  return denoise(receivers, noisy, open, options, threads);
}

double spread(const std::vector<float>& values, float about) {
  double sum = 0.0;
  for (const float v : values) sum += std::pow(static_cast<double>(v - about), 2);
  return std::sqrt(sum / static_cast<double>(values.size()));
}

/// As n strata of which √n are crossed.
std::vector<float> noisy_values(float p, int samples) {
  std::mt19937 random(7);
  std::normal_distribution<float> noise(
      0.0f, std::sqrt(p * (1.0f - p)) * std::pow(static_cast<float>(samples), -0.75f));
  std::vector<float> out(kSide * kSide);
  for (float& v : out) v = std::clamp(p + noise(random), 0.0f, 1.0f);
  return out;
}

TEST(Denoise, TakesNoiseFromAPlane) {
  const Plane plane;
  const std::vector<float> noisy = noisy_values(0.4f, 16);
  const std::vector<float> out = filtered(plane.receivers(), noisy, plane.all);
  EXPECT_GT(spread(noisy, 0.4f), 0.05);
  EXPECT_LT(spread(out, 0.4f), 0.2 * spread(noisy, 0.4f));
}

TEST(Denoise, KeepsWhatIsExact) {
  const Plane plane;
  const std::vector<float> noisy = noisy_values(0.4f, 16);
  std::vector<std::uint32_t> open;
  for (const std::uint32_t i : plane.all)
    if (i % 3 == 0) open.push_back(i);
  const std::vector<float> out = filtered(plane.receivers(), noisy, open);
  std::size_t changed = 0;
  for (const std::uint32_t i : plane.all) {
    if (i % 3 != 0) {
      EXPECT_EQ(out[i], noisy[i]) << i;
    }
    changed += out[i] != noisy[i];
  }
  EXPECT_GT(changed, open.size() / 2);
  EXPECT_EQ(filtered(plane.receivers(), noisy, {}), noisy);
}

TEST(Denoise, DoesNotMixSurfaces) {
  Plane plane;
  std::vector<float> step;
  for (const std::int32_t object : plane.objects) step.push_back(object == 0 ? 0.3f : 0.6f);
  const auto expect_kept = [&] {
    const std::vector<float> out = filtered(plane.receivers(), step, plane.all, {.samples = 1});
    for (const std::uint32_t i : plane.all) EXPECT_NEAR(out[i], step[i], 2e-3f) << i;
  };
  expect_kept();  // another object
  for (std::size_t i = 0; i < plane.objects.size(); ++i) {
    if (plane.objects[i] == 1) plane.normals[i] = Vec3(0.6, 0.0, 0.8);
    plane.objects[i] = 0;
  }
  expect_kept();  // another normal
  for (std::size_t i = 0; i < plane.normals.size(); ++i) {
    plane.normals[i] = Vec3(0.0, 0.0, 1.0);
    if (step[i] > 0.5f) plane.points[i].z = 1000.0;
  }
  expect_kept();  // another plane
}

TEST(Denoise, NeedsPixels) {
  const Plane plane;
  const std::vector<float> noisy(plane.all.size(), 0.5f);
  Receivers points = plane.receivers();
  points.width = points.height = 0;
  EXPECT_THROW(filtered(points, noisy, plane.all), UsageError);
  Receivers bare = plane.receivers();
  bare.normals = {};
  EXPECT_THROW(filtered(bare, noisy, plane.all), UsageError);
}

// Of real penumbras, wide ones, where noise is most of the error.
TEST(Denoise, HelpsFewRays) {
  const Scene scene = testing::data_scene("torus-medium");
  const testing::View view(scene, 320, 240);
  const testing::Pixels pixels = view.near_penumbra(testing::every_pixel(view.surface));
  const testing::Values r1 = view.trace(pixels, 1024, 101), r2 = view.trace(pixels, 1024, 102);
  const auto rmse = [&](const char* denoised) {
    const RenderResult frame =
        render(scene, {.method = "rays",
                       .options = {{"samples", std::uint64_t{16}}, {"denoise", std::string(denoised)}},
                       .width = 320,
                       .height = 240});
    testing::Values values;
    for (const std::uint32_t i : pixels) values.push_back(frame.lights.front().visibility[i]);
    return testing::penumbra_error(values, r1, r2).rmse;
  };
  const double off = rmse("off"), on = rmse("a-trous");
  std::printf("16 rays: %.4f, filtered %.4f\n", off, on);
  EXPECT_LT(on, 0.6 * off);  // at 320x240 half: what is left is blur
}

}  // namespace
}  // namespace penumbra
