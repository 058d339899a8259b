// The reference at any scale: scenes moved, turned and scaled, lights far away and infinitely far, large
// floors.
#include <gtest/gtest.h>

#include "tests/render/rays/ray_support.h"

namespace penumbra {
namespace {

using testing::Values;

/// A box that stands on a floor of this half size, under a lamp.
Scene box_on_floor(double half, bool floor_casts = false) {
  Scene scene;
  testing::light_of(scene) = {{-4, 5, 1}, {0.8, -1, -0.2}, 0.5};
  scene.camera = {{1, 6, 6}, {0.7, 0.2, 0}, {0, 1, 0}, 35};
  scene.objects.push_back({"floor", make_plane(half), Vec3(0.8), floor_casts});
  scene.objects.push_back({"box", make_box({0, 0.5, 0}, Vec3(0.5)), Vec3(0.8), true});
  return scene;
}

/// The scene and receivers on it, all by one motion and scale.
struct Moved {
  Moved(const Scene& of, const SurfaceBuffer& on, const testing::Motion& motion, double scale)
      : scene(of), surface(on) {
    const auto place = [&](const Vec3& p) { return motion(p) * scale; };
    for (SceneObject& object : scene.objects) {
      std::vector<Vec3> p;
      for (const Vec3& each : object.mesh.positions()) p.push_back(place(each));
      object.mesh = testing::mesh_of(p, {object.mesh.triangles().begin(), object.mesh.triangles().end()});
    }
    DiskLight& light = testing::light_of(scene);
    light = {place(light.center), motion.turned(light.normal), light.radius * scale};
    for (Vec3& p : surface.position) p = place(p);
    for (Vec3& n : surface.normal) n = motion.turned(n);
  }
  Scene scene;
  SurfaceBuffer surface;
};

Values reference(const Scene& scene, const SurfaceBuffer& surface, int samples = 256) {
  const RayScene rays(scene, 0);
  return trace_reference(rays, scene.lights.front().shape, surface.receivers(), testing::every_pixel(surface),
                         {.samples = samples, .seed = 5})
      .visibility;
}

double largest_difference(const Values& a, const Values& b) {
  double most = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(double{a[i]} - double{b[i]}));
  return most;
}

TEST(ReferenceScales, PowersOfTwoChangeNoBit) {
  const Scene scene = testing::data_scene("torus-medium");
  const testing::View view(scene, 96, 72);
  const Values expected = reference(scene, view.surface);
  for (const double scale : {0x1p-40, 0x1p-3, 0x1p20, 0x1p40}) {
    const Moved moved(scene, view.surface, {}, scale);
    EXPECT_EQ(reference(moved.scene, moved.surface), expected) << scale;
  }
}

/// Light samples keep their places on the disk where the light's axes turn with it, which they do for scales
/// and shifts.
TEST(ReferenceScales, ScalesAndShiftsChangeNextToNothing) {
  const Scene scene = testing::data_scene("boxes-medium");
  const testing::View view(scene, 96, 72);
  const Values expected = reference(scene, view.surface);
  for (const double scale : {1e-9, 1e-4, 3.0, 1e5, 1e9})
    for (const double shift : {0.0, 1e3, 1e5}) {
      testing::Motion motion;
      motion.offset = Vec3(0.6, -0.5, 0.62) * shift;
      const Moved moved(scene, view.surface, motion, scale);
      const Values values = reference(moved.scene, moved.surface);
      std::size_t differ = 0;
      for (std::size_t i = 0; i < values.size(); ++i) differ += values[i] != expected[i];
      EXPECT_LE(differ, 20u) << scale << ", " << shift;
      EXPECT_LE(largest_difference(values, expected), 1.01 / 256) << scale << ", " << shift;
    }
}

TEST(ReferenceScales, TurnsChangeNoMoreThanOtherSamples) {
  testing::Random random(431);
  const Scene scene = testing::data_scene("torus-medium");
  const testing::View view(scene, 96, 72);
  const Values expected = reference(scene, view.surface, 4096);
  for (int i = 0; i < 3; ++i) {
    const Moved moved(scene, view.surface, testing::Motion::random(random), random.spread(1e-3, 1e3));
    const Values values = reference(moved.scene, moved.surface, 4096);
    EXPECT_LE(largest_difference(values, expected), 0.006);
    double sum = 0.0;
    for (std::size_t k = 0; k < values.size(); ++k) sum += double{values[k]} - double{expected[k]};
    EXPECT_LE(std::abs(sum), 1e-4 * static_cast<double>(values.size()));
  }
}

/// No floor, however large, and no stray triangle changes what is seen near the box.
TEST(ReferenceScales, LargeFloorsChangeNoBit) {
  const Scene small = box_on_floor(20.0);
  const testing::View view(small, 96, 72);
  const Values expected = reference(small, view.surface);
  for (const double half : {1e2, 1e4, 1e6})
    for (const bool casts : {false, true}) {
      Scene large = box_on_floor(half, casts);
      // Receivers see another face of the floor, or the same.
      SurfaceBuffer surface = view.surface;
      large.objects.push_back(
          {"stray", make_triangle({1e6, 0, 0}, {1e6, 1, 0}, {1e6, 0, 1}), Vec3(0.8), true});
      EXPECT_EQ(reference(large, surface), expected) << half << casts;
    }
}

/// Disks of one angle further and further away, and the distant light that they tend to.
TEST(ReferenceScales, FarLightsTendToADistantOne) {
  Scene scene = box_on_floor(20.0);
  const testing::View view(scene, 192, 144);
  const Vec3 direction = glm::normalize(Vec3(0.7, -1.0, 0.1));
  constexpr double kDegrees = 6.0;
  const double radius = std::tan(0.5 * kDegrees * testing::kPi / 180.0);
  scene.lights[0].shape = DistantLight{direction, kDegrees};
  const Values distant = reference(scene, view.surface);
  double partly = 0;
  for (const float v : distant) partly += v > 0.0f && v < 1.0f;
  EXPECT_GT(partly, 100);
  double last = std::numeric_limits<double>::infinity();
  for (const double distance : {1e2, 1e3, 1e4, 1e6, 1e8, 1e11}) {
    scene.lights[0].shape = DiskLight{-distance * direction, direction, radius * distance};
    const Values near = reference(scene, view.surface);
    double sum = 0.0;
    for (std::size_t i = 0; i < near.size(); ++i) sum += std::abs(double{near[i]} - double{distant[i]});
    EXPECT_LE(sum, std::max(0.35 * last, 0.02 * partly / 256)) << distance;
    last = sum;
  }
  EXPECT_EQ(last, 0.0) << "at 1e11";
}

}  // namespace
}  // namespace penumbra
