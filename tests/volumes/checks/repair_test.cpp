#include "penumbra/volumes/checks/repair.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <numeric>

#include "penumbra/mesh/error.h"
#include "penumbra/mesh/io/polygon_soup.h"
#include "penumbra/mesh/shapes.h"
#include "tests/volumes/checks/soup.h"

namespace penumbra {
namespace {

using testing::Soup;

/// Repairs, and checks that every input triangle is in the result, turned or not, or named as dropped.
RepairResult repaired(const Soup& soup) {
  RepairResult r = repair(soup.positions, soup.triangles);
  std::vector<std::uint32_t> all = r.source_triangles, flipped;
  all.insert(all.end(), r.degenerate.begin(), r.degenerate.end());
  std::size_t faces = r.degenerate.size();
  for (const ComponentRepair& c : r.components) {
    all.insert(all.end(), c.dropped.begin(), c.dropped.end());
    flipped.insert(flipped.end(), c.flipped.begin(), c.flipped.end());
    faces += c.faces.size();
  }
  EXPECT_EQ(faces, soup.triangles.size());
  std::sort(all.begin(), all.end());
  std::vector<std::uint32_t> expected(soup.triangles.size());
  std::iota(expected.begin(), expected.end(), 0u);
  EXPECT_EQ(all, expected);
  std::sort(flipped.begin(), flipped.end());
  for (std::size_t i = 0; i < r.triangles.size(); ++i) {
    const IndexedTriangle &in = soup.triangles[r.source_triangles[i]], &out = r.triangles[i];
    const bool turned = std::binary_search(flipped.begin(), flipped.end(), r.source_triangles[i]);
    for (int k = 0; k < 3; ++k) EXPECT_EQ(soup.positions[in[k]], r.positions[out[turned ? (3 - k) % 3 : k]]);
  }
  return r;
}

const ComponentRepair& only(const RepairResult& r) {
  EXPECT_EQ(r.components.size(), 1u);
  return r.components.front();
}

bool is_closed(const RepairResult& r) {
  return TriangleMesh::build(r.positions, r.triangles, {.weld = true, .flip_inside_out = false}).is_closed();
}

TEST(Repair, ASoundMeshStaysAsItIs) {
  const RepairResult r = repaired(Soup(make_torus({0, 0, 0}, 1, 0.3, 16, 8)));
  EXPECT_EQ(only(r).verdict, RepairVerdict::kAsIs);
  EXPECT_TRUE(only(r).flipped.empty());
}

TEST(Repair, TurnsFacesAlike) {
  Soup soup(make_icosphere({0, 0, 0}, 1, 2));
  for (std::size_t i = 0; i < soup.triangles.size(); i += 3)
    std::swap(soup.triangles[i][0], soup.triangles[i][1]);
  const RepairResult r = repaired(soup);
  EXPECT_EQ(only(r).verdict, RepairVerdict::kMended);
  EXPECT_EQ(only(r).flipped.size(), (soup.triangles.size() + 2) / 3);
  EXPECT_GT(only(r).stitched_edges, 0u);
  EXPECT_TRUE(is_closed(r));
}

TEST(Repair, TurnsAnInsideOutComponentOutward) {
  Soup soup(make_box({0, 0, 0}, Vec3(1)));
  for (IndexedTriangle& t : soup.triangles) std::swap(t[1], t[2]);
  const RepairResult r = repaired(soup);
  EXPECT_EQ(only(r).verdict, RepairVerdict::kMended);
  EXPECT_EQ(only(r).flipped.size(), 12u);
}

TEST(Repair, DropsRepeatedFacesAndStitches) {
  Soup soup(make_box({0, 0, 0}, Vec3(1)));
  Soup unindexed(make_box({0, 0, 0}, Vec3(1)));
  unindexed.positions.clear();
  for (IndexedTriangle& t : unindexed.triangles) {
    for (std::uint32_t& v : t) {
      unindexed.positions.push_back(soup.positions[v]);
      v = static_cast<std::uint32_t>(unindexed.positions.size() - 1);
    }
  }
  unindexed.triangles.push_back(unindexed.triangles[4]);
  unindexed.triangles.push_back(
      {unindexed.triangles[7][1], unindexed.triangles[7][0], unindexed.triangles[7][2]});
  const RepairResult r = repaired(unindexed);
  EXPECT_EQ(r.welded_vertices, 36u - 8u);
  EXPECT_EQ(only(r).verdict, RepairVerdict::kMended);
  EXPECT_EQ(only(r).dropped, (std::vector<std::uint32_t>{12, 13}));
  EXPECT_TRUE(only(r).flipped.empty());
  EXPECT_TRUE(is_closed(r));
}

TEST(Repair, DropsComponentsThatRepeatOthers) {
  for (const bool inside_out : {false, true}) {
    Soup soup(make_box({0, 0, 0}, Vec3(1)));
    soup.add(Soup(make_box({0, 0, 0}, Vec3(1))));
    for (std::size_t f = 12; f < 24; ++f)
      if (inside_out) std::swap(soup.triangles[f][0], soup.triangles[f][1]);
    const RepairResult r = repaired(soup);
    EXPECT_EQ(only(r).verdict, RepairVerdict::kMended);
    EXPECT_EQ(r.triangles.size(), 12u);
    EXPECT_TRUE(only(r).flipped.empty());
    EXPECT_TRUE(is_closed(r));
    EXPECT_EQ(TriangleMesh::build(r.positions, r.triangles).components()[0].signed_volume, 8.0);
  }
}

TEST(Repair, KeepsTheFacesThatTwoSolidsShare) {
  Soup soup(make_box({0, 0, 0}, Vec3(1)));
  soup.add(Soup(make_box({2, 0, 0}, Vec3(1))));
  const RepairResult r = repaired(soup);
  ASSERT_EQ(r.components.size(), 2u);
  for (const ComponentRepair& c : r.components) EXPECT_EQ(c.verdict, RepairVerdict::kAsIs);
}

TEST(Repair, KeepsCavities) {
  Soup soup(make_box({0, 0, 0}, Vec3(2)));
  Soup cavity(make_box({0, 0, 0}, Vec3(1)));
  for (IndexedTriangle& t : cavity.triangles) std::swap(t[0], t[1]);
  soup.add(cavity);
  const RepairResult r = repaired(soup);
  ASSERT_EQ(r.components.size(), 2u);
  for (const ComponentRepair& c : r.components) EXPECT_EQ(c.verdict, RepairVerdict::kAsIs);
}

TEST(Repair, LeavesOpenOnesAndSaysSo) {
  Soup soup(make_box({0, 0, 0}, Vec3(1)));
  soup.triangles.pop_back();
  std::swap(soup.triangles[0][0], soup.triangles[0][1]);
  const RepairResult r = repaired(soup);
  EXPECT_EQ(only(r).verdict, RepairVerdict::kLeft);
  EXPECT_EQ(only(r).boundary_edges, 3u);
  EXPECT_NE(to_text(r).find("open: 3 boundary edges"), std::string::npos);
}

TEST(Repair, LeavesNonManifoldOnes) {
  Soup soup(make_box({0, 0, 0}, Vec3(1)));
  std::swap(soup.triangles[0][0], soup.triangles[0][1]);
  soup.positions.push_back({3, 3, 3});
  soup.triangles.push_back({soup.triangles[0][0], soup.triangles[0][1], 8});
  const RepairResult r = repaired(soup);
  EXPECT_EQ(only(r).verdict, RepairVerdict::kLeft);
  EXPECT_EQ(only(r).non_manifold_edges, 1u);
  EXPECT_EQ(only(r).boundary_edges, 2u);
}

TEST(Repair, LeavesSelfIntersectingOnes) {
  Soup soup(make_icosphere({0, 0, 0}, 1, 2));
  soup.positions[0] *= -1.5;  // through to the other side
  const RepairResult r = repaired(soup);
  EXPECT_EQ(only(r).verdict, RepairVerdict::kLeft);
  EXPECT_GT(only(r).self_intersections, 0u);
}

TEST(Repair, LeavesAMoebiusStripOfFaces) {
  Soup soup(make_triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}));
  soup.positions.clear();
  soup.triangles.clear();
  constexpr std::uint32_t kSteps = 12;
  for (std::uint32_t i = 0; i < kSteps; ++i) {
    const double a = 2 * 3.14159265358979 * i / kSteps;
    for (const double side : {-0.3, 0.3}) {
      const double r = 1 + side * std::cos(a / 2);
      soup.positions.push_back({r * std::cos(a), side * std::sin(a / 2), r * std::sin(a)});
    }
    const std::uint32_t j = (i + 1) % kSteps, turn = j == 0 ? 1 : 0;
    soup.triangles.push_back({2 * i, 2 * i + 1, 2 * j + turn});
    soup.triangles.push_back({2 * i + 1, 2 * j + (1 - turn), 2 * j + turn});
  }
  EXPECT_EQ(only(repaired(soup)).verdict, RepairVerdict::kLeft);
}

