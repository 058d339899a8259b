// Rays against the oracle, which decides every face by exact predicates: where float alone would be wrong.
#include <gtest/gtest.h>

#include <cmath>

#include "render/rays/ray_packets.h"
#include "tests/oracle/oracle.h"
#include "tests/render/rays/ray_support.h"

namespace penumbra {
namespace {

using testing::Random;
using testing::RayCase;
using testing::RayJudge;

/// A floor with a wall that rises from its middle, both of 2 × 2, turned and moved.
struct Corner {
  Corner(const testing::Motion& motion_, bool in_one_mesh) : motion(motion_) {
    const std::vector<Vec3> p = motion(
        {{-1, 0, -1}, {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {0, 0, -1}, {0, 0, 1}, {0, 1, -1}, {0, 1, 1}});
    const std::vector<IndexedTriangle> floor{{0, 1, 5}, {0, 5, 4}, {4, 5, 2}, {4, 2, 3}},
        wall{{4, 5, 7}, {4, 7, 6}};
    if (in_one_mesh) {
      std::vector<IndexedTriangle> all = floor;
      all.insert(all.end(), wall.begin(), wall.end());
      meshes.push_back(testing::mesh_of(p, all));
    } else {
      meshes.push_back(testing::mesh_of({p[0], p[1], p[2], p[3]}, {{0, 1, 2}, {0, 2, 3}}));
      meshes.push_back(testing::mesh_of(p, wall));
    }
  }
  testing::Motion motion;
  std::vector<TriangleMesh> meshes;
};

/// Receivers on the floor, ever closer to the wall, that look over it and through it.
TEST(ExactRays, AgreeAtAConcaveEdge) {
  Random random(401);
  for (const bool in_one_mesh : {true, false})
    for (int turn = 0; turn < 3; ++turn) {
      const Corner corner(turn == 0 ? testing::Motion() : testing::Motion::random(random), in_one_mesh);
      RayJudge judge(corner.meshes);
      for (int i = 0; i < 4'000; ++i) {
        const double distance = random.spread(1e-13, 0.5), z = random.uniform(-0.9, 0.9);
        // Of the four triangles of the floor, or the two.
        const std::uint32_t face =
            in_one_mesh ? (distance > 0.5 * (z + 1.0) ? 3 : 2) : (distance > z ? 1 : 0);
        const Vec3 x(distance, 0.0, z);
        const double over = random.spread(1e-3, 10.0);  // height at which the ray passes the wall
        const Vec3 way = Vec3(-1.0, over, random.uniform(-0.2, 0.2)) *
                         (random.uniform(0.0, 1.0) < 0.5 ? 3.0 : 0.5 * distance);
        const bool known = random.uniform(0.0, 1.0) < 0.7;
        judge.add({.from = {corner.motion(x), known ? 0 : -1, face}, .way = corner.motion.turned(way)});
      }
      judge.finish();
      EXPECT_EQ(judge.wrong(), 0u) << "turn " << turn << (in_one_mesh ? ", one mesh" : ", two");
      EXPECT_GT(judge.blocked(), 1'000u);
      EXPECT_GT(judge.free(), 1'000u);
    }
}

/// Boxes of some sizes, each turned its own way.
std::vector<TriangleMesh> boxes(Random& random, int count) {
  std::vector<TriangleMesh> out;
  for (int i = 0; i < count; ++i) {
    const testing::Motion motion = testing::Motion::random(random);
    const Vec3 half{random.uniform(0.1, 0.5), random.uniform(0.1, 0.5), random.uniform(0.1, 0.5)};
    const TriangleMesh box = make_box(random.point(1.0), half);
    std::vector<Vec3> p(box.positions().begin(), box.positions().end());
    out.push_back(testing::mesh_of(motion.turned(p), {box.triangles().begin(), box.triangles().end()}));
  }
  return out;
}

/// Rays from faces, from the air and from afar that pass edges closely on either side, to lights at any
/// distance. Float has the last word where a ray grazes both faces of an edge; one of these does.
TEST(ExactRays, AgreeBesideEdges) {
  Random random(402);
  const double far[] = {1e1, 1e3, 1e5, 1e7, 1e11};
  std::size_t wrong = 0;
  for (int scene = 0; scene < 4; ++scene) {
    const std::vector<TriangleMesh> meshes = boxes(random, 5);
    RayJudge judge(meshes);
    for (int i = 0; i < 12'000; ++i) {
      RayCase ray;
      ray.from = testing::random_start(random, meshes);
      if (i % 4 == 0) ray.from = {.point = random.direction() * random.spread(2.0, 1e6)};
      // A start far away is rounded, and with it the ray.
      const double least = std::max(1e-12, 1e-14 * glm::length(ray.from.point));
      const Vec3 target = testing::beside_random_edge(random, meshes, random.spread(least, 1e-3));
      ray.way = target - ray.from.point;
      ray.endless = i % 3 == 0;
      if (!ray.endless) ray.way *= i % 2 ? random.uniform(1.01, 3.0) : far[i % 5] / glm::length(ray.way);
      judge.add(ray);
    }
    judge.finish();
    wrong += judge.wrong();
    EXPECT_GT(judge.blocked(), 1'000u);
    EXPECT_GT(judge.free(), 1'000u);
  }
  EXPECT_LE(wrong, 1u) << "of 48,000";
}

/// Light points just before a face, just behind it and in it.
TEST(ExactRays, EndExactlyAtTheLight) {
  Random random(403);
  const std::vector<TriangleMesh> meshes = boxes(random, 3);
  RayJudge judge(meshes);
  for (int i = 0; i < 20'000; ++i) {
    RayCase ray;
    ray.from = {.point = random.point(2.0)};
    const testing::FacePoint at = testing::random_face_point(random, meshes);
    ray.way = at.point + random.spread(1e-12, 1e-2) * (i % 2 ? 1.0 : -1.0) * at.normal - ray.from.point;
    judge.add(ray);
  }
  judge.finish();
  EXPECT_EQ(judge.wrong(), 0u);
  EXPECT_GT(judge.blocked(), 1'000u);
  EXPECT_GT(judge.free(), 1'000u);
}

/// A lamp in a wall's own plane, and receivers on the wall: nothing of the wall hides the lamp.
TEST(ExactRays, ALampInAWallsPlaneLightsTheWall) {
  Random random(404);
  for (int turn = 0; turn < 4; ++turn) {
    const testing::Motion motion = turn == 0 ? testing::Motion() : testing::Motion::random(random);
    const TriangleMesh wall =
        testing::mesh_of(motion({{-1, -1, 0}, {0, -1, 0}, {1, -1, 0}, {-1, 1, 0}, {0, 1, 0}, {1, 1, 0}}),
                         {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}});
    Scene scene;
    scene.objects.push_back({"wall", wall, Vec3(0.8), true});
    const RayScene rays(scene, 1);
    detail::RayPacket packet;
    for (int i = 0; i < 4'000; ++i) {
      const std::size_t k = static_cast<std::size_t>(i) % detail::RayPacket::kRays;
      const Vec3 x = motion({random.uniform(-1, 1), random.uniform(-1, 1), 0}),
                 q = motion({random.uniform(-3, 3), random.uniform(-3, 3), random.spread(1e-12, 1e-3)});
      packet.set(k, {{.point = x}, q - x});  // no face is known
      packet.wanted[k] = -1;
      if (k + 1 < detail::RayPacket::kRays) continue;
      detail::find_occluded(rays, packet, detail::Coherence::kCoherent);
      for (std::size_t j = 0; j < detail::RayPacket::kRays; ++j)
        ASSERT_FALSE(packet.is_occluded(j)) << "turn " << turn;
    }
  }
}

/// A plate with tiny faces in its middle, and waves of some height there.
TriangleMesh waved_plate(Random& random, int side, double least, double height) {
  std::vector<double> steps;
  for (int i = -side; i <= side; ++i)
    steps.push_back(i == 0 ? 0.0 : std::copysign(std::pow(least, 1.0 - std::abs(i) / double(side)), i));
  std::vector<Vec3> points;
  for (const double y : steps)
    for (const double x : steps)
      points.push_back(
          {x, y, std::max(std::abs(x), std::abs(y)) < 0.5 ? height * random.uniform(0.0, 1.0) : 0.0});
  const auto columns = static_cast<std::uint32_t>(steps.size());
  std::vector<IndexedTriangle> faces;
  for (std::uint32_t j = 0; j + 1 < columns; ++j)
    for (std::uint32_t i = 0; i + 1 < columns; ++i) {
      const std::uint32_t k = j * columns + i;
      faces.push_back({k, k + 1, k + columns + 1});
      faces.push_back({k, k + columns + 1, k + columns});
    }
  return testing::mesh_of(points, faces);
}

/// So flat over the waves that float's rounding of the plate may be more than their height.
RayCase ray_along(Random& random, const testing::FacePoint& at, bool from_face, double steep, double height) {
  const Vec3 side = random.direction(), along = glm::normalize(Vec3(side.x, side.y, 0.0));
  RayCase ray;
  if (from_face) {
    ray.from = {at.point, 0, at.face};
    ray.way = random.uniform(1.0, 5.0) * (along + steep * random.spread(1e-2, 3.0) * at.normal);
  } else {
    const double over = height * random.spread(1e-2, 100.0);
    ray.from = {.point = at.point - random.uniform(1.2, 4.0) * along + Vec3(0, 0, over)};
    ray.way = 2.0 * (at.point + Vec3(0, 0, height * random.uniform(-0.2, 1.2)) - ray.from.point);
  }
  return ray;
}

/// From faces none may be wrong. From the air float passes over some waves that are lower than its rounding.
TEST(ExactRays, AgreeAlongSurfaces) {
  for (const bool from_face : {true, false}) {
    Random random(406);
    std::size_t wrong = 0, blocked = 0, free = 0;
    for (int plate = 0; plate < 24; ++plate) {
      const double least = random.spread(1e-5, 1e-1), height = least * random.spread(1e-5, 0.3);
      const std::vector<TriangleMesh> meshes{waved_plate(random, 12, least, height)};
      const testing::Motion motion = testing::Motion::random(random);  // else floats know z well
      const auto p = meshes[0].positions();
      const auto faces = meshes[0].triangles();
      RayJudge judge({testing::mesh_of(motion({p.begin(), p.end()}), {faces.begin(), faces.end()})});
      for (int i = 0; i < 2'000; ++i) {
        const testing::FacePoint at = testing::random_face_point(random, meshes);
        if (std::abs(at.point.x) > 0.7 || std::abs(at.point.y) > 0.7) continue;
        RayCase ray = ray_along(random, at, from_face, height / least, height);
        ray.from.point = motion(ray.from.point), ray.way = motion.turned(ray.way);
        judge.add(ray);
      }
      judge.finish();
      wrong += judge.wrong(), blocked += judge.blocked(), free += judge.free();
    }
    std::printf("%zu of %zu rays along surfaces differ\n", wrong, blocked + free);
    EXPECT_GT(blocked, 5'000u);
    EXPECT_GT(free, 2'000u);
    EXPECT_LE(wrong, from_face ? 0u : 300u);
  }
}

/// A ray that grazes both faces of an edge is the one thing that float decides. Few do.
TEST(ExactRays, AgreeOnSmoothSilhouettesButForFew) {
  Random random(405);
  const std::vector<TriangleMesh> meshes{make_icosphere({0.2, 0.1, -0.3}, 1.0, 5)};
  RayJudge judge(meshes);
  for (int i = 0; i < 40'000; ++i) {
    const Vec3 x = Vec3(0.2, 0.1, -0.3) + random.direction() * random.spread(1.1, 10.0);
    const Vec3 center = Vec3(0.2, 0.1, -0.3) - x;
    const Vec3 across = glm::normalize(glm::cross(center, random.direction()));
    const double sine = (1.0 + random.uniform(-2e-3, 1e-4)) / glm::length(center);  // where the outline is
    judge.add({.from = {.point = x},
               .way = 4.0 * (std::sqrt(1.0 - sine * sine) * center + sine * glm::length(center) * across),
               .endless = i % 2 == 0});
  }
  judge.finish();
  EXPECT_LE(judge.wrong(), 2u);
  EXPECT_GT(judge.blocked(), 4'000u);
  EXPECT_GT(judge.free(), 4'000u);
  std::printf("%zu of %zu rays along outlines differ\n", judge.wrong(), judge.blocked() + judge.free());
}

}  // namespace
}  // namespace penumbra
