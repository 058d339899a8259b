// Fill light, fading and shadow catchers: exact values, and no other channel that changes.
#include "render/shading/fill_and_fade.h"

#include <gtest/gtest.h>

#include "render/light/light_integrals.h"
#include "render/shading/shading.h"
#include "tests/render/render_support.h"

namespace penumbra {
namespace {

using testing::kPi;
using testing::Values;

constexpr float kVisibility[] = {1.0f, 0.75f, 0.25f, 0.0f};

/// A floor 4 in front of the light that faces it, and one receiver for each visibility, at x.
struct Floor {
  Scene scene = testing::scene_in_light_frame(0.5, {testing::rectangle(-3, 1, -1, 1, 4)});
  Vec3 x{0.5, 0.25, 4};
  Values visibility{std::begin(kVisibility), std::end(kVisibility)};

  Floor() {
    scene.objects[0].albedo = {0.2, 0.4, 0.8};
    scene.lights.front().radiance = {3, 5, 7};
    scene.camera.up = {0, 3, 0};
  }
  SurfaceBuffer surface(const Vec3& normal = {0, 0, -1}) const {
    return testing::receivers(std::vector<Vec3>(visibility.size(), x), normal, 2);
  }
  Image shaded(const Vec3& normal = {0, 0, -1}) const {
    return shade(scene, surface(normal), std::vector<LightVisibility>{{visibility, {}}},
                 detail::make_threads(1));
  }
  double direct(int k) const {
    return scene.objects[0].albedo[k] / kPi * scene.lights[0].radiance[k] *
           disk_irradiance_factor(testing::light_of(scene), x, {0, 0, -1});
  }
};

const char* const kColors[] = {"R", "G", "B"};
const char* const kMeasured[] = {"visibility", "region", "object", "P.X", "P.Y", "P.Z", "N.X", "N.Y", "N.Z"};

// By the quadrature that defines it: the cosine-weighted half-space of the normal, sky above the horizon.
TEST(SkyFactor, IsTheIntegralOverSkyAndGround) {
  const Vec3 up{0, 1, 0};
  for (const double tilt : {0.0, 30.0, 90.0, 150.0, 180.0}) {
    const Vec3 n{std::sin(tilt * kPi / 180), std::cos(tilt * kPi / 180), 0}, side{n.y, -n.x, 0}, w{0, 0, 1};
    constexpr int kRings = 400, kSectors = 800;
    double sum = 0.0;
    for (int i = 0; i < kRings; ++i)
      for (int j = 0; j < kSectors; ++j) {  // rings of equal cosine-weighted solid angle
        const double r = std::sqrt((i + 0.5) / kRings), a = 2 * kPi * (j + 0.5) / kSectors;
        const Vec3 d = r * std::cos(a) * side + r * std::sin(a) * w + std::sqrt(1 - r * r) * n;
        sum += d.y > 0.0 ? 1.0 : 0.5;
      }
    EXPECT_NEAR(detail::sky_factor(n, up), sum / (kRings * kSectors), 1e-3) << tilt;
  }
}

TEST(FillLight, IsAddedWhateverHidesTheLight) {
  Floor floor;
  const Image without = floor.shaded();
  floor.scene.picture.ambient = {0.1, 0.2, 0.3};
  const Image with = floor.shaded();
  for (int k = 0; k < 3; ++k)
    for (std::size_t i = 0; i < 4; ++i) {
      const double fill = floor.scene.objects[0].albedo[k] * floor.scene.picture.ambient[k] * 0.75;
      EXPECT_NEAR(with.at(kColors[k])[i], floor.direct(k) * kVisibility[i] + fill, 1e-7);
    }
  for (const char* channel : kMeasured) EXPECT_EQ(with.at(channel), without.at(channel)) << channel;
  EXPECT_EQ(with.at("A"), without.at("A"));
}

TEST(FillLight, ComesFromAbove) {
  Floor floor;
  floor.scene.picture.ambient = Vec3(0.5);
  floor.visibility.assign(4, 0.0f);
  for (const auto& [normal, factor] :
       {std::pair(Vec3(0, 1, 0), 1.0), std::pair(Vec3(0, -1, 0), 0.5), std::pair(Vec3(1, 0, 0), 0.75)})
    EXPECT_NEAR(floor.shaded(normal).at("B")[0], 0.8 * 0.5 * factor, 1e-7);
}

// The floor's middle is (-1, 0, 4).
TEST(Fading, IsBetweenItsDistancesFromTheMiddle) {
  Floor floor;
  floor.visibility.assign(4, 1.0f);
  const Image solid = floor.shaded();
  floor.scene.objects[0].fade = {1.0, 3.0};
  SurfaceBuffer surface = floor.surface();
  const double distances[] = {1.0, 1.5, 2.0, 3.0}, opacity[] = {1.0, 0.84375, 0.5, 0.0};
  for (std::size_t i = 0; i < 4; ++i) surface.position[i] = {-1 + distances[i], 0, 4};
  Scene opaque = floor.scene;
  opaque.objects[0].fade = {};
  const std::vector<LightVisibility> seen = {{floor.visibility, {}}};
  const Image faded = shade(floor.scene, surface, seen, detail::make_threads(1)),
              full = shade(opaque, surface, seen, detail::make_threads(1));
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_FLOAT_EQ(faded.at("A")[i], static_cast<float>(opacity[i]));
    for (const char* color : kColors)
      EXPECT_NEAR(faded.at(color)[i], full.at(color)[i] * opacity[i], 1e-7) << "multiplied by A";
  }
  for (const char* channel : kMeasured) EXPECT_EQ(faded.at(channel), full.at(channel)) << channel;
}

TEST(ShadowCatcher, IsAsOpaqueAsTheShadowIsDark) {
  Floor floor;
  const Image before = floor.shaded();
  floor.scene.objects[0].shadow_catcher = true;
  const Image image = floor.shaded();
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_FLOAT_EQ(image.at("A")[i], 1.0f - kVisibility[i]) << "V_h is 1";
    for (const char* color : kColors) EXPECT_EQ(image.at(color)[i], 0.0f);
  }
  for (const char* channel : kMeasured) EXPECT_EQ(image.at(channel), before.at(channel)) << channel;
}

