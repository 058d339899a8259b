// What a camera sees, against the oracle: close-ups, cameras far away, inside and between things of very
// different size.
#include "render/rays/camera_rays.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/render/rays/ray_support.h"

namespace penumbra {
namespace {

struct Differences {
  std::size_t seen = 0, faces = 0;        ///< pixels that see a face, and see another than the oracle does
  double off_ray = 0.0, off_plane = 0.0;  ///< at most, over the distance and over the coordinates
};

Differences compare(const Scene& scene, int width, int height) {
  std::vector<TriangleMesh> meshes;
  for (const SceneObject& object : scene.objects) meshes.push_back(object.mesh);
  const oracle::Oracle oracle{std::span(meshes)};
  const RayScene rays(scene, 0);
  const SurfaceBuffer surface = make_surface_buffer(scene, rays, width, height);
  const PixelRays pixels(scene.camera, width, height);
  Differences out;
  for (std::size_t i = 0; i < surface.size(); ++i) {
    const Vec3 d = pixels.direction(static_cast<int>(i) % width + 0.5, static_cast<int>(i) / width + 0.5);
    const auto expected = oracle.first_hit(pixels.origin, d);
    if (expected.has_value() != surface.hit(i) ||
        (expected && (static_cast<std::int32_t>(expected->face.object) != surface.object[i] ||
                      index(expected->face.face) != surface.face[i]))) {
      ++out.faces;
      continue;
    }
    if (!expected) continue;
    ++out.seen;
    const Vec3 at = surface.position[i] - pixels.origin;
    const TriangleMesh& mesh = meshes[expected->face.object];
    const Vec3& corner = mesh.positions()[mesh.triangles()[surface.face[i]][0]];
    const double size = glm::length(surface.position[i]) + glm::length(corner);
    out.off_ray =
        std::max(out.off_ray, glm::length(glm::cross(d, at)) / (glm::length(d) * (glm::length(at) + size)));
    out.off_plane =
        std::max(out.off_plane, std::abs(glm::dot(surface.normal[i], surface.position[i] - corner)) / size);
  }
  return out;
}

void expect_same(const Scene& scene, const char* what, std::size_t least_seen) {
  const Differences d = compare(scene, 160, 120);
  EXPECT_EQ(d.faces, 0u) << what;
  EXPECT_GE(d.seen, least_seen) << what;
  EXPECT_LE(d.off_ray, 1e-14) << what;
  EXPECT_LE(d.off_plane, 1e-15) << what;
}

Scene scene_of(std::vector<TriangleMesh> meshes, const Camera& camera) {
  Scene scene;
  scene.camera = camera;
  for (TriangleMesh& mesh : meshes) {
    const bool casts = !scene.objects.empty();  // the first is a floor
    scene.objects.push_back({"object", std::move(mesh), Vec3(0.8), casts});
  }
  return scene;
}

TEST(CameraRays, SeeCloseUps) {
  for (int exponent = 1; exponent <= 9; ++exponent) {
    const double h = std::pow(10.0, -exponent);
    const std::vector<Vec3> sheet{{-1, h, -1}, {-1, h, 1}, {1, h, 1}, {1, h, -1}};
    const Scene scene = scene_of({make_plane(20.0), testing::mesh_of(sheet, {{0, 1, 2}, {0, 2, 3}})},
                                 {{1 + 2 * h, 6 * h, 4 * h}, {1, 0, 0}, {0, 1, 0}, 60});
    expect_same(scene, ("sheet at 1e-" + std::to_string(exponent)).c_str(), 5'000);
  }
}

TEST(CameraRays, SeeSheetsThatCastCloseAboveAFloorThatDoes) {
  for (int exponent = 1; exponent <= 9; ++exponent) {
    const double h = std::pow(10.0, -exponent);
    Scene scene =
        scene_of({make_plane(20.0),
                  testing::mesh_of({{-1, h, -1}, {-1, h, 1}, {1, h, 1}, {1, h, -1}}, {{0, 1, 2}, {0, 2, 3}})},
                 {{3, 4, 5}, {0, 0, 0}, {0, 1, 0}, 40});
    scene.objects[0].casts = true;
    expect_same(scene, ("sheet at 1e-" + std::to_string(exponent)).c_str(), 15'000);
  }
}

TEST(CameraRays, SeeFromAfar) {
  for (const double distance : {1e2, 1e4, 1e6}) {
    const double degrees = 2.5 / distance * 180.0 / testing::kPi;
    const Scene scene =
        scene_of({make_plane(2.0), make_box({0, 0.5, 0}, Vec3(0.5)), make_icosphere({1, 0.4, 0.8}, 0.4, 2)},
                 {Vec3(0.5, 0.6, 0.7) * distance, {0, 0.3, 0}, {0, 1, 0}, degrees});
    // Seen from afar, directions are rounded to a part of the pixels.
    const Differences d = compare(scene, 160, 120);
    EXPECT_LE(d.faces, 2u) << distance;
    EXPECT_GE(d.seen, 5'000u) << distance;
    EXPECT_LE(d.off_plane, 1e-15) << distance;
  }
}

TEST(CameraRays, SeeFromInsideAndBetweenScales) {
  expect_same(
      scene_of({make_plane(1e6), make_box({0, 0.5, 0}, Vec3(0.5)), make_box({1e5, 2e4, 0}, Vec3(2e4))},
               {{-3, 1.2, 2}, {0, 0.5, 0}, {0, 1, 0}, 60}),
      "a box on a floor of 1e6", 14'000);
  expect_same(scene_of({make_plane(3.0), make_box({0, 0.5, 0}, Vec3(0.5))},
                       {{0.1, 0.2, 0.3}, {0.5, 0.4, 0}, {0, 1, 0}, 90}),
              "inside of a box", 19'000);
  Scene armadillo = testing::data_scene("armadillo-medium");
  expect_same(armadillo, "armadillo", 10'000);
  armadillo.camera.target = {0.1, 1.2, 0.3};
  armadillo.camera.fov_y_degrees = 0.5;
  expect_same(armadillo, "a close-up of it", 10'000);
}

// Rays through another point of every pixel are those through the centers of a picture that is moved by as
// much.
TEST(CameraRays, GoThroughAnyPointOfAPixel) {
  const Scene scene = testing::data_scene("torus-medium");
  const RayScene rays(scene, 0);
  const SurfaceBuffer fine = make_surface_buffer(scene, rays, 160, 120);
  std::size_t same = 0;
  for (const int x : {0, 1})
    for (const int y : {0, 1}) {
      const SurfaceBuffer part = make_surface_buffer(scene, rays, 80, 60, {0.25 + 0.5 * x, 0.25 + 0.5 * y});
      for (std::size_t i = 0; i < part.size(); ++i) {
        const std::size_t k =
            (2 * (i / 80) + static_cast<std::size_t>(y)) * 160 + 2 * (i % 80) + static_cast<std::size_t>(x);
        same += part.object[i] == fine.object[k] && part.face[i] == fine.face[k] &&
                glm::distance(part.position[i], fine.position[k]) < 1e-12;
      }
    }
  EXPECT_GE(same + 5, fine.size()) << "but for rays on an edge";
}

TEST(CameraRays, SayHowFarTheyAreAndCanBeStopped) {
  const Scene scene = testing::data_scene("torus-medium");
  const RayScene rays(scene, 0);
  std::vector<double> fractions;
  make_surface_buffer(scene, rays, 64, 640, {}, [&](double f) {
    fractions.push_back(f);
    return true;
  });
  EXPECT_GE(fractions.size(), 10u);
  EXPECT_TRUE(std::ranges::is_sorted(fractions));
  EXPECT_THROW(make_surface_buffer(scene, rays, 64, 640, {}, [](double f) { return f < 0.5; }), Cancelled);
}

}  // namespace
}  // namespace penumbra
