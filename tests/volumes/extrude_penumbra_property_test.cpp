// The guarantee of penumbra volumes: no point that is not fully lit is outside. For every caster of
// data/scenes, half of the points are within 1e-3 of the volume's surface, half anywhere in the scene's box.
// A tenth of the points by default; PENUMBRA_LONG=1 in the environment asks for all.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <iostream>

#include "mesh/shapes.h"
#include "tests/volumes/convex_pieces.h"
#include "tests/volumes/scene_caster.h"
#include "tests/volumes/shadow_oracle.h"
#include "volumes/volumes.h"

namespace penumbra {
namespace {

constexpr std::uint64_t kSeed = 36;
constexpr double kNearSurface = 1e-3;

int point_count() {
  return std::getenv("PENUMBRA_LONG") ? 100'000 : 10'000;
}

class ContainmentCheck {
 public:
  ContainmentCheck(const TriangleMesh& mesh, const DiskLight& light, const ShadowMesh& volume,
                   const Bounds& box)
      : random_(kSeed),
        volume_(volume),
        box_(box),
        light_(light),
        oracle_(mesh, light),
        pieces_(volume.positions, volume.triangles, light) {
    EXPECT_EQ(pieces_.size(), volume.cells);
    EXPECT_TRUE(pieces_.all_convex_and_closed());
  }

  void run(int count) {
    for (int i = 0; i < count; ++i) {
      const Vec3 x = i % 2 ? near_surface() : anywhere();
      const int winding = pieces_.winding_number(x, 1);
      const bool shaded = oracle_.is_partly_hidden(x);
      (i % 2 ? shaded_near_ : shaded_anywhere_) += shaded;
      if (winding >= 1) (i % 2 ? inside_near_ : inside_anywhere_) += 1;
      if (i % 100 == 0) most_ = std::max(most_, pieces_.winding_number(on_some_cell()));
      if (shaded && winding < 1) {
        ++outside_;
        ADD_FAILURE() << "seed " << kSeed << ", point " << i << ": (" << x.x << ", " << x.y << ", " << x.z
                      << ") is not fully lit but has winding number " << winding;
        if (outside_ > 3) return;
      }
    }
  }

  void print(const std::string& name, double milliseconds) const {
    const auto share = [](int part, int all) { return all > 0 ? 100.0 * (all - part) / all : 0.0; };
    std::cout << "  " << name << ": cells " << volume_.cells << ", triangles " << volume_.triangles.size()
              << ", built in " << milliseconds << " ms; not fully lit: " << shaded_near_ << " near, "
              << shaded_anywhere_ << " anywhere, outside " << outside_
              << "; inside but fully lit: " << share(shaded_near_, inside_near_) << "% near, "
              << share(shaded_anywhere_, inside_anywhere_) << "% anywhere; greatest winding " << most_
              << "; exact decisions " << oracle_.exact_decisions() << "\n";
  }
  int shaded() const { return shaded_near_ + shaded_anywhere_; }

 private:
  bool usable(const Vec3& x) const {
    for (int k = 0; k < 3; ++k) {
      if (x[k] < box_.low[k] || x[k] > box_.high[k]) return false;
    }
    return side_of_light_plane(x, light_) == Sign::kPositive;
  }

  Vec3 anywhere() {
    for (;;) {
      Vec3 x;
      for (int k = 0; k < 3; ++k) x[k] = random_.uniform(box_.low[k], box_.high[k]);
      if (usable(x)) return x;
    }
  }

  /// A point within 1e-3 of the volume's outside. Several in a row are by the same place of it, which is
  /// costly to find.
  Vec3 near_surface() {
    constexpr int kUses = 8, kAttempts = 100;
    if (uses_++ % kUses == 0) surface_ = outer_surface_point();
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
      const Vec3 x = surface_ + std::pow(random_.uniform(0.0, 1.0), 3.0) * kNearSurface * random_.direction();
      if (usable(x)) return x;
    }
    return anywhere();
  }

  /// Where a ray from the inside leaves the volume for the last time.
  Vec3 outer_surface_point() {
    constexpr int kAttempts = 100;
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
      const Vec3 start = on_some_cell(), way = anywhere() - start;
      const double t = pieces_.last_exit(start, way);
      if (t >= 0.0 && t < 1.0) return start + t * way;
    }
    return anywhere();  // the volume fills the box
  }