// Half of the light is below the horizon, which is no shadow.
TEST(ShadowCatcher, TakesTheHorizonForNoShadow) {
  Floor floor;
  floor.scene.objects[0].shadow_catcher = true;
  floor.x = {0, 0, 4};
  floor.visibility = {0.5f, 0.25f, 0.0f, 0.5f};
  EXPECT_EQ(floor.shaded({1, 0, 0}).at("A"), (Values{0.0f, 0.5f, 1.0f, 0.0f}));
}

TEST(ShadowCatcher, IsPalerByFillLight) {
  Floor floor;
  floor.scene.objects[0].shadow_catcher = true;
  floor.scene.picture.ambient = {0.1, 0.2, 0.3};
  const Image image = floor.shaded();
  Vec3 direct, fill;
  for (int k = 0; k < 3; ++k) {
    direct[k] = floor.direct(k);
    fill[k] = floor.scene.objects[0].albedo[k] * floor.scene.picture.ambient[k] * 0.75;
  }
  const double share = detail::luminance(direct) / detail::luminance(direct + fill);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(image.at("A")[i], (1 - kVisibility[i]) * share, 1e-6);
}

TEST(ShadowCatcher, ShowsNothingWhereThereIsNoLight) {
  Floor floor;
  floor.scene.objects[0].shadow_catcher = true;
  floor.visibility.assign(4, 0.0f);
  floor.x = {0, 0, -1};
  EXPECT_EQ(floor.shaded().at("A"), Values(4, 0.0f)) << "behind the light";
  floor.scene.picture.ambient = Vec3(0.2);
  EXPECT_EQ(floor.shaded().at("A"), Values(4, 0.0f)) << "fill light alone has no shadow";
}

TEST(ShadowCatcher, HoldsTheShadowsOfAllLights) {
  Floor floor;
  floor.scene.objects[0].shadow_catcher = true;
  floor.scene.lights.front().name = "a";
  floor.scene.lights.push_back(floor.scene.lights.front());
  floor.scene.lights.back().name = "b";
  floor.scene.lights.back().radiance *= 3.0;
  const Values lit(4, 1.0f);
  const std::vector<LightVisibility> seen = {{floor.visibility, {}}, {lit, {}}};
  const Image image = shade(floor.scene, floor.surface(), seen, detail::make_threads(1));
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(image.at("A")[i], 0.25 * (1 - kVisibility[i]), 1e-7);
}

TEST(ShadowCatcher, Fades) {
  Floor floor;
  floor.scene.objects[0].shadow_catcher = true;
  floor.x = {1, 0, 4};
  floor.scene.objects[0].fade = {1.0, 3.0};
  const Values alpha = floor.shaded().at("A");
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(alpha[i], 0.5 * (1 - kVisibility[i]), 1e-7);
}

TEST(ShadeColors, AreThoseOfThePicture) {
  Floor floor;
  floor.scene.picture.ambient = Vec3(0.1);
  floor.scene.objects[0].fade = {0.5, 3.0};
  const Image image = floor.shaded();
  const Colors colors =
      shade_colors(floor.scene, floor.surface(), std::vector<LightVisibility>{{floor.visibility, {}}},
                   detail::make_threads(1));
  EXPECT_EQ(colors.r, image.at("R"));
  EXPECT_EQ(colors.g, image.at("G"));
  EXPECT_EQ(colors.b, image.at("B"));
  EXPECT_EQ(colors.a, image.at("A"));
}

}  // namespace
}  // namespace penumbra
