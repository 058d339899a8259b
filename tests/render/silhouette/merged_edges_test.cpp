// Faces that are taken for one: what that may move, by looking at every face; and visibility with and
// without.
#include "render/silhouette/merge/merged_edges.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <cmath>
#include <map>

#include "penumbra/mesh/shapes.h"
#include "render/rays/ray_scene.h"
#include "render/silhouette/areas/projected_edges.h"
#include "render/silhouette/collect/uncertain_edges.h"
#include "render/silhouette/silhouette_visibility.h"
#include "tests/render/render_support.h"
#include "tests/render/silhouette/subdivide.h"

namespace penumbra::detail {
namespace {

using testing::Random;

/// Its vertices pushed along a smooth wave.
TriangleMesh waved(const TriangleMesh& mesh, double height) {
  std::vector<Vec3> points(mesh.positions().begin(), mesh.positions().end());
  const double size = bounds_of(points).radius();
  for (Vec3& p : points) {
    const Vec3 k = 5.0 / size * p;
    p += height * size * Vec3(std::sin(k.y + 0.3 * k.z), std::sin(k.z + 0.5 * k.x), std::sin(k.x));
  }
  return TriangleMesh::build(points, mesh.triangles());
}

TriangleMesh cut(TriangleMesh mesh, int times) {
  for (int i = 0; i < times; ++i) mesh = testing::cut_in_four(mesh);
  return mesh;
}

TriangleMesh rounded_to_float(const TriangleMesh& mesh) {
  std::vector<Vec3> points;
  for (const Vec3& p : mesh.positions()) points.emplace_back(glm::vec3(p));
  return TriangleMesh::build(points, mesh.triangles());
}

/// Three quarters of a waved sphere: with boundary.
TriangleMesh bowl(int level) {
  const TriangleMesh ball = waved(make_icosphere({1, 2, 3}, 2.0, level), 0.02);
  std::vector<IndexedTriangle> faces;
  for (const IndexedTriangle& t : ball.triangles())
    if (ball.positions()[t[0]].x < 2.0) faces.push_back(t);
  return TriangleMesh::build(ball.positions(), faces);
}

/// `level`: 4^level times as many faces as a box or an icosahedron.
std::map<std::string, TriangleMesh> meshes(int level) {
  std::map<std::string, TriangleMesh> out;
  out["ball"] = make_icosphere({0, 0, 0}, 1.0, level);
  out["bowl"] = bowl(level);
  out["waved box"] = waved(cut(make_box({4, 0, 1}, {1, 2, 0.5}), level), 0.01);
  out["box"] = cut(make_box({4, 0, 1}, {1, 2, 0.5}), 5);
  out["box in float"] = rounded_to_float(cut(make_box({0.3, 0.1, 0.2}, {1.1, 2.3, 0.7}), 5));
  return out;
}

struct Face {
  double area;
  Vec3 normal, corner;
};

std::vector<Face> faces_of(const TriangleMesh& mesh, const FacePatches::Partition& partition,
                           std::uint32_t patch) {
  std::vector<Face> out;
  for (std::size_t i = 0; i < partition.side.size(); ++i) {
    if (partition.side[i] != patch + partition.side.size()) continue;
    const auto& [a, b, c] = mesh.triangles()[i];
    const Vec3 p = mesh.positions()[a], n = glm::cross(mesh.positions()[b] - p, mesh.positions()[c] - p);
    out.push_back({0.5 * glm::length(n), glm::normalize(n), p});
  }
  return out;
}

/// What is taken for the wrong side, seen from x, is no more than the error says.
void expect_error_holds(const std::vector<Face>& faces, const FacePatch& patch, const Vec3& x) {
  double area = 0.0, sum = 0.0, magnitudes = 0.0;
  for (const Face& f : faces) {
    const double v = f.area * glm::dot(f.normal, x - f.corner);
    area += f.area, sum += v, magnitudes += std::abs(v);
    const double mean = glm::dot(patch.normal, x - patch.center);
    ASSERT_LE(std::abs(v / f.area - mean),
              patch.tilt * glm::distance(x, patch.center) + patch.spread + 1e-12);
  }
  const double mistaken = 0.5 * (magnitudes - std::abs(sum));
  ASSERT_LE(mistaken, patch.error * std::sqrt(area) * glm::distance(x, patch.center) * (1.0 + 1e-9) + 1e-12);
}

TEST(FacePatches, ErrorsHoldFromEverywhere) {
  Random random(71);
  std::size_t patches = 0;
  for (const auto& [name, mesh] : meshes(5)) {
    const FacePatches all(mesh);
    const double size = bounds_of(mesh.positions()).radius();
    for (const double tolerance : {1e-5, 1e-4, 1e-3, 1e-2}) {
      const FacePatches::Partition partition = all.partition(tolerance * size);
      for (std::uint32_t i = 0; i < partition.patches.size();
           i += 1 + static_cast<std::uint32_t>(partition.patches.size()) / 40) {
        const FacePatch& patch = partition.patches[i];
        ASSERT_LE(patch.error, tolerance * size);
        const std::vector<Face> faces = faces_of(mesh, partition, i);
        ASSERT_GE(faces.size(), 2u) << name;
        ++patches;
        for (int k = 0; k < 20; ++k) {
          // Also from where the patch is seen edge-on.
          Vec3 away = random.direction();
          if (k % 2 == 0) away = glm::normalize(away - glm::dot(away, patch.normal) * patch.normal);
          expect_error_holds(faces, patch, patch.center + random.spread(1.0, 100.0) * patch.radius * away);
        }
      }
    }
  }
  EXPECT_GT(patches, 300u);
}

TEST(FacePatches, HoldTheirFaces) {
  for (const auto& [name, mesh] : meshes(5)) {
    const FacePatches::Partition partition =
        FacePatches(mesh).partition(1e-3 * bounds_of(mesh.positions()).radius());
    for (std::size_t i = 0; i < partition.side.size(); ++i) {
      if (partition.side[i] < partition.side.size()) {
        ASSERT_EQ(partition.side[i], i);
        continue;
      }
      const FacePatch& patch = partition.patches[partition.side[i] - partition.side.size()];
      for (const std::uint32_t v : mesh.triangles()[i]) {
        ASSERT_LE(glm::distance(mesh.positions()[v], patch.center), patch.radius * (1.0 + 1e-12)) << name;
        ASSERT_LE(std::abs(glm::dot(patch.normal, mesh.positions()[v] - patch.center)), patch.thick + 1e-15);
      }
    }
  }
}

TEST(FacePatches, AFlatSideIsOne) {
  for (const char* name : {"box", "box in float"}) {
    const TriangleMesh mesh = meshes(5)[name];
    const FacePatches::Partition partition = FacePatches(mesh).partition(1e-6);
    EXPECT_EQ(partition.patches.size(), 6u) << name;
    for (const FacePatch& p : partition.patches) EXPECT_TRUE(p.is_flat());
  }
}

/// Small closed pieces must not vanish within a patch.
TEST(FacePatches, NoClosedSurfaceIsWithinOne) {
  Random random(72);
  std::vector<Vec3> points;
  std::vector<IndexedTriangle> faces;
  for (std::uint32_t i = 0; i < 500; ++i) {
    const Vec3 p = random.point();
    for (int k = 0; k < 4; ++k) points.push_back(p + 1e-4 * random.point());
    for (const IndexedTriangle& t : {IndexedTriangle{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}})
      faces.push_back({4 * i + t[0], 4 * i + t[1], 4 * i + t[2]});
  }
  const TriangleMesh dust = TriangleMesh::build(points, faces);
  const FacePatches::Partition partition = FacePatches(dust).partition(10.0);
  for (const Component& c : dust.components()) {
    std::set<std::uint32_t> sides;
    for (const FaceId f : c.faces) sides.insert(partition.side[index(f)]);
    EXPECT_GE(sides.size(), 2u);
  }
}

Scene scene_of(const TriangleMesh& mesh) {
  Scene scene;
  const Bounds box = bounds_of(mesh.positions());
  testing::light_of(scene) = {box.center() + Vec3(0.3, 0.1, 3.0) * box.radius(), Vec3(0, 0, -1),
                              0.3 * box.radius()};
  scene.objects.push_back({"caster", mesh, Vec3(0.8), true});
  return scene;
}

MergedEdges merged_edges_of(const Scene& scene) {
  const RayFrame frame = ray_frame(scene);
  return {scene, frame.origin, frame.scale};
}

TEST(MergedEdges, CloseUpAsTheSurfaceDid) {
  std::size_t levels = 0;
  for (const auto& [name, mesh] : meshes(6)) {
    const Scene scene = scene_of(mesh);
    const MergedEdges merged = merged_edges_of(scene);
    for (const MergedLevel& level : merged.levels()) {
      ++levels;
      // Round each side edges lead as often to a vertex as from it.
      std::map<std::pair<std::uint32_t, VertexId>, int> ends;
      for (const MergedEdge& e : level.edges) {
        ++ends[{e.left, e.from}], --ends[{e.left, e.to}];
        if (e.right != MergedEdge::kNoSide) --ends[{e.right, e.from}], ++ends[{e.right, e.to}];
      }
      for (const auto& [end, sum] : ends) ASSERT_EQ(sum, 0) << name;
    }
  }
  EXPECT_GE(levels, 8u);
}

/// A sheet's boundary closes up without a vertex that it has to begin at.
TEST(MergedEdges, OfASheetAreItsSides) {
  const Scene scene = scene_of(cut(testing::rectangle(-1, 1, -1, 2, 0.5), 5));
  const MergedEdges merged = merged_edges_of(scene);
  ASSERT_FALSE(merged.levels().empty());
  EXPECT_LE(merged.levels()[0].edges.size(), 5u) << "of 128";
  EXPECT_EQ(merged.levels()[0].deviation, 0.0);
}

TEST(MergedEdges, LeaveFewEdgesOfFineSurfaces) {
  const Scene scene = scene_of(make_icosphere({0, 0, 0}, 1.0, 7));
  const MergedEdges merged = merged_edges_of(scene);
  ASSERT_GE(merged.levels().size(), 4u);
  for (std::size_t i = 0; i < merged.levels().size(); ++i) {
    const MergedLevel& level = merged.levels()[i];
    EXPECT_GT(level.deviation, 0.0);
    if (i > 0) {
      EXPECT_LT(level.edges.size(), 0.75 * static_cast<double>(merged.levels()[i - 1].edges.size()));
      EXPECT_GT(level.deviation, merged.levels()[i - 1].deviation);
    }
  }
  EXPECT_LT(merged.levels().back().edges.size(), 2000u) << "of 491,520";
  const Scene flat = scene_of(meshes(5)["box"]);
  ASSERT_EQ(merged_edges_of(flat).levels().size(), 1u);
  EXPECT_EQ(merged_edges_of(flat).levels()[0].edges.size(), 12u);
  EXPECT_EQ(merged_edges_of(flat).levels()[0].deviation, 0.0);
  EXPECT_TRUE(merged_edges_of(scene_of(make_icosphere({0, 0, 0}, 1.0, 3))).levels().empty()) << "few faces";
}

struct Difference {
  double most = 0.0, square = 0.0;
  std::size_t penumbra = 0, contradictions = 0, merged = 0, lost = 0;
};

Difference compare(const Scene& scene, const SurfaceBuffer& surface, double tolerance) {
  const RayScene rays(scene, 0);
  SilhouetteOptions options;
  options.tolerance = 0.0;
  const SilhouetteResult exact = testing::see_silhouettes(scene, rays, surface, options);
  options.tolerance = tolerance;
  const SilhouetteResult r = testing::see_silhouettes(scene, rays, surface, options);
  EXPECT_EQ(r.counts.receivers, exact.counts.receivers);
  EXPECT_EQ(r.counts.behind_light, exact.counts.behind_light);
  EXPECT_EQ(r.counts.fallback, exact.counts.fallback);
  Difference out;
  out.merged = r.counts.merged_receivers;
  for (std::size_t i = 0; i < surface.size(); ++i) {
    const double v = exact.visibility[i], d = std::abs(r.visibility[i] - v);
    out.most = std::max(out.most, d);
    if (v > 0.0 && v < 1.0) ++out.penumbra, out.square += d * d;
    // Certified lit is what nothing hides above the horizon, and that then is all of V.
    out.contradictions += (r.region[i] == 0 && d > 1e-6) || (r.region[i] == 2 && v > 1e-5) ? 1 : 0;
    out.lost += exact.region[i] >= 0 && r.region[i] < 0 ? 1 : 0;
  }
  return out;
}

/// The floor, and all around the caster.
SurfaceBuffer receivers_about(Random& random, const Scene& scene) {
  const Bounds box = scene.bounds();
  std::vector<Vec3> points, normals;
  for (int i = 0; i < 6400; ++i) {
    const bool on_floor = i < 4800;
    points.push_back(on_floor ? box.center() +
                                    box.radius() * Vec3(0.04 * (i % 80 - 40), 0.06 * (i / 80 - 30), -1.5)
                              : box.center() + box.radius() * random.point(1.5));
    normals.push_back(on_floor ? Vec3(0, 0, 1) : random.direction());
  }
  return testing::receivers(points, normals, 80);
}

TEST(MergedFaces, MoveVisibilityLittle) {
  Random random(73);
  std::size_t merged = 0;
  for (const auto& [name, mesh] : meshes(7)) {
    Scene scene = scene_of(mesh);
    const DiskLight light = testing::light_of(scene);
    const double size = scene.bounds().radius();
    for (int k = 0; k < 6; ++k) {
      testing::light_of(scene) = {light.center + 0.5 * size * random.point(),
                                  light.normal + 0.2 * random.point(), size * random.spread(0.3, 1.5)};
      const double tolerance = k % 2 == 0 ? 1e-2 : 4e-3;
      const Difference d = compare(scene, receivers_about(random, scene), tolerance);
      const double rmse = std::sqrt(d.square / static_cast<double>(std::max<std::size_t>(1, d.penumbra)));
      std::printf("%-12s tolerance %.3f: merged for %5zu, %5zu in penumbra: RMSE %.1e, most %.1e, lost %zu\n",
                  name.c_str(), tolerance, d.merged, d.penumbra, rmse, d.most, d.lost);
      merged += d.merged;
      EXPECT_LE(rmse, 0.1 * tolerance) << name;
      EXPECT_LE(d.most, tolerance) << name;
      EXPECT_EQ(d.contradictions, 0u) << name;
      EXPECT_LE(d.lost, 320u) << name;
    }
  }
  EXPECT_GT(merged, 100000u);
}

/// On a finely divided surface that is flat face by face nothing is lost: the same edges as before.
TEST(MergedFaces, OfFlatSidesLeaveTheCoarseMeshsEdges) {
  Scene scene = testing::data_scene("torus-medium");
  const auto render = [&] {
    const RayScene rays(scene, 0);
    return testing::see_silhouettes(scene, rays, make_surface_buffer(scene, rays, 160, 120));
  };
  const SilhouetteResult coarse = render();
  scene.objects.back().mesh = cut(scene.objects.back().mesh, 3);
  const SilhouetteResult fine = render();
  EXPECT_EQ(coarse.counts.merged_receivers, 0u);
  EXPECT_EQ(fine.counts.merged_receivers, fine.counts.receivers);
  EXPECT_LT(fine.counts.band_edges, 600u) << "of 55,296";
  EXPECT_EQ(fine.region, coarse.region);
  for (std::size_t i = 0; i < fine.visibility.size(); ++i)
    ASSERT_NEAR(fine.visibility[i], coarse.visibility[i], 1e-6);
}

TEST(MergedFaces, AreNotMistakenWhereCastersCrossTheLightsPlane) {
  Scene scene = scene_of(make_icosphere({0, 0, 0}, 1.0, 5));
  testing::light_of(scene) = {{0.9, 0, 0}, {0, 0, 1}, 0.5};
  Random random(74);
  const Difference d = compare(scene, receivers_about(random, scene), 2e-3);
  EXPECT_EQ(d.merged, 0u);
  EXPECT_EQ(d.most, 0.0);
}

/// A scene under its light.
struct Stage {
  explicit Stage(const Scene& scene)
      : frame(ray_frame(scene)),
        light(testing::light_of(scene)),
        edges(scene, frame.origin, frame.scale),
        lit(scene, light, edges),
        band(make_band(lit, edges)) {}
  RayFrame frame;
  UnitLight light;
  SceneEdges edges;
  LitScene lit;
  Band band;  ///< of all faces
};

/// On the way from light into penumbra, where the certificate only just holds, no true edge is across the
/// disk.
TEST(MergedFaces, CertificatesHoldToTheLast) {
  Random random(76);
  std::size_t checked = 0;
  for (const auto& [name, mesh] : meshes(6)) {
    const Scene scene = scene_of(mesh);
    const Stage stage(scene);
    const auto& [frame, light, edges, lit, exact] = stage;
    const double slack = certificate_slack(lit.extent);
    const MergedEdges merged = merged_edges_of(scene);
    for (const MergedLevel& level : merged.levels()) {
      const Band band = make_merged_band(lit, merged, level);
      const auto receiver_at = [&](const Vec3& world) {
        TileReceiver r;
        r.x = stage.light.point(world), r.normal = Vec3(0, 0, -1), r.horizon = no_horizon();
        return r;
      };
      const auto is_certain = [&](const Vec3& world) {
        const TileReceiver r = receiver_at(world);
        for (std::size_t i = 0; i < band.edges.size(); ++i)
          if (!is_certainly_no_silhouette(band, i, r, slack)) return false;
        return true;
      };
      const Vec3 middle = scene.bounds().center();
      const double size = scene.bounds().radius();
      for (int k = 0; k < 12; ++k) {
        const glm::dvec2 way = random.unit2();
        const double depth = random.uniform(1.5, 4.0) * size;
        const auto at = [&](double t) { return middle + Vec3(t * size * way, -depth); };
        double inside = 8.0;
        while (inside > 0.0 && is_certain(at(inside))) inside -= 0.05;
        double outside = inside + 0.05;
        if (inside <= 0.0 || outside >= 8.0) continue;
        for (int step = 0; step < 40; ++step) {
          const double half = 0.5 * (inside + outside);
          (is_certain(at(half)) ? outside : inside) = half;
        }
        const TileReceiver r = receiver_at(at(outside));
        ++checked;
        for (const BandEdge& e : exact.edges) {
          const Projection p = project_edge(e, r.x, 0.0);
          ASSERT_FALSE(p.near && p.segment.jump != 0) << name << ", level of " << level.edges.size();
        }
      }
    }
  }
  EXPECT_GT(checked, 100u);
}

/// What floats dismiss is beside the disk for every receiver, with all that is within the margin.
TEST(MergedLanes, DismissOnlyWhatIsBesideTheDisk) {
  Random random(78);
  const double extent = 30.0;
  std::size_t dismissed = 0, dismissed_for_all = 0, kept = 0;
  for (int round = 0; round < 3000; ++round) {
    MergedBlock block;
    block.count = 1 + static_cast<std::size_t>(round) % MergedBlock::kEdges;
    for (std::size_t k = 0; k < block.count; ++k) {
      const Vec3 at{random.uniform(-4, 4), random.uniform(-4, 4), random.uniform(0.5, 12)};
      const FacePlane plane{Vec3(0, 0, 1), 0.0, 0.0};
      block.edges[k] = {at, at + random.spread(0.01, 3.0) * random.direction(), plane, plane};
      block.sides[k].margin = random.spread(1e-6, 0.5);
      block.sides[k].left = {at + random.point(), random.spread(0.1, 3.0), 0.1, 0.1, round % 3 == 0};
    }
    std::vector<TileReceiver> receivers;
    const Vec3 place{random.uniform(-8, 8), random.uniform(-8, 8), random.uniform(6, 20)};
    for (int i = 0; i < 12; ++i) {
      TileReceiver r;
      r.x = place + random.spread(1e-3, 5.0) * random.point(), r.normal = Vec3(0, 0, -1);
      r.horizon = no_horizon();
      receivers.push_back(r);
    }
    Shaft shaft(receivers, extent);
    shaft.tighten(receivers);
    const MergedLanes lanes(block, extent);
    const std::uint32_t for_all = may_be_across(lanes, FloatShaft(shaft, extent));
    EXPECT_EQ(for_all >> block.count, 0u);
    for (const TileReceiver& r : receivers) {
      const std::uint32_t for_one = may_be_across(lanes, FloatEye(r, extent));
      for (std::size_t k = 0; k < block.count; ++k) {
        const bool is_dismissed = !((for_all & for_one) >> k & 1);
        (is_dismissed ? dismissed : kept) += 1;
        dismissed_for_all += !(for_all >> k & 1);
        if (!is_dismissed) continue;
        const auto& [left, right, margin, middle, half] = block.sides[k];
        ASSERT_TRUE(left.is_flat || left.is_far(r.x));
        for (int point = 0; point < 8; ++point) {
          const double t = point == 0 ? 0.0 : point == 1 ? 1.0 : random.uniform(0, 1);
          const Vec3 p = block.edges[k].a + t * (block.edges[k].b - block.edges[k].a) +
                         0.999 * margin * random.direction();
          if (!(p.z < r.x.z) || !(p.z > 0.0)) continue;
          const glm::dvec2 seen = glm::dvec2(r.x) + glm::dvec2(p - r.x) * (r.x.z / (r.x.z - p.z));
          ASSERT_GT(glm::dot(seen, seen), 1.0) << round;
        }
      }
    }
  }
  EXPECT_GT(dismissed_for_all, 20000u);
  EXPECT_GT(dismissed, dismissed_for_all + 1000);
  EXPECT_GT(kept, 5000u);
}

/// What few tiles ask for: every edge that one of their receivers sees across the disk.
TEST(SceneEdges, LoseNothingThatAReceiverSees) {
  Random random(75);
  for (const auto& [name, mesh] : meshes(5)) {
    const Scene scene = scene_of(mesh);
    const Stage stage(scene);
    const auto& [frame, light, edges, lit, all] = stage;
    std::size_t seen = 0;
    for (int round = 0; round < 40; ++round) {
      const Vec3 place =
          scene.bounds().center() + scene.bounds().radius() * (random.point(1.5) - Vec3(0, 0, 1));
      std::vector<TileReceiver> receivers;
      for (int i = 0; i < 12; ++i) {
        TileReceiver r;
        r.x = light.point(place + random.spread(1e-4, 0.1) * random.point());
        r.normal = light.direction(random.direction());
        if (!(r.x.z > 0.0)) continue;
        receivers.push_back(r);
      }
      if (receivers.empty()) continue;
      Shaft shaft(receivers, all.extent);
      shaft.tighten(receivers);
      const std::vector<ReceiverRegion> regions{shaft.region(receivers, light, frame)};
      const Band found = make_band(lit, edges, regions);
      const auto key = [](const BandEdge& e) { return std::array{e.a.x, e.a.y, e.a.z, e.b.x, e.b.y, e.b.z}; };
      std::set<std::array<double, 6>> keys;
      for (const BandEdge& e : found.edges) keys.insert(key(e));
      for (const TileReceiver& r : receivers)
        for (const BandEdge& e : all.edges) {
          const bool below = glm::dot(r.normal, e.a - r.x) < 0.0 && glm::dot(r.normal, e.b - r.x) < 0.0;
          if (below || !project_edge(e, r.x, certificate_slack(all.extent)).near) continue;
          ++seen;
          ASSERT_TRUE(keys.contains(key(e))) << name;
        }
    }
    EXPECT_GT(seen, 100u) << name;
  }
}

}  // namespace
}  // namespace penumbra::detail
