// Receivers in groups: each in one of them, and the order in which they come decides nothing.
#include "render/receivers/receiver_groups.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>

#include "tests/render/render_support.h"

namespace penumbra::detail {
namespace {

using testing::Random;
using Group = std::vector<std::uint32_t>;

std::vector<Group> groups_of(const Receivers& receivers) {
  const ReceiverGroups groups(receivers);
  std::vector<Group> out(groups.count());
  for (std::size_t g = 0; g < out.size(); ++g)
    groups.for_each(g, [&](std::uint32_t i) { out[g].push_back(i); });
  return out;
}

void expect_each_once(const std::vector<Group>& groups, std::size_t count) {
  Group all;
  for (const Group& group : groups) {
    EXPECT_FALSE(group.empty());
    EXPECT_LE(group.size(), ReceiverGroups::kMost);
    all.insert(all.end(), group.begin(), group.end());
  }
  std::sort(all.begin(), all.end());
  EXPECT_EQ(all, testing::first_pixels(count));
}

/// Points of two planes that face each other, in no order.
struct Points {
  std::vector<Vec3> points, normals;
  Receivers receivers() const { return {.points = points, .normals = normals}; }
};
Points random_points(std::uint64_t seed, std::size_t count) {
  Random random(seed);
  Points out;
  for (std::size_t i = 0; i < count; ++i) {
    const bool floor = i % 2 == 0;
    out.points.push_back({random.uniform(-3, 3), floor ? 0.0 : 1e-3, random.uniform(-3, 3)});
    out.normals.push_back({0, floor ? 1 : -1, 0});
  }
  return out;
}

TEST(ReceiverGroups, HoldEveryReceiverOnce) {
  for (const std::size_t count : {1u, 2u, 63u, 64u, 65u, 127u, 1000u, 20'000u}) {
    const Points points = random_points(5, count);
    const std::vector<Group> groups = groups_of(points.receivers());
    expect_each_once(groups, count);
    EXPECT_EQ(groups.size(), (count + 63) / 64) << count;
    expect_each_once(groups_of({.points = points.points}), count);
  }
  EXPECT_TRUE(groups_of({}).empty());
}

TEST(ReceiverGroups, OfPixelsAreTiles) {
  std::vector<Vec3> points(21 * 10, Vec3(0.0));
  const std::vector<Group> groups = groups_of({.points = points, .width = 21, .height = 10});
  expect_each_once(groups, points.size());
  ASSERT_EQ(groups.size(), 6u);
  for (const Group& group : groups)
    for (const std::uint32_t i : group) {
      EXPECT_EQ(i % 21 / 8, group.front() % 21 / 8);
      EXPECT_EQ(i / 21 / 8, group.front() / 21 / 8);
    }
}

/// What lies in the groups, in their order and each group's own.
std::vector<std::vector<double>> contents(const Points& points) {
  std::vector<std::vector<double>> out;
  for (const Group& group : groups_of(points.receivers())) {
    out.emplace_back();
    for (const std::uint32_t i : group)
      for (const Vec3& v : {points.points[i], points.normals[i]})
        out.back().insert(out.back().end(), {v.x, v.y, v.z});
  }
  return out;
}

TEST(ReceiverGroups, DoNotDependOnTheOrderOfReceivers) {
  const Points points = random_points(6, 10'000);
  const auto expected = contents(points);
  Group order = testing::first_pixels(points.points.size());
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    std::shuffle(order.begin(), order.end(), std::mt19937_64(seed));
    Points shuffled;
    for (const std::uint32_t i : order) {
      shuffled.points.push_back(points.points[i]);
      shuffled.normals.push_back(points.normals[i]);
    }
    EXPECT_EQ(contents(shuffled), expected) << "seed " << seed;
  }
}

TEST(ReceiverGroups, OfEqualPointsHoldEachOnce) {
  Points points;
  points.points.assign(1'000, Vec3(1, 2, 3));
  points.normals.assign(1'000, Vec3(0, 1, 0));
  expect_each_once(groups_of(points.receivers()), 1'000);
  for (std::size_t i = 0; i < 1'000; i += 3) points.points[i] = {4, 5, 6};
  const std::vector<Group> groups = groups_of(points.receivers());
  expect_each_once(groups, 1'000);
  const auto mixed = [&](const Group& group) {
    return std::any_of(group.begin(), group.end(),
                       [&](std::uint32_t i) { return points.points[i] != points.points[group.front()]; });
  };
  EXPECT_LE(std::count_if(groups.begin(), groups.end(), mixed), 1);
}

// What a group shares, its shaft above all, is worth the less the wider the group is.
TEST(ReceiverGroups, LieCloseTogether) {
  const Points points = random_points(7, 20'000);
  double sum = 0.0;
  const std::vector<Group> groups = groups_of(points.receivers());
  std::size_t both_sides = 0;
  for (const Group& group : groups) {
    Bounds bounds;
    std::set<double> sides;
    for (const std::uint32_t i : group) {
      bounds.add(points.points[i]);
      sides.insert(points.normals[i].y);
    }
    both_sides += sides.size() > 1;
    sum += bounds.radius();
  }
  // 64 of the 10,000 points of a side are a square of 6 √(64/10,000) a side, half of whose diagonal is .34.
  EXPECT_LE(sum / static_cast<double>(groups.size()), 0.45);
  // The planes nearly touch, but groups are divided by normals too; their middle need not lie between the
  // sides.
  EXPECT_LE(both_sides, groups.size() / 10);
}

}  // namespace
}  // namespace penumbra::detail
