// Charts and where they lie in the texture.
#include "penumbra/render/bake/texture_atlas.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "penumbra/mesh/error.h"
#include "penumbra/mesh/shapes.h"
#include "render/bake/charts.h"
#include "render/bake/clip.h"
#include "render/bake/texture_coverage.h"
#include "render/bake/uv_overlaps.h"

namespace penumbra {
namespace {

using detail::Chart;
using detail::doubled_area;

std::vector<SceneObject> objects_of(std::vector<TriangleMesh> meshes) {
  std::vector<SceneObject> objects;
  for (TriangleMesh& mesh : meshes) objects.push_back({.name = "object", .mesh = std::move(mesh)});
  return objects;
}

/// A ramp that turns around the y axis more than once: seen from above it lies on itself.
TriangleMesh spiral_ramp() {
  std::vector<Vec3> points;
  std::vector<IndexedTriangle> faces;
  constexpr std::uint32_t kSteps = 60;
  for (std::uint32_t i = 0; i <= kSteps; ++i) {
    const double a = 2.5 * 2.0 * std::numbers::pi * i / kSteps;
    for (const double r : {2.0, 4.0}) points.emplace_back(r * std::cos(a), 0.02 * i, r * std::sin(a));
    if (i == kSteps) break;
    const std::uint32_t k = 2 * i;
    faces.push_back({k, k + 2, k + 1});
    faces.push_back({k + 1, k + 2, k + 3});
  }
  return TriangleMesh::build(points, faces);
}

TEST(Charts, ABoxHasSixOfItsSidesSizes) {
  const std::vector<Chart> charts = detail::make_charts(make_box({5, 6, 7}, {1, 2, 3}), 0, 30.0);
  ASSERT_EQ(charts.size(), 6u);
  std::vector<double> areas;
  for (const Chart& chart : charts) {
    EXPECT_EQ(chart.faces.size(), 2u);
    EXPECT_GE(chart.extent.x, chart.extent.y);
    areas.push_back(chart.extent.x * chart.extent.y);
  }
  std::ranges::sort(areas);
  const double expected[] = {8, 8, 12, 12, 24, 24};
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(areas[i], expected[i], 1e-12);
}

TEST(Charts, FlatOnesKeepLengthsAndTurnAsFacesDo) {
  const TriangleMesh mesh = make_box({5, 6, 7}, {1, 2, 3});
  for (const Chart& chart : detail::make_charts(mesh, 0, 30.0))
    for (std::size_t i = 0; i < chart.faces.size(); ++i) {
      const IndexedTriangle& t = mesh.triangles()[chart.faces[i]];
      for (std::size_t k = 0; k < 3; ++k) {
        const glm::dvec2 side = chart.uv[i][(k + 1) % 3] - chart.uv[i][k];
        const Vec3 edge = mesh.positions()[t[(k + 1) % 3]] - mesh.positions()[t[k]];
        EXPECT_NEAR(std::hypot(side.x, side.y), glm::length(edge), 1e-12);
      }
      EXPECT_LT(doubled_area(chart.uv[i]), 0.0) << "y runs down, so counter-clockwise is negative";
    }
}

TEST(Charts, EveryFaceOfARoundBodyIsInOneChart) {
  const TriangleMesh mesh = make_icosphere({0, 0, 0}, 1, 3);
  std::vector<int> seen(mesh.triangles().size(), 0);
  for (const Chart& chart : detail::make_charts(mesh, 0, 30.0)) {
    EXPECT_TRUE(detail::find_overlaps(chart.uv, 1e-9, 1).empty());
    for (const std::uint32_t f : chart.faces) ++seen[f];
  }
  for (const int count : seen) EXPECT_EQ(count, 1);
}

TEST(Charts, ARampThatLiesOnItselfIsDivided) {
  const TriangleMesh mesh = spiral_ramp();
  const std::vector<Chart> charts = detail::make_charts(mesh, 0, 30.0);
  EXPECT_GE(charts.size(), 3u);
  std::size_t faces = 0;
  for (const Chart& chart : charts) {
    EXPECT_TRUE(detail::find_overlaps(chart.uv, 1e-9, 1).empty());
    faces += chart.faces.size();
  }
  EXPECT_EQ(faces, mesh.triangles().size());
}

TEST(UvOverlaps, CommonAreasAndPairs) {
  const FaceUv a{{{0, 0}, {2, 0}, {0, 2}}}, b{{{1, 0}, {3, 0}, {1, 2}}}, beside{{{2, 0}, {2, 2}, {0, 2}}};
  EXPECT_NEAR(detail::common_area(a, b), 0.5, 1e-15);
  EXPECT_NEAR(detail::common_area(a, {b[0], b[2], b[1]}), 0.5, 1e-15) << "the other way round";
  EXPECT_EQ(detail::common_area(a, beside), 0.0) << "they share a side";
  EXPECT_NEAR(detail::common_area(a, a), 2.0, 1e-15);
  const FaceUv all[] = {a, beside, b};
  const auto pairs = detail::find_overlaps(all, 0.0, 10);
  ASSERT_EQ(pairs.size(), 2u);
  EXPECT_EQ(pairs[0], std::pair(0u, 2u));
  EXPECT_EQ(pairs[1], std::pair(1u, 2u));
}

/// No texel within the padding of one that a chart touches is touched by another.
void expect_charts_apart(const std::vector<SceneObject>& objects, const AtlasOptions& options) {
  const TextureAtlas atlas = make_atlas(objects, options);
  const detail::TextureCoverage coverage(atlas, 64);
  std::vector<std::vector<std::size_t>> charts(objects.size());  // of each face
  for (std::uint32_t object = 0; object < objects.size(); ++object) {
    charts[object].resize(objects[object].mesh.triangles().size());
    std::size_t number = 1000 * object;
    for (const Chart& chart : detail::make_charts(objects[object].mesh, object, options.chart_degrees)) {
      for (const std::uint32_t f : chart.faces) charts[object][f] = number;
      ++number;
    }
  }
  std::vector<std::size_t> owner(static_cast<std::size_t>(atlas.width * atlas.height), SIZE_MAX);
  for (std::size_t t = 0; t < coverage.tiles(); ++t)
    coverage.for_each_piece(
        t, 1, [](int, int) { return true; },
        [&](const detail::TexelPiece& piece) {
          const std::size_t chart = charts[piece.object][piece.face];
          for (int y = piece.y - options.padding; y <= piece.y + options.padding; ++y)
            for (int x = piece.x - options.padding; x <= piece.x + options.padding; ++x) {
              if (x < 0 || y < 0 || x >= atlas.width || y >= atlas.height) continue;
              const std::size_t other = owner[static_cast<std::size_t>(y * atlas.width + x)];
              EXPECT_TRUE(other == SIZE_MAX || other == chart) << x << "," << y;
            }
          owner[static_cast<std::size_t>(piece.y * atlas.width + piece.x)] = chart;
        });
}

TEST(TextureAtlas, ChartsAreApart) {
  const auto objects = objects_of({make_box({0, 0, 0}, {1, 2, 3}), make_icosphere({5, 0, 0}, 1, 1)});
  expect_charts_apart(objects, {.size = 96, .padding = 2});
  expect_charts_apart(objects, {.texel = 0.2, .padding = 3});
}

TEST(TextureAtlas, IsAsFineAsItsSizeAllows) {
  const auto objects = objects_of({make_box({0, 0, 0}, {1, 2, 3})});
  const TextureAtlas small = make_atlas(objects, {.size = 64}), large = make_atlas(objects, {.size = 256});
  EXPECT_EQ(small.width, 64);
  EXPECT_EQ(small.height, 64);
  EXPECT_EQ(small.charts, 6u);
  // 88 square units in 4,096 texels would be texels of .147.
  EXPECT_LT(small.texel, 0.25);
  EXPECT_LT(large.texel, small.texel / 3.5);
}

TEST(TextureAtlas, SidesOfABoxAreWholeTexels) {
  const auto objects = objects_of({make_box({0, 0, 0}, {1.03, 2.01, 3.07})});
  const TextureAtlas atlas = make_atlas(objects, {.texel = 0.25});
  const detail::TextureCoverage coverage(atlas, 32);
  for (int y = 0; y < atlas.height; ++y)
    for (int x = 0; x < atlas.width; ++x)
      EXPECT_TRUE(coverage.is_full(x, y) || !coverage.is_touched(x, y)) << x << "," << y;
}

TEST(TextureAtlas, TakesTheObjectsThatItIsTold) {
  const auto objects = objects_of({make_box({0, 0, 0}, {1, 1, 1}), make_box({5, 0, 0}, {1, 1, 1})});
  const TextureAtlas atlas = make_atlas(objects, {.size = 64, .objects = {1}});
  EXPECT_FALSE(atlas.has(0));
  EXPECT_TRUE(atlas.has(1));
  EXPECT_EQ(atlas.charts, 6u);
}

TEST(TextureAtlas, RefusesWhatDoesNotFit) {
  const auto many = objects_of({make_random_triangles({0, 0, 0}, 10, 0.1, 500, 1)});
  EXPECT_THROW(make_atlas(many, {.size = 32}), UsageError);
  EXPECT_THROW(make_atlas(many, {.texel = 1e-6}), UsageError);
  EXPECT_NO_THROW(make_atlas(many, {.size = 128}));
}

// A corner lies on the opposite edge but for a rounding: turned into its chart, the face has no height.
TEST(TextureAtlas, ASliverGetsATexel) {
  const std::vector<Vec3> points{{0, 0, 0}, {1, 1, 0}, {0.8125, std::nextafter(0.8125, 1.0), 0}};
  const auto sliver = TriangleMesh::build(points, std::vector<IndexedTriangle>{{0, 1, 2}});
  for (const auto& objects : {objects_of({sliver}), objects_of({sliver, make_box({5, 0, 0}, {1, 1, 1})})}) {
    const TextureAtlas atlas = make_atlas(objects, {.size = 64});
    for (const std::vector<FaceUv>& faces : atlas.uv)
      for (const FaceUv& uv : faces)
        for (const glm::dvec2& p : uv) EXPECT_TRUE(p.x >= 0.0 && p.x <= 64.0 && p.y >= 0.0 && p.y <= 64.0);
  }
}

TEST(TextureAtlas, RefusesWhatIsNoNumberAndWhatIsTooSmall) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto box = objects_of({make_box({0, 0, 0}, {1, 1, 1})});
  EXPECT_THROW(make_atlas(box, {.texel = nan}), UsageError);
  EXPECT_THROW(make_atlas(box, {.chart_degrees = nan}), UsageError);
  EXPECT_THROW(make_atlas(objects_of({make_box({0, 0, 0}, Vec3(1e-200))}), {.size = 64}), UsageError);
}

TEST(TextureCoverage, PiecesAddUpToFaces) {
  const TextureAtlas atlas{.width = 50,
                           .height = 40,
                           .uv = {{FaceUv{{{3.3, 4.7}, {41.2, 9.9}, {17.5, 36.1}}},
                                   FaceUv{{{41.2, 9.9}, {45.0, 38.0}, {17.5, 36.1}}},
                                   FaceUv{{{1, 1}, {1.0001, 1}, {1, 1.0001}}}}}};
  const detail::TextureCoverage coverage(atlas, 16);
  for (const int side : {1, 3}) {
    std::vector<double> areas(3, 0.0);
    for (std::size_t t = 0; t < coverage.tiles(); ++t)
      coverage.for_each_piece(
          t, side, [](int, int) { return true; },
          [&](const detail::TexelPiece& piece) {
            areas[piece.face] += piece.area;
            EXPECT_GE(piece.at.x, piece.x - 1e-9);
            EXPECT_LE(piece.at.x, piece.x + 1 + 1e-9);
            EXPECT_GE(piece.at.y, piece.y - 1e-9);
            EXPECT_LE(piece.at.y, piece.y + 1 + 1e-9);
            const Vec3 b = detail::barycentric_in(atlas.uv[0][piece.face], piece.at);
            EXPECT_NEAR(b.x + b.y + b.z, 1.0, 1e-15);
            EXPECT_GE(std::min({b.x, b.y, b.z}), 0.0);
          });
    for (std::size_t f = 0; f < 3; ++f)
      EXPECT_NEAR(areas[f], 0.5 * std::abs(doubled_area(atlas.uv[0][f])), 1e-10);
  }
  EXPECT_TRUE(coverage.is_touched(1, 1)) << "by ever so little";
  EXPECT_FALSE(coverage.is_touched(2, 1));
  EXPECT_TRUE(coverage.is_full(20, 20));
}

}  // namespace
}  // namespace penumbra
