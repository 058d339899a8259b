#include "render/rays/camera_rays.h"
#include "render/silhouette/silhouette_visibility.h"

#include <gtest/gtest.h>

#include "penumbra/mesh/error.h"
#include "penumbra/render/renderer.h"
#include "render/silhouette/light_rays.h"
#include "tests/render/error_support.h"
#include "tests/render/render_support.h"
#include "tests/render/silhouette/face_overlap.h"

namespace penumbra {
namespace {

using testing::Pixels;
using testing::Values;

const Vec3 kToLight{0, 0, -1};  // of receivers on a plane z = const

SilhouetteResult see(const Scene& scene, const SurfaceBuffer& surface, int threads = 0) {
  const RayScene rays(scene, threads);
  return testing::see_silhouettes(scene, rays, surface);
}

/// Receivers of a square grid on the plane z = const, in the light's frame.
SurfaceBuffer grid(double half, double z, int side) {
  std::vector<Vec3> points;
  for (int j = 0; j < side; ++j)
    for (int i = 0; i < side; ++i)
      points.push_back({half * (2.0 * (i + 0.513) / side - 1.0), half * (2.0 * (j + 0.487) / side - 1.0), z});
  return testing::receivers(points, kToLight, side);
}

/// The chord of the plane through edge a → b as receiver x sees it; the side of `inside` is kept.
Chord chord_of_edge(const Scene& scene, const Vec3& x, const Vec3& a, const Vec3& b, const Vec3& inside) {
  Vec3 n = edge_plane(x, a, b);
  if (glm::dot(n, inside - x) < 0.0) n = -n;
  return chord_of_plane(n, x, testing::light_of(scene).radius);
}

/// Largest difference to `truth(point)` over all receivers.
template <class Truth>
double worst(const SurfaceBuffer& surface, const Values& visibility, const Truth& truth) {
  double most = 0.0;
  for (std::size_t i = 0; i < surface.size(); ++i)
    most = std::max(most, std::abs(visibility[i] - truth(surface.position[i])));
  return most;
}

// Visibility is kept in float: half an ulp of 1, and the closed form's own rounding.
constexpr double kFloatVisibility = 1.3e-7;

TEST(Silhouette, OneEdgeIsTheChordFormula) {
  const Vec3 a{-20, -3, 2}, b{20, 5, 7}, away{0, -60, 4}, lit{0, 60, 4};
  const Scene scene = testing::scene_in_light_frame(0.8, {make_triangle(a, b, away)});
  const SurfaceBuffer surface = grid(6.0, 10.0, 96);
  const SilhouetteResult r = see(scene, surface);
  const double error = worst(surface, r.visibility, [&](const Vec3& p) {
    return half_plane_area(chord_of_edge(scene, p, a, b, lit).delta);
  });
  std::printf("%zu integrated, off by at most %.2g\n", r.counts.integrated, error);
  EXPECT_GT(r.counts.integrated, 500u);
  EXPECT_LE(error, kFloatVisibility);
}

// Two casters one above the other whose edges cross the disk: overlap is fused, not multiplied.
TEST(Silhouette, TwoCastersAreTwoHalfPlanes) {
  const Vec3 a{-40, -3, 2}, b{40, 5, 3}, c{1, -40, 5}, d{-2, 40, 4};
  const Scene scene = testing::scene_in_light_frame(
      1.2, {make_triangle(a, b, {0, -90, 2}), make_triangle(d, c, {-90, 0, 4.5})});
  const SurfaceBuffer surface = grid(4.0, 10.0, 96);
  const SilhouetteResult r = see(scene, surface);
  const double error = worst(surface, r.visibility, [&](const Vec3& p) {
    return two_half_planes_area(chord_of_edge(scene, p, a, b, {0, 90, 2}),
                                chord_of_edge(scene, p, c, d, {90, 0, 4.5}));
  });
  std::printf("%zu overlapping, off by at most %.2g\n", r.counts.overlapping, error);
  EXPECT_GT(r.counts.overlapping, 300u);
  EXPECT_LE(error, kFloatVisibility);
}

// A caster's edge and the receiver's horizon: again two half-planes.
TEST(Silhouette, TheHorizonIsPartOfTheBoundary) {
  const Vec3 a{-20, -3, 2}, b{20, 5, 3};
  const Scene scene = testing::scene_in_light_frame(2.0, {make_triangle(a, b, {0, -60, 2})});
  SurfaceBuffer surface = grid(4.0, 6.0, 96);
  const Vec3 normal = glm::normalize(Vec3(-0.95, 0.1, -0.2));
  surface.normal.assign(surface.size(), normal);
  const SilhouetteResult r = see(scene, surface);
  std::size_t cut = 0;
  const double error = worst(surface, r.visibility, [&](const Vec3& x) {
    Vec3 n = edge_plane(x, a, b);
    if (glm::dot(n, Vec3(0, 60, 2) - x) < 0.0) n = -n;
    const Chord edge = chord_of_plane(n, x, 2.0), horizon = chord_of_plane(normal, x, 2.0);
    cut += std::abs(edge.delta) < 1.0 && std::abs(horizon.delta) < 1.0 ? 1 : 0;
    return two_half_planes_area(edge, horizon);
  });
  EXPECT_GT(cut, 300u) << "both cross the disk";
  EXPECT_LE(error, kFloatVisibility);
}

struct Compared {
  ErrorFigures figures;
  SilhouetteResult result;
};
Compared against_rays(const Scene& scene, int width, int height, int samples) {
  const testing::View view(scene, width, height);
  SilhouetteResult r = view.see_silhouettes();
  const Pixels all = testing::every_pixel(view.surface);
  const ErrorFigures figures =
      testing::penumbra_error(r.visibility, view.trace(all, samples, 101), view.trace(all, samples, 102));
  return {figures, std::move(r)};
}

// What remains of two references' noise in the estimate: noise²/√pixels under the root, about .0022²/√2000
// for 1,024 samples (and twice that noise for foliage).
TEST(Silhouette, AgreesWithRaysOverClosedCasters) {
  for (const char* name : {"cube-medium", "sphere-large", "torus-medium", "boxes-large", "speck-large"}) {
    const Compared c = against_rays(testing::data_scene(name), 160, 120, 1024);
    std::printf("%-14s RMSE %.5f max %.4f over %zu pixels\n", name, c.figures.rmse, c.figures.max_absolute,
                c.figures.pixels);
    EXPECT_LE(c.figures.rmse, 0.0007) << name;
    EXPECT_LE(c.figures.max_absolute, 0.015) << name;
    EXPECT_EQ(c.result.counts.fallback, 0u) << name;
  }
}

TEST(Silhouette, AgreesWithRaysOverOpenCasters) {
  for (const char* name : {"foliage-medium", "triangle-large"}) {
    const Compared c = against_rays(testing::data_scene(name), 160, 120, 1024);
    std::printf("%-14s RMSE %.5f max %.4f over %zu pixels\n", name, c.figures.rmse, c.figures.max_absolute,
                c.figures.pixels);
    EXPECT_LE(c.figures.rmse, 0.0015) << name;
    EXPECT_LE(c.figures.max_absolute, 0.025) << name;
  }
}

TEST(Silhouette, IsTheSameForAnyNumberOfThreads) {
  for (const char* name : {"boxes-large", "foliage-medium"}) {
    const Scene scene = testing::data_scene(name);
    const testing::View one(scene, 200, 150, 1), two(scene, 200, 150, 2);
    const SilhouetteResult a = one.see_silhouettes();
    const SilhouetteResult b = two.see_silhouettes();
    EXPECT_EQ(a.visibility, b.visibility) << name;
    EXPECT_EQ(a.region, b.region) << name;
    EXPECT_EQ(a.counts.segments, b.counts.segments) << name;
  }
}

/// A floor that does not cast, a camera above it, a light, and casters between.
Scene scene_over_floor(std::vector<TriangleMesh> casters, const DiskLight& light) {
  Scene scene;
  testing::light_of(scene) = light;
  scene.camera = {{3.1, 4.2, 5.3}, {0, 0.4, 0}, {0, 1, 0}, 45};
  scene.objects.push_back({"floor", make_plane(4.0, 3), Vec3(0.8), false});
  for (TriangleMesh& mesh : casters) scene.objects.push_back({"caster", std::move(mesh), Vec3(0.8), true});
  return scene;
}
const DiskLight kLamp{{0.3, 4, -0.2}, {0, -1, 0}, 0.9};

void expect_agreement(const Scene& scene, const char* what, double most = 0.03) {
  const Compared c = against_rays(scene, 128, 96, 1024);
  std::printf("%-22s RMSE %.5f max %.4f over %zu pixels\n", what, c.figures.rmse, c.figures.max_absolute,
              c.figures.pixels);
  EXPECT_GT(c.figures.pixels, 100u) << what;
  EXPECT_LE(c.figures.rmse, 0.0015) << what;
  EXPECT_LE(c.figures.max_absolute, most) << what;
}

TEST(Silhouette, ContactOfCasterAndFloor) {
  expect_agreement(scene_over_floor({make_box({0, 0.5, 0}, {0.6, 0.5, 0.4})}, kLamp), "contact");
}

TEST(Silhouette, CastersThatCrossTheLightsPlane) {
  expect_agreement(scene_over_floor({make_box({0.9, 3.9, 0.1}, {0.35, 0.8, 0.5})}, kLamp),
                   "box through the disk");
  expect_agreement(scene_over_floor({make_triangle({0.5, 5, -0.1}, {-0.4, 3, 0.4}, {0.9, 2.5, 0.3})}, kLamp),
                   "triangle through it");
}

TEST(Silhouette, ASheetInTheLightsPlaneHidesNothing) {
  for (const double tilt : {0.0, 1e-18, -1e-17, 1e-16}) {
    std::vector<Vec3> points;
    std::vector<IndexedTriangle> faces;
    for (std::uint32_t i = 0; i < 8; ++i) {
      const double x = 0.2 * i - 0.7, z = i % 2 ? tilt : -tilt;
      points.insert(points.end(), {{x, -0.4, z}, {x, 0.45, -z}});
      if (i > 0) faces.insert(faces.end(), {{2 * i - 2, 2 * i - 1, 2 * i}, {2 * i, 2 * i - 1, 2 * i + 1}});
    }
    const Scene scene = testing::scene_in_light_frame(0.8, {TriangleMesh::build(points, faces)});
    for (const float v : see(scene, grid(6.0, 10.0, 32)).visibility) EXPECT_EQ(v, 1.0f) << tilt;
  }
}

/// Two layers of thin bars across the light, along x or y.
Scene fence(bool along_x) {
  std::vector<TriangleMesh> bars;
  for (int k = 0; k < 44; ++k)
    for (const double z : {0.05, 0.3}) {
      const double at = 0.05 * k - 1.1, width = 0.018;
      bars.push_back(along_x ? testing::rectangle(-2.0, 2.0, at, at + width, z)
                             : testing::rectangle(at, at + width, -2.0, 2.0, z));
    }
  return testing::scene_in_light_frame(1.0, std::move(bars));
}

TEST(Silhouette, RowsMeasureRegularPatterns) {
  for (const bool along_x : {false, true}) {
    const Scene scene = fence(along_x);
    const SurfaceBuffer surface = grid(4.0, 10.0, 24);
    const RayScene rays(scene, 0);
    SilhouetteOptions options;
    const Values usual = testing::see_silhouettes(scene, rays, surface, options).visibility;
    options.rows = 1024;
    const Values fine = testing::see_silhouettes(scene, rays, surface, options).visibility;
    for (std::size_t i = 0; i < usual.size(); ++i) EXPECT_NEAR(usual[i], fine[i], 0.005) << i;
  }
}

TEST(Silhouette, CoincidentCastersAreOne) {
  const TriangleMesh box = make_box({0, 1.2, 0}, {0.6, 0.5, 0.4});
  const Scene one = scene_over_floor({box}, kLamp), two = scene_over_floor({box, box}, kLamp);
  const testing::View view(one, 128, 96), twice(two, 128, 96);
  const SilhouetteResult a = view.see_silhouettes();
  const SilhouetteResult b = testing::see_silhouettes(two, twice.rays, view.surface);
  for (std::size_t i = 0; i < view.surface.size(); ++i)
    ASSERT_NEAR(a.visibility[i], b.visibility[i], 1e-6) << "pixel " << i;
}

// An open box, one with a face turned over, two that pass through each other, three faces at an edge.
TEST(Silhouette, DoesNotNeedSolidCasters) {
  const TriangleMesh box = make_box({0, 1.2, 0}, {0.6, 0.5, 0.4});
  const std::vector<Vec3> points(box.positions().begin(), box.positions().end());
  std::vector<IndexedTriangle> faces(box.triangles().begin(), box.triangles().end());
  const std::vector<IndexedTriangle> open(faces.begin() + 3, faces.end());
  expect_agreement(scene_over_floor({testing::mesh_of(points, open)}, kLamp), "open");
  std::vector<IndexedTriangle> turned = faces;
  std::swap(turned[5][0], turned[5][1]);
  expect_agreement(scene_over_floor({testing::mesh_of(points, turned)}, kLamp), "face turned over");
  expect_agreement(scene_over_floor({box, make_box({0.3, 1.4, 0.2}, {0.5, 0.3, 0.5})}, kLamp),
                   "one through the other");
  std::vector<Vec3> more = points;
  more.push_back({0.9, 2.0, 0.9});
  std::vector<IndexedTriangle> fin = faces;
  fin.push_back({faces[0][0], faces[0][1], static_cast<std::uint32_t>(more.size() - 1)});
  expect_agreement(scene_over_floor({testing::mesh_of(more, fin)}, kLamp), "three faces at an edge");
}

// Edges that pass exactly through the disk's center and poles, seen from receivers exactly under them.
TEST(Silhouette, EdgesThroughTheCenter) {
  const Scene scene = testing::scene_in_light_frame(1.0, {testing::rectangle(0, 30, -30, 30, 4.0)});
  std::vector<Vec3> points;
  for (int j = 0; j < 16; ++j)
    for (int i = 0; i < 16; ++i) points.push_back({0.0, 0.125 * (j - 8), 5.0 + 0.25 * i});
  const SurfaceBuffer surface = testing::receivers(points, kToLight, 16);
  for (const float v : see(scene, surface).visibility) EXPECT_NEAR(v, 0.5, 1e-6);
}

TEST(Silhouette, BehindTheLightIsDark) {
  const Scene scene = testing::scene_in_light_frame(1.0, {testing::rectangle(0, 1, -1, 1, 4.0)});
  const SurfaceBuffer surface =
      testing::receivers(std::vector<Vec3>{{0, 0, -1}, {0.5, 0, 0}, {3, 0, -2}, {0, 0, 9}}, kToLight, 4);
  const SilhouetteResult r = see(scene, surface);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(r.visibility[i], 0.0f);
    EXPECT_EQ(r.region[i], 2);
  }
  EXPECT_EQ(r.counts.behind_light, 3u);
  EXPECT_GT(r.visibility[3], 0.0f);
}

TEST(Silhouette, EmptyScenesAndPointLights) {
  Scene scene = testing::scene_in_light_frame(1.0, {});
  const SilhouetteResult r = see(scene, grid(2.0, 5.0, 16));
  for (std::size_t i = 0; i < r.visibility.size(); ++i) {
    EXPECT_EQ(r.visibility[i], 1.0f);
    EXPECT_EQ(r.region[i], 0);
  }
  testing::light_of(scene).radius = 0.0;
  EXPECT_THROW(see(scene, grid(2.0, 5.0, 16)), UsageError);
  Scene point = testing::data_scene("cube-medium");
  testing::light_of(point).radius = 0.0;
  RenderOptions options;
  options.width = 80, options.height = 60;
  options.method = "hard";
  const Image hard = render(point, options).image;
  for (const char* method : {"silhouette", "rays"}) {
    options.method = method;
    EXPECT_EQ(render(point, options).image.at("visibility"), hard.at("visibility"));
  }
}

TEST(Silhouette, RaysTraceOnlyWhatIsNotCertified) {
  const Scene scene = testing::data_scene("torus-medium");
  RenderOptions options;
  options.width = 160, options.height = 120;
  options.method = "reference";
  const RenderResult all = render(scene, options);
  options.method = "rays";
  const RenderResult some = render(scene, options);
  const auto rays_of = [](const RenderResult& r) {
    return static_cast<double>(testing::count_in(r.lights[0].counts, "rays"));
  };
  EXPECT_LT(rays_of(some), 0.5 * rays_of(all));
  const Values &a = all.image.at("visibility"), &b = some.image.at("visibility");
  const Values& region = some.image.at("region");
  // The same samples where rays are traced. Where nothing crosses the disk V is exact instead, also where the
  // horizon cuts the disk: there the reference is noisy by a chord's few strata.
  std::size_t same = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_NEAR(a[i], b[i], region[i] >= 0.0f ? 0.0 : 0.03) << i;
    same += a[i] == b[i] ? 1 : 0;
  }
  EXPECT_GT(same, a.size() * 9 / 10);
}

