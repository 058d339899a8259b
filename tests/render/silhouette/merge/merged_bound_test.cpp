// Where merged edges tell a wrong number of faces: the bound on the area, and the points at which they are
// right, against every face.
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <map>
#include <numeric>

#include "render/silhouette/areas/aim_room.h"
#include "render/silhouette/collect/uncertain_edges.h"
#include "tests/render/silhouette/fine_meshes.h"
#include "tests/render/silhouette/merge/adversarial_casters.h"

namespace penumbra::detail {
namespace {

using penumbra::testing::adversarial_scene;
using penumbra::testing::fine_meshes;
using penumbra::testing::kPi;
using penumbra::testing::merged_edges_of;
using penumbra::testing::Random;
using penumbra::testing::scene_of;

struct LightUnits {
  const UnitLight& light;
  Vec3 point(const Vec3& p) const { return light.point(p); }
  Vec3 direction(const Vec3& d) const { return light.direction(d); }
  double per_unit() const { return light.per_radius(); }
};

/// A level of detail with all its edges in the light's frame.
Band whole_band(const Scene& scene, const LitScene& lit, const MergedLevel& level) {
  Band band;
  band.extent = lit.extent;
  band.edges = LargeArray<BandEdge>(level.edges.size());
  band.lanes = LargeArray<MergedLanes>(level.block_count());
  std::vector<std::uint32_t> all(level.block_count());
  std::iota(all.begin(), all.end(), 0u);
  const MergedLevel::EdgeCounts counts = level.count_edges(all);
  for (std::size_t i = 0; i < level.block_count(); ++i) {
    const MergedBlock block = level.block(scene, i, LightUnits{lit.light}, lit.extent, counts);
    std::copy_n(block.edges.begin(), block.count, band.edges.data() + i * MergedBlock::kEdges);
    band.sides.insert(band.sides.end(), block.sides.begin(), block.sides.begin() + block.count);
    band.lanes[i] = MergedLanes(block, lit.extent);
  }
  return band;
}

/// Counts faces before points of the disk as one receiver sees them.
class Counter {
 public:
  /// Requires all of the scene below x.
  Counter(const Scene& scene, const UnitLight& light, const Vec3& x) {
    const auto seen = [&](const Vec3& p) {
      const Vec3 q = light.point(p);
      return glm::dvec2(x) + glm::dvec2(q - x) * (x.z / (x.z - q.z));
    };
    for (const SceneObject& object : scene.objects) {
      std::vector<glm::dvec2> points;
      for (const Vec3& p : object.mesh.positions()) points.push_back(seen(p));
      for (const auto& [a, b, c] : object.mesh.triangles()) {
        const auto low = glm::min(glm::min(points[a], points[b]), points[c]);
        const auto high = glm::max(glm::max(points[a], points[b]), points[c]);
        if (low.x < 1.0 && low.y < 1.0 && high.x > -1.0 && high.y > -1.0)
          faces_.push_back({points[a], points[b], points[c]});
      }
    }
  }
  int faces_before(const glm::dvec2& q) const {
    const auto side = [&](const glm::dvec2& a, const glm::dvec2& b) {
      return (b.x - a.x) * (q.y - a.y) - (b.y - a.y) * (q.x - a.x);
    };
    int count = 0;
    for (const auto& [a, b, c] : faces_) {
      const double u = side(a, b), v = side(b, c), w = side(c, a);
      count += (u > 0.0 && v > 0.0 && w > 0.0) || (u < 0.0 && v < 0.0 && w < 0.0) ? 1 : 0;
    }
    return count;
  }