TEST(Repair, SettlesEachComponentAlone) {
  Soup soup(make_box({0, 0, 0}, Vec3(1)));
  Soup turned(make_box({5, 0, 0}, Vec3(1)));
  std::swap(turned.triangles[3][0], turned.triangles[3][1]);
  soup.add(turned);
  soup.add(Soup(make_plane(1.0)));
  soup.triangles.push_back({0, 0, 1});
  const RepairResult r = repaired(soup);
  ASSERT_EQ(r.components.size(), 3u);
  EXPECT_EQ(r.components[0].verdict, RepairVerdict::kAsIs);
  EXPECT_EQ(r.components[1].verdict, RepairVerdict::kMended);
  EXPECT_EQ(r.components[1].flipped, (std::vector<std::uint32_t>{15}));
  EXPECT_EQ(r.components[2].verdict, RepairVerdict::kLeft);
  EXPECT_EQ(r.degenerate, (std::vector<std::uint32_t>{26}));
}

TEST(Repair, IsDoneWhenRepeated) {
  Soup soup(make_icosphere({0, 0, 0}, 1, 1));
  std::swap(soup.triangles[7][0], soup.triangles[7][1]);
  const RepairResult once = repair(soup.positions, soup.triangles),
                     twice = repair(once.positions, once.triangles);
  EXPECT_EQ(only(twice).verdict, RepairVerdict::kAsIs);
  EXPECT_EQ(once.triangles, twice.triangles);
}

TEST(Repair, RefusesWhatTheBuilderRefuses) {
  const std::vector<Vec3> p{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const std::vector<IndexedTriangle> t{{0, 1, 3}};
  EXPECT_THROW(repair(p, t), MeshError);
  EXPECT_TRUE(repair({}, {}).components.empty());
}

TEST(Repair, RealMeshes) {
  const auto folder = std::filesystem::path(PENUMBRA_DATA) / "meshes";
  for (const char* name :
       {"blobby-shuffled", "elephant-with-holes", "snowden_lo", "doll-house", "decorativePlant"}) {
    const PolygonSoup soup = read_polygon_soup(folder / (std::string(name) + ".ply"));
    const std::vector<IndexedTriangle> triangles = triangulate(soup).triangles;
    const RepairResult r = repair(soup.positions, triangles);
    std::cout << name << "\n" << to_text(r);
    std::size_t faces = r.degenerate.size();
    for (const ComponentRepair& c : r.components) faces += c.faces.size();
    EXPECT_EQ(faces, triangles.size()) << name;
    if (std::string(name) == "blobby-shuffled") {
      EXPECT_TRUE(is_closed(r));
    }
  }
}

}  // namespace
}  // namespace penumbra
