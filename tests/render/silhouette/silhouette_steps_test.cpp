// The steps of the silhouette method, one by one.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <tuple>

#include "penumbra/mesh/shapes.h"
#include "render/silhouette/areas/clip_segments.h"
#include "render/silhouette/areas/visible_area.h"
#include "render/silhouette/collect/edge_blocks.h"
#include "render/silhouette/collect/edge_list.h"
#include "render/silhouette/collect/shaft.h"
#include "tests/render/render_support.h"

namespace penumbra::detail {
namespace {

using glm::dvec2;
using penumbra::testing::Random;

Chord random_horizon(Random& random) {
  return {random.unit2(), random.uniform(-0.95, 0.95)};
}

TEST(DiskPart, WalksItsBoundary) {
  Random random(5);
  for (int i = 0; i < 400; ++i) {
    const DiskPart part(i % 4 == 0 ? no_horizon() : random_horizon(random));
    // Around D in small steps from the lowest point, by its ends at rising and falling heights.
    const int n = 4000;
    dvec2 last{0.0};
    double sum = 0.0, off = 0.0;
    bool started = false;
    const auto step = [&](const dvec2& p, bool left) {
      if (started) sum += 0.5 * (last.x * p.y - last.y * p.x);
      started = true;
      last = p;
      const bool chord = part.is_cut() && std::abs(height(part.horizon(), p)) < 1e-9;
      const Event e{p, chord, 1};
      if (part.on_left(e) == left) off = std::max(off, std::abs(part.walked(e) - sum));
    };
    const auto at = [&](int k) {
      return part.bottom() + (part.top() - part.bottom()) * 0.5 * (1.0 - std::cos(testing::kPi * k / n));
    };
    for (int k = 1; k < n; ++k) {
      const auto [left, right] = part.span(at(k), DiskPart::half_width(at(k)));
      if (k == 1) {
        const double low = part.bottom();
        last = {part.span(low, DiskPart::half_width(low)).second, low};
        started = true;
      }
      step({right, at(k)}, false);
    }
    for (int k = n - 1; k > 0; --k) step({part.span(at(k), DiskPart::half_width(at(k))).first, at(k)}, true);
    EXPECT_NEAR(sum, part.area(), 2e-3) << i;
    EXPECT_LE(off, 2e-3) << i;
  }
}

/// Closed outlines of random polygons, as faces would leave them: jump 2 inside.
std::vector<Segment> random_polygons(Random& random, int count) {
  std::vector<Segment> segments;
  for (int p = 0; p < count; ++p) {
    const dvec2 middle{random.uniform(-1, 1), random.uniform(-1, 1)};
    const double size = random.spread(0.05, 2.0), start = random.uniform(0, 6.3);
    const int corners = 3 + p % 4;
    const auto corner = [&](int k) {
      const double angle = start + 2.0 * testing::kPi * (k % corners) / corners;
      return middle + size * dvec2(std::cos(angle), std::sin(angle));
    };
    for (int k = 0; k < corners; ++k) segments.push_back({corner(k), corner(k + 1), 2});
  }
  return segments;
}

/// Number of polygons over p (each edge with the inside on its left), by winding.
int winding(const std::vector<Segment>& segments, const dvec2& p) {
  int sum = 0;
  for (const Segment& s : segments) {
    if ((s.a.y <= p.y) == (s.b.y <= p.y)) continue;
    const double x = s.a.x + (s.b.x - s.a.x) * (p.y - s.a.y) / (s.b.y - s.a.y);
    if (x > p.x) sum += s.b.y > s.a.y ? 1 : -1;
  }
  return sum;
}

TEST(VisibleArea, SlabsAndManyRowsAgreeWithPointCounts) {
  Random random(17);
  VisibleArea visible_area;
  double worst_rows = 0.0, worst_points = 0.0;
  for (int i = 0; i < 300; ++i) {
    const DiskPart part(i % 2 == 0 ? no_horizon() : random_horizon(random));
    const std::vector<Segment> segments = random_polygons(random, 1 + i % 4);
    ClippedSegments clipped;
    clip_segments(segments, 0, part, clipped);
    ASSERT_TRUE(clipped.closed);
    if (clipped.segments.empty()) continue;
    const VisibleAreaResult slabs = visible_area.by_slabs(clipped, part),
                            rows = visible_area.by_rows(clipped, part, 1024);
    worst_rows = std::max(worst_rows, std::abs(slabs.area - rows.area));
    // The lowest level by counting points.
    std::map<int, int> counts;
    const int n = 200;
    for (int y = 0; y < n; ++y)
      for (int x = 0; x < n; ++x) {
        const dvec2 p{2.0 * (x + 0.5) / n - 1.0, 2.0 * (y + 0.5) / n - 1.0};
        if (glm::dot(p, p) < 1.0 && height(part.horizon(), p) > 0.0) ++counts[winding(segments, p)];
      }
    const double counted = counts.begin()->second * 4.0 / (n * n);
    // Neither a depth complexity too small for points, nor one that points miss.
    if (counts.begin()->second > 20 && slabs.area > 0.02)
      worst_points = std::max(worst_points, std::abs(slabs.area - counted));
    for (const dvec2& aim : slabs.aims) {
      EXPECT_LT(glm::dot(aim, aim), 1.0);
      EXPECT_GE(height(part.horizon(), aim), -1e-9);
    }
    VisibleAreaResult chain;
    if (area_by_chain(clipped, part, 0.0, chain)) {
      EXPECT_NEAR(chain.area, slabs.area, 1e-9) << i;
    }
  }
  std::printf("slabs against 1,024 rows %.2g, against counted points %.2g\n", worst_rows, worst_points);
  EXPECT_LE(worst_rows, 2e-4);
  EXPECT_LE(worst_points, 0.02) << "cells of 1/100 along boundaries of length below 20";
}

TEST(VisibleArea, WhatLiesBetweenRowsIsFound) {
  // A triangle over half of the disk, and thirty strips on top of each other between two of 64 rows.
  std::vector<Segment> segments;
  const auto outline = [&](std::vector<dvec2> corners) {
    for (std::size_t k = 0; k < corners.size(); ++k)
      segments.push_back({corners[k], corners[(k + 1) % corners.size()], 2});
  };
  outline({{-0.8, -0.5}, {0.7, -0.6}, {0.1, 0.7}});
  for (int k = 0; k < 30; ++k)
    outline({{-0.9 + 0.001 * k, -0.006}, {0.9, -0.0055}, {0.9, 0.0055}, {-0.9 + 0.001 * k, 0.006}});
  const DiskPart part(no_horizon());
  ClippedSegments clipped;
  clip_segments(segments, 0, part, clipped);
  VisibleArea visible_area;
  const double exact = visible_area.by_slabs(clipped, part).area;
  EXPECT_NEAR(visible_area.by_rows(clipped, part, 64).area, exact, 0.01);
}

/// Silhouettes of merged faces turn back here and there: tiny loops the wrong way round, at a depth complexity below
/// all.
TEST(VisibleArea, SliversBelowTheLowestDepthComplexityCountForNothing) {
  Random random(20);
  const auto outline = [](std::vector<Segment>& out, const std::vector<dvec2>& corners, int jump) {
    for (std::size_t k = 0; k < corners.size(); ++k)
      out.push_back({corners[k], corners[(k + 1) % corners.size()], jump});
  };
  VisibleArea visible_area;
  for (int i = 0; i < 100; ++i) {
    const DiskPart part(i % 2 == 0 ? no_horizon() : random_horizon(random));
    std::vector<Segment> segments;
    const dvec2 d = random.unit2(), side{-d.y, d.x}, foot = random.uniform(-0.6, 0.6) * side;
    outline(segments, {foot - 9.0 * d, foot + 9.0 * d, foot + 9.0 * (d + side), foot - 9.0 * (d - side)}, 2);
    ClippedSegments whole;
    clip_segments(segments, 0, part, whole);
    if (!whole.closed || whole.segments.empty()) continue;
    const double exact = visible_area.by_slabs(whole, part).area;
    if (exact <= 1e-3 * part.area()) continue;  // a sliver itself
    const int slivers = 1 + i % 9;
    for (int k = 0; k < slivers; ++k) {
      const dvec2 at = foot + random.uniform(-0.7, 0.7) * d + random.uniform(-0.02, 0.02) * side;
      outline(segments, {at, at + 0.02 * d, at + 0.02 * d + 0.002 * side}, -2);
    }
    ClippedSegments clipped;
    clip_segments(segments, 0, part, clipped);
    VisibleAreaResult result;
    visible_area.compute(clipped, part, 64, 1e-3, result);
    EXPECT_NEAR(result.area, exact, 1e-3) << i;
    EXPECT_NEAR(visible_area.by_slabs(clipped, part, 1e-3).area, exact, 1e-3) << i;
    EXPECT_NEAR(visible_area.by_rows(clipped, part, 64, 1e-3).area, exact, 2e-3) << i;
    if (visible_area.by_few_rows(clipped, part, 1e-3, result)) {
      EXPECT_NEAR(result.area, exact, 1e-3) << i;
    }
  }
}

/// A second caster within the first's shadow is no sliver, wherever it lies between few rows.
TEST(VisibleArea, FewRowsDoNotMistakeOverlapForTwoDepthComplexities) {
  Random random(24);
  VisibleArea visible_area;
  for (int i = 0; i < 300; ++i) {
    const DiskPart part(no_horizon());
    std::vector<Segment> segments = random_polygons(random, 2 + i % 3);
    ClippedSegments clipped;
    clip_segments(segments, 0, part, clipped);
    if (!clipped.closed || clipped.segments.empty()) continue;
    VisibleAreaResult few;
    if (visible_area.by_few_rows(clipped, part, 1e-3, few)) {
      EXPECT_NEAR(few.area, visible_area.by_slabs(clipped, part).area, 0.02) << i;
    }
  }
}

TEST(Rows, VectorsAgreeWithRowsSortedSingly) {
  Random random(19);
  Rows together, singly;
  for (int i = 0; i < 200; ++i) {
    const DiskPart part(i % 2 == 0 ? no_horizon() : random_horizon(random));
    const std::vector<Segment> segments = random_polygons(random, 1 + i % 60);
    ClippedSegments clipped;
    clip_segments(segments, 0, part, clipped);
    const int rows = 4 + i % 90;
    const RowSums a = together.sweep(clipped, part, rows), b = singly.sweep_singly(clipped, part, rows);
    ASSERT_EQ(a.length, b.length);
    ASSERT_EQ(a.first, b.first);
    ASSERT_EQ(a.second, b.second);
    ASSERT_EQ(a.lowest, b.lowest);
    ASSERT_EQ(a.lowest_length, b.lowest_length);
    ASSERT_EQ(a.complexities, b.complexities);
    for (int k = 0; k < 2; ++k) ASSERT_EQ(a.aims[k], b.aims[k]);
  }
}

TEST(ClippedSegments, IsExactForOneChord) {
  Random random(23);
  for (int i = 0; i < 500; ++i) {
    const Chord chord{random.unit2(), random.uniform(-0.99, 0.99)};
    const dvec2 foot = -chord.delta * chord.normal, d{chord.normal.y, -chord.normal.x};
    // A band of faces beyond the chord, ends far outside of the disk.
    const double reach = random.spread(3.0, 1e7);
    const std::vector<Segment> segments{{foot - reach * d, foot + reach * d, -1}};
    const DiskPart part(no_horizon());
    ClippedSegments clipped;
    clip_segments(segments, 0, part, clipped);
    VisibleAreaResult out;
    if (!area_by_chain(clipped, part, 0.0, out)) continue;  // too near the rim for a ray
    EXPECT_NEAR(out.area / testing::kPi, half_plane_area(chord.delta), 1e-9) << i;
  }
}

/// A chain across the disk that turns back or makes a loop here and there, closed far below.
std::vector<Segment> folded_chain(Random& random) {
  std::vector<dvec2> corners;
  const double bend = random.uniform(-0.3, 0.3), back = random.spread(0.01, 0.3);
  for (double x = -1.5; x < 1.5; x += random.uniform(0.02, 0.2)) {
    corners.push_back({x, bend * x * x + random.uniform(-0.01, 0.01)});
    if (random.uniform(0, 1) < 0.3)
      corners.push_back({x - random.uniform(0, back), bend * x * x + random.uniform(-back, back)});
    if (random.uniform(0, 1) < 0.1) {
      const dvec2 p = corners.back();
      const double high = random.uniform(-back, back);
      for (const dvec2& step : {dvec2(back, 0), dvec2(back, high), dvec2(0, high), dvec2(0, 0)})
        corners.push_back(p + step);
    }
  }
  corners.push_back({3.0, bend}), corners.push_back({3.0, -9.0}), corners.push_back({-3.0, -9.0});
  const dvec2 turn = random.unit2();
  std::vector<Segment> out;
  const auto corner = [&](std::size_t k) {
    const dvec2& p = corners[k % corners.size()];
    return dvec2(turn.x * p.x - turn.y * p.y, turn.y * p.x + turn.x * p.y);
  };
  for (std::size_t k = 0; k < corners.size(); ++k) out.push_back({corner(k + 1), corner(k), 2});
  std::rotate(out.begin(), out.begin() + static_cast<long>(random.uniform(0, 1) * 9), out.end());
  return out;
}

TEST(ClippedSegments, FoldsOfAChainTakeUpNoMoreThanTheyMay) {
  Random random(24);
  const DiskPart part(no_horizon());
  std::size_t chains = 0, folded = 0;
  double tightest = 0.0;
  for (int i = 0; i < 600; ++i) {
    const std::vector<Segment> segments = folded_chain(random);
    ClippedSegments clipped;
    clip_segments(segments, 0, part, clipped);
    ASSERT_TRUE(clipped.closed);
    if (is_one_chain(clipped) || !is_one_chain(clipped, 0.5)) continue;
    double least = 0.0, enough = 0.5;  // of folds to allow
    for (int step = 0; step < 20; ++step) {
      const double middle = 0.5 * (least + enough);
      (is_one_chain(clipped, middle) ? enough : least) = middle;
    }
    ++chains;
    std::size_t others = 0;
    const int n = 200;
    for (int y = 0; y < n; ++y)
      for (int x = 0; x < n; ++x) {
        const dvec2 p{2.0 * (x + 0.5) / n - 1.0, 2.0 * (y + 0.5) / n - 1.0};
        const int complexity = winding(segments, p);
        others += glm::dot(p, p) < 1.0 && complexity != 0 && complexity != 1 ? 1 : 0;
      }
    const double area = static_cast<double>(others) * 4.0 / (n * n);
    folded += area > 0.0 ? 1 : 0;
    EXPECT_LE(area, enough + 5e-4) << i;
    tightest = std::max(tightest, area / enough);
  }
  EXPECT_GT(folded, 40u) << "of " << chains;
  EXPECT_GT(tightest, 0.3) << "or the bound says little";
}

Band band_of(const Scene& scene) {
  const RayFrame frame = ray_frame(scene);
  const UnitLight light(testing::light_of(scene));
  const SceneEdges edges(scene, frame.origin, frame.scale);
  return make_band(LitScene(scene, light, edges), edges);
}

/// Random triangles between light and receivers as a band.
Band random_band(Random& random, int count, bool closed) {
  Scene scene = testing::scene_in_light_frame(1.0, {});
  std::vector<Vec3> points;
  std::vector<IndexedTriangle> faces;
  for (int i = 0; i < count; ++i) {
    const Vec3 middle{random.uniform(-4, 4), random.uniform(-4, 4), random.uniform(0.5, 9)};
    const double size = random.spread(0.01, 2.0);
    const auto first = static_cast<std::uint32_t>(points.size());
    for (int k = 0; k < 4; ++k) points.push_back(middle + random.point(size));
    faces.push_back({first, first + 1, first + 2});
    if (!closed) continue;
    faces.push_back({first, first + 3, first + 1});
    faces.push_back({first + 1, first + 3, first + 2});
    faces.push_back({first + 2, first + 3, first});
  }
  scene.objects.push_back({"", testing::mesh_of(points, faces), Vec3(0.8), true});
  return band_of(scene);
}

/// A finely divided sphere between light and receivers.
Band sphere_band(Random& random) {
  Scene scene = testing::scene_in_light_frame(1.0, {});
  const Vec3 middle{random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(2, 5)};
  scene.objects.push_back({"", make_icosphere(middle, random.uniform(0.3, 1.5), 5), Vec3(0.8), true});
  return band_of(scene);
}

/// The same segments to the last bit, in any order.
void expect_same_segments(std::vector<Segment> p, std::vector<Segment> q) {
  const auto numbers = [](const Segment& s) { return std::tuple(s.a.x, s.a.y, s.b.x, s.b.y, s.jump); };
  const auto before = [&](const Segment& s, const Segment& t) { return numbers(s) < numbers(t); };
  std::sort(p.begin(), p.end(), before);
  std::sort(q.begin(), q.end(), before);
  ASSERT_EQ(p.size(), q.size());
  for (std::size_t i = 0; i < p.size(); ++i) ASSERT_EQ(numbers(p[i]), numbers(q[i]));
}

void add_place(std::int32_t place, std::int32_t jump, TestedEdges& out) {
  out.places.push_back(place);
  out.jumps.push_back(jump);
  ++out.count;
}

void expect_same_places(const TestedEdges& p, const TestedEdges& q) {
  ASSERT_EQ(p.count, q.count);
  const auto n = static_cast<std::ptrdiff_t>(p.count);
  ASSERT_TRUE(std::equal(p.places.begin(), p.places.begin() + n, q.places.begin()));
  ASSERT_TRUE(std::equal(p.jumps.begin(), p.jumps.begin() + n, q.jumps.begin()));
}

/// Receivers near each other whose tangent plane may cut the disk.
std::vector<TileReceiver> random_receivers(Random& random, std::size_t count) {
  std::vector<TileReceiver> out;
  const Vec3 middle{random.uniform(-6, 6), random.uniform(-6, 6), random.uniform(3, 10)};
  const double size = random.spread(0.01, 2.0);
  const Vec3 normal = glm::normalize(Vec3(0, 0, -1) + random.point(1.5));
  while (out.size() < count) {
    const Vec3 x = middle + random.point(size), n = glm::normalize(normal + random.point(0.05));
    const double center = -glm::dot(n, x), fall2 = n.x * n.x + n.y * n.y;
    const bool cuts = center * center < fall2;
    if (!cuts && center <= 0.0) return random_receivers(random, count);  // behind its own plane
    out.push_back({x, n, cuts ? chord_of_plane(n, x, 1.0) : no_horizon(), cuts, 0});
  }
  return out;
}

/// What is above the horizon of the edges near the disk, by the definition.
std::vector<Segment> seen_edges(const Band& band, const TileReceiver& r, double slack, bool& certain) {
  std::vector<Segment> out;
  certain = true;
  for (const BandEdge& e : band.edges) {
    const Projection p = project_edge(e, r.x, slack);
    if (!p.near) continue;
    const bool above = height(r.horizon, p.segment.a) > 0.0 || height(r.horizon, p.segment.b) > 0.0;
    certain = certain && !above;
    if (p.segment.jump != 0 && above) out.push_back(p.segment);
  }
  return out;
}

TEST(EdgeBlocks, VectorsAgreeWithOneEdgeAtATimeAndLoseNothing) {
  Random random(37);
  std::size_t kept = 0, near = 0, listed = 0, looked_into = 0, clipped = 0;
  for (int round = 0; round < 80; ++round) {
    const Band band = round % 4 == 3 ? sphere_band(random) : random_band(random, 60, round % 2 == 0);
    const BandTree tree(band);
    const EdgeBlocks blocks(band);
    const std::vector<TileReceiver> receivers = random_receivers(random, 16);
    Shaft shaft(receivers, band.extent);
    shaft.tighten(receivers);
    std::vector<NodeMask> list, few;
    ProjectedEdges projected;
    tree.collect(shaft, list);
    tree.narrow(list, std::span(receivers).first(4), few);
    for (std::size_t r = 0; r < receivers.size(); ++r) {
      const TileReceiver& receiver = receivers[r];
      TestedEdges tested, singly;
      EXPECT_TRUE(blocks.test_edges(tree, r < 4 ? few : list, receiver, blocks.count(), tested));
      for (std::size_t b = 0; b < tested.looked_into; ++b)
        for (std::uint32_t lane = 0; lane < 8; ++lane) {
          const std::uint32_t i = 8 * static_cast<std::uint32_t>(tested.blocks[b]) + lane;
          const int jump = blocks.test_edge(i, receiver.x);
          if (jump == 0) continue;
          add_place(static_cast<std::int32_t>(i), jump, singly);
          ASSERT_LT(i, band.edges.size()) << "no edge";
          if (jump != TestedEdges::kUnsure) {
            ASSERT_EQ(jump, jump_at(band.edges[i], receiver.x));
          }
        }
      expect_same_places(tested, singly);
      project_edges(band, tested, receiver.x, receiver.horizon, 1e-6, projected);
      bool certain = false;
      const std::vector<Segment> segments = seen_edges(band, receiver, 1e-6, certain);
      expect_same_segments(projected.segments, segments);
      if (!receiver.horizon_cuts) {
        ASSERT_EQ(projected.certain, certain);
      }
      kept += tested.count, near += segments.size(), looked_into += tested.looked_into;
      listed += count_blocks(list), clipped += receiver.horizon_cuts ? 1 : 0;
    }
  }
  std::printf("%zu blocks listed, %zu looked into, %zu edges tested, %zu near; %zu horizons\n", listed,
              looked_into, kept, near, clipped);
  EXPECT_GT(near, 1000u);
  EXPECT_GT(clipped, 50u);
  EXPECT_LT(looked_into, listed);
}

TEST(EdgeList, VectorsAgreeWithOneEdgeAtATimeAndLoseNothing) {
  Random random(31);
  std::size_t kept = 0, near = 0, listed = 0;
  for (int round = 0; round < 40; ++round) {
    const Band band = random_band(random, 60, round % 2 == 0);
    const BandTree tree(band);
    std::vector<TileReceiver> receivers;
    const Vec3 middle{random.uniform(-6, 6), random.uniform(-6, 6), random.uniform(3, 10)};
    for (int i = 0; i < 16; ++i)
      receivers.push_back(
          {middle + random.point(round % 3 == 0 ? 2.0 : 0.1), {0, 0, -1}, no_horizon(), false, 0});
    Shaft shaft(receivers, band.extent);
    shaft.tighten(receivers);
    std::vector<NodeMask> blocks;
    std::vector<std::uint32_t> edges, narrowed;
    TestedEdges tested;
    ProjectedEdges projected;
    tree.collect(shaft, blocks);
    EdgeBlocks(band).collect(blocks, shaft, edges);
    EdgeList list, half;
    list.assign(band, edges, shaft.middle());
    const std::span<const TileReceiver> few(receivers.data(), 4);
    Shaft narrow_shaft(few, band.extent);
    narrow_shaft.tighten(few);
    narrow(list, narrow_shaft, narrowed);
    half.assign(list, narrowed);
    for (std::size_t r = 0; r < receivers.size(); ++r) {
      const Vec3& x = receivers[r].x;
      const EdgeList& l = r < 4 ? half : list;
      test_edges(l, x, tested);
      TestedEdges singly;
      for (std::uint32_t i = 0; i < l.size(); ++i) {
        const int jump = test_edge(l, i, x);
        if (jump == 0) continue;
        add_place(l.place(i), jump, singly);
      }
      expect_same_places(tested, singly);
      std::vector<Segment> segments;
      std::size_t found = 0, expected = 0;
      for (std::size_t i = 0; i < tested.count; ++i) {
        const BandEdge& e = l.edge(tested.places[i]);
        if (tested.jumps[i] != TestedEdges::kUnsure) {
          ASSERT_EQ(tested.jumps[i], jump_at(e, x));
        }
        const Projection p = project_edge(e, x, 1e-6);
        found += p.near ? 1 : 0;
        if (p.near && p.segment.jump != 0) segments.push_back(p.segment);
      }
      project_edges(l, x, no_horizon(), 1e-6, projected);
      expect_same_segments(projected.segments, segments);
      ASSERT_EQ(projected.certain, found == 0);
      for (std::size_t i = 0; i < projected.segments.size(); ++i) {
        const Segment& s = projected.segments[i];
        ASSERT_TRUE(i >= projected.inside || (glm::dot(s.a, s.a) < 1.0 && glm::dot(s.b, s.b) < 1.0));
      }
      for (const BandEdge& e : band.edges) expected += project_edge(e, x, 1e-6).near ? 1 : 0;
      ASSERT_EQ(found, expected) << "round " << round;
      kept += tested.count, near += found, listed += l.size();
    }
  }
  std::printf("%zu listed, %zu tested, %zu near\n", listed, kept, near);
  EXPECT_GT(near, 1000u);
  EXPECT_LT(kept, listed);
}

}  // namespace
}  // namespace penumbra::detail
