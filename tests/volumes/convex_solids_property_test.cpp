// Volumes of random convex solids against oracles that share nothing with them: no point in a produced umbra
// sees any of the light, none outside of it is wholly hidden, and none outside of the penumbra volume misses
// any. Half of the points lie within 1e-3 of a produced surface. 100 solids by default; PENUMBRA_LONG=1 in
// the environment: 1,000.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <iostream>

#include "penumbra/volumes/convex_umbra.h"
#include "penumbra/volumes/volumes.h"
#include "tests/volumes/light_samples.h"
#include "tests/volumes/random_solids.h"
#include "tests/volumes/umbra_oracle.h"

namespace penumbra {
namespace {

constexpr std::uint64_t kSeed = 1'000'003;
constexpr int kPoints = 1000;
constexpr double kNearSurface = 1e-3;
constexpr double kRounding = 1e-13;  // scene units, in scenes of 20 and with far corners at 100

struct Figures {
  long points = 0, umbra = 0, penumbra = 0, false_umbra = 0, missed_umbra = 0, missed_penumbra = 0;
  long within_rounding = 0, exact = 0;
};

class SolidCheck {
 public:
  SolidCheck(const testing::ConvexScene& scene, testing::RandomInputs& random)
      : scene_(scene),
        random_(random),
        oracle_(scene.mesh, scene.light),
        umbra_oracle_(scene.mesh, scene.light) {
    ExtrudeOptions options;
    options.bound_center = scene.box.center();
    options.bound_radius = scene.box.radius();
    const Classification classes = classify_faces(scene.mesh, scene.light);
    umbra_ = convex_umbra(scene.mesh, scene.light, classes, options);
    penumbra_ = extrude_penumbra(scene.mesh, scene.light, classes, options);
  }

  void run(Figures& figures, int solid) {
    ASSERT_EQ(umbra_.guarantee, Guarantee::kExact) << "seed " << kSeed << " solid " << solid;
    const testing::TriangleTree umbra(umbra_.positions, umbra_.triangles),
        penumbra(penumbra_.positions, penumbra_.triangles);
    const Vec3 outside = testing::unshadowed_point(scene_.light, scene_.mesh.bounds(), 1.0);
    for (int i = 0; i < kPoints; ++i) {
      const Vec3 x = i % 2 ? near(i % 4 == 1 ? umbra_ : penumbra_) : anywhere();
      const bool dark = umbra_oracle_.is_wholly_hidden(x), shaded = oracle_.is_partly_hidden(x);
      const int in_umbra = testing::winding_number(umbra, x, outside, 0.1, random_);
      const int in_penumbra = testing::winding_number(penumbra, x, outside, 0.1, random_);
      ++figures.points;
      figures.umbra += dark;
      figures.penumbra += shaded && !dark;
      const bool differs = (in_umbra >= 1) != dark, rounding = std::abs(beyond(umbra_, x)) <= kRounding;
      figures.within_rounding += differs && rounding;
      figures.false_umbra += differs && !rounding && !dark;
      figures.missed_umbra += differs && !rounding && dark;
      figures.missed_penumbra += in_penumbra < 1 && shaded;
      if ((differs && !rounding) || (in_penumbra < 1 && shaded))
        ADD_FAILURE() << "seed " << kSeed << " solid " << solid << " point " << i << ": umbra " << in_umbra
                      << " for " << dark << ", penumbra " << in_penumbra << " for " << shaded << ", "
                      << beyond(umbra_, x) << " beyond the umbra's planes, " << beyond(penumbra_, x)
                      << " beyond the penumbra's, at " << x.x << ", " << x.y << ", " << x.z
                      << "; to a corner " << to_corner(x);
    }
    figures.exact += static_cast<long>(umbra_oracle_.exact_decisions() + oracle_.exact_decisions());
  }

 private:
  bool usable(const Vec3& x) const {
    for (int k = 0; k < 3; ++k) {
      if (x[k] < scene_.box.low[k] || x[k] > scene_.box.high[k]) return false;
    }
    return side_of_light_plane(x, scene_.light) == Sign::kPositive;
  }

  /// How far x is beyond the triangle planes of a convex piece; negative inside.
  static double beyond(const ShadowMesh& volume, const Vec3& x) {
    double most = -std::numeric_limits<double>::infinity();
    for (const IndexedTriangle& t : volume.triangles) {
      const Vec3 &a = volume.positions[t[0]], &b = volume.positions[t[1]], &c = volume.positions[t[2]];
      most = std::max(most, glm::dot(glm::normalize(glm::cross(b - a, c - a)), x - a));
    }
    return most;
  }

  double to_corner(const Vec3& x) const {
    double least = std::numeric_limits<double>::infinity();
    for (const Vec3& p : scene_.mesh.positions()) least = std::min(least, glm::length(p - x));
    return least;
  }

  Vec3 anywhere() {
    for (;;) {
      Vec3 x;
      for (int k = 0; k < 3; ++k) x[k] = random_.uniform(scene_.box.low[k], scene_.box.high[k]);
      if (usable(x)) return x;
    }
  }

  /// Triangles reach far beyond the box: of several tries, weights towards near corners.
  Vec3 near(const ShadowMesh& volume) {
    for (int attempt = 0; attempt < 1000; ++attempt) {
      const auto i =
          static_cast<std::size_t>(random_.integer(0, static_cast<int>(volume.triangles.size()) - 1));
      const IndexedTriangle& t = volume.triangles[i];
      Vec3 weight(random_.uniform(0, 1), random_.uniform(0, 1), random_.uniform(0, 1));
      weight *= weight * weight;
      Vec3 x(0.0);
      for (int k = 0; k < 3; ++k) x += weight[k] / (weight.x + weight.y + weight.z) * volume.positions[t[k]];
      x += std::pow(random_.uniform(0, 1), 3.0) * kNearSurface * random_.direction();
      if (usable(x)) return x;
    }
    return anywhere();
  }

  const testing::ConvexScene& scene_;
  testing::RandomInputs& random_;
  testing::ShadowOracle oracle_;
  testing::UmbraOracle umbra_oracle_;
  ShadowMesh umbra_, penumbra_;
};

class ConvexSolids : public ::testing::TestWithParam<bool> {};

INSTANTIATE_TEST_SUITE_P(Lights, ConvexSolids, ::testing::Bool(),
                         [](const auto& each) { return each.param ? "distant" : "disk"; });

TEST_P(ConvexSolids, UmbraIsExactAndPenumbraContains) {
  const int solids = std::getenv("PENUMBRA_LONG") ? 1000 : 100;
  testing::RandomInputs random(kSeed);
  Figures figures;
  for (int k = 0; k < solids && !HasFailure(); ++k) {
    const testing::ConvexScene scene = testing::random_convex_scene(random, k, GetParam());
    SolidCheck(scene, random).run(figures, k);
  }
  std::cout << "  " << solids << " solids, " << figures.points << " points: " << figures.umbra
            << " in umbra, " << figures.penumbra << " in penumbra; false umbra " << figures.false_umbra
            << ", missed umbra " << figures.missed_umbra << ", outside of the penumbra volume "
            << figures.missed_penumbra << "; umbra undecided by rounding " << figures.within_rounding
            << "; exact decisions of the oracles " << figures.exact << "\n";
  EXPECT_GT(figures.umbra, figures.points / 100);
  EXPECT_GT(figures.penumbra, figures.points / 50);
}

}  // namespace
}  // namespace penumbra
