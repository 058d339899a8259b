#include "render/d_buffer/d_buffer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/matrix.hpp>

#include "penumbra/mesh/error.h"
#include "penumbra/render/renderer.h"
#include "penumbra/volumes/volumes.h"
#include "render/d_buffer/entries/targets.h"
#include "render/shading/shading.h"
#include "render/silhouette/silhouette_visibility.h"
#include "tests/render/error_support.h"
#include "tests/render/render_support.h"

namespace penumbra {
namespace {

using testing::at_pixels;
using testing::Pixels;
using testing::Random;
using testing::Values;
using testing::View;

/// One context for all tests: it takes a while to start.
gl::Context& context() {
  static const std::unique_ptr<gl::Context> shared = gl::make_context(gl::Backend::kOsMesa);
  return *shared;
}

DBufferFrame draw(const Scene& scene, const SurfaceBuffer& surface, const DBufferOptions& options) {
  const RayScene rays(scene, 0);
  DBuffer buffer(context(), scene, rays);
  buffer.set_surface(surface.receivers());
  return buffer.render(testing::light_of(scene), options);
}

DBufferFrame draw(const Scene& scene, const SurfaceBuffer& surface, int size = 0) {
  return draw(scene, surface, DBufferOptions{.size = size});
}

::testing::AssertionResult all_in_range(const Values& visibility) {
  for (std::size_t i = 0; i < visibility.size(); ++i)
    if (!(visibility[i] >= 0.0f && visibility[i] <= 1.0f + 1e-6f))
      return ::testing::AssertionFailure() << "visibility " << visibility[i] << " at pixel " << i;
  return ::testing::AssertionSuccess();
}

/// RMSE over the true penumbra of `pixels`, by two references of 256 samples.
ErrorFigures error_over_penumbra(const View& view, const Values& visibility, const Pixels& pixels) {
  const Pixels near = view.near_penumbra(pixels);
  return testing::penumbra_error(at_pixels(visibility, near), view.trace(near, 256, 21),
                                 view.trace(near, 256, 22));
}

struct Threshold {
  const char* scene;
  double rmse;
};

class DBufferScenes : public ::testing::TestWithParam<Threshold> {};

// The engine's stated accuracy for floor pixels. It holds for 640×480; half that size samples the same
// penumbra.
INSTANTIATE_TEST_SUITE_P(Data, DBufferScenes,
                         ::testing::Values(Threshold{"cube-small", .004}, Threshold{"cube-medium", .001},
                                           Threshold{"sphere-small", .01}, Threshold{"sphere-medium", .0125},
                                           Threshold{"torus-small", .011}, Threshold{"torus-medium", .0175},
                                           Threshold{"boxes-small", .01}, Threshold{"boxes-medium", .0115}),
                         [](const auto& threshold) {
                           std::string name = threshold.param.scene;
                           name[name.find('-')] = '_';
                           return name;
                         });

TEST_P(DBufferScenes, ErrorOnTheFloor) {
  const Scene scene = testing::data_scene(GetParam().scene);
  const View view(scene, 320, 240);
  const Values v = draw(scene, view.surface).visibility;
  EXPECT_TRUE(all_in_range(v));
  const ErrorFigures floor = error_over_penumbra(view, v, testing::pixels_of(view.surface, 0));
  std::printf("%-14s floor: %zu pixels, RMSE %.4f (at most %.3f)\n", GetParam().scene, floor.pixels,
              floor.rmse, GetParam().rmse);
  EXPECT_GT(floor.pixels, 400u);
  EXPECT_LE(floor.rmse, GetParam().rmse);
}

class PaperContents : public ::testing::TestWithParam<Threshold> {};

// What a prototype of the paper's method with eq. 2 and 3 corrected reached at 1024² texels, and 15% more.
INSTANTIATE_TEST_SUITE_P(Data, PaperContents,
                         ::testing::Values(Threshold{"cube-small", .038}, Threshold{"cube-medium", .054},
                                           Threshold{"sphere-small", .031}, Threshold{"sphere-medium", .035},
                                           Threshold{"torus-small", .035}, Threshold{"torus-medium", .053},
                                           Threshold{"boxes-small", .053}, Threshold{"boxes-medium", .089},
                                           Threshold{"foliage-small", .163},
                                           Threshold{"foliage-medium", .154}),
                         [](const auto& threshold) {
                           std::string name = threshold.param.scene;
                           name[name.find('-')] = '_';
                           return name;
                         });

TEST_P(PaperContents, ErrorOnTheFloor) {
  const Scene scene = testing::data_scene(GetParam().scene);
  const View view(scene, 320, 240);
  const Values v =
      draw(scene, view.surface,
           {.size = 1024, .contents = DBufferContents::kDistances, .curve = VisibilityCurve::kSmoothstep})
          .visibility;
  EXPECT_TRUE(all_in_range(v));
  const ErrorFigures floor = error_over_penumbra(view, v, testing::pixels_of(view.surface, 0));
  std::printf("%-15s floor: %zu pixels, RMSE %.4f (prototype %.3f)\n", GetParam().scene, floor.pixels,
              floor.rmse, GetParam().rmse);
  EXPECT_GT(floor.pixels, 400u);
  EXPECT_LE(floor.rmse, 1.15 * GetParam().rmse);
}

/// Every option at once sane: in range, and not worse than a hard shadow on a scene that suits the method.
TEST(DBuffer, EveryOptionBeatsTheHardShadow) {
  const Scene scene = testing::data_scene("torus-medium");
  const View view(scene, 160, 120);
  const Pixels floor = testing::pixels_of(view.surface, 0);
  const Values hard = trace_hard(view.rays, testing::light_of(scene), view.surface.receivers(),
                                 testing::every_pixel(view.surface))
                          .visibility;
  const double worst = error_over_penumbra(view, hard, floor).rmse;
  for (const auto center : {CenterTest::kRay, CenterTest::kDepth})
    for (const auto conflict : {Conflict::kNearest, Conflict::kFurthest})
      for (const auto curve :
           {VisibilityCurve::kExact, VisibilityCurve::kSmoothstep, VisibilityCurve::kSquareRoot})
        for (const auto contents : {DBufferContents::kEdge, DBufferContents::kDistances}) {
          const Values v =
              draw(scene, view.surface,
                   {.contents = contents, .curve = curve, .conflict = conflict, .center = center})
                  .visibility;
          EXPECT_TRUE(all_in_range(v));
          const double rmse = error_over_penumbra(view, v, floor).rmse;
          std::printf("%s %s %s %s: %.4f (hard shadow %.4f)\n", name_in(d_buffer_contents(), contents),
                      name_in(visibility_curves(), curve), name_in(conflicts(), conflict),
                      name_in(center_tests(), center), rmse, worst);
          EXPECT_LT(rmse, worst);
        }
}

TEST(DBuffer, CastersOwnSurfaceIsClean) {
  for (const char* name : {"cube-small", "cube-medium", "sphere-small", "sphere-medium"}) {
    const Scene scene = testing::data_scene(name);
    const View view(scene, 320, 240);
    const Values v = draw(scene, view.surface).visibility;
    const Pixels own = testing::pixels_of(view.surface, 1);
    const ErrorFigures figures = error_figures(at_pixels(v, own), view.trace(own, 256, 21),
                                               view.trace(own, 256, 22), testing::first_pixels(own.size()));
    std::printf("%-14s caster: %zu pixels, RMSE %.4f\n", name, figures.pixels, figures.rmse);
    EXPECT_GT(figures.pixels, 1'000u) << name;
    EXPECT_LE(figures.rmse, 0.01) << name;
  }
}

TEST(DBuffer, FarFromCastersIsTheHorizonsFraction) {
  for (const char* name : {"cube-medium", "torus-large"}) {
    const Scene scene = testing::data_scene(name);
    const View view(scene, 160, 120);
    const Values v = draw(scene, view.surface, 256).visibility;
    int far = 0;
    for (std::size_t i = 0; i < v.size(); ++i) {
      const Vec3& p = view.surface.position[i];
      if (view.surface.object[i] != 0 || p.y < 0.0 || std::hypot(p.x, p.z) < 9.0) continue;
      ++far;
      ASSERT_NEAR(v[i], fraction_above_horizon(testing::light_of(scene), p, view.surface.normal[i]), 1e-5)
          << name << ", pixel " << i;
    }
    EXPECT_GT(far, 500) << name;
  }
}

/// Receivers all over the space in front of the light and a little behind, turned at random.
SurfaceBuffer scattered_receivers(std::uint64_t seed, const DiskLight& light, int count) {
  Random random(seed);
  std::vector<Vec3> points, normals;
  for (int i = 0; i < count; ++i) {
    points.push_back(light.center + random.point(5.0) + 4.0 * glm::normalize(light.normal));
    normals.push_back(random.direction());
  }
  return testing::receivers(points, normals, 64);
}

TEST(DBuffer, WithoutCastersIsTheHorizonsFraction) {
  Scene scene;
  testing::light_of(scene) = {{0.3, 5, 0.2}, {0.2, -1, 0.1}, 0.7};
  scene.objects.push_back({"floor", make_plane(6.0), Vec3(0.8), false});
  constexpr std::uint64_t kSeed = 99;
  const SurfaceBuffer surface = scattered_receivers(kSeed, testing::light_of(scene), 4'096);
  const Values v = draw(scene, surface, 64).visibility;
  for (std::size_t i = 0; i < v.size(); ++i)
    ASSERT_NEAR(
        v[i], fraction_above_horizon(testing::light_of(scene), surface.position[i], surface.normal[i]), 1e-5)
        << "seed " << kSeed << ", receiver " << i;
}

TEST(DBuffer, OfAnEmptyMeshListAndNoObjects) {
  Scene scene;
  testing::light_of(scene) = {{0, 5, 0}, {0, -1, 0}, 0.5};
  const SurfaceBuffer surface = testing::receivers(std::vector<Vec3>(64, Vec3(0.0)), Vec3(0, 1, 0), 64);
  for (const float v : draw(scene, surface, 64).visibility) ASSERT_NEAR(v, 1.0f, 1e-6f);
  scene.objects.push_back({"nothing", TriangleMesh(), Vec3(0.8), true});
  for (const float v : draw(scene, surface, 64).visibility) ASSERT_NEAR(v, 1.0f, 1e-6f);
}

TEST(DBuffer, CasterBehindTheLightCastsNothing) {
  Scene scene;
  testing::light_of(scene) = {{0, 5, 0}, {0, -1, 0}, 0.5};
  scene.objects.push_back({"floor", make_plane(6.0), Vec3(0.8), false});
  scene.objects.push_back({"box", make_box({0, 7, 0}, Vec3(1.0)), Vec3(0.8), true});
  const SurfaceBuffer surface = scattered_receivers(5, testing::light_of(scene), 4'096);
  const Values v = draw(scene, surface, 128).visibility;
  for (std::size_t i = 0; i < v.size(); ++i)
    ASSERT_NEAR(
        v[i], fraction_above_horizon(testing::light_of(scene), surface.position[i], surface.normal[i]), 1e-5)
        << i;
}

TEST(DBuffer, SurvivesLightsInsideOrTouchingCasters) {
  const Vec3 centers[] = {{0, 0, 0},        {0, 1, 0}, {1, 1, 1},          {1, 1, 0},   {0, 0.999999, 0},
                          {0, 1.000001, 0}, {0, 2, 0}, {0.5, 1 + 1e-9, 0}, {1.5, 0, 0}, {0, -1, 0}};
  for (const Vec3& center : centers) {
    Scene scene;
    testing::light_of(scene) = {center, {0, -1, 0}, 5.0};
    scene.objects.push_back({"floor", make_plane(6.0), Vec3(0.8), false});
    scene.objects.push_back({"box", make_box(Vec3(0.0), Vec3(1.0)), Vec3(0.8), true});
    const RayScene rays(scene, 0);
    DBuffer buffer(context(), scene, rays);
    for (const Vec3& normal : {Vec3(0, -1, 0), Vec3(0, 1, 0), Vec3(1, 1, 1)}) {
      testing::light_of(scene).normal = normal;
      buffer.set_surface(scattered_receivers(6, testing::light_of(scene), 1'024).receivers());
      for (const double radius : {1e-6, 0.3, 5.0}) {
        testing::light_of(scene).radius = radius;
        ASSERT_TRUE(all_in_range(buffer.render(testing::light_of(scene), {.size = 64}).visibility))
            << "light at " << center.x << " " << center.y << " " << center.z << ", radius " << radius;
      }
    }
  }
}

// A box through the light's plane, beside the disk: its shadow lies where the rays say.
TEST(DBuffer, CasterAcrossTheLightsPlane) {
  Scene scene;
  testing::light_of(scene) = {{0, 5, 0}, {0, -1, 0}, 0.5};
  scene.camera = {{0, 9, 12}, {0, 0, 0}, {0, 1, 0}, 50};
  scene.objects.push_back({"floor", make_plane(8.0), Vec3(0.8), false});
  scene.objects.push_back({"box", make_box({2, 4.5, 0}, {0.4, 1.5, 0.6}), Vec3(0.8), true});
  const View view(scene, 160, 120);
  const DBufferFrame frame = draw(scene, view.surface, 512);
  EXPECT_TRUE(all_in_range(frame.visibility));
  const Pixels floor = testing::pixels_of(view.surface, 0);
  const Values r1 = view.trace(floor, 64, 21), r2 = view.trace(floor, 64, 22),
               v = at_pixels(frame.visibility, floor);
  const ErrorFigures figures = testing::penumbra_error(v, r1, r2);
  std::printf("across the light's plane: %zu pixels, RMSE %.4f\n", figures.pixels, figures.rmse);
  EXPECT_GT(figures.pixels, 200u);
  EXPECT_LE(figures.rmse, 0.01) << "corners, and texels of a coarse hemicube";
  std::size_t umbra = 0, dark = 0;
  for (std::size_t i = 0; i < floor.size(); ++i) {
    if (r1[i] + r2[i] > 0.0f) continue;
    ++umbra;
    dark += v[i] < 0.05f;
  }
  EXPECT_GT(umbra, 100u);
  EXPECT_GT(static_cast<double>(dark), 0.98 * static_cast<double>(umbra));
}

/// A box at |x/z| up to `widest`, over a floor in the light's frame.
Scene box_at_tangent(double widest) {
  Scene scene = testing::scene_in_light_frame(0.4, {});
  const double nearest = 4.0, far = 10.0;
  // The window reaches to the box's outer corner plus the penumbra's width there.
  const double reach = 0.4 * (1.0 / nearest - 1.0 / far);
  const double outer = (widest - reach) * nearest;
  scene.camera = {{0.6 * outer, 0, 1}, {2.0 * outer, 0, far}, {0, 1, 0}, 75};
  scene.objects.push_back({"floor", testing::rectangle(-60, 60, -60, 60, far), Vec3(0.8), false});
  scene.objects.push_back({"box", make_box({outer - 0.7, 0, 4.5}, {0.7, 0.6, 0.5}), Vec3(0.8), true});
  return scene;
}

// The same shadow by one perspective and by a hemicube, either side of where the engine changes over.
TEST(DBuffer, WideScenesUseAHemicubeThatAgreesWithOnePerspective) {
  double rmse[2];
  for (const bool wide : {false, true}) {
    const Scene scene = box_at_tangent(detail::kWidestWindow * (wide ? 1.02 : 0.95));
    const View view(scene, 240, 180);
    const DBufferFrame frame = draw(scene, view.surface, 1024);
    EXPECT_EQ(testing::count_in(frame.counts, "targets"), wide ? 2u : 1u)
        << "the front, and the side that the box is on";
    EXPECT_TRUE(all_in_range(frame.visibility));
    const ErrorFigures figures =
        error_over_penumbra(view, frame.visibility, testing::pixels_of(view.surface, 0));
    std::printf("%s: %zu pixels, RMSE %.4f\n", wide ? "hemicube" : "one target", figures.pixels,
                figures.rmse);
    EXPECT_GT(figures.pixels, 300u);
    rmse[wide] = figures.rmse;
  }
  // A box is exact but for corners whose texels are taken by the wrong edge.
  EXPECT_LE(rmse[0], 0.01);
  EXPECT_LE(rmse[1], 0.01);
}

// A post that ends just below the lamp hides the center from everywhere, and all entries are wrong alike:
// nothing contradicts anything, so that only rays at even distances tell.
TEST(DBuffer, APostBelowTheLampDoesNotDarkenTheFloor) {
  const Scene scene = testing::scene_in_light_frame(0.5, {make_box({0, 0, 2.01}, {0.04, 0.04, 1.99})});
  std::vector<Vec3> points;
  for (int j = 0; j < 120; ++j)
    for (int i = 0; i < 160; ++i) points.push_back({0.05 * i - 4.013, 0.05 * j - 3.017, 4.0});
  const SurfaceBuffer surface = testing::receivers(points, Vec3(0, 0, -1), 160);
  const RayScene rays(scene, 0);
  const Values truth = testing::see_silhouettes(scene, rays, surface).visibility;
  const Values v = draw(scene, surface).visibility;
  double squares = 0.0;
  for (std::size_t i = 0; i < v.size(); ++i) squares += (v[i] - truth[i]) * (v[i] - truth[i]);
  const double rmse = std::sqrt(squares / static_cast<double>(v.size()));
  std::printf("a post below the lamp: RMSE %.4f\n", rmse);
  EXPECT_LE(rmse, 0.03);
}

TEST(DBuffer, OneEdgeIsTheChordFormula) {
  // The shadow's boundary on a plane, from a caster with one edge near the receivers: penumbra of 40 texels.
  const double r = 0.8, z = 5.0, depth = 10.0;
  Scene scene = testing::scene_in_light_frame(r, {testing::rectangle(-10, 0.123, -10, 10, z)});
  scene.objects.push_back({"floor", testing::rectangle(-4, 4, -4, 4, depth), Vec3(0.8), false});
  const double extent = 2.0 * 10.0 / z + 2.0 * r * (1.0 / z - 1.0 / depth);
  const double texels = 2.0 * r * (1.0 / z - 1.0 / depth) * 1020 / extent;
  ASSERT_GE(texels, 34.0);
  std::vector<Vec3> points;
  std::vector<double> expected;
  for (int j = 0; j < 64; ++j)
    for (int i = 0; i < 256; ++i) {
      const Vec3 p{-1.2 + 2.4 * (i + 0.5) / 256 + 0.246, -2.0 + 4.0 * (j + 0.37) / 64, depth};
      points.push_back(p);
      expected.push_back(half_plane_area(-(p.x + (0.123 - p.x) * depth / (depth - z)) / r));
    }
  // Few texels do as well: what a texel stores is good for every receiver, and each that touches the penumbra
  // is drawn.
  for (const int size : {1024, 100, 40}) {
    const DBufferFrame frame = draw(scene, testing::receivers(points, Vec3(0, 0, -1), 256), size);
    EXPECT_EQ(testing::count_in(frame.counts, "targets"), 1u);
    const double rms = testing::rms_difference(frame.visibility, expected);
    std::printf("one edge, penumbra %.1f texels wide: RMS difference %.2g\n", texels * (size - 4) / 1020,
                rms);
    EXPECT_LE(rms, 0.002) << size;
  }
}

/// Texel of a D-buffer with one perspective, in (x/z, y/z): it spans the casters and their penumbrae down to
/// the farthest receiver, with four texels to spare.
double texel_size(const Scene& scene, const LightFrame& axes, int size) {
  const auto local = [&](const Vec3& p) {
    const Vec3 d = p - testing::light_of(scene).center;
    return Vec3(glm::dot(d, axes.u), glm::dot(d, axes.v), glm::dot(d, axes.w));
  };
  double farthest = 0.0;
  for (const SceneObject& object : scene.objects)
    for (const Vec3& p : object.mesh.positions()) farthest = std::max(farthest, local(p).z);
  glm::dvec2 low(1e9), high(-1e9);
  for (const SceneObject& object : scene.objects) {
    if (!object.casts) continue;
    for (const Vec3& world : object.mesh.positions()) {
      const Vec3 p = local(world);
      const double reach = testing::light_of(scene).radius * (1.0 / p.z - 1.0 / farthest);
      low = glm::min(low, glm::dvec2(p.x, p.y) / p.z - reach);
      high = glm::max(high, glm::dvec2(p.x, p.y) / p.z + reach);
    }
  }
  return std::max(high.x - low.x, high.y - low.y) / (size - 4);
}

struct BandEdge {
  Vec3 a, b;          ///< light's frame
  Vec3 apex1, apex2;  ///< of the faces beside it; equal at a boundary
};

/// The receiver's exact visibility where exactly one band edge divides its disk; `texels`: how wide the
/// penumbra is.
struct OneEdge {
  bool divides = false;
  double visibility = 0.0, texels = 0.0;
};

class OneEdgeOracle {
 public:
  OneEdgeOracle(const Scene& scene, int size)
      : scene_(scene), axes_(light_frame(testing::light_of(scene))), texel_(texel_size(scene, axes_, size)) {
    for (const SceneObject& object : scene.objects) {
      if (!object.casts) continue;
      const TriangleMesh& mesh = object.mesh;
      for (const EdgeId id : find_silhouettes(mesh, classify_faces(mesh, testing::light_of(scene))).band) {
        const Edge& e = mesh.edges()[index(id)];
        const Vec3 left = local(mesh.position(e.left_apex));
        edges_.push_back({local(mesh.position(e.from)), local(mesh.position(e.to)), left,
                          e.is_boundary() ? left : local(mesh.position(e.right_apex))});
      }
    }
  }

  OneEdge at(const Vec3& world, const Vec3& normal) const {
    const Vec3 x = local(world);
    const Vec3 n(glm::dot(normal, axes_.u), glm::dot(normal, axes_.v), glm::dot(normal, axes_.w));
    const double r = testing::light_of(scene_).radius;
    if (x.z <= 0.0 || chord_of_plane(n, x, r).delta < 1.0) return {};
    const BandEdge* found = nullptr;
    for (const BandEdge& e : edges_) {
      if (std::max(e.a.z, e.b.z) >= x.z) return {};  // kept to edges wholly between light and receiver
      const glm::dvec2 p = on_disk(e.a, x) / r, q = on_disk(e.b, x) / r;
      if (distance_to_center(p, q) > 1.0) continue;
      if (found || glm::dot(p, p) < 1.0 || glm::dot(q, q) < 1.0) return {};
      found = &e;
    }
    return found ? judge(*found, world, x) : OneEdge{};
  }

 private:
  Vec3 local(const Vec3& p) const {
    const Vec3 d = p - testing::light_of(scene_).center;
    return {glm::dot(d, axes_.u), glm::dot(d, axes_.v), glm::dot(d, axes_.w)};
  }
  /// Where the line from x through p meets the light's plane.
  static glm::dvec2 on_disk(const Vec3& p, const Vec3& x) {
    return glm::dvec2(x) + glm::dvec2(p - x) * (x.z / (x.z - p.z));
  }
  static double distance_to_center(const glm::dvec2& p, const glm::dvec2& q) {
    const glm::dvec2 d = q - p;
    return glm::length(p + std::clamp(-glm::dot(p, d) / glm::dot(d, d), 0.0, 1.0) * d);
  }
  OneEdge judge(const BandEdge& e, const Vec3& world, const Vec3& x) const {
    const double r = testing::light_of(scene_).radius;
    const Vec3 plane = edge_plane(x, e.a, e.b);
    const Chord chord = chord_of_plane(plane, x, r);
    // Either side is open or hidden as a whole; one ray into each says which.
    const auto open = [&](double distance) {
      const glm::dvec2 p = r * distance * chord.normal;
      return !testing::is_blocked(scene_, world,
                                  testing::light_of(scene_).center + p.x * axes_.u + p.y * axes_.v)
                  .hidden;
    };
    const double positive = open(0.5 * (1.0 - chord.delta)) ? 1.0 : 0.0;  // half-way between chord and rim
    const double negative = open(0.5 * (-1.0 - chord.delta)) ? 1.0 : 0.0;
    const double share = half_plane_area(chord.delta);
    // The penumbra's width in (x/z, y/z) is 2r (1/z of the edge - 1/z of the receiver).
    const glm::dvec2 p = on_disk(e.a, x), q = on_disk(e.b, x), middle = -r * chord.delta * chord.normal;
    const double t = std::clamp(glm::dot(middle - p, q - p) / glm::dot(q - p, q - p), 0.0, 1.0);
    // Perspective: a point of the edge weighs its ends by the *other* parameter's distance from the
    // receiver's plane.
    const double wa = (1.0 - t) * (x.z - e.a.z), wb = t * (x.z - e.b.z);
    const double z = (wa * e.a.z + wb * e.b.z) / (wa + wb);
    return {true, positive * share + negative * (1.0 - share), 2.0 * r * (1.0 / z - 1.0 / x.z) / texel_};
  }

  const Scene& scene_;
  LightFrame axes_;
  double texel_;
  std::vector<BandEdge> edges_;
};

TEST(DBuffer, ReceiversThatOneEdgeDividesAreExact) {
  for (const char* name : {"cube-medium", "boxes-medium", "triangle-medium", "torus-medium", "cube-large"}) {
    const Scene scene = testing::data_scene(name);
    const View view(scene, 320, 240);
    const DBufferFrame frame = draw(scene, view.surface, 1024);
    ASSERT_EQ(testing::count_in(frame.counts, "targets"), 1u) << name;
    const OneEdgeOracle oracle(scene, 1024);
    Values values;
    std::vector<double> exact;
    int partly = 0;
    double worst = 0.0;
    for (std::size_t i = 0; i < view.surface.size(); ++i) {
      if (!view.surface.hit(i) || view.surface.object[i] != 0) continue;
      const OneEdge one = oracle.at(view.surface.position[i], view.surface.normal[i]);
      if (!one.divides || one.texels < 34.0) continue;
      values.push_back(frame.visibility[i]);
      exact.push_back(one.visibility);
      partly += one.visibility > 0.0 && one.visibility < 1.0;
      worst = std::max(worst, std::abs(one.visibility - frame.visibility[i]));
    }
    const double rms = values.empty() ? 0.0 : testing::rms_difference(values, exact);
    std::printf("%-16s %zu receivers (%d partly lit), RMSE %.2g, worst %.2g\n", name, values.size(), partly,
                rms, worst);
    EXPECT_LE(rms, 0.001) << name;
    if (std::string(name).find("medium") != std::string::npos && std::string(name) != "torus-medium") {
      EXPECT_GT(partly, 200) << name;
    }
  }
}

TEST(DBuffer, OfRadiusZeroIsTheHardShadow) {
  Scene scene = testing::data_scene("boxes-medium");
  testing::light_of(scene).radius = 0.0;
  RenderOptions options;
  options.width = 160, options.height = 120;
  options.method = "dbuffer";
  const Values soft = render(scene, options).image.at("visibility");
  options.method = "hard";
  EXPECT_EQ(soft, render(scene, options).image.at("visibility"));
  EXPECT_GT(std::count(soft.begin(), soft.end(), 0.0f), 500);
}

TEST(DBuffer, FramesDoNotDependOnTheFrameBefore) {
  const Scene scene = testing::data_scene("torus-medium");
  const View view(scene, 160, 120);
  DBuffer buffer(context(), scene, view.rays);
  buffer.set_surface(view.surface.receivers());
  const Values first = buffer.render(testing::light_of(scene), {.size = 256}).visibility;
  DiskLight other = testing::light_of(scene);
  other.center.x += 3.0;
  other.radius *= 3.0;
  EXPECT_NE(buffer.render(other, {.size = 128}).visibility, first);
  EXPECT_EQ(buffer.render(testing::light_of(scene), {.size = 256}).visibility, first);
}

TEST(DBuffer, SizesOutsideTheirRangeAreRefused) {
  const Scene scene = testing::data_scene("cube-medium");
  const RayScene rays(scene, 0);
  DBuffer buffer(context(), scene, rays);
  buffer.set_surface(testing::receivers({{0, 0, 0}}, Vec3(0, 1, 0), 1).receivers());
  for (const int size : {-1, 1, 15, 8193})
    EXPECT_THROW(buffer.render(testing::light_of(scene), {.size = size}), UsageError) << size;
  EXPECT_NO_THROW(buffer.render(testing::light_of(scene), {.size = 16}));
}

TEST(DBuffer, ZeroIsASizeByTheImage) {
  EXPECT_EQ(d_buffer_size_for(640, 480), 576);
  EXPECT_EQ(d_buffer_size_for(32, 24), 512);
  EXPECT_EQ(d_buffer_size_for(3840, 2160), 2880);
  EXPECT_EQ(d_buffer_size_for(20'000, 20'000), 4096);
  const Scene scene = testing::data_scene("torus-medium");
  const View view(scene, 160, 120);
  const DBufferFrame by_image = draw(scene, view.surface, 0), by_number = draw(scene, view.surface, 512);
  EXPECT_EQ(by_image.visibility, by_number.visibility);
  EXPECT_EQ(testing::count_in(by_image.counts, "buffer_size"), 512u);
}

TEST(ChooseTargets, OneWindowWhereItFitsElseFiveSides) {
  EXPECT_TRUE(detail::choose_targets({1e300, 1e300}, {-1e300, -1e300}, 1024).empty());
  const auto one = detail::choose_targets({-0.5, 0.25}, {1.0, detail::kWidestWindow}, 104);
  ASSERT_EQ(one.size(), 1u);
  const double wanted[4] = {-0.545, 1.045, 0.205, detail::kWidestWindow + 0.045};  // a margin of two texels
  for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(one[0].window[k], wanted[k], 1e-12);
  const double wide = detail::kWidestWindow + 1e-6;
  EXPECT_EQ(detail::choose_targets({-0.5, 0.25}, {0.9, wide}, 1024).size(), 2u) << "front and +y";
  EXPECT_EQ(detail::choose_targets({-0.5, 0.25}, {1.1, wide}, 1024).size(), 3u) << "and +x";
  const auto five = detail::choose_targets({-wide, -1.0}, {1.0, 1.0}, 1024);
  ASSERT_EQ(five.size(), 5u);
  for (const detail::Target& t : five) EXPECT_NEAR(glm::determinant(t.axes), 1.0, 1e-15) << "none mirrors";
  // Every direction in front of the light lies in exactly one side (but for borders).
  Random random(8);
  for (int k = 0; k < 1'000; ++k) {
    Vec3 d = random.direction();
    d.z = std::abs(d.z) + 1e-9;
    int hits = 0;
    for (const detail::Target& t : five) {
      const Vec3 p = t.axes * d;
      if (p.z <= 0.0) continue;
      const double u = p.x / p.z, v = p.y / p.z;
      hits += u >= t.window[0] && u < t.window[1] && v >= t.window[2] && v < t.window[3];
    }
    ASSERT_EQ(hits, 1) << d.x << " " << d.y << " " << d.z;
  }
}

}  // namespace
}  // namespace penumbra
