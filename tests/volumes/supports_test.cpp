#include "penumbra/volumes/supports.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "penumbra/mesh/shapes.h"
#include "tests/volumes/scene_caster.h"

namespace penumbra {
namespace {

constexpr double kPi = std::numbers::pi;

struct Found {
  TriangleMesh mesh;
  CircularLight light;
  Classification classes;
  Silhouettes silhouettes;
  Supports supports;
};

Found find(const TriangleMesh& mesh, const CircularLight& light) {
  Found f{mesh, light, classify_faces(mesh, light), {}, {}};
  f.silhouettes = find_silhouettes(mesh, f.classes);
  f.supports = find_supports(mesh, VertexRings(mesh), light, f.silhouettes);
  return f;
}

const Edge& edge_of(const Found& f, const SupportFacet& facet) {
  return f.mesh.edges()[index(facet.edge)];
}
VertexId begin_of(const Found& f, const SupportFacet& facet) {
  return facet.flipped ? edge_of(f, facet).to : edge_of(f, facet).from;
}
VertexId end_of(const Found& f, const SupportFacet& facet) {
  return facet.flipped ? edge_of(f, facet).from : edge_of(f, facet).to;
}

Vec3 contact_at(const CircularLight& light, double angle) {
  const LightFrame frame = light_frame(light);
  return light.center + light.radius * (std::cos(angle) * frame.u + std::sin(angle) * frame.v);
}

/// The way that light takes from the rim to p.
Vec3 from_contact(const CircularLight& light, double angle, const Vec3& p) {
  const LightFrame frame = light_frame(light);
  return -way_to_center(light, p) - light.radius * (std::cos(angle) * frame.u + std::sin(angle) * frame.v);
}

std::size_t count(const Found& f, SupportKind kind) {
  return static_cast<std::size_t>(
      std::count_if(f.supports.facets.begin(), f.supports.facets.end(),
                    [&](const SupportFacet& facet) { return facet.kind == kind; }));
}

/// δ of the chord that the plane through x and the directed edge leaves, its positive side counting as lit.
double delta_at(const Found& f, const SupportFacet& facet, const Vec3& x) {
  const Vec3 a = f.mesh.position(begin_of(f, facet)), b = f.mesh.position(end_of(f, facet));
  const Vec3 n = glm::cross(a - x, b - a);
  return glm::dot(n, way_to_center(f.light, x)) /
         (f.light.radius * glm::length(glm::cross(glm::normalize(f.light.normal), n)));
}

/// Receivers on each facet, beyond its edge: the chord there touches the disk, which is wholly on the lit
/// side where the penumbra begins, wholly on the other where the umbra does.
void expect_facets_turned_to_the_light(const Found& f) {
  for (const SupportFacet& facet : f.supports.facets) {
    const Vec3 a = f.mesh.position(begin_of(f, facet)), b = f.mesh.position(end_of(f, facet));
    for (const double along : {0.1, 0.5, 0.9}) {
      const Vec3 p = a + along * (b - a);
      const Vec3 x = p + 0.7 * from_contact(f.light, facet.rim_angle, p);
      const double expected = facet.kind == SupportKind::kPenumbra ? 1.0 : -1.0;
      ASSERT_NEAR(delta_at(f, facet, x), expected, 1e-9)
          << "edge " << index(facet.edge) << ", angle " << facet.rim_angle;
    }
    const Vec3 x = a + 0.7 * from_contact(f.light, facet.rim_angle, a),
               normal = glm::normalize(glm::cross(a - x, b - a));
    const LightFrame frame = light_frame(f.light);
    const Vec3 along_rim = -std::sin(facet.rim_angle) * frame.u + std::cos(facet.rim_angle) * frame.v;
    ASSERT_NEAR(glm::dot(normal, along_rim), 0.0, 1e-9) << "the plane touches the rim at its angle";
    const Edge& e = edge_of(f, facet);
    for (const VertexId apex : {e.left_apex, e.is_boundary() ? e.left_apex : e.right_apex}) {
      ASSERT_LE(glm::dot(normal, f.mesh.position(apex) - x), 1e-12) << "the faces lie on the dark side";
    }
    EXPECT_GE(facet.rim_angle, 0.0);
    EXPECT_LT(facet.rim_angle, 2 * kPi);
  }
}

/// `previous` and `next` belong together, and an end is shared.
void expect_links_match(const Found& f) {
  const auto& facets = f.supports.facets;
  for (std::uint32_t i = 0; i < facets.size(); ++i) {
    if (facets[i].next == kNoFacet) continue;
    const SupportFacet& next = facets[facets[i].next];
    ASSERT_EQ(next.previous, i);
    ASSERT_EQ(next.kind, facets[i].kind);
    ASSERT_EQ(end_of(f, facets[i]), begin_of(f, next));
  }
}

/// Facets of a kind, followed from the first by `next`, come back to it after passing all.
void expect_one_loop(const Found& f, SupportKind kind) {
  std::uint32_t first = 0;
  while (f.supports.facets[first].kind != kind) ++first;
  std::size_t steps = 0;
  std::uint32_t at = first;
  do {
    at = f.supports.facets[at].next;
    ++steps;
  } while (at != first && at != kNoFacet && steps <= f.supports.facets.size());
  EXPECT_EQ(at, first);
  EXPECT_EQ(steps, count(f, kind));
}

// A cube's shadow from a corner's direction is a hexagon.
const DiskLight kSmallLight{{6, 7, 8}, {-6, -7, -8}, 0.1};
const DistantLight kSun{{-6, -7, -8}, 0.53};

class CubeUnder : public ::testing::TestWithParam<CircularLight> {};

INSTANTIATE_TEST_SUITE_P(SmallLights, CubeUnder,
                         ::testing::Values(CircularLight(kSmallLight), CircularLight(kSun)),
                         [](const auto& each) { return each.param.is_distant() ? "sun" : "disk"; });

TEST_P(CubeUnder, ASmallLightHasOneFacetOfEachKindASilhouetteEdge) {
  const Found f = find(make_box(Vec3(0.0), Vec3(1.0)), GetParam());
  ASSERT_EQ(f.silhouettes.umbra.size(), 6u);
  ASSERT_EQ(f.silhouettes.umbra, f.silhouettes.penumbra);
  for (const SupportKind kind : {SupportKind::kPenumbra, SupportKind::kUmbra}) {
    std::vector<EdgeId> edges;
    for (const SupportFacet& facet : f.supports.facets)
      if (facet.kind == kind) edges.push_back(facet.edge);
    EXPECT_EQ(edges, f.silhouettes.umbra);
  }
}

TEST_P(CubeUnder, ASmallLightHasFacetsInOneLoop) {
  const Found f = find(make_box(Vec3(0.0), Vec3(1.0)), GetParam());
  expect_links_match(f);
  expect_one_loop(f, SupportKind::kPenumbra);
  expect_one_loop(f, SupportKind::kUmbra);
}

TEST_P(CubeUnder, ASmallLightHasConesThatTurnOnceRoundTheDisk) {
  const Found f = find(make_box(Vec3(0.0), Vec3(1.0)), GetParam());
  double turn = 0.0;
  ASSERT_EQ(f.supports.cones.size(), 6u);
  for (const ConeSector& cone : f.supports.cones) {
    EXPECT_EQ(cone.kind, SupportKind::kPenumbra) << "convex casters have no umbra cones";
    EXPECT_GT(cone.to_angle, cone.from_angle);
    turn += cone.to_angle - cone.from_angle;
    // The sector runs from one facet at its vertex to its neighbor in the loop.
    const SupportFacet& from = f.supports.facets[cone.from_facet];
    EXPECT_TRUE(from.next == cone.to_facet || from.previous == cone.to_facet);
    EXPECT_NEAR(std::remainder(from.rim_angle - cone.from_angle, 2 * kPi), 0.0, 1e-12);
    EXPECT_NEAR(std::remainder(f.supports.facets[cone.to_facet].rim_angle - cone.to_angle, 2 * kPi), 0.0,
                1e-12);
    for (const std::uint32_t i : {cone.from_facet, cone.to_facet}) {
      const SupportFacet& facet = f.supports.facets[i];
      EXPECT_TRUE(begin_of(f, facet) == cone.vertex || end_of(f, facet) == cone.vertex);
    }
  }
  EXPECT_NEAR(turn, 2 * kPi, 1e-9);
}

TEST(Supports, FacetsFaceTheLight) {
  expect_facets_turned_to_the_light(find(make_box(Vec3(0.0), Vec3(1.0)), kSmallLight));
  expect_facets_turned_to_the_light(find(make_box(Vec3(0.0), Vec3(1.0)), kSun));
  for (const char* name : {"cube-medium", "cube-large", "sphere-medium", "torus-small", "torus-large",
                           "boxes-medium", "foliage-medium"}) {
    SCOPED_TRACE(name);
    const testing::SceneCaster scene = testing::load_scene(name);
    for (const CircularLight& light : {CircularLight(scene.light), CircularLight(kSun),
                                       CircularLight(DistantLight{{0.1, -1, 0.2}, 40.0})}) {
      const Found f = find(scene.mesh, light);
      EXPECT_GT(f.supports.facets.size(), 5u);
      expect_facets_turned_to_the_light(f);
      expect_links_match(f);
    }
  }
}

TEST(Supports, KnifeEdgeBetweenMixedFacesCarriesPenumbraFacets) {
  // A thin wedge whose edge points at a wide light: both of its faces see a part of the disk only.
  const std::vector<Vec3> points{{-1, 0, 0},   {1, 0, 0},      {-1, -2, 0.1},
                                 {1, -2, 0.1}, {-1, -2, -0.1}, {1, -2, -0.1}};
  const std::vector<IndexedTriangle> triangles{{0, 2, 3}, {0, 3, 1}, {0, 1, 5}, {0, 5, 4},
                                               {2, 4, 5}, {2, 5, 3}, {0, 4, 2}, {1, 3, 5}};
  const DiskLight light{{0, 4, 0}, {0, -1, 0}, 2.0};
  const Found f = find(TriangleMesh::build(points, triangles), light);
  ASSERT_TRUE(f.mesh.is_closed());
  int facets = 0;
  for (std::size_t i = 0; i < f.mesh.edges().size(); ++i) {
    const Edge& e = f.mesh.edges()[i];
    if (index(e.from) + index(e.to) != 1) continue;  // vertices 0 and 1
    ASSERT_EQ(f.classes.faces[index(e.left)], FaceClass::kMixed);
    ASSERT_EQ(f.classes.faces[index(e.right)], FaceClass::kMixed);
    for (const SupportFacet& facet : f.supports.facets)
      if (index(facet.edge) == i) {
        ++facets;
        EXPECT_EQ(facet.kind, SupportKind::kPenumbra);
      }
  }
  EXPECT_EQ(facets, 2) << "the first of the light disappears on either side";
  expect_facets_turned_to_the_light(f);
}

TEST(Supports, BehindTheLightIsNothing) {
  const Found f = find(make_box({0, 5, 0}, Vec3(1.0)), {{0, 0, 0}, {0, -1, 0}, 0.5});
  EXPECT_TRUE(f.supports.facets.empty());
  EXPECT_TRUE(f.supports.cones.empty());
}

TEST(Supports, SpikeIntoTheDiskHasAConeAllRound) {
  // Every edge at the tip, prolonged, meets the disk: no plane through one touches it.
  const std::vector<Vec3> points{{0, 0, 0}, {0.1, -3, 0.1}, {-0.1, -3, 0.1}, {0, -3, -0.1}};
  const std::vector<IndexedTriangle> triangles{{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}};
  const Found f = find(TriangleMesh::build(points, triangles), {{0, 4, 0}, {0, -1, 0}, 2.0});
  ASSERT_EQ(f.supports.cones.size(), 1u);
  const ConeSector& cone = f.supports.cones[0];
  EXPECT_EQ(index(cone.vertex), 0u);
  EXPECT_EQ(cone.kind, SupportKind::kPenumbra);
  EXPECT_EQ(cone.from_facet, kNoFacet);
  EXPECT_EQ(cone.to_facet, kNoFacet);
  EXPECT_NEAR(cone.to_angle - cone.from_angle, 2 * kPi, 1e-12);
}

/// Whether some face at v lies on the line from `contact` through v + offset, looking at v's faces alone.
bool star_covers(const TriangleMesh& mesh, VertexId v, const Vec3& contact, const Vec3& offset) {
  const Vec3 d = mesh.position(v) + offset - contact;
  for (const IndexedTriangle& t : mesh.triangles()) {
    if (std::find(t.begin(), t.end(), static_cast<std::uint32_t>(index(v))) == t.end()) continue;
    const Vec3 a = mesh.positions()[t[0]], e1 = mesh.positions()[t[1]] - a, e2 = mesh.positions()[t[2]] - a;
    const Vec3 h = glm::cross(d, e2), s = contact - a, q = glm::cross(s, e1);
    const double det = glm::dot(e1, h);
    const double u = glm::dot(s, h) / det, w = glm::dot(d, q) / det;
    if (u >= 0.0 && w >= 0.0 && u + w <= 1.0) return true;
  }
  return false;
}

struct Star {
  int hidden = 0, open = 0;  ///< directions about the vertex on the disk's side of the tangent plane
  int hidden_beyond = 0, open_beyond = 0;
};

/// What the rim point at `angle` sees round v.
Star look_at_star(const Found& f, VertexId v, double angle) {
  const Vec3 contact = contact_at(f.light, angle);
  const LightFrame frame = light_frame(f.light);
  const Vec3 outward = std::cos(angle) * frame.u + std::sin(angle) * frame.v;
  const Vec3 tangent = -std::sin(angle) * frame.u + std::cos(angle) * frame.v;
  const Vec3 line = glm::normalize(f.mesh.position(v) - contact);
  // The tangent plane holds the line and the rim's tangent; beyond it is where the disk is not.
  Vec3 beyond = glm::normalize(glm::cross(line, tangent));
  if (glm::dot(beyond, outward) < 0.0) beyond = -beyond;
  const Vec3 across = glm::cross(line, beyond);
  Star star;
  for (int k = 0; k < 64; ++k) {
    const double turn = 2 * kPi * (k + 0.5) / 64;
    const bool hidden =
        star_covers(f.mesh, v, contact, 1e-4 * (std::cos(turn) * across + std::sin(turn) * beyond));
    const bool on_disk_side = std::sin(turn) < 0.0;
    ++(on_disk_side ? (hidden ? star.hidden : star.open) : (hidden ? star.hidden_beyond : star.open_beyond));
  }
  return star;
}

TEST(Supports, UmbraConesSitAtReflexCornersOnly) {
  std::size_t umbra = 0, penumbra = 0;
  for (const char* name : {"torus-small", "torus-medium", "torus-large"}) {
    SCOPED_TRACE(name);
    const testing::SceneCaster scene = testing::load_scene(name);
    const Found f = find(scene.mesh, scene.light);
    for (const ConeSector& cone : f.supports.cones) {
      const Star star = look_at_star(f, cone.vertex, 0.5 * (cone.from_angle + cone.to_angle));
      if (cone.kind == SupportKind::kUmbra) {
        ++umbra;
        EXPECT_LE(star.open, 1) << "vertex " << index(cone.vertex) << ": the whole disk's side is covered";
        EXPECT_GT(star.open_beyond, 0)
            << "vertex " << index(cone.vertex) << ": not an inner vertex of the picture";
      } else {
        ++penumbra;
        EXPECT_LE(star.hidden, 1) << "vertex " << index(cone.vertex)
                                  << ": nothing of the disk's side is covered";
        EXPECT_GT(star.hidden_beyond, 0) << "vertex " << index(cone.vertex);
      }
    }
  }
  EXPECT_GT(umbra, 20u);
  EXPECT_GT(penumbra, 50u);
}

TEST(Supports, GapFacesAreMixedAndTurnedAway) {
  std::size_t gaps = 0;
  for (const char* name : {"torus-large", "sphere-large"}) {
    const testing::SceneCaster scene = testing::load_scene(name);
    const Found f = find(scene.mesh, scene.light);
    const std::vector<GapFace> found = find_gap_faces(f.mesh, f.light, f.classes, f.supports);
    gaps += found.size();
    for (const GapFace& gap : found) {
      EXPECT_EQ(f.classes.faces[index(gap.face)], FaceClass::kMixed);
      const IndexedTriangle& t = f.mesh.triangles()[index(gap.face)];
      const auto p = f.mesh.positions();
      EXPECT_LT(glm::dot(glm::cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]), f.light.center - p[t[0]]), 0.0);
      ASSERT_LT(gap.facet, f.supports.facets.size());
      EXPECT_EQ(f.supports.facets[gap.facet].kind, SupportKind::kUmbra);
    }
  }
  EXPECT_GT(gaps, 10u);
}

}  // namespace
}  // namespace penumbra