// Decided by the geometry of faces: rays miss what overlaps the pyramid by little.
TEST(Silhouette, CertifiesWhatNoFaceOverlaps) {
  for (const char* name : {"cube-large", "boxes-large", "boxes-medium", "torus-large", "sphere-small",
                           "bunny-large", "knot1-medium", "armadillo-medium"}) {
    const Scene scene = testing::data_scene(name);
    const RayScene rays(scene, 0);
    const SurfaceBuffer surface = make_surface_buffer(scene, rays, 160, 120);
    const SilhouetteResult r = testing::see_silhouettes(scene, rays, surface);
    const testing::LitShare lit = testing::certified_share_of_free(scene, surface, r.region, 3'000'000);
    std::printf("%-16s %.4f of what no face overlaps is certified lit (%zu pixels without certificate)\n",
                name, lit.share, lit.tested);
    EXPECT_GE(lit.share, 0.97) << name;
    EXPECT_EQ(lit.overlapped, 0u) << name;
  }
}

TEST(Silhouette, CanBeCancelled) {
  const Scene scene = testing::data_scene("cube-medium");
  const testing::View view(scene, 64, 48);
  EXPECT_THROW(view.see_silhouettes({}, [](double) { return false; }), Cancelled);
}

}  // namespace
}  // namespace penumbra
