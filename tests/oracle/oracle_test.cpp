// The oracle against closed forms.
//
// Seen from x, a point p of a caster at height h covers the light at p·H/h, H the height of the light: all
// shares below are those of the unit disk after division by its radius.
#include "tests/oracle/oracle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>
#include <set>

#include "penumbra/mesh/shapes.h"
#include "tests/oracle/oracle_support.h"

namespace penumbra::oracle {
namespace {

constexpr int kSamples = 4096;
// The largest error that the header states for a half-plane.
constexpr double kHalfPlane = 0.0024;

double seen(std::initializer_list<TriangleMesh> casters, const Vec3& x, const Light& light,
            std::uint64_t seed = 1) {
  return Oracle(std::span(casters.begin(), casters.size())).unoccluded(x, {}, light, kSamples, seed);
}

TEST(OracleSamples, ErrorOfAHalfPlaneIsAsStated) {
  const DiskLight light{{0, 0, 0}, {0, 0, 3}, 1.0};
  const struct {
    int samples;
    double rms, most;
  } stated[] = {{256, 0.0044, 0.022}, {1024, 0.0016, 0.008}, {4096, 0.00055, 0.0024}};
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (const auto& [samples, rms, most] : stated) {
    double squares = 0, worst = 0;
    const int lines = 2'000'000 / samples;
    for (int i = 0; i < lines; ++i) {
      const double angle = 4 * uniform(random), d = uniform(random);
      int below = 0;
      for (const Vec3& p : light_samples(light, samples, random()))
        below += p.x * std::cos(angle) + p.y * std::sin(angle) < d;
      const double error = static_cast<double>(below) / samples - share_below(d);
      squares += error * error;
      worst = std::max(worst, std::abs(error));
    }
    EXPECT_LT(std::sqrt(squares / lines), rms) << samples;
    EXPECT_LT(worst, most) << samples;
  }
}

TEST(OracleSamples, LieOnTheDisk) {
  const DiskLight light{{3, -2, 5}, {1e-200, 2e-200, -3e-200}, 0.25};
  Vec3 mean(0.0);
  double squares = 0;
  for (const Vec3& p : light_samples(light, 1000, 5)) {
    const Vec3 d = p - light.center;
    EXPECT_NEAR(d.x + 2 * d.y - 3 * d.z, 0, 1e-14);  // six roundings of coordinates up to 5.3
    EXPECT_LE(std::hypot(d.x, d.y, d.z), 0.25);
    mean += d / 1000.0;
    squares += glm::dot(d, d) / 1000;
  }
  EXPECT_NEAR(squares, 0.25 * 0.25 / 2, 1e-14) << "equal areas";
  EXPECT_LT(std::hypot(mean.x, mean.y, mean.z), 1e-3);
}

TEST(Oracle, HalfPlanesAtAnyHeightAndScale) {
  for (const double scale : {1e-9, 1.0, 1e9})
    for (const double height : {1e-6, 1e-3, 1.0, 2.0, 3.999})
      for (const double d : {-1.01, -0.99, -0.5, -0.01, 0.2, 0.7, 0.999, 1.01}) {
        const double edge = d * 0.5 * height / 4, far = 1e6;
        for (const bool turned : {false, true}) {
          const double x0 = turned ? far : edge, x1 = turned ? edge : far;
          const auto sheet = make_sheet(height * scale, x0 * scale, x1 * scale, -far * scale, far * scale);
          EXPECT_NEAR(seen({sheet}, Vec3(0.0), light_above({}, 4 * scale, 0.5 * scale)), share_below(d),
                      kHalfPlane)
              << scale << ' ' << height << ' ' << d;
        }
      }
}

TEST(Oracle, Slab) {
  for (const double width : {0.01, 0.3, 0.9, 1.2})
    for (const double off : {0.0, 0.4, -0.8}) {
      const double unit = 0.5 * 1.5 / 4;
      const auto slab = make_sheet(1.5, (off - width) * unit, (off + width) * unit, -9, 9);
      EXPECT_NEAR(seen({slab}, Vec3(0.0), light_above({}, 4, 0.5)),
                  1 - share_below(off + width) + share_below(off - width), 2 * kHalfPlane);
    }
}

TEST(Oracle, HoleInAPlate) {
  const TriangleMesh plate = make_plate_with_hole(2.0, 0.1, 50);
  // From the ground at height 0 the hole covers a disk of radius 0.2 on the light, and moves by as much as x
  // does.
  for (const double radius : {0.1, 0.2, 0.3, 0.5})
    for (const double off : {0.0, 0.05, 0.2, 0.35, 0.8})
      EXPECT_NEAR(seen({plate}, {off, 0, 0}, DiskLight{{0, 4, 0}, {0, -1, 0}, radius}),
                  share_in_disk(0.2 / radius, off / radius), 0.003)
          << radius << ' ' << off;
}

// A wall stands just beside x and carries a roof: both end at the same edge, and rays near it are blocked
// once.
TEST(Oracle, TwoPlanesAtAnEdgeNearTheReceiver) {
  for (const double away : {1e-12, 1e-7, 1e-2})
    for (const double d : {0.0625, 0.5, 0.875}) {
      const double height = away * 8 / d;
      const auto wall = make_quad({away, 0, -99}, {away, 0, 99}, {away, height, 99}, {away, height, -99});
      const auto roof = make_sheet(height, away, 99, -99, 99);
      const DiskLight light = light_above({}, 4, 0.5);
      EXPECT_NEAR(seen({wall, roof}, Vec3(0.0), light), share_below(d), kHalfPlane);
      EXPECT_NEAR(seen({roof}, Vec3(0.0), light), share_below(d), kHalfPlane);
      EXPECT_NEAR(seen({wall}, Vec3(0.0), light), share_below(d), kHalfPlane);
    }
}

// Nearer to the axis than the light, the far face's corner covers most: the top one for a corner beyond x,
// else the bottom one.
TEST(Oracle, BoxCornerUnderNearAndFarLights) {
  for (const double distance : {4.0, 1e6, 1e9})
    for (const auto& [a, b] : {std::pair(0.3, 0.2), {0.7, 0.1}, {-0.3, -0.4}, {-0.05, -0.9}}) {
      const double low = 0.5, high = 1.0, radius = distance / 8;
      const double unit = (a > 0 ? high : low) / 8;
      const Vec3 corner(a * unit, low, b * unit), half(20, (high - low) / 2, 20);
      const auto box = make_box(corner + half, half);
      EXPECT_NEAR(seen({box}, Vec3(0.0), light_above({}, distance, radius)), 1 - share_of_quadrant(a, b),
                  0.003)
          << distance << ' ' << a << ' ' << b;
    }
}

TEST(Oracle, SheetJustAboveAHugeGround) {
  const auto ground = make_plane(1e6);
  for (const double distance : {4.0, 1e6, 1e9})
    for (const double gap : {1e-5, 1.0})
      for (const double d : {-0.6, 0.1, 0.9}) {
        const Vec3 x(131072.5, 0, -300000.25);
        const double edge = x.x + d * gap / 8;
        const auto sheet = make_sheet(gap, edge, 9e5, -9e5, 9e5);
        const double expected = share_below((edge - x.x) * 8 / gap);
        EXPECT_NEAR(seen({ground, sheet}, x, light_above(x, distance, distance / 8)), expected, kHalfPlane)
            << distance << ' ' << gap << ' ' << d;
        // The ground's other side is dark.
        EXPECT_EQ(seen({ground}, x - Vec3(0, gap, 0), light_above(x, distance, distance / 8)), 0);
      }
}

TEST(Oracle, HorizonIsOneMoreChord) {
  const Oracle empty({});
  const DiskLight light{{0, 4, 0}, {0, -2, 0}, 0.5};
  for (const double d : {-1.1, -0.7, 0.0, 0.3, 0.95, 1.1}) {
    // N·(c - x) = 4 N_y, |m × N| = |N_x|.
    const Vec3 normal(8, d, 0);
    EXPECT_NEAR(empty.visibility(Vec3(0.0), normal, {}, light, kSamples, 3), share_below(d), kHalfPlane);
    EXPECT_EQ(empty.unoccluded(Vec3(0.0), {}, light, kSamples, 3), 1);
  }
  const auto sheet = make_sheet(1, 0, 99, -99, 99);
  const Oracle half(std::span(&sheet, 1));
  EXPECT_NEAR(half.visibility(Vec3(0.0), {-8, -0.5, 0}, {}, light, kSamples, 3), share_below(-0.5),
              kHalfPlane);
  EXPECT_NEAR(half.visibility(Vec3(0.0), {0, 0.0, 1}, {}, light, kSamples, 3), 0.25, 2 * kHalfPlane);
}

TEST(Oracle, LightsShineForwardAndNothingBehindThemCasts) {
  for (const Vec3& m : {Vec3(0, -1, 0), Vec3(1, -2, 3), Vec3(-0.3, 0.1, 0.7)}) {
    const Vec3 center(0.1, 0.2, 0.3), u(m.y, -m.x, 0), v = glm::cross(m, u);
    const DiskLight light{center, m, 0.5};
    const auto plate = [&](double forward) {
      const Vec3 at = center + forward * m;
      return make_quad(at + 9.0 * (u + v), at + 9.0 * (u - v), at - 9.0 * (u + v), at - 9.0 * (u - v));
    };
    EXPECT_EQ(seen({}, center + 2.0 * m, light), 1);
    EXPECT_EQ(seen({}, center - 2.0 * m, light), 0);
    EXPECT_EQ(seen({}, center, light), 0);
    EXPECT_EQ(seen({plate(-1e-12)}, center + 2.0 * m, light), 1);
    EXPECT_EQ(seen({plate(1e-12)}, center + 2.0 * m, light), 0);
  }
  // In the light's own plane, exactly.
  EXPECT_EQ(seen({make_sheet(4, -9, 9, -9, 9)}, Vec3(0.0), light_above({}, 4, 0.5)), 1);
}

TEST(Oracle, RadiusZeroIsOneRay) {
  const DiskLight point = light_above({}, 4, 0);
  EXPECT_EQ(seen({make_sheet(1, -1, 1, -1, 1)}, Vec3(0.0), point), 0);
  EXPECT_EQ(seen({make_sheet(1, 1e-12, 1, -1, 1)}, Vec3(0.0), point), 1);
  EXPECT_EQ(seen({make_sheet(1, 0, 1, -1, 1)}, Vec3(0.0), point), 0) << "an edge blocks";
}

TEST(Oracle, SeedsRotateTheSamples) {
  const auto sheet = make_sheet(1, 0.02, 9, -9, 9);
  const DiskLight light = light_above({}, 4, 0.5);
  EXPECT_EQ(seen({sheet}, Vec3(0.0), light, 1), seen({sheet}, Vec3(0.0), light, 1));
  std::set<double> values;
  for (std::uint64_t seed = 0; seed < 20; ++seed) values.insert(seen({sheet}, Vec3(0.0), light, seed));
  EXPECT_GT(values.size(), 3u);
}

}  // namespace
}  // namespace penumbra::oracle
