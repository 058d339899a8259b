// The oracle against rational numbers on rays that are degenerate on purpose, and the rule that faces in the
// receiver's plane hide nothing.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "penumbra/mesh/shapes.h"
#include "tests/oracle/oracle.h"
#include "tests/oracle/oracle_support.h"
#include "tests/oracle/random_inputs.h"
#include "tests/oracle/rational_rays.h"
#include "tests/oracle/signs.h"

namespace penumbra::oracle {
namespace {

struct Case {
  TriangleMesh mesh;
  Ray ray;
  Light light;
};

/// Faces with small integers as corners, one more of which the ray aims at: at a corner, a point of an edge,
/// a point of the plane. All of it may be far from the origin, tiny, or off by one unit in the last place.
/// The ray ends at a disk, or it has a direction and no end.
Case degenerate_case(Random& random, bool distant) {
  std::vector<Vec3> points;
  for (int i = 0; i < 6; ++i) points.push_back(random.lattice(4));
  std::vector<IndexedTriangle> faces = {{0, 1, 2}, {1, 3, 2}, {2, 3, 4}, {0, 4, 5}};
  const double s = random.integer(0, 4) / 4.0, t = (1 - s) * random.integer(0, 2) / 2.0;
  const Vec3 target = points[0] + s * (points[1] - points[0]) + t * (points[2] - points[0]);
  Vec3 x = random.integer(0, 3) ? random.lattice(6)
                                : points[1] + double(random.integer(0, 2)) * (target - points[0]);
  Vec3 q = x + std::ldexp(1.0, random.integer(-1, 2)) * (target - x);
  if (x == q) q = x + Vec3(1, 0, 0);
  Vec3 normal, center = q;
  do normal = random.lattice(3);
  while (glm::dot(normal, x - q) <= 0);
  if (random.integer(0, 2) == 0) center += 0.125 * random.integer(-3, 1) * normal;  // before or behind q
  if (glm::dot(normal, x - center) <= 0) center = q;

  const Vec3 offset =
      random.integer(0, 2) ? Vec3(0.0) : std::ldexp(1.0, random.integer(4, 30)) * random.lattice(9);
  const double scale = std::ldexp(1.0, 20 * random.integer(-3, 3)) * (random.integer(0, 1) ? 1.0 : 0.7);
  const bool nudged = random.integer(0, 1);
  const auto place = [&](Vec3& p) {
    p = scale * (p + offset);
    if (nudged && random.integer(0, 3) == 0) random.nudge(p);
  };
  const Vec3 direction = std::ldexp(1.0, random.integer(-40, 40)) * (q - x);
  for (Vec3& p : points) place(p);
  for (Vec3* p : {&x, &q, &center}) place(*p);
  const TriangleMesh mesh = TriangleMesh::build(points, faces);
  if (!distant) return {mesh, {x, q, center, normal}, DiskLight{center, normal, 1.0}};
  Ray ray{x, direction, Vec3(0.0), Vec3(0.0), true};
  if (nudged && random.integer(0, 1)) random.nudge(ray.q);
  return {mesh, ray, DistantLight{-ray.q, 1.0}};
}

/// A point in front of the light, and q farther towards it: what Oracle::blocked asks for.
bool is_sound(const Case& c) {
  if (c.ray.endless) return c.ray.q != Vec3(0.0);
  const RationalPoint m = exact(c.ray.normal), x = exact(c.ray.x);
  return dot(m, minus(x, exact(c.ray.center))) > 0 && dot(m, minus(x, exact(c.ray.q))) > 0;
}

void degenerate_rays_agree_with_rationals(bool distant) {
  int cases = 0, blocked = 0, rim = 0, flat = 0, unsigned_by_double = 0;
  for (std::uint64_t seed = 0; cases < 10000; ++seed) {
    Random random(seed);
    const Case c = degenerate_case(random, distant);
    if (!is_sound(c)) continue;
    ++cases;
    bool any = false, any_rim = false, any_flat = false;
    for (std::size_t f = 0; f < c.mesh.triangles().size(); ++f) {
      const std::array<Vec3, 3> face = corners_of(c.mesh, f);
      const Meeting meeting = meeting_of(c.ray, face);
      any = any || meeting == Meeting::kInside || meeting == Meeting::kOnTheRim;
      any_rim = any_rim || meeting == Meeting::kOnTheRim;
      any_flat = any_flat || meeting == Meeting::kFlat;
      for (std::size_t i = 0; i < 3; ++i)
        unsigned_by_double += !determinant(distant ? c.ray.q : c.ray.q - c.ray.x, face[i] - c.ray.x,
                                           face[(i + 1) % 3] - c.ray.x)
                                   .sign();
    }
    const Oracle oracle(std::span(&c.mesh, 1));
    ASSERT_EQ(oracle.blocked(c.ray.x, c.ray.q, {}, c.light), any) << "seed " << seed;
    ASSERT_EQ(oracle.blocked_by_any(c.ray.x, c.ray.q, {}, c.light), any) << "seed " << seed;
    blocked += any;
    rim += any_rim;
    flat += any_flat;
  }
  // The cases are what they should be.
  EXPECT_GT(blocked, 2000);
  EXPECT_LT(blocked, 8000);
  EXPECT_GT(rim, 1000);
  EXPECT_GT(flat, 300);
  EXPECT_GT(unsigned_by_double, 3000);
}

TEST(OracleProperty, DegenerateRaysAgreeWithRationals) {
  degenerate_rays_agree_with_rationals(false);
}

TEST(OracleProperty, DegenerateDirectionsAgreeWithRationals) {
  degenerate_rays_agree_with_rationals(true);
}

/// Points a few roundings above a plane of rounded coordinates, both sides of the limit of four.
TEST(OracleProperty, PlanesOfFacesAreToldAsStated) {
  int flat = 0;
  for (std::uint64_t seed = 0; seed < 5000; ++seed) {
    Random random(seed);
    const Vec3 origin = random.point(std::pow(10.0, random.integer(-3, 3)));
    const Corners face{origin + random.point(1), origin + random.point(1), origin + random.point(1)};
    const double s = random.uniform(-1, 2), t = random.uniform(-1, 2);
    Vec3 x = face.a + s * (face.b - face.a) + t * (face.c - face.a);
    const int axis = random.integer(0, 2);
    for (int steps = random.integer(0, 30); steps > 0; --steps) x[axis] = std::nextafter(x[axis], 1e300);
    const FacePoints points = {exact(face.a), exact(face.b), exact(face.c), exact(x)};
    const bool expected = is_flat(points);
    ASSERT_EQ(side_of_face(x, face), expected ? 0 : sgn(volume(points))) << "seed " << seed;
    flat += expected;
  }
  EXPECT_GT(flat, 1000);
  EXPECT_LT(flat, 4000);
}

/// A light's plane through a point that is computed on the face, and points of a plane through q.
TEST(OracleProperty, PlanesOfLightsAndHorizonsAreExact) {
  int before = 0, above = 0;
  for (std::uint64_t seed = 0; seed < 5000; ++seed) {
    Random random(seed);
    const Vec3 origin = random.point(std::pow(10.0, random.integer(-3, 3)));
    const Corners face{origin + random.point(1), origin + random.point(1), origin + random.point(1)};
    const Vec3 x = origin + random.point(2);
    const Vec3 at = face.a + 0.25 * (face.b - face.a) + 0.25 * (face.c - face.a),
               q = at + random.uniform(0.5, 2) * (at - x);
    Vec3 m = random.point(1);
    if (glm::dot(m, x - q) < 0) m = -m;
    const Ray ray{x, q, at + random.uniform(-1, 1) * glm::cross(m, random.point(1)), m};
    const RationalPoint exact_m = exact(m), d = minus(exact(q), exact(x));
    const RationalPoint n = cross(minus(exact(face.b), exact(face.a)), minus(exact(face.c), exact(face.a)));
    const RationalPoint to_light = minus(exact(ray.center), exact(x));
    if (dot(exact_m, to_light) >= 0 || dot(exact_m, d) >= 0) continue;
    const Rational hit = dot(n, minus(exact(face.a), exact(x))) / dot(n, d);
    const Rational end = dot(exact_m, to_light) / dot(exact_m, d);
    ASSERT_EQ(is_before_light(ray, face), hit < end) << "seed " << seed;
    const int side = sgn(dot(exact_m, minus(exact(ray.center), exact(at))));
    ASSERT_EQ(sign_of_dot(m, ray.center, at), side) << "seed " << seed;
    before += hit < end;
    above += side > 0;
  }
  for (const int count : {before, above}) {
    EXPECT_GT(count, 1000);
    EXPECT_LT(count, 4000);
  }
}

/// Bounds hold, and are tight enough to be of use.
TEST(OracleProperty, DeterminantsLieWithinTheirBounds) {
  int decided = 0;
  for (std::uint64_t seed = 0; seed < 20000; ++seed) {
    Random random(seed);
    const Vec3 x = std::ldexp(1.0, random.integer(-30, 30)) * random.point(1);
    Vec3 p[3];
    for (Vec3& v : p) v = x + std::ldexp(1.0, random.integer(-20, 20)) * random.point(1);
    if (random.integer(0, 1))
      p[2] = random.uniform(-2, 2) * (p[0] - x) + random.uniform(-2, 2) * (p[1] - x) + x;
    const Bounded value = determinant(p[0] - x, p[1] - x, p[2] - x);
    const Rational truth =
        dot(minus(exact(p[0]), exact(x)), cross(minus(exact(p[1]), exact(x)), minus(exact(p[2]), exact(x))));
    ASSERT_TRUE(abs(truth - Rational(value.value)) <= Rational(value.error)) << "seed " << seed;
    if (const auto sign = value.sign()) {
      ASSERT_EQ(*sign, sgn(truth)) << "seed " << seed;
      ++decided;
    }
  }
  EXPECT_GT(decided, 9000);
  EXPECT_LT(decided, 19000);
}

/// A plane of many triangles, turned and moved, so that all coordinates are rounded.
TriangleMesh turned_plane(int segments, const Vec3& u, const Vec3& n, const Vec3& v, const Vec3& center) {
  const TriangleMesh plane = make_plane(1.0, segments);
  std::vector<Vec3> points;
  for (const Vec3& p : plane.positions()) points.push_back(center + p.x * u + p.y * n + p.z * v);
  return TriangleMesh::build(points, plane.triangles());
}

TEST(OracleProperty, FacesInTheReceiversPlaneHideNothing) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Random random(seed);
    const Vec3 n = glm::normalize(random.point(1)), u = glm::normalize(glm::cross(n, random.point(1)));
    const Vec3 v = glm::cross(u, n), center = random.point(std::pow(10.0, random.integer(0, 5)));
    const TriangleMesh casters[] = {turned_plane(5, u, n, v, center), turned_plane(3, u, n, v, center)};
    const auto face = static_cast<std::uint32_t>(random.integer(0, 49));
    const auto corner = corners_of(casters[0], face);
    double s = random.uniform(0, 1), t = random.uniform(0, 1);
    if (s + t > 1) s = 1 - s, t = 1 - t;
    const Vec3 x = corner[0] + s * (corner[1] - corner[0]) + t * (corner[2] - corner[0]);
    const CasterFace own[] = {{0, FaceId{face}}};
    for (const double side : {1.0, -1.0}) {
      const DiskLight light{center + side * random.uniform(0.01, 5) * n + random.uniform(-3, 3) * u,
                            -side * n, 0.5};
      // The second plane has other faces, in one of which x lies, and which no id names.
      EXPECT_EQ(Oracle(std::span(casters, 2)).unoccluded(x, own, light, 64, seed), 1) << "seed " << seed;
      EXPECT_EQ(Oracle(std::span(casters, 2)).visibility(x, side * n, own[0], light, 64, seed), 1)
          << "seed " << seed;
      const DistantLight sun{-side * n + 0.3 * u, 10.0};
      EXPECT_EQ(Oracle(std::span(casters, 2)).visibility(x, side * n, own[0], sun, 64, seed), 1)
          << "seed " << seed;
      // The same faces a little above x hide all of the light.
      const double above = 1e-11 * (std::abs(center.x) + std::abs(center.y) + std::abs(center.z) + 1);
      const TriangleMesh lifted = turned_plane(3, 1e3 * u, n, 1e3 * v, center + side * above * n);
      EXPECT_EQ(Oracle(std::span(&lifted, 1)).unoccluded(x, {}, light, 64, seed), 0) << "seed " << seed;
      EXPECT_EQ(Oracle(std::span(&lifted, 1)).unoccluded(x, {}, sun, 64, seed), 0) << "seed " << seed;
    }
  }
}

/// An own face is named by its id, however far x lies off its plane; the same face of another object does
/// cast.
TEST(OracleProperty, OwnFacesAreToldByTheirIds) {
  const TriangleMesh sheets[] = {make_sheet(1, -9, 9, -9, 9), make_sheet(2, -9, 9, -9, 9)};
  const Oracle oracle(sheets);
  const DiskLight light = light_above({}, 4, 0.5);
  const CasterFace all[] = {{0, FaceId{0}}, {0, FaceId{1}}, {1, FaceId{0}}, {1, FaceId{1}}};
  const Vec3 x(0, 0, 0);
  EXPECT_EQ(oracle.unoccluded(x, all, light, 256, 1), 1);
  EXPECT_EQ(oracle.unoccluded(x, std::span(all, 2), light, 256, 1), 0);
  EXPECT_EQ(oracle.unoccluded(x, std::span(all + 2, 2), light, 256, 1), 0);
  EXPECT_NEAR(oracle.unoccluded(x, std::span(all, 3), light, 4096, 1), 0.5, 0.0024)
      << "one half of the upper sheet";
}

}  // namespace
}  // namespace penumbra::oracle
