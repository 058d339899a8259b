#include "render/d_buffer/seen_boundary.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/render/render_support.h"

namespace penumbra {
namespace {

using detail::EntryUse;
using detail::SeenBoundary;
using testing::Random;

constexpr std::uint32_t kFollowed = 1, kEdgeAlone = 2;
const Vec3 kReceiver(0.1, -0.2, 0.3);

EntryUse use_of(std::uint32_t facet, std::uint32_t kind) {
  return {facet << 4 | kind};
}

/// A point of light space that the receiver sees at the point d of the disk.
Vec3 seen_at(const glm::dvec2& d, double height) {
  return kReceiver + height * Vec3(d, 1.0);
}

/// Records of a line of edges; `closed`: the last joins the first. Lit is the left as seen on the disk: edges
/// run against the line, since light space is a mirror image of the world.
std::vector<glm::vec4> records_of(const std::vector<Vec3>& line, bool closed) {
  const std::vector<Vec3> corners(line.rbegin(), line.rend());
  const std::size_t edges = closed ? corners.size() : corners.size() - 1;
  const auto corner = [&](std::size_t i) { return glm::vec3(corners[i % corners.size()]); };
  std::vector<glm::vec4> out;
  for (std::size_t i = 0; i < edges; ++i) {
    const bool has_previous = closed || i > 0, has_next = closed || i + 1 < edges;
    const std::size_t previous = (i + corners.size() - 1) % corners.size();
    out.emplace_back(has_previous ? corner(previous) : corner(i),
                     has_previous ? static_cast<float>((i + edges - 1) % edges + 1) : 0.0f);
    out.emplace_back(corner(i), 0.0f);
    out.emplace_back(corner(i + 1), 0.0f);
    out.emplace_back(has_next ? corner(i + 2) : corner(i + 1),
                     has_next ? static_cast<float>((i + 1) % edges + 1) : 0.0f);
  }
  return out;
}

bool is_left_of(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& p) {
  return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x) > 0.0;
}

/// Compares with `expected` at random points of the disk.
template <class Expected>
void expect_lit(const SeenBoundary& boundary, const Expected& expected) {
  Random random(12);
  int lit = 0;
  for (int k = 0; k < 2'000; ++k) {
    const glm::dvec2 p = std::sqrt(random.uniform(0.0, 1.0)) * random.unit2();
    ASSERT_EQ(boundary.is_lit(p), expected(p)) << p.x << " " << p.y;
    lit += boundary.is_lit(p);
  }
  EXPECT_GT(lit, 20);
  EXPECT_LT(lit, 1'980);
}

TEST(SeenBoundary, OneEdgeIsAHalfPlane) {
  const glm::dvec2 a(-3.0, 0.4), b(2.0, -0.6);
  for (const bool turned : {false, true}) {
    const auto records = records_of({seen_at(turned ? b : a, 0.5), seen_at(turned ? a : b, 2.0)}, false);
    const bool left = SeenBoundary(records, use_of(0, kFollowed), kReceiver, false).is_lit({0.0, 0.9});
    EXPECT_NE(left, turned) << "the direction of the edge says which side is lit";
    expect_lit(SeenBoundary(records, use_of(0, kFollowed), kReceiver, false),
               [&](const glm::dvec2& p) { return is_left_of(a, b, p) == left; });
  }
}

TEST(SeenBoundary, AnEdgeAloneMovesToTheCenterThatContradictsIt) {
  const glm::dvec2 a(-3.0, 0.4), b(3.0, 0.4);
  const auto records = records_of({seen_at(a, 1.0), seen_at(b, 1.0)}, false);
  // Lit is y > .4: the center is not. One that is seen moves the edge down to it.
  expect_lit(SeenBoundary(records, use_of(0, kEdgeAlone), kReceiver, true),
             [](const glm::dvec2& p) { return p.y > 0.4; });
  expect_lit(SeenBoundary(records, use_of(0, kEdgeAlone), kReceiver, false),
             [](const glm::dvec2& p) { return p.y > 0.0; });
}

TEST(SeenBoundary, CornersAndClosedBoundariesAreFollowedFromAnyEdge) {
  const std::vector<glm::dvec2> corner{{-4.0, 0.3}, {0.2, -0.1}, {0.5, 3.0}};
  const std::vector<Vec3> line{seen_at(corner[0], 0.7), seen_at(corner[1], 1.0), seen_at(corner[2], 1.5)};
  for (const std::uint32_t facet : {0u, 1u})  // turns left: lit is what is left of both
    expect_lit(SeenBoundary(records_of(line, false), use_of(facet, kFollowed), kReceiver, false),
               [&](const glm::dvec2& p) {
                 return is_left_of(corner[0], corner[1], p) && is_left_of(corner[1], corner[2], p);
               });
  const std::vector<glm::dvec2> triangle{{-0.5, -0.4}, {0.6, -0.3}, {0.1, 0.7}};
  std::vector<Vec3> ring;
  for (const glm::dvec2& d : triangle) ring.push_back(seen_at(d, 1.0 + 0.5 * d.x));
  for (const std::uint32_t facet : {0u, 1u, 2u})
    expect_lit(SeenBoundary(records_of(ring, true), use_of(facet, kFollowed), kReceiver, false),
               [&](const glm::dvec2& p) {
                 return is_left_of(triangle[0], triangle[1], p) && is_left_of(triangle[1], triangle[2], p) &&
                        is_left_of(triangle[2], triangle[0], p);
               });
}

// The corner lies outside of the disk: both of its edges cut the disk.
TEST(SeenBoundary, AnEdgeMayComeBackPastACorner) {
  const std::vector<glm::dvec2> corner{{-1.3, -0.8}, {1.5, 0.1}, {-1.3, 0.9}};
  const auto at = [&](std::size_t i) { return seen_at(corner[i], 1.0); };
  const auto inside = [&](const glm::dvec2& p) {
    return is_left_of(corner[0], corner[1], p) && is_left_of(corner[1], corner[2], p);
  };
  for (const std::uint32_t facet : {0u, 1u}) {
    expect_lit(
        SeenBoundary(records_of({at(0), at(1), at(2)}, false), use_of(facet, kFollowed), kReceiver, false),
        inside);
    expect_lit(
        SeenBoundary(records_of({at(2), at(1), at(0)}, false), use_of(facet, kFollowed), kReceiver, false),
        [&](const glm::dvec2& p) { return !inside(p); });
  }
}

}  // namespace
}  // namespace penumbra
