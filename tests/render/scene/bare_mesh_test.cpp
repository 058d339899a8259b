// What a bare mesh gets: a floor, a light and a camera that suit it.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <string>

#include "penumbra/mesh/error.h"
#include "penumbra/mesh/shapes.h"
#include "render/light/light_integrals.h"
#include "render/scene/default_scene.h"

namespace penumbra {
namespace {

Scene scene_of(const std::string& off) {
  return parse_scene_or_mesh(off, "", "bare.off").scene;
}

const DiskLight& disk_of(const Scene& scene) {
  return std::get<DiskLight>(scene.lights.front().shape);
}

// Whether the camera sees a point, with some margin.
bool sees(const Camera& camera, const Vec3& p, double aspect) {
  const Vec3 forward = glm::normalize(camera.target - camera.eye);
  const Vec3 right = glm::normalize(glm::cross(forward, camera.up));
  const Vec3 d = p - camera.eye;
  const double depth = glm::dot(d, forward);
  const double limit = depth * std::tan(camera.fov_y_degrees * 3.14159265358979 / 360) * 0.98;
  return depth > 0 && std::abs(glm::dot(d, glm::cross(right, forward))) < limit &&
         std::abs(glm::dot(d, right)) < limit * aspect;
}

TEST(BareMesh, AndScenesMayBeginWithAByteOrderMark) {
  const std::string mark = "\xEF\xBB\xBF", off = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  EXPECT_EQ(scene_of(mark + off).objects.size(), 2u);
  EXPECT_THROW(parse_scene_or_mesh(mark + R"({"version": 1, "objects": []})", "", "s"), SceneError);
}

TEST(BareMesh, NamesMayBeAnyBytes) {
  const std::string off = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  EXPECT_FALSE(parse_scene_or_mesh(off, "", "b\xFCrste.off").scene.document.empty());
}

TEST(BareMesh, GetsFloorLightAndCameraInProportion) {
  const Vec3 shapes[] = {{1, 1, 1}, {1, 0.01, 1}, {0.01, 1, 0.01}, {1, 0.2, 0.1}};
  for (const double scale : {1e-3, 1.0, 1e6})
    for (const Vec3& shape : shapes) {
      std::string text = "OFF\n4 4 0\n";
      for (const Vec3& p : {Vec3(0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)}) {
        char line[128];
        const Vec3 q = scale * (shape * p + Vec3(3, -2, 1));
        std::snprintf(line, sizeof line, "%.17g %.17g %.17g\n", q.x, q.y, q.z);
        text += line;
      }
      const Scene scene = scene_of(text + "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n");
      ASSERT_EQ(scene.objects.size(), 2u);
      EXPECT_FALSE(scene.objects[0].casts);
      EXPECT_TRUE(scene.objects[1].casts);
      const Bounds mesh = bounds_of(scene.objects[1].mesh.positions());
      const Bounds floor = bounds_of(scene.objects[0].mesh.positions());
      EXPECT_LT(floor.high.y, mesh.low.y);
      EXPECT_GT(floor.high.y, mesh.low.y - 0.05 * mesh.radius());
      EXPECT_LT(floor.low.x, mesh.low.x);
      EXPECT_GT(floor.high.z, mesh.high.z);
      EXPECT_GT(disk_of(scene).center.y, mesh.high.y + mesh.radius());
      EXPECT_GT(disk_of(scene).radius, 0.0);
      for (const Vec3& p : scene.objects[1].mesh.positions()) EXPECT_TRUE(sees(scene.camera, p, 4.0 / 3.0));
      for (const Vec3& p : scene.objects[1].mesh.positions())
        EXPECT_GT(glm::dot(p - disk_of(scene).center, disk_of(scene).normal), 0.0);
      for (const Vec3& p : scene.objects[1].mesh.positions()) {
        const Vec3 way = p - disk_of(scene).center,
                   shadow = p + way * ((p.y - floor.low.y) / (disk_of(scene).center.y - p.y));
        EXPECT_NEAR(shadow.y, floor.low.y, 1e-9 * mesh.radius() + 1e-15 * std::abs(floor.low.y));
        EXPECT_TRUE(sees(scene.camera, shadow, 4.0 / 3.0));
        EXPECT_LT(glm::distance(shadow, floor.center()), scene.objects[0].fade.to)
            << "on what is seen of the floor";
      }
      EXPECT_LE(scene.objects[0].fade.to, 0.5 * (floor.high.x - floor.low.x) * (1 + 1e-12))
          << "no edge is seen";
      EXPECT_GT(scene.picture.ambient.x, 0.0);
      // Neither dark nor clipped: what the floor has of light at the mesh's foot, exposure 0.
      const Vec3 foot{mesh.center().x, floor.low.y, mesh.center().z};
      const double lit = scene.objects[0].albedo.x / 3.14159265358979 * scene.lights[0].radiance.x *
                             disk_irradiance_factor(disk_of(scene), foot, {0, 1, 0}) +
                         scene.objects[0].albedo.x * scene.picture.ambient.x;
      EXPECT_GT(lit, 0.6);
      EXPECT_LT(lit, 0.9);
    }
}

// A scan's speck far below does not make it float; as many specks as there is of anything else are the mesh.
TEST(BareMesh, StandsOnItsFloorWhateverSpecksLieAround) {
  const auto floor_with_specks = [](double size, int count) {
    std::vector<Vec3> positions;
    std::vector<IndexedTriangle> triangles;
    const auto add = [&](const TriangleMesh& box) {
      const auto first = static_cast<std::uint32_t>(positions.size());
      positions.insert(positions.end(), box.positions().begin(), box.positions().end());
      for (const auto& [i, j, k] : box.triangles()) triangles.push_back({first + i, first + j, first + k});
    };
    add(make_box({0, 3, 0}, Vec3(1.0)));
    for (int k = 0; k < count; ++k) add(make_box({0.1 * k, -30, 0}, Vec3(size)));
    const Scene scene = detail::scene_around(TriangleMesh::build(positions, triangles), "specks");
    return scene.objects[0].mesh.bounds().high.y;
  };
  EXPECT_NEAR(floor_with_specks(0.01, 1), 2.0, 0.01);
  EXPECT_NEAR(floor_with_specks(0.01, 200), -30.0, 0.1) << "2% of the area";
  EXPECT_NEAR(floor_with_specks(0.03, 1), -30.0, 0.1) << "larger than a speck";
}

}  // namespace
}  // namespace penumbra
