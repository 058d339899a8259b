// More samples a pixel: the mean that they should have, and nothing else that changes.
#include "render/antialias.h"

#include <gtest/gtest.h>

#include "penumbra/mesh/error.h"
#include "penumbra/render/renderer.h"
#include "tests/render/draft_options.h"
#include "tests/render/render_support.h"

namespace penumbra {
namespace {

using testing::Values;

TEST(SamplesOfPixel, AreCentersOfEqualSquares) {
  const auto four = detail::samples_of_pixel(2);
  ASSERT_EQ(four.size(), 4u);
  EXPECT_EQ(four[1].x, 0.75);
  EXPECT_EQ(four[1].y, 0.25);
  for (int n = 1; n <= kMostAntialias; ++n) {
    const auto samples = detail::samples_of_pixel(n);
    EXPECT_EQ(samples.size(), static_cast<std::size_t>(n * n));
    EXPECT_EQ(std::ranges::count_if(samples, &PointInPixel::is_center), n % 2) << n;
  }
}

TEST(ColorSums, OfEqualValuesHaveThatMean) {
  testing::Random random(5);
  Colors colors;
  for (auto* channel : {&colors.r, &colors.g, &colors.b, &colors.a})
    for (int i = 0; i < 1'000; ++i) channel->push_back(static_cast<float>(random.spread(1e-30, 1e30)));
  for (const int count : {1, 3, 7, 9, 49, 225, 256}) {
    detail::ColorSums sums(colors.r.size());
    for (int k = 0; k < count; ++k) sums.add(colors);
    Image image{.width = 1'000, .height = 1, .channels = {}};
    for (const char* name : {"R", "G", "B", "A"}) image.add(name);
    sums.write_means(image);
    EXPECT_EQ(image.at("R"), colors.r) << count;
    EXPECT_EQ(image.at("A"), colors.a) << count;
  }
}

/// A wall in z = 0 from x = -9 to `edge`; the camera sees 4×4 pixels of side 1 of it, x and y from -2 to 2.
Scene wall_up_to(double edge) {
  Scene scene;
  scene.lights.push_back({.name = {}, .shape = DiskLight{{0, 0, 9}, {0, 0, -1}, 1.0}, .radiance = Vec3(0.0)});
  scene.objects.push_back(
      {.name = "wall", .mesh = testing::rectangle(-9, edge, -9, 9, 0), .albedo = Vec3(0.3)});
  scene.camera = {.eye = {0, 0, 8}, .fov_y_degrees = 2.0 * std::atan(0.25) * 180.0 / testing::kPi};
  scene.picture.ambient = Vec3(0.7);
  return scene;
}

RenderOptions options_with(int antialias, const std::string& method = "none", int width = 4, int height = 4) {
  RenderOptions options;
  options.method = method;
  options.width = width;
  options.height = height;
  options.antialias = antialias;
  return options;
}

// Fill light alone is the same all over the wall.
TEST(Antialias, OfAConstantIsTheConstant) {
  const Scene scene = wall_up_to(9);
  const Image one = render(scene, options_with(1)).image;
  const float constant = one.at("R")[0];
  EXPECT_FLOAT_EQ(constant, static_cast<float>(0.3 * 0.7 * 0.75));
  for (const int n : {2, 3, 5, 16})
    EXPECT_EQ(render(scene, options_with(n)).image.channels, one.channels) << n;
}

// The wall ends 0.3 of a pixel behind the left border of the third one.
TEST(Antialias, CountsTheSamplesThatSeeASurface) {
  const Scene scene = wall_up_to(0.3);
  const struct {
    int n;
    float alpha;
  } kCases[] = {{1, 0.0f}, {2, 0.5f}, {3, 1.0f / 3.0f}, {4, 0.25f}, {10, 0.3f}};
  for (const auto& [n, alpha] : kCases) {
    const Image image = render(scene, options_with(n)).image;
    for (std::size_t row = 0; row < 4; ++row) {
      EXPECT_EQ(image.at("A")[4 * row + 1], 1.0f);
      EXPECT_FLOAT_EQ(image.at("A")[4 * row + 2], alpha) << n;
      EXPECT_FLOAT_EQ(image.at("G")[4 * row + 2], alpha * static_cast<float>(0.3 * 0.7 * 0.75))
          << "multiplied by A";
      EXPECT_EQ(image.at("A")[4 * row + 3], 0.0f);
      EXPECT_EQ(image.at("object")[4 * row + 2], -1.0f) << "what the center sees";
    }
  }
}

/// Means over n × n pixels.
Values boxes_of(const Values& fine, int width, int n) {
  Values out;
  const auto w = static_cast<std::size_t>(width), k = static_cast<std::size_t>(n),
             rows = fine.size() / (w * k * k);
  for (std::size_t y = 0; y < rows; ++y)
    for (std::size_t x = 0; x < w; ++x) {
      double sum = 0.0;
      for (std::size_t j = 0; j < k; ++j)
        for (std::size_t i = 0; i < k; ++i) sum += static_cast<double>(fine[(y * k + j) * w * k + x * k + i]);
      out.push_back(static_cast<float>(sum / static_cast<double>(k * k)));
    }
  return out;
}

/// Pixels that differ by more than rounding: a sample's ray is the same one but for its last bits.
std::size_t differing(const Values& a, const Values& b) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.size(); ++i) count += std::abs(a[i] - b[i]) > 1e-5f;
  return count;
}

// A picture with as many times more pixels has the same samples.
TEST(Antialias, IsALargerPictureMadeSmaller) {
  Scene scene = testing::data_scene("torus-medium");
  scene.picture.ambient = Vec3(0.1);
  for (const char* method : {"none", "hard", "silhouette"})
    for (const int n : {2, 3}) {
      const Image fine = render(scene, options_with(1, method, 40 * n, 30 * n)).image,
                  image = render(scene, options_with(n, method, 40, 30)).image;
      for (const char* channel : {"R", "B", "A"})
        EXPECT_LE(differing(image.at(channel), boxes_of(fine.at(channel), 40, n)), 2u)
            << method << ", " << n << ", " << channel;
    }
}

TEST(Antialias, ChangesNoMeasuredChannelOfAnyMethod) {
  register_drawing_methods();
  Scene scene = testing::data_scene("torus-medium");
  for (const MethodInfo& method : methods()) {
    RenderOptions options = options_with(1, method.name, 40, 30);
    options.options = testing::drafts_of(method.name);
    const auto plain = render(scene, options).image.channels;
    Scene adorned = scene;
    adorned.picture.ambient = Vec3(0.2);
    adorned.objects[0].shadow_catcher = true;
    for (const int n : {2, 3}) {
      options.antialias = n;
      const RenderResult result = render(adorned, options);
      EXPECT_EQ(result.antialias, n);
      for (const auto& [name, values] : plain)
        if (name.size() > 1) {
          EXPECT_EQ(result.image.at(name), values) << method.name << ", " << name;
        }
      EXPECT_NE(result.image.at("A"), plain.at("A")) << method.name;
    }
  }
}

// Else every sample of a pixel would see the same noise, and the mean of nine would have it too.
TEST(Antialias, TakesAnotherSeedForEachSample) {
  const Scene scene = testing::data_scene("cube-large");
  const auto noise_of = [&](int n) {
    RenderOptions options = options_with(n, "reference", 60, 45);
    options.options = {{"samples", std::uint64_t{1}}};
    const Values noisy = render(scene, options).image.at("G"),
                 exact = render(scene, options_with(n, "silhouette", 60, 45)).image.at("G");
    double sum = 0.0;
    for (std::size_t i = 0; i < noisy.size(); ++i) sum += std::pow(noisy[i] - exact[i], 2);
    return sum;
  };
  EXPECT_LT(noise_of(3), 0.2 * noise_of(1)) << "a ninth of the variance";
}

TEST(Antialias, IsRefusedOutsideItsRange) {
  const Scene scene = wall_up_to(9);
  for (const int n : {-1, 0, kMostAntialias + 1})
    EXPECT_THROW(render(scene, options_with(n)), UsageError) << n;
}

TEST(Antialias, ReportsAllFramesAndCanBeStopped) {
  const Scene scene = testing::data_scene("torus-medium");
  RenderOptions options = options_with(2, "silhouette", 40, 30);
  std::vector<double> fractions;
  options.progress = [&](double f) {
    fractions.push_back(f);
    return true;
  };
  render(scene, options);
  EXPECT_TRUE(std::ranges::is_sorted(fractions));
  EXPECT_EQ(fractions.back(), 1.0);
  EXPECT_GT(std::ranges::count_if(fractions, [](double f) { return f > 0.2 && f < 0.99; }), 3);
  options.progress = [](double f) { return f < 0.5; };
  EXPECT_THROW(render(scene, options), Cancelled);
}

}  // namespace
}  // namespace penumbra