 private:
  std::vector<std::array<glm::dvec2, 3>> faces_;
};

/// All merged edges with a jump, as one receiver sees them.
std::vector<Segment> segments_of(const Band& band, const Vec3& x) {
  std::vector<Segment> out;
  for (const BandEdge& e : band.edges) {
    const int jump = jump_at(e, x, 0.0);
    if (jump == 0) continue;
    out.push_back(project_segment(e.a, e.b, x, {}).segment);
    out.back().jump = jump;
  }
  return out;
}

/// How many faces more lie before a point of the disk than before its center, by the edges between the two.
/// The band leaves out edges beside the disk, so no way there would do.
int counted_by(const std::vector<Segment>& segments, const glm::dvec2& q) {
  const auto side = [&](const glm::dvec2& p) { return q.x * p.y - q.y * p.x; };
  int count = 0;
  for (const Segment& s : segments) {
    const double a = side(s.a), b = side(s.b);
    if ((a > 0.0) == (b > 0.0)) continue;
    const double at = glm::dot(q, s.a + a / (a - b) * (s.b - s.a));
    if (at > 0.0 && at < glm::dot(q, q)) count += b > a ? -s.jump : s.jump;
  }
  return count;
}

struct Tally {
  std::size_t receivers = 0, wrong = 0, right = 0, free = 0, bounded = 0;
};

/// A point of the disk: how many faces more than merged edges tell lie before it, and whether that is said to
/// be known.
struct Point {
  int apart;
  bool is_known;
};

/// Points spread over the disk. How many faces lie before its center changes all numbers by one constant.
std::vector<Point> points_of(Random& random, const Counter& counter, const Band& band,
                             const TileReceiver& receiver, double beside, Tally& tally) {
  constexpr int kPoints = 400;
  const std::vector<Segment> segments = segments_of(band, receiver.x);
  const double slack = certificate_slack(band.extent);
  const Shaft shaft(std::span(&receiver, 1), band.extent);
  std::vector<NodeMask> list;
  for (std::uint32_t i = 0; 8 * i < band.lanes.size(); ++i)
    list.push_back({i, (1u << std::min<std::size_t>(8, band.lanes.size() - 8 * i)) - 1});
  UncertainEdges uncertain;
  uncertain.begin_tile(band, list, shaft);
  uncertain.begin_part({});
  const DiskPart part(receiver.horizon);

  std::vector<Point> out;
  for (int i = 0; i < kPoints; ++i) {
    const glm::dvec2 q = std::sqrt((i + random.uniform(0, 1)) / kPoints) * random.unit2();
    const int faces = counter.faces_before(q);
    const bool is_right = uncertain.are_none(receiver, DiskSpot::point(q), slack);
    const bool is_free = !is_right && faces == 0 && has_room(q, beside, segments, part);
    out.push_back({faces - counted_by(segments, q), is_right || is_free});
    tally.right += is_right ? 1 : 0, tally.free += is_free ? 1 : 0;
  }
  return out;
}

/// One receiver, below which the whole scene lies.
void expect_bounds_hold(Random& random, const Counter& counter, const Band& band,
                        const TileReceiver& receiver, Tally& tally) {
  Mistaken mistaken;
  const FloatShaft in_float(Shaft(std::span(&receiver, 1), band.extent), band.extent);
  for (const MergedLanes& lanes : band.lanes)
    if (!lanes.is_exact) add_mistaken(lanes, in_float, mistaken);
  const std::vector<Point> points = points_of(random, counter, band, receiver, mistaken.beside, tally);

  // Where merged edges are said to be right they are; else the number that is met most often counts as right.
  std::map<int, double> met;
  for (const Point& p : points) met[p.apart] += p.is_known ? 1e6 : 1.0;
  const int apart = std::ranges::max_element(met, {}, [](const auto& m) { return m.second; })->first;
  double wrong = 0.0;
  for (const Point& p : points) {
    if (p.is_known) {
      ASSERT_EQ(p.apart, apart);
    }
    wrong += p.apart != apart ? 1.0 : 0.0;
  }
  ++tally.receivers;
  tally.wrong += static_cast<std::size_t>(wrong);
  if (!(mistaken.area < kPi)) return;
  ++tally.bounded;
  const auto count = static_cast<double>(points.size());
  const double share = wrong / count;
  ASSERT_LE(share - 3.0 * std::sqrt(share * (1.0 - share) / count), mistaken.area / kPi);
}

void expect_bounds_hold(Random& random, const Scene& scene, int receivers, Tally& tally) {
  const testing::Stage stage(scene);
  const UnitLight& light = stage.light;
  const MergedEdges merged = merged_edges_of(scene);
  const TriangleMesh& mesh = scene.objects.back().mesh;
  double highest = 0.0;
  for (const Vec3& p : mesh.positions()) highest = std::max(highest, light.point(p).z);
  for (const MergedLevel& level : merged.levels()) {
    const Band whole = whole_band(scene, stage.lit, level),
               of_light = make_merged_band(stage.lit, merged, level);
    for (int k = 0; k < receivers; ++k) {
      // Past a vertex, more or less.
      const Vec3 v = light.point(mesh.positions()[static_cast<std::size_t>(
          random.uniform(0, 1) * static_cast<double>(mesh.positions().size()))]);
      TileReceiver r;
      r.x = Vec3(0.5 * random.unit2(), 0.0);
      r.x += (v - r.x) * (highest * random.uniform(1.02, 3.0) / v.z);
      r.normal = Vec3(0, 0, -1), r.horizon = no_horizon();
      const Counter counter(scene, light, r.x);
      for (const Band* band : {&whole, &of_light}) {
        expect_bounds_hold(random, counter, *band, r, tally);
        if (::testing::Test::HasFatalFailure()) return;
      }
    }
  }
}

TEST(MergedBound, HoldsOnFineMeshes) {
  Random random(79);
  Tally tally;
  for (const auto& [name, mesh] : fine_meshes(6)) {
    Scene scene = scene_of(mesh);
    const DiskLight light = testing::light_of(scene);
    for (int k = 0; k < 4; ++k) {
      testing::light_of(scene) = {light.center, light.normal + 0.2 * random.point(),
                                  light.radius * random.spread(0.02, 2.0)};
      expect_bounds_hold(random, scene, 12, tally);
      ASSERT_FALSE(HasFatalFailure()) << name << ", radius " << testing::light_of(scene).radius;
    }
  }
  std::printf("%zu receivers, %zu of them bounded: %zu points wrong, %zu right for certain, %zu free\n",
              tally.receivers, tally.bounded, tally.wrong, tally.right, tally.free);
  EXPECT_GT(tally.receivers, 500u);
  EXPECT_GT(tally.bounded, 300u);
  EXPECT_GT(tally.wrong, 500u) << "else nothing is put to the test";
  EXPECT_GT(tally.right, 20000u);
  EXPECT_GT(tally.free, 500u);
}

TEST(MergedBound, HoldsOnCastersThatAreHardToMerge) {
  Random random(80);
  Tally tally;
  for (std::uint64_t seed = 1; seed <= 80; ++seed) {
    const testing::AdversarialScene s = adversarial_scene(seed, 6000);
    expect_bounds_hold(random, s.scene, 8, tally);
    ASSERT_FALSE(HasFatalFailure()) << s.name;
  }
  std::printf("%zu receivers, %zu of them bounded: %zu points wrong, %zu right for certain, %zu free\n",
              tally.receivers, tally.bounded, tally.wrong, tally.right, tally.free);
  EXPECT_GT(tally.receivers, 300u);
  EXPECT_GT(tally.bounded, 100u);
  EXPECT_GT(tally.wrong, 500u) << "else nothing is put to the test";
  EXPECT_GT(tally.right, 10000u);
}

}  // namespace
}  // namespace penumbra::detail
