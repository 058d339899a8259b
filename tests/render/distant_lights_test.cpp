// Pictures under distant lights: what near disks of the same angle and radiance tend to, and closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "penumbra/render/renderer.h"
#include "tests/render/render_support.h"

namespace penumbra {
namespace {

using testing::kPi;

RenderOptions by(const std::string& method) {
  RenderOptions options;
  options.method = method;
  options.width = 120;
  options.height = 90;
  return options;
}

const DistantLight& sun_of(const Scene& scene) {
  return std::get<DistantLight>(scene.lights.at(0).shape);
}

/// The scene under a disk of the sun's angle that is this far from the middle of everything, and faces it.
Scene under_disk(Scene scene, double distance) {
  const DistantLight sun = sun_of(scene);
  const Vec3 m = glm::normalize(sun.direction);
  scene.lights[0].shape =
      DiskLight{scene.bounds().center() - distance * m, m, distance * CircularLight(sun).radius};
  return scene;
}

double rms_difference(const Image& a, const Image& b) {
  double sum = 0.0;
  std::size_t count = 0;
  for (const char* channel : {"R", "G", "B"})
    for (std::size_t i = 0; i < a.at(channel).size(); ++i, ++count) {
      const double d = double{a.at(channel)[i]} - b.at(channel)[i];
      sum += d * d;
    }
  return std::sqrt(sum / static_cast<double>(count));
}

// At distance D the light's direction and angle change across a scene of size s by s/D, and so do form
// factors and shadows. (The colors are about 0.5; the float of a pixel holds 3e-8 of it.)
TEST(DistantLights, GiveThePicturesThatRecedingDisksTendTo) {
  for (const char* method : {"none", "silhouette"}) {
    const Scene scene = testing::data_scene("boxes-sun");
    const double size = scene.bounds().radius();
    const Image expected = render(scene, by(method)).image;
    double before = 0.0;
    for (const double distance : {1e3, 1e4, 1e5, 1e6, 1e8}) {
      const double error =
          rms_difference(render(under_disk(scene, distance * size), by(method)).image, expected);
      std::printf("%s, %g sizes away: %.3g\n", method, distance, error);
      EXPECT_LT(error, 1.0 / distance + 1e-7) << method << ", " << distance << " sizes away";
      if (before > 1e-5) {
        EXPECT_NEAR(error / before, 0.1, 0.05) << method << ", " << distance << " sizes away";
      }
      before = error;
    }
  }
}

// A floor that sees all of the sun has albedo/π · E · sin(elevation), wherever it is; so it has under a point
// at infinity.
TEST(DistantLights, LightALevelFloorByTheirElevation) {
  for (const double angle : {0.0, 0.53, 20.0}) {
    Scene scene = testing::data_scene("boxes-sun");
    DistantLight sun = sun_of(scene);
    sun.angle_degrees = angle;
    scene.lights[0] = {.name = {}, .shape = sun, .radiance = Vec3(3.0) / irradiance_per_radiance(sun)};
    const Image image = render(scene, by("silhouette")).image;
    const double expected = 0.8 / kPi * 3.0 * -glm::normalize(sun.direction).y;
    int lit = 0;
    for (std::size_t i = 0; i < image.at("R").size(); ++i) {
      if (image.at("object")[i] != 0.0f || image.at("N.Y")[i] != 1.0f) continue;
      const double v = image.at("visibility")[i];
      EXPECT_NEAR(image.at("G")[i], expected * v, 1e-6 * expected) << angle << "°, pixel " << i;
      lit += v == 1.0;
    }
    EXPECT_GT(lit, 1'000) << angle;
  }
}

}  // namespace
}  // namespace penumbra
