// Hulls of patches lie in the solid: points of each hull are counted with winding numbers by exact crossings,
// which know nothing of patches. And merged volumes are the same set of points as those of one cell a face.
#include "volumes/cells/convex_patches.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <iostream>
#include <set>

#include "penumbra/mesh/shapes.h"
#include "penumbra/volumes/volumes.h"
#include "tests/volumes/convex_pieces.h"
#include "tests/volumes/scene_caster.h"
#include "volumes/cells/convex_hull.h"
#include "volumes/predicates/predicate_tiers.h"

namespace penumbra {
namespace {

using detail::ConvexPatch;

/// All faces of the component but degenerate ones.
std::vector<FaceId> faces_with_area(const TriangleMesh& mesh, const Component& component) {
  std::vector<FaceId> faces;
  for (const FaceId f : component.faces) {
    const IndexedTriangle& t = mesh.triangles()[index(f)];
    if (!detail::collinear(mesh.positions()[t[0]], mesh.positions()[t[1]], mesh.positions()[t[2]]))
      faces.push_back(f);
  }
  return faces;
}

std::vector<Vec3> positions_of(const TriangleMesh& mesh, const ConvexPatch& patch) {
  std::vector<Vec3> points;
  for (const std::uint32_t v : patch.vertices) points.push_back(mesh.positions()[v]);
  return points;
}

void expect_partition(const TriangleMesh& mesh, const std::vector<FaceId>& members,
                      const std::vector<ConvexPatch>& patches) {
  std::multiset<FaceId> seen;
  for (const ConvexPatch& patch : patches) {
    seen.insert(patch.faces.begin(), patch.faces.end());
    std::set<std::uint32_t> vertices;
    for (const FaceId f : patch.faces)
      vertices.insert(mesh.triangles()[index(f)].begin(), mesh.triangles()[index(f)].end());
    EXPECT_EQ(std::multiset<std::uint32_t>(patch.vertices.begin(), patch.vertices.end()),
              std::multiset<std::uint32_t>(vertices.begin(), vertices.end()));
  }
  EXPECT_EQ(seen, std::multiset<FaceId>(members.begin(), members.end()));
}

/// Points in the interiors of hulls, many of them close to a facet, all of which the surface must wind
/// around.
class HullsAreInside {
 public:
  explicit HullsAreInside(const TriangleMesh& mesh)
      : mesh_(mesh), tree_(mesh.positions(), mesh.triangles()), box_(bounds_of(mesh.positions())) {}

  void check(const ConvexPatch& patch, int points) {
    const std::vector<Vec3> corners = positions_of(mesh_, patch);
    const std::vector<IndexedTriangle> hull = detail::convex_hull(corners);
    if (hull.empty()) return;  // flat
    ++solid_;
    for (int i = 0; i < points; ++i) {
      const Vec3 x = i % 2 ? near_facet(corners, hull) : anywhere_in(corners);
      const bool within = std::all_of(hull.begin(), hull.end(), [&](const IndexedTriangle& t) {
        return orient3d(corners[t[0]], corners[t[1]], corners[t[2]], x) == Sign::kNegative;
      });
      if (!within) continue;
      ++points_;
      const int winding = testing::winding_number(tree_, x, box_.high + 1.1 * (box_.high - box_.low),
                                                  0.1 * box_.radius(), random_);
      ASSERT_GE(winding, 1) << "patch of face " << index(patch.faces.front()) << " with "
                            << patch.faces.size() << " faces, at " << x.x << ", " << x.y << ", " << x.z;
    }
  }
  long points() const { return points_; }
  long solid() const { return solid_; }

 private:
  Vec3 anywhere_in(const std::vector<Vec3>& corners) {
    Vec3 x(0.0);
    double sum = 0.0;
    for (const Vec3& p : corners) {
      const double weight = std::pow(random_.uniform(0, 1), 4.0);
      x += weight * p;
      sum += weight;
    }
    return x / sum;
  }

