// The oracle's hierarchy against all faces.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>
#include <span>

#include "penumbra/mesh/shapes.h"
#include "tests/oracle/oracle.h"
#include "tests/oracle/oracle_support.h"
#include "tests/oracle/random_inputs.h"

namespace penumbra::oracle {
namespace {

TEST(OracleHierarchy, HierarchyFindsWhatAllFacesDo) {
  int blocked = 0, rays = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    Random random(seed);
    const Vec3 offset = seed % 3 == 2 ? random.point(1e7) : Vec3(0.0);
    const TriangleMesh casters[] = {
        make_random_triangles(offset, 1.0, 0.15, 300, seed),
        make_box(offset + Vec3(0.5, 0, 0), Vec3(0.25, 0.125, 0.5)),
        make_sheet(offset.y - 0.5, offset.x - 1, offset.x + 1, offset.z - 1, offset.z + 1),
    };
    const Oracle oracle(casters);
    for (int i = 0; i < 1500; ++i) {
      Vec3 x = offset + 2.0 * random.point(1), q = offset + 2.0 * random.point(1);
      if (i % 3 == 1) {
        // Along an axis, or in a face of a box of the hierarchy.
        const std::size_t mesh = static_cast<std::size_t>(random.integer(0, 2));
        const auto points = casters[mesh].positions();
        x = points[static_cast<std::size_t>(random.integer(0, static_cast<int>(points.size()) - 1))];
        q = x;
        for (int axes = random.integer(1, 2); axes > 0; --axes) {
          const double reach = random.uniform(-2, 2);
          const int axis = random.integer(0, 2);
          x[axis] += reach;
          q[axis] -= reach;
        }
      } else if (i % 3 == 2) {
        const auto face = corners_of(casters[0], static_cast<std::size_t>(random.integer(0, 299)));
        x = face[0] + 0.5 * (face[0] - q);
      }
      if (x == q) continue;
      const CasterFace own[] = {{0, FaceId{static_cast<std::uint32_t>(random.integer(0, 299))}}};
      const auto agree = [&](const Vec3& target, const Light& light) {
        const bool expected = oracle.blocked_by_any(x, target, own, light);
        ASSERT_EQ(oracle.blocked(x, target, own, light), expected) << "seed " << seed << ", ray " << i;
        blocked += expected;
        ++rays;
      };
      agree(q, DiskLight{q, x - q, 1.0});
      agree(q - x, DistantLight{x - q, 1.0});
    }
  }
  EXPECT_GT(blocked, rays / 5);
  EXPECT_LT(blocked, rays * 9 / 10);
}

/// A camera's ray: the nearest of all faces, by distances of its own.
TEST(OracleHierarchy, FirstHitIsTheNearest) {
  int hits = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Random random(seed);
    const TriangleMesh mesh = make_random_triangles(Vec3(0.0), 1.0, 0.3, 200, seed);
    const Oracle oracle(std::span(&mesh, 1));
    for (int i = 0; i < 500; ++i) {
      const Vec3 start = random.point(2), direction = random.point(1) - start;
      double nearest = std::numeric_limits<double>::infinity();
      std::uint32_t expected = 0;
      for (std::uint32_t f = 0; f < mesh.triangles().size(); ++f) {
        const auto corner = corners_of(mesh, f);
        const Vec3 u = corner[1] - corner[0], v = corner[2] - corner[0], w = start - corner[0];
        const double across = glm::dot(glm::cross(v, u), direction);
        const double t = glm::dot(glm::cross(u, v), w) / across;
        const double s1 = glm::dot(glm::cross(w, v), direction) / -across,
                     s2 = glm::dot(glm::cross(u, w), direction) / -across;
        if (t <= 0 || s1 < 0 || s2 < 0 || s1 + s2 > 1 || t >= nearest) continue;
        nearest = t;
        expected = f;
      }
      const std::optional<Hit> hit = oracle.first_hit(start, direction);
      ASSERT_EQ(hit.has_value(), std::isfinite(nearest)) << "seed " << seed << ", ray " << i;
      if (!hit) continue;
      EXPECT_EQ(hit->face, (CasterFace{0, FaceId{expected}})) << "seed " << seed << ", ray " << i;
      EXPECT_NEAR(hit->distance, nearest, 1e-9 * nearest);
      ++hits;
    }
  }
  EXPECT_GT(hits, 2000);
  EXPECT_LT(hits, 9500);
}

/// The sheet is its own box in the hierarchy, without thickness: a ray to its rim hits both or neither.
TEST(OracleHierarchy, RaysToTheRimOfABoxAreNotLost) {
  int blocked = 0;
  for (std::uint64_t seed = 0; seed < 20000; ++seed) {
    Random random(seed);
    const double x0 = random.uniform(-1, 0), z0 = random.uniform(-1, 0);
    const TriangleMesh sheet = make_sheet(random.uniform(1, 2), x0, x0 + 1, z0, z0 + 1);
    const Vec3 a = sheet.positions()[0], b = sheet.positions()[1];
    const Vec3 x = random.point(1), aim = a + random.uniform(0, 1) * (b - a);
    const Vec3 q = aim + random.uniform(0.5, 2) * (aim - x);
    const DiskLight light{q, x - q, 1.0};
    const Oracle oracle(std::span(&sheet, 1));
    const bool expected = oracle.blocked_by_any(x, q, {}, light);
    ASSERT_EQ(oracle.blocked(x, q, {}, light), expected) << "seed " << seed;
    blocked += expected;
    const DistantLight sun{x - aim, 1.0};
    ASSERT_EQ(oracle.blocked(x, aim - x, {}, sun), oracle.blocked_by_any(x, aim - x, {}, sun))
        << "seed " << seed;
  }
  EXPECT_GT(blocked, 5000);
  EXPECT_LT(blocked, 15000);
}

}  // namespace
}  // namespace penumbra::oracle
