#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>

#include "render/light/disk_area.h"
#include "tests/render/render_support.h"

namespace penumbra {
namespace {

using testing::kPi;
using testing::Random;
using Big = boost::multiprecision::cpp_bin_float_quad;

struct BigVec {
  Big x, y, z;
  BigVec(const Vec3& p) : x(p.x), y(p.y), z(p.z) {}
};

/// The signed distance, in radii, of the disk's center from the line in which the plane through x, a and b
/// meets the light's plane, all in 113 bits: two of the plane's directions are intersected with z = 0.
/// Positive where the center lies on the side of (a - x) × (b - x).
double exact_delta(const Vec3& receiver, const Vec3& from, const Vec3& to, double r) {
  const BigVec x(receiver), a(from), b(to);
  const Big px = a.x - x.x, py = a.y - x.y, pz = a.z - x.z;
  const Big qx = b.x - x.x, qy = b.y - x.y, qz = b.z - x.z;
  const bool by_a = abs(pz) > abs(qz);
  const Big s = -x.z / (by_a ? pz : qz);
  const Big at_x = x.x + s * (by_a ? px : qx), at_y = x.y + s * (by_a ? py : qy);
  const Big along_x = px * qz - qx * pz, along_y = py * qz - qy * pz;
  const Big distance =
      abs(along_x * at_y - along_y * at_x) / sqrt(along_x * along_x + along_y * along_y) / Big(r);
  const Big side = -(x.x * (py * qz - pz * qy) + x.y * (pz * qx - px * qz) + x.z * (px * qy - py * qx));
  return static_cast<double>(side < 0 ? Big(-distance) : distance);
}

TEST(ChordOfPlaneProperty, IsTheDistanceOfCenterAndChord) {
  constexpr std::uint64_t kSeed = 20'041;
  Random random(kSeed);
  double worst = 0.0;
  int inside = 0;
  for (int k = 0; k < 10'000;) {
    const Vec3 x{random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(1, 5)};
    const Vec3 a{random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(0.1, 0.9) * x.z};
    const Vec3 b = a + random.spread(0.01, 2.0) * random.direction();
    const double r = random.spread(0.1, 2.0);
    const Vec3 n = edge_plane(x, a, b);
    const double size = glm::length(n);
    if (size < 1e-3 * glm::length(b - a) * glm::length(a - x) || std::hypot(n.x, n.y) < 1e-3 * size) continue;
    const double exact = exact_delta(x, a, b, r);
    if (std::abs(exact) > 2.0) continue;  // only chords near the disk say anything
    const Chord chord = chord_of_plane(n, x, r);
    worst = std::max(worst, std::abs(chord.delta - exact));
    ASSERT_NEAR(chord.delta, exact, 1e-12) << "seed " << kSeed << ", edge " << k;
    inside += std::abs(exact) < 1.0;
    ++k;
  }
  EXPECT_GT(inside, 2'000);
  std::printf("worst difference of delta: %.2g\n", worst);
}

TEST(ChordOfPlaneProperty, NormalPointsIntoThePositiveSide) {
  constexpr std::uint64_t kSeed = 20'042;
  Random random(kSeed);
  for (int k = 0; k < 10'000; ++k) {
    const Vec3 x = random.point(3.0) + Vec3(0, 0, 4), n = random.direction();
    const double r = random.uniform(0.1, 2.0);
    const Chord chord = chord_of_plane(n, x, r);
    const glm::dvec2 p = random.uniform(0.0, 1.0) * random.unit2();
    const double distance = glm::dot(chord.normal, p) + chord.delta;
    if (std::abs(distance) < 1e-9) continue;
    ASSERT_EQ(distance > 0.0, glm::dot(n, Vec3(r * p, 0.0) - x) > 0.0) << "seed " << kSeed << ", plane " << k;
  }
}

/// Simpson's rule over [low, high].
template <class Function>
double integral(double low, double high, int halves, const Function& f) {
  const double h = (high - low) / (2 * halves);
  double sum = f(low) + f(high);
  for (int i = 1; i < 2 * halves; ++i) sum += (i % 2 ? 4.0 : 2.0) * f(low + i * h);
  return sum * h / 3.0;
}

/// The strip integral of 2√(1 - t²) over t > -δ, with t = 1 - u² so that the integrand is smooth for δ ≤ 0.
double half_plane_by_quadrature(double delta) {
  if (delta > 0.0) return 1.0 - half_plane_by_quadrature(-delta);
  const auto f = [](double u) { return 4.0 * u * u * std::sqrt(2.0 - u * u); };
  return integral(0.0, std::sqrt(std::max(0.0, 1.0 + delta)), 500, f) / kPi;
}

TEST(HalfPlaneAreaProperty, AgreesWithQuadrature) {
  constexpr std::uint64_t kSeed = 20'043;
  Random random(kSeed);
  double worst = 0.0, worst_fast = 0.0;
  for (int k = 0; k < 5'000; ++k) {
    double delta = random.uniform(-1.0, 1.0);
    if (k % 5 == 0) delta = std::copysign(1.0 - random.spread(1e-16, 0.1), delta);
    const double exact = half_plane_by_quadrature(delta);
    worst = std::max(worst, std::abs(half_plane_area(delta) - exact));
    worst_fast = std::max(worst_fast, std::abs(half_plane_area_fast(delta) - exact));
    ASSERT_NEAR(half_plane_area(delta), exact, 1e-10) << "seed " << kSeed << ", chord " << k;
    ASSERT_NEAR(half_plane_area_fast(delta), exact, 3e-5) << "seed " << kSeed << ", chord " << k;
  }
  std::printf("worst difference: exact %.2g, fast %.2g\n", worst, worst_fast);
}

/// Both half-planes' share of the disk by strips across the first one's normal: at distance t the strip
/// reaches from -√(1 - t²) to √(1 - t²), the second cuts it. With t = sin θ the integrand is smooth between
/// the points where the second line meets the circle or the first line.
double two_half_planes_by_quadrature(const Chord& one, const Chord& two) {
  const double c = glm::dot(one.normal, two.normal);
  const double s = one.normal.x * two.normal.y - one.normal.y * two.normal.x;
  const auto strip = [&](double theta) {
    const double t = std::sin(theta), half = std::cos(theta);
    double low = -half, high = half;
    const double value = c * t + two.delta;  // value + s·y ≥ 0
    if (std::abs(s) < 1e-15) return value >= 0.0 ? 2.0 * half * half : 0.0;
    if (s > 0.0) low = std::clamp(-value / s, low, high);
    if (s < 0.0) high = std::clamp(-value / s, low, high);
    return (high - low) * half;
  };
  const double d1 = std::clamp(one.delta, -1.0, 1.0), d2 = std::clamp(two.delta, -1.0, 1.0);
  const double reach = std::sqrt((1.0 - d2) * (1.0 + d2));
  std::vector<double> at{-d1, 1.0, std::clamp(-d2 * c - reach * s, -d1, 1.0),
                         std::clamp(-d2 * c + reach * s, -d1, 1.0)};
  std::sort(at.begin(), at.end());
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < at.size(); ++i) {
    // The ends are moved inwards by nothing that matters, so that a jump of parallel lines is not met.
    const double low = std::asin(std::clamp(at[i], -1.0, 1.0)),
                 high = std::asin(std::clamp(at[i + 1], -1.0, 1.0));
    const double inset = std::min(1e-13, 0.25 * (high - low));
    if (high > low) sum += integral(low + inset, high - inset, 300, strip);
  }
  return sum / kPi;
}

struct ChordPair {
  Chord one, two;
  const char* kind;
};

/// The k-th of a mixture: free, parallel, antiparallel, the same line, nearly so, tangent to the circle.
ChordPair chord_pair(Random& random, int k) {
  ChordPair p{
      {random.unit2(), random.uniform(-1.0, 1.0)}, {random.unit2(), random.uniform(-1.0, 1.0)}, "free"};
  const double sign = k % 2 ? 1.0 : -1.0;
  switch (k % 7) {
    case 1:
      p.kind = "parallel", p.two.normal = sign * p.one.normal;
      break;
    case 2:
      p.kind = "same line", p.two = {sign * p.one.normal, sign * p.one.delta};
      break;
    case 3:
    case 4: {
      p.kind = "nearly the same line";
      const double turn = random.spread(1e-16, 1e-2), shift = turn * random.uniform(-1.5, 1.5);
      const glm::dvec2 n = p.one.normal, across{-n.y, n.x};
      p.two = {sign * (std::cos(turn) * n + std::sin(turn) * across),
               std::clamp(sign * (p.one.delta + shift), -1.0, 1.0)};
      break;
    }
    case 5:
      p.kind = "nearly tangent", p.two.delta = sign * (1.0 - random.spread(1e-17, 1e-3));
      break;
    case 6:
      p.kind = "both nearly tangent", p.one.delta = 1.0 - random.spread(1e-17, 1e-3),
      p.two.delta = sign * (1.0 - random.spread(1e-17, 1e-3));
      break;
    default:
      break;
  }
  return p;
}

TEST(TwoHalfPlanesAreaProperty, AgreesWithQuadrature) {
  constexpr std::uint64_t kSeed = 20'044;
  Random random(kSeed);
  double worst = 0.0;
  for (int k = 0; k < 7'000; ++k) {
    const ChordPair p = chord_pair(random, k);
    const double area = two_half_planes_area(p.one, p.two),
                 exact = two_half_planes_by_quadrature(p.one, p.two);
    worst = std::max(worst, std::abs(area - exact));
    EXPECT_NEAR(area, exact, 1e-9) << "seed " << kSeed << ", pair " << k << ", " << p.kind;
    EXPECT_NEAR(area, two_half_planes_area(p.two, p.one), 1e-9)
        << "seed " << kSeed << ", pair " << k << ", swapped";
    if (HasFailure()) return;
  }
  std::printf("worst difference of the area: %.2g\n", worst);
}

TEST(TwoHalfPlanesAreaProperty, TheFourPartsMakeTheDisk) {
  constexpr std::uint64_t kSeed = 20'045;
  Random random(kSeed);
  for (int k = 0; k < 7'000; ++k) {
    const ChordPair p = chord_pair(random, k);
    const Chord not_one{-p.one.normal, -p.one.delta}, not_two{-p.two.normal, -p.two.delta};
    const double sum = two_half_planes_area(p.one, p.two) + two_half_planes_area(p.one, not_two) +
                       two_half_planes_area(not_one, p.two) + two_half_planes_area(not_one, not_two);
    ASSERT_NEAR(sum, 1.0, 1e-9) << "seed " << kSeed << ", pair " << k << ", " << p.kind;
  }
}

}  // namespace
}  // namespace penumbra
