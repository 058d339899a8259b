#include "volumes/cells/triangle_contact.h"

#include <CGAL/Gmpq.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/intersections.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "penumbra/volumes/predicates/predicates.h"
#include "tests/volumes/random_inputs.h"
#include "volumes/predicates/predicate_tiers.h"

namespace penumbra {
namespace {

using detail::Corners;
using detail::do_meet;

const Corners kTriangle{Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(0, 4, 0)};

TEST(DoMeet, AcrossBesideAndTouching) {
  EXPECT_TRUE(do_meet(kTriangle, {Vec3(1, 1, -1), Vec3(1, 1, 1), Vec3(2, 1, 1)}));
  EXPECT_FALSE(do_meet(kTriangle, {Vec3(5, 1, -1), Vec3(5, 1, 1), Vec3(6, 1, 1)}));
  EXPECT_TRUE(do_meet(kTriangle, {Vec3(1, 1, 0), Vec3(1, 1, 1), Vec3(2, 1, 1)})) << "a corner on it";
  EXPECT_TRUE(do_meet(kTriangle, kTriangle));
}

TEST(DoMeet, SharedCornersAndSidesDoNotCount) {
  EXPECT_FALSE(do_meet(kTriangle, {Vec3(4, 0, 0), Vec3(0, 0, 0), Vec3(0, 0, 4)}));
  EXPECT_FALSE(do_meet(kTriangle, {Vec3(4, 0, 0), Vec3(0, 0, 0), Vec3(1, -1, 0)}));
  EXPECT_TRUE(do_meet(kTriangle, {Vec3(4, 0, 0), Vec3(0, 0, 0), Vec3(1, 9, 0)})) << "folded back";
  EXPECT_FALSE(do_meet(kTriangle, {Vec3(0, 0, 0), Vec3(-1, 0, 0), Vec3(0, -1, 0)}));
  EXPECT_TRUE(do_meet(kTriangle, {Vec3(0, 0, 0), Vec3(1, 1, 1), Vec3(1, 1, -1)})) << "through it";
  EXPECT_TRUE(do_meet(kTriangle, {Vec3(0, 0, 0), Vec3(8, 0, 0), Vec3(4, -1, 0)})) << "along a side";
}

// ---- against CGAL's intersections in rationals

using Kernel = CGAL::Simple_cartesian<CGAL::Gmpq>;
using Point = Kernel::Point_3;

Point exact(const Vec3& p) {
  return {p.x, p.y, p.z};
}

bool do_meet_oracle(const Corners& a, const Corners& b) {
  std::vector<Point> shared;
  for (const Vec3& p : a)
    if (std::find(b.begin(), b.end(), p) != b.end()) shared.push_back(exact(p));
  const Kernel::Triangle_3 first(exact(a[0]), exact(a[1]), exact(a[2])),
      second(exact(b[0]), exact(b[1]), exact(b[2]));
  const auto common = CGAL::intersection(first, second);
  if (!common) return false;
  const auto is_shared = [&](const Point& p) {
    return std::find(shared.begin(), shared.end(), p) != shared.end();
  };
  if (const auto* point = boost::get<Point>(&*common)) return !is_shared(*point);
  if (const auto* segment = boost::get<Kernel::Segment_3>(&*common))
    return !is_shared(segment->source()) || !is_shared(segment->target());
  return true;
}

TEST(DoMeet, AgreesWithIntersectionsInRationals) {
  constexpr std::uint64_t kSeed = 31;
  testing::RandomInputs random(kSeed);
  int meet = 0, apart = 0, shared_corners[4] = {};
  for (int k = 0; k < 40'000; ++k) {
    Corners a, b;
    const int size = 1 + k % 3;
    for (Vec3& p : a) p = random.lattice_point(size);
    for (Vec3& p : b) p = random.lattice_point(size);
    for (int i = 0; i < k % 4 && i < 2; ++i)
      b[static_cast<std::size_t>(2 - i)] = a[static_cast<std::size_t>(i)];
    if (k % 5 == 0)  // one plane
      for (Corners* t : {&a, &b})
        for (Vec3& p : *t) p.z = p.x + 2.0 * p.y;
    if (k % 7 == 0) random.nudge(b[static_cast<std::size_t>(random.integer(0, 2))]);
    if (detail::collinear(a[0], a[1], a[2]) || detail::collinear(b[0], b[1], b[2])) continue;
    const bool truth = do_meet_oracle(a, b);
    ASSERT_EQ(do_meet(a, b), truth) << "seed " << kSeed << " input " << k;
    ASSERT_EQ(do_meet(b, a), truth) << "seed " << kSeed << " input " << k;
    ++(truth ? meet : apart);
    ++shared_corners[std::count_if(
        a.begin(), a.end(), [&](const Vec3& p) { return std::find(b.begin(), b.end(), p) != b.end(); })];
  }
  EXPECT_GT(meet, 4'000);
  EXPECT_GT(apart, 4'000);
  for (int i = 0; i < 3; ++i) EXPECT_GT(shared_corners[i], 1'000) << i;
}

TEST(Crossing, SaysWhichWayAndNothingWhereItTouches) {
  EXPECT_EQ(detail::crossing({1, 1, -1}, {1, 1, 1}, kTriangle), 1);
  EXPECT_EQ(detail::crossing({1, 1, 1}, {1, 1, -1}, kTriangle), -1);
  EXPECT_EQ(detail::crossing({3, 3, -1}, {3, 3, 1}, kTriangle), 0);
  EXPECT_EQ(detail::crossing({1, 1, 1}, {1, 1, 2}, kTriangle), 0);
  EXPECT_EQ(detail::crossing({2, 2, -1}, {2, 2, 1}, kTriangle), std::nullopt);
  EXPECT_EQ(detail::crossing({1, 1, 0}, {1, 1, 1}, kTriangle), std::nullopt);
}

}  // namespace
}  // namespace penumbra
