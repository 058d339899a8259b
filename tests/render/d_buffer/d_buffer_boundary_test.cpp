// The boundary that the visibility shader follows from edge to edge: exact areas of plane casters, without
// resampling by rays.
#include <gtest/gtest.h>

#include <cmath>

#include "render/d_buffer/d_buffer.h"
#include "render/gl/context.h"
#include "render/silhouette/silhouette_visibility.h"
#include "tests/render/render_support.h"

namespace penumbra {
namespace {

/// A polygon in the plane z, turned so that it looks at the light.
struct Polygon {
  const char* name;
  std::vector<glm::dvec2> corners;
  std::vector<IndexedTriangle> triangles;
};

Polygon regular(const char* name, int corners, double radius) {
  Polygon out{name, {{0.0, 0.0}}, {}};
  for (int k = 0; k < corners; ++k) {
    const double angle = 2.0 * testing::kPi * k / corners;
    out.corners.push_back(radius * glm::dvec2(std::cos(angle), std::sin(angle)));
    out.triangles.push_back(
        {0, static_cast<std::uint32_t>(k + 1), static_cast<std::uint32_t>((k + 1) % corners + 1)});
  }
  return out;
}

Polygon corner_piece() {
  return {"corner piece",
          {{0, 0}, {2, 0}, {2, 0.8}, {0.8, 0.8}, {0.8, 2}, {0, 2}},
          {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}}};
}

Scene scene_of(const Polygon& polygon, double radius) {
  std::vector<Vec3> points;
  for (const glm::dvec2& c : polygon.corners) points.emplace_back(c, 4.0);
  Scene scene = testing::scene_in_light_frame(radius, {testing::mesh_of(points, polygon.triangles)});
  scene.objects.push_back({"floor", testing::rectangle(-6, 6, -6, 6, 8.0), Vec3(0.8), false});
  return scene;
}

SurfaceBuffer grid(double half) {
  constexpr int kSide = 96;
  std::vector<Vec3> points;
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x)
      points.emplace_back(half * (2.0 * (x + 0.5) / kSide - 1.0), half * (2.0 * (y + 0.5) / kSide - 1.0),
                          8.0);
  return testing::receivers(points, {0, 0, -1}, kSide);
}

struct Case {
  Polygon polygon;
  double radius;  ///< of the light
};

TEST(DBufferBoundary, IsExactFromEdgeToEdge) {
  const auto context = gl::make_context(gl::Backend::kOsMesa);
  for (const Case& c : {Case{regular("triangle", 3, 1.5), 1.0}, Case{regular("twelve edges", 12, 1.5), 1.0},
                        Case{regular("forty edges", 40, 1.5), 0.5}, Case{corner_piece(), 0.5},
                        Case{regular("small hexagon", 6, 0.2), 1.0}}) {
    const Scene scene = scene_of(c.polygon, c.radius);
    const RayScene rays(scene, 0);
    const SurfaceBuffer surface = grid(6.0);
    DBuffer buffer(*context, scene, rays);
    buffer.set_surface(surface.receivers());
    const auto visibility =
        buffer.render(testing::light_of(scene), {.size = 1024, .check = EntryCheck::kNone}).visibility;
    const auto truth = testing::see_silhouettes(scene, rays, surface).visibility;
    // No ray denies what is exact, so that none changes it.
    EXPECT_EQ(buffer.render(testing::light_of(scene), {.size = 1024}).visibility, visibility)
        << c.polygon.name;
    double sum = 0.0, worst = 0.0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
      if (!(truth[i] > 0.0f && truth[i] < 1.0f)) continue;
      const double d = visibility[i] - truth[i];
      sum += d * d, worst = std::max(worst, std::abs(d)), ++count;
    }
    const double rmse = std::sqrt(sum / static_cast<double>(count));
    std::printf("%-14s %5zu receivers, RMSE %.6f, at most %.5f\n", c.polygon.name, count, rmse, worst);
    EXPECT_GT(count, 300u);
    EXPECT_LE(rmse, 1e-4) << c.polygon.name;
    EXPECT_LE(worst, 1e-3) << c.polygon.name;
  }
}

}  // namespace
}  // namespace penumbra
