#include "render/rays/camera_rays.h"

#include <gtest/gtest.h>

#include "penumbra/mesh/error.h"
#include "tests/render/render_support.h"

namespace penumbra {
namespace {

/// A floor, a box and a triangle in front of it, seen from above.
Scene known_scene() {
  Scene scene;
  testing::light_of(scene) = {{0, 5, 0}, {0, -1, 0}, 0.5};
  scene.camera = {{1.3, 4, 6}, {0.1, 0.3, 0}, {0, 1, 0}, 40};
  scene.objects.push_back({"floor", make_plane(3.0, 4), Vec3(0.8), false});
  scene.objects.push_back({"box", make_box({0, 0.6, 0}, {0.5, 0.6, 0.4}), Vec3(0.8), true});
  scene.objects.push_back(
      {"triangle", make_triangle({-1, 0.2, 1}, {-0.2, 0.2, 1.4}, {-0.8, 1.2, 1}), Vec3(0.8), true});
  return scene;
}

struct Nearest {
  int object = -1;
  std::uint32_t face = 0;
  double at = 1.0;
  bool clear = true;  ///< no border of a triangle near the ray
};

Nearest nearest_face(const Scene& scene, const Vec3& origin, const Vec3& far) {
  Nearest out;
  for (std::size_t o = 0; o < scene.objects.size(); ++o) {
    const TriangleMesh& mesh = scene.objects[o].mesh;
    for (std::uint32_t f = 0; f < mesh.triangles().size(); ++f) {
      const IndexedTriangle& t = mesh.triangles()[f];
      const auto p = mesh.positions();
      const testing::SegmentHit hit = testing::segment_triangle(origin, far, p[t[0]], p[t[1]], p[t[2]]);
      if (hit.at > 1.0) continue;
      if (std::abs(hit.margin) < 1e-4) out.clear = false;
      if (hit.margin >= 0.0 && hit.at < out.at)
        out.object = static_cast<int>(o), out.face = f, out.at = hit.at;
    }
  }
  return out;
}

TEST(SurfaceBuffer, SeesTheNearestFace) {
  const Scene scene = known_scene();
  const testing::View view(scene, 96, 72);
  const PixelRays pixels(scene.camera, 96, 72);
  std::vector<int> seen(4, 0);
  int unclear = 0;
  for (int y = 0; y < 72; ++y) {
    for (int x = 0; x < 96; ++x) {
      const std::size_t i = static_cast<std::size_t>(y * 96 + x);
      const Nearest expected =
          nearest_face(scene, pixels.origin, pixels.origin + 100.0 * pixels.direction(x + 0.5, y + 0.5));
      ++seen[static_cast<std::size_t>(view.surface.object[i] + 1)];
      if (!expected.clear) {
        ++unclear;
        continue;
      }
      ASSERT_EQ(view.surface.object[i], expected.object) << x << ", " << y;
      ASSERT_EQ(view.surface.hit(i), expected.object >= 0);
      if (expected.object >= 0) {
        ASSERT_EQ(view.surface.face[i], expected.face) << x << ", " << y;
      }
    }
  }
  for (const int count : seen) EXPECT_GT(count, 50) << "background and every object are seen";
  EXPECT_LT(unclear, 60);
}

void expect_points_exact(const Scene& scene, int width, int height) {
  const testing::View view(scene, width, height);
  const PixelRays pixels(scene.camera, width, height);
  double off_plane = 0.0, off_ray = 0.0;
  for (std::size_t i = 0; i < view.surface.size(); ++i) {
    if (!view.surface.hit(i)) continue;
    const TriangleMesh& mesh = scene.objects[static_cast<std::size_t>(view.surface.object[i])].mesh;
    const IndexedTriangle& t = mesh.triangles()[view.surface.face[i]];
    const auto p = mesh.positions();
    const Vec3 normal = glm::normalize(glm::cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]));
    const int x = static_cast<int>(i) % width, y = static_cast<int>(i) / width;
    const Vec3 d = pixels.direction(x + 0.5, y + 0.5), at = view.surface.position[i] - pixels.origin;
    const double size = glm::length(at) + glm::length(pixels.origin);
    off_plane = std::max(off_plane, std::abs(glm::dot(normal, view.surface.position[i] - p[t[0]])) / size);
    off_ray = std::max(off_ray, glm::length(glm::cross(d, at)) / glm::length(d) / size);
    ASSERT_NEAR(glm::length(view.surface.normal[i]), 1.0, 1e-14);
    ASSERT_NEAR(std::abs(glm::dot(view.surface.normal[i], normal)), 1.0, 1e-14);
    ASSERT_LE(glm::dot(view.surface.normal[i], d), 0.0) << "towards the viewer";
  }
  EXPECT_LE(off_plane, 1e-12);
  EXPECT_LE(off_ray, 1e-12);
  std::printf("off the plane %.2g, off the ray %.2g (relative)\n", off_plane, off_ray);
}

TEST(SurfaceBuffer, PointsLieOnThePlaneAndThePixelsRay) {
  expect_points_exact(known_scene(), 96, 72);
  expect_points_exact(testing::data_scene("torus-medium"), 160, 120);
}

TEST(SurfaceBuffer, BackFacesAreSeenWithTheirNormalTurned) {
  Scene scene;
  testing::light_of(scene) = {{0, 0, 5}, {0, 0, -1}, 0.5};
  scene.camera = {{0, 0, 4}, {0, 0, 0}, {0, 1, 0}, 40};
  scene.objects.push_back({"t", make_triangle({-5, -5, 0}, {0, 9, 0}, {5, -5, 0}), Vec3(0.8), true});
  const testing::View view(scene, 4, 4);
  for (std::size_t i = 0; i < 16; ++i) {
    ASSERT_TRUE(view.surface.hit(i));
    EXPECT_EQ(view.surface.normal[i], Vec3(0, 0, 1));
  }
}

TEST(SurfaceBuffer, OfAnEmptySceneIsBackground) {
  Scene scene;
  testing::light_of(scene) = {{0, 0, 5}, {0, 0, -1}, 0.5};
  const testing::View view(scene, 5, 3);
  EXPECT_EQ(view.surface.size(), 15u);
  for (std::size_t i = 0; i < 15; ++i) EXPECT_FALSE(view.surface.hit(i));
}

TEST(SurfaceBuffer, RefusesSizesOutsideItsRange) {
  const Scene scene = known_scene();
  const RayScene rays(scene, 1);
  for (const auto& [width, height] : {std::pair{0, 4}, {4, 0}, {-1, 4}, {65537, 1}, {1, 65537}})
    EXPECT_THROW(make_surface_buffer(scene, rays, width, height), UsageError) << width << "x" << height;
}

}  // namespace
}  // namespace penumbra