  Vec3 near_facet(const std::vector<Vec3>& corners, const std::vector<IndexedTriangle>& hull) {
    const IndexedTriangle& t =
        hull[static_cast<std::size_t>(random_.integer(0, static_cast<int>(hull.size()) - 1))];
    const Vec3 on_facet = anywhere_in({corners[t[0]], corners[t[1]], corners[t[2]]});
    return on_facet + std::pow(10.0, random_.uniform(-9, -1)) * (anywhere_in(corners) - on_facet);
  }

  const TriangleMesh& mesh_;
  testing::TriangleTree tree_;
  Bounds box_;
  testing::RandomInputs random_{11};
  long points_ = 0, solid_ = 0;
};

void check_mesh(const std::string& name, const TriangleMesh& mesh, int points, double least_joined) {
  SCOPED_TRACE(name);
  HullsAreInside inside(mesh);
  std::size_t faces = 0, patches = 0;
  for (const Component& component : mesh.components()) {
    if (!component.closed || component.signed_volume <= 0.0) continue;
    const std::vector<FaceId> members = faces_with_area(mesh, component);
    const std::vector<ConvexPatch> found =
        detail::PatchFinder(mesh).find(detail::FaceTree(mesh, component.faces), members);
    expect_partition(mesh, members, found);
    for (const ConvexPatch& patch : found) inside.check(patch, points);
    faces += members.size();
    patches += found.size();
  }
  std::cout << "  " << name << ": " << faces << " faces, " << patches << " patches, " << inside.solid()
            << " with interior, " << inside.points() << " points inside\n";
  EXPECT_GE(static_cast<double>(faces) / static_cast<double>(patches), least_joined);
}

TEST(ConvexPatches, HullsLieInTheSolid) {
  const auto data = std::filesystem::path(PENUMBRA_DATA);
  check_mesh("torus", testing::read_moved(data / "scenes/torus.off", Vec3(0.0)), 60, 4.0);
  check_mesh("bunny", testing::read_moved(data / "meshes/bunny.ply", Vec3(0.0)), 40, 4.0);
  check_mesh("knot1", testing::read_moved(data / "meshes/knot1.ply", Vec3(0.0)), 40, 4.0);
  check_mesh("fandisk", testing::read_moved(data / "meshes/fandisk.ply", Vec3(0.0)), 20, 3.5);
}

/// An L of height h over the unit lattice: its top and bottom are flat patches whose hull would bridge the
/// notch.
TriangleMesh make_ell(double height) {
  const std::vector<std::pair<int, int>> outline{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
  std::vector<Vec3> p;
  for (const double y : {0.0, height}) {
    for (const auto& [x, z] : outline) p.push_back(Vec3(x, y, z));
  }
  std::vector<IndexedTriangle> t;
  for (const IndexedTriangle& top :
       std::vector<IndexedTriangle>{{0, 3, 1}, {1, 3, 2}, {0, 4, 3}, {0, 5, 4}}) {
    t.push_back({top[0] + 6, top[1] + 6, top[2] + 6});
    t.push_back({top[0], top[2], top[1]});
  }
  for (std::uint32_t i = 0; i < 6; ++i) {
    const std::uint32_t j = (i + 1) % 6;
    t.push_back({i, i + 6, j + 6});
    t.push_back({i, j + 6, j});
  }
  return TriangleMesh::build(p, t);
}

TEST(ConvexPatches, DoNotBridgeANotch) {
  for (const double height : {1.0, 1e-9, 1e9}) {
    const TriangleMesh mesh = make_ell(height);
    ASSERT_TRUE(mesh.is_closed());
    const Component& component = mesh.components().front();
    const std::vector<FaceId> members = faces_with_area(mesh, component);
    const std::vector<ConvexPatch> patches =
        detail::PatchFinder(mesh).find(detail::FaceTree(mesh, component.faces), members);
    expect_partition(mesh, members, patches);
    EXPECT_LT(patches.size(), members.size());
    for (const ConvexPatch& patch : patches) {
      const auto has = [&](double x, double z) {
        return std::any_of(patch.vertices.begin(), patch.vertices.end(), [&](std::uint32_t v) {
          return mesh.positions()[v].x == x && mesh.positions()[v].z == z;
        });
      };
      EXPECT_FALSE((has(2, 0) || has(2, 1)) && (has(1, 2) || has(0, 2)));
    }
    HullsAreInside inside(mesh);
    for (const ConvexPatch& patch : patches) inside.check(patch, 100);
  }
}

/// A box with a pit in its top that nearly reaches the bottom.
TEST(ConvexPatches, DoNotCoverADent) {
  const std::vector<Vec3> p{{0, 0, 0}, {4, 0, 0}, {4, 0, 4}, {0, 0, 4}, {0, 1, 0}, {4, 1, 0},
                            {4, 1, 4}, {0, 1, 4}, {1, 1, 1}, {3, 1, 1}, {2, 1, 3}, {2, 0.1, 2}};
  const std::vector<IndexedTriangle> t{{0, 1, 2},  {0, 2, 3}, {0, 4, 5},  {0, 5, 1},   {1, 5, 6},
                                       {1, 6, 2},  {2, 6, 7}, {2, 7, 3},  {3, 7, 4},   {3, 4, 0},
                                       {4, 8, 9},  {4, 9, 5}, {5, 9, 10}, {5, 10, 6},  {6, 10, 7},
                                       {7, 10, 8}, {7, 8, 4}, {8, 11, 9}, {9, 11, 10}, {10, 11, 8}};
  const TriangleMesh mesh = TriangleMesh::build(p, t);
  ASSERT_TRUE(mesh.is_closed());
  ASSERT_EQ(mesh.components().size(), 1u);
  const std::vector<FaceId> members = faces_with_area(mesh, mesh.components().front());
  const std::vector<ConvexPatch> patches =
      detail::PatchFinder(mesh).find(detail::FaceTree(mesh, mesh.components().front().faces), members);
  expect_partition(mesh, members, patches);
  EXPECT_LT(patches.size(), members.size());
  HullsAreInside inside(mesh);
  for (const ConvexPatch& patch : patches) inside.check(patch, 200);
}

/// By a triangle of the volume (perhaps beyond the bound), rather where its corners are near; farther off
/// than rounding.
Vec3 near(const ShadowMesh& volume, testing::RandomInputs& random) {
  const IndexedTriangle& t = volume.triangles[static_cast<std::size_t>(
      random.integer(0, static_cast<int>(volume.triangles.size()) - 1))];
  Vec3 weight(random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1));
  weight *= weight * weight;
  Vec3 x = std::pow(10.0, random.uniform(-6, -1)) * random.direction();
  for (int k = 0; k < 3; ++k) x += weight[k] / (weight.x + weight.y + weight.z) * volume.positions[t[k]];
  return x;
}

TEST(ConvexPatches, MergedVolumesHoldTheSamePoints) {
  for (const char* name : {"torus-medium", "torus-large", "bunny-medium", "knot1-small"}) {
    SCOPED_TRACE(name);
    const testing::SceneCaster scene = testing::load_scene(name);
    ExtrudeOptions options;
    options.bound_center = scene.scene.center();
    options.bound_radius = scene.scene.radius();
    const Classification classes = classify_faces(scene.mesh, scene.light);
    const ShadowMesh merged = extrude_penumbra(scene.mesh, scene.light, classes, options);
    options.merge_faces = false;
    const ShadowMesh single = extrude_penumbra(scene.mesh, scene.light, classes, options);
    EXPECT_LT(3 * merged.triangles.size(), single.triangles.size());
    testing::ConvexPieces few(merged.positions, merged.triangles, scene.light),
        many(single.positions, single.triangles, scene.light);
    ASSERT_EQ(few.size(), merged.cells);
    ASSERT_TRUE(few.all_convex_and_closed());
    testing::RandomInputs random(3);
    int inside = 0, outside = 0, differ = 0;
    for (int i = 0; i < 20000; ++i) {
      const Vec3 x = near(i % 2 ? merged : single, random);
      if (glm::length(x - options.bound_center) > options.bound_radius ||
          side_of_light_plane(x, scene.light) != Sign::kPositive)
        continue;
      const bool in_many = many.winding_number(x, 1) >= 1;
      ++(in_many ? inside : outside);
      differ += in_many != (few.winding_number(x, 1) >= 1);
    }
    EXPECT_GT(outside, 200);
    EXPECT_GT(inside, 200);
    EXPECT_EQ(differ, 0);
  }
}

}  // namespace
}  // namespace penumbra
