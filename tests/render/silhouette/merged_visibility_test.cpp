// Visibility with merged faces against visibility without.
#include "render/rays/camera_rays.h"
#include "render/silhouette/silhouette_visibility.h"

#include <gtest/gtest.h>

#include <cmath>

#include "penumbra/mesh/shapes.h"
#include "render/rays/ray_scene.h"
#include "tests/render/render_support.h"
#include "tests/render/silhouette/fine_meshes.h"

namespace penumbra::detail {
namespace {

using penumbra::testing::divided;
using penumbra::testing::fine_meshes;
using penumbra::testing::Random;
using penumbra::testing::scene_of;

struct Difference {
  double most = 0.0, square = 0.0;
  std::size_t penumbra = 0, contradictions = 0, merged = 0, lost = 0;
};

Difference compare(const Scene& scene, const SurfaceBuffer& surface, double tolerance) {
  const RayScene rays(scene, 0);
  SilhouetteOptions options;
  options.tolerance = 0.0;
  const SilhouetteResult exact = testing::see_silhouettes(scene, rays, surface, options);
  options.tolerance = tolerance;
  const SilhouetteResult r = testing::see_silhouettes(scene, rays, surface, options);
  EXPECT_EQ(r.counts.receivers, exact.counts.receivers);
  EXPECT_EQ(r.counts.behind_light, exact.counts.behind_light);
  EXPECT_EQ(r.counts.fallback, exact.counts.fallback);
  Difference out;
  out.merged = r.counts.merged_receivers;
  for (std::size_t i = 0; i < surface.size(); ++i) {
    const double v = exact.visibility[i], d = std::abs(r.visibility[i] - v);
    out.most = std::max(out.most, d);
    if (v > 0.0 && v < 1.0) ++out.penumbra, out.square += d * d;
    // Certified lit is what nothing hides above the horizon, and that then is all of V.
    out.contradictions += (r.region[i] == 0 && d > 1e-6) || (r.region[i] == 2 && v > 1e-5) ? 1 : 0;
    out.lost += exact.region[i] >= 0 && r.region[i] < 0 ? 1 : 0;
  }
  return out;
}

/// The floor, and all around the caster.
SurfaceBuffer receivers_about(Random& random, const Scene& scene) {
  const Bounds box = scene.bounds();
  std::vector<Vec3> points, normals;
  for (int i = 0; i < 6400; ++i) {
    const bool on_floor = i < 4800;
    points.push_back(on_floor ? box.center() +
                                    box.radius() * Vec3(0.04 * (i % 80 - 40), 0.06 * (i / 80 - 30), -1.5)
                              : box.center() + box.radius() * random.point(1.5));
    normals.push_back(on_floor ? Vec3(0, 0, 1) : random.direction());
  }
  return testing::receivers(points, normals, 80);
}

TEST(MergedFaces, MoveVisibilityLittle) {
  Random random(73);
  std::size_t merged = 0;
  for (const auto& [name, mesh] : fine_meshes(7)) {
    Scene scene = scene_of(mesh);
    const DiskLight light = testing::light_of(scene);
    const double size = scene.bounds().radius();
    for (int k = 0; k < 6; ++k) {
      testing::light_of(scene) = {light.center + 0.5 * size * random.point(),
                                  light.normal + 0.2 * random.point(), size * random.spread(0.3, 1.5)};
      const double tolerance = k % 2 == 0 ? 1e-2 : 4e-3;
      const Difference d = compare(scene, receivers_about(random, scene), tolerance);
      const double rmse = std::sqrt(d.square / static_cast<double>(std::max<std::size_t>(1, d.penumbra)));
      std::printf("%-12s tolerance %.3f: merged for %5zu, %5zu in penumbra: RMSE %.1e, most %.1e, lost %zu\n",
                  name.c_str(), tolerance, d.merged, d.penumbra, rmse, d.most, d.lost);
      merged += d.merged;
      EXPECT_LE(rmse, 0.1 * tolerance) << name;
      EXPECT_LE(d.most, tolerance) << name;
      EXPECT_EQ(d.contradictions, 0u) << name;
      EXPECT_LE(d.lost, 320u) << name;
    }
  }
  EXPECT_GT(merged, 100000u);
}

/// On a finely divided surface that is flat face by face nothing is lost: the same edges as before.
TEST(MergedFaces, OfFlatSidesLeaveTheCoarseMeshsEdges) {
  Scene scene = testing::data_scene("torus-medium");
  const auto render = [&] {
    const RayScene rays(scene, 0);
    return testing::see_silhouettes(scene, rays, make_surface_buffer(scene, rays, 160, 120));
  };
  const SilhouetteResult coarse = render();
  scene.objects.back().mesh = divided(scene.objects.back().mesh, 3);
  const SilhouetteResult fine = render();
  EXPECT_EQ(coarse.counts.merged_receivers, 0u);
  EXPECT_EQ(fine.counts.merged_receivers, fine.counts.receivers);
  EXPECT_LT(fine.counts.band_edges, 600u) << "of 55,296";
  EXPECT_EQ(fine.region, coarse.region);
  for (std::size_t i = 0; i < fine.visibility.size(); ++i)
    ASSERT_NEAR(fine.visibility[i], coarse.visibility[i], 1e-6);
}

TEST(MergedFaces, AreNotMistakenWhereCastersCrossTheLightsPlane) {
  Scene scene = scene_of(make_icosphere({0, 0, 0}, 1.0, 5));
  testing::light_of(scene) = {{0.9, 0, 0}, {0, 0, 1}, 0.5};
  Random random(74);
  const Difference d = compare(scene, receivers_about(random, scene), 2e-3);
  EXPECT_EQ(d.merged, 0u);
  EXPECT_EQ(d.most, 0.0);
}

}  // namespace
}  // namespace penumbra::detail
