// Smooth shading: RGB of a coarse ball with normals is nearly that of a round one, and has no dark seams.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "penumbra/mesh/shapes.h"
#include "render/light/light_integrals.h"
#include "render/shading/shading.h"
#include "tests/render/render_support.h"

namespace penumbra {
namespace {

struct Ball {
  Scene scene;
  SurfaceBuffer surface;
  std::vector<float> visibility;

  explicit Ball(bool smooth) {
    scene.lights.push_back({.shape = DiskLight{.center = {3, 4, 2}, .normal = {-3, -4, -2}, .radius = 0.5},
                            .radiance = Vec3(10.0)});
    SceneObject ball{.name = "ball", .mesh = make_icosphere(Vec3(0.0), 1.0, 2), .albedo = Vec3(1.0)};
    for (const IndexedTriangle& t : ball.mesh.triangles()) {
      if (!smooth) break;
      std::array<glm::vec3, 3>& normals = ball.corner_normals.emplace_back();
      for (std::size_t k = 0; k < 3; ++k) normals[k] = glm::vec3(ball.mesh.positions()[t[k]]);
    }
    scene.objects.push_back(ball);
  }

  /// A point of a face that has these barycentric coordinates.
  void add(std::uint32_t face, double a, double b, double c) {
    const TriangleMesh& mesh = scene.objects[0].mesh;
    const auto& [i, j, k] = mesh.triangles()[face];
    const Vec3 &p = mesh.positions()[i], &q = mesh.positions()[j], &r = mesh.positions()[k];
    const Vec3 n = glm::normalize(glm::cross(q - p, r - p));
    surface.object.push_back(0);
    surface.face.push_back(face);
    surface.position.push_back(a * p + b * q + c * r);
    surface.normal.push_back(n);
    visibility.push_back(static_cast<float>(
        fraction_above_horizon(std::get<DiskLight>(scene.lights[0].shape), surface.position.back(), n)));
    surface.width = static_cast<int>(surface.object.size());
    surface.height = 1;
  }

  std::vector<float> red() const {
    const std::vector<LightVisibility> lights = {{visibility, {}}};
    return shade(scene, surface, lights, detail::make_threads(1)).at("R");
  }
};

double round_ball(const Ball& ball, std::size_t i) {
  const Vec3 n = glm::normalize(ball.surface.position[i]);
  return 10.0 / testing::kPi *
         disk_irradiance_factor(std::get<DiskLight>(ball.scene.lights[0].shape), ball.surface.position[i], n);
}

/// Of points that get at least this share of the brightest one's light on a round ball.
double rms_error(const Ball& ball, double share) {
  const std::vector<float> red = ball.red();
  std::vector<double> round;
  for (std::size_t i = 0; i < red.size(); ++i) round.push_back(round_ball(ball, i));
  const double brightest = *std::ranges::max_element(round);
  double sum = 0.0, count = 0.0;
  for (std::size_t i = 0; i < red.size(); ++i) {
    if (round[i] < share * brightest) continue;
    sum += std::pow(red[i] - round[i], 2);
    ++count;
  }
  return std::sqrt(sum / count);
}

TEST(SmoothShading, OfACoarseBallIsNearlyThatOfARoundOne) {
  Ball flat(false), smooth(true);
  for (Ball* ball : {&flat, &smooth})
    for (std::uint32_t f = 0; f < ball->scene.objects[0].mesh.triangles().size(); ++f)
      for (const auto& [a, b, c] :
           {std::array{1. / 3, 1. / 3, 1. / 3}, std::array{.8, .1, .1}, std::array{.1, .2, .7}})
        ball->add(f, a, b, c);
  EXPECT_LT(rms_error(smooth, 0.7), 0.1 * rms_error(flat, 0.7));
  // Faces that are turned away are dark, where a round ball still gets grazing light.
  EXPECT_LT(rms_error(smooth, 0.0), 0.4 * rms_error(flat, 0.0));
}

TEST(SmoothShading, ChangesLittleAcrossEdgesAndNothingElse) {
  Ball flat(false), smooth(true);
  const TriangleMesh& mesh = flat.scene.objects[0].mesh;
  for (Ball* ball : {&flat, &smooth})
    for (const Edge& e : mesh.edges())
      for (const FaceId f : {e.left, e.right}) {
        std::array<double, 3> at{};
        for (std::size_t k = 0; k < 3; ++k) {
          const VertexId v{mesh.triangles()[index(f)][k]};
          at[k] = v == e.from || v == e.to ? 0.5 : 0.0;
        }
        ball->add(static_cast<std::uint32_t>(f), at[0], at[1], at[2]);
      }
  const auto largest_step = [](const std::vector<float>& red) {
    float step = 0.0f;
    for (std::size_t i = 0; i < red.size(); i += 2) step = std::max(step, std::abs(red[i] - red[i + 1]));
    return step;
  };
  EXPECT_LT(largest_step(smooth.red()), 0.5f * largest_step(flat.red()));
  const std::vector<float> red = smooth.red(), flat_red = flat.red();
  for (std::size_t i = 0; i < red.size(); ++i)
    if (flat_red[i] == 0.0f) {
      EXPECT_EQ(red[i], 0.0f) << "a face that is turned away";
    }
  EXPECT_EQ(smooth.visibility, flat.visibility);
}

}  // namespace
}  // namespace penumbra