  /// A point on the surface of some cell, inside of others as a rule; towards the near corners, since the far
  /// ones are beyond the box.
  Vec3 on_some_cell() {
    for (int attempt = 0; attempt < 1000; ++attempt) {
      const std::size_t i = static_cast<std::size_t>(random_.uniform(0.0, 1.0) * volume_.triangles.size());
      const IndexedTriangle& t = volume_.triangles[i];
      Vec3 weights(random_.uniform(0, 1), random_.uniform(0, 1), random_.uniform(0, 1));
      weights *= weights * weights;
      const Vec3 p = (weights.x * volume_.positions[t[0]] + weights.y * volume_.positions[t[1]] +
                      weights.z * volume_.positions[t[2]]) /
                     (weights.x + weights.y + weights.z);
      if (usable(p)) return p;
    }
    return anywhere();
  }

  testing::RandomInputs random_;
  const ShadowMesh& volume_;
  Bounds box_;
  DiskLight light_;
  testing::ShadowOracle oracle_;
  testing::ConvexPieces pieces_;
  Vec3 surface_{0.0};
  int uses_ = 0;
  int shaded_near_ = 0, shaded_anywhere_ = 0, inside_near_ = 0, inside_anywhere_ = 0, outside_ = 0, most_ = 0;
};

ShadowMesh build_timed(const TriangleMesh& mesh, const DiskLight& light, const Bounds& box,
                       double& milliseconds) {
  VolumeOptions options;
  options.extrude.bound_center = box.center();
  options.extrude.bound_radius = box.radius();
  const auto start = std::chrono::steady_clock::now();
  ShadowMesh volume = build_shadow_volumes(mesh, light, options).penumbra;
  milliseconds = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  return volume;
}

void check(const std::string& name, const TriangleMesh& mesh, const DiskLight& light, const Bounds& box,
           int points) {
  double milliseconds = 0.0;
  const ShadowMesh volume = build_timed(mesh, light, box, milliseconds);
  ASSERT_EQ(volume.guarantee, Guarantee::kContains);
  ContainmentCheck check(mesh, light, volume, box);
  check.run(points);
  check.print(name, milliseconds);
  EXPECT_GT(check.shaded(), points / 100) << "too few points in shadow to mean anything";
}

class EveryScene : public ::testing::TestWithParam<std::string> {};

TEST_P(EveryScene, NoPointInShadowIsOutsideOfThePenumbraVolume) {
  const testing::SceneCaster scene = testing::load_scene(GetParam());
  check(scene.name, scene.mesh, scene.light, scene.scene, point_count());
}

INSTANTIATE_TEST_SUITE_P(Data, EveryScene, ::testing::ValuesIn(testing::scene_names()),
                         [](const auto& scene) {
                           std::string name = scene.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

/// A convex caster of many vertices, most of which are left out of the far end.
TEST(PenumbraOfAFineSphere, ContainsItsShadow) {
  Bounds box;
  box.add(Vec3(-6, 0, -6));
  box.add(Vec3(6, 10, 6));
  for (const double radius : {0.0001, 0.8, 3.5}) {
    check("fine sphere", make_icosphere({-0.3, 5, 0.1}, 1.0, 5), DiskLight{{0, 10, 0}, {0.1, -1, 0}, radius},
          box, 4000);
  }
}

TEST(PenumbraOfAFineSphere, ContainsItsShadowWhenTinyAndFarFromTheAxis) {
  const Vec3 center(900, 5, 0);
  Bounds box;
  box.add(center - Vec3(1e-6));
  box.add(center + Vec3(1e-6));
  const DiskLight light{{0, 10, 0}, {0, -1, 0}, 1e-9};
  check("tiny sphere", make_icosphere(center, 1e-6, 3), light, box, 2000);
}

/// Lights that cut through the caster or touch it: clipped triangles, distance cut-offs and half-space cells.
TEST(PenumbraNearTheLight, ContainsTheShadowOfFacesThatCrossItsPlane) {
  const TriangleMesh mesh =
      testing::read_moved(std::filesystem::path(PENUMBRA_DATA) / "scenes" / "torus.off", Vec3(0.0));
  const Bounds box = bounds_of(mesh.positions());
  const Vec3 c = box.center();
  for (const Vec3& at : {c, Vec3(box.high.x, c.y, c.z), Vec3(c.x, box.high.y, c.z), box.high}) {
    check("torus and a light at " + std::to_string(at.x), mesh, DiskLight{at, {0.1, -1, 0.2}, 0.1}, box,
          2000);
  }
}

}  // namespace
}  // namespace penumbra
