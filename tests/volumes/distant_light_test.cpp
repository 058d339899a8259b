// What a distant light is the limit of: disks of the same angle, further and further away. And shadows under
// it whose shape is known.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <iostream>

#include "penumbra/mesh/shapes.h"
#include "penumbra/volumes/supports.h"
#include "penumbra/volumes/tangent_planes.h"
#include "tests/volumes/scene_caster.h"
#include "tests/volumes/volume_support.h"

namespace penumbra {
namespace {

/// The disk that fills the same angle from the middle of the mesh, `sizes` of the mesh away.
DiskLight far_disk(const DistantLight& sun, const TriangleMesh& mesh, double sizes) {
  const double distance = sizes * mesh.bounds().radius();
  return {mesh.bounds().center() - distance * light_frame(sun).w, sun.direction,
          distance * CircularLight(sun).radius};
}

const std::vector<DistantLight> kSuns = {
    {{0.05, -1.0, 0.1}, 0.53}, {{3.0, -1.0, -1.5}, 10.0}, {{-0.2, -0.9, 0.3}, 60.0}};

// ---- the limit

/// From one distance to the next of 1e3, 1e4, ... 1e12 sizes.
constexpr int kFirstPower = 3, kLastPower = 12;

std::size_t differing(const std::vector<FaceClass>& a, const std::vector<FaceClass>& b) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.size(); ++i) count += a[i] != b[i];
  return count;
}

TEST(FarDisks, ClassesConvergeToThoseOfADistantLight) {
  for (const char* name : {"bunny.ply", "knot1.ply", "fandisk.ply", "armadillo.ply"}) {
    const TriangleMesh mesh = read_mesh(std::filesystem::path(PENUMBRA_DATA) / "meshes" / name);
    for (const DistantLight& sun : kSuns) {
      const Classification at_infinity = classify_faces(mesh, sun);
      std::cout << "  " << name << ", " << sun.angle_degrees << " degrees: of " << mesh.triangles().size()
                << " classes differ";
      std::size_t last = 0;
      for (int power = kFirstPower; power <= kLastPower; ++power) {
        const auto far = classify_faces(mesh, far_disk(sun, mesh, std::pow(10.0, power)));
        last = differing(far.faces, at_infinity.faces);
        std::cout << " " << last;
        // The light's angle from a face changes by 1/sizes or less; faces are turned every way.
        EXPECT_LE(static_cast<double>(last),
                  2.0 + 10.0 * static_cast<double>(mesh.triangles().size()) * std::pow(10.0, -power))
            << name << " at 1e" << power;
      }
      std::cout << "\n";
      EXPECT_EQ(last, 0u) << name;
    }
  }
}

/// Of an icosphere: no plane of it is by chance tangent to these lights.
TEST(FarDisks, SupportsAndSheetsConverge) {
  const TriangleMesh mesh = make_icosphere({0.3, 0.1, -0.2}, 1.0, 3);
  const VertexRings rings(mesh);
  ExtrudeOptions options;
  options.bound_center = mesh.bounds().center();
  options.bound_radius = 4.0;
  for (const DistantLight& sun : kSuns) {
    const auto silhouettes_of = [&](const CircularLight& light) {
      return find_silhouettes(mesh, classify_faces(mesh, light));
    };
    const Silhouettes at_infinity = silhouettes_of(sun);
    const Supports supports = find_supports(mesh, rings, sun, at_infinity);
    const ShadowMesh sheets = extrude_sheets(mesh, sun, at_infinity, options);
    ASSERT_GT(supports.facets.size(), 10u);
    for (int power = 5; power <= kLastPower; ++power) {
      SCOPED_TRACE("1e" + std::to_string(power) + ", " + std::to_string(sun.angle_degrees) + " degrees");
      const DiskLight disk = far_disk(sun, mesh, std::pow(10.0, power));
      const Silhouettes silhouettes = silhouettes_of(disk);
      const Supports far = find_supports(mesh, rings, disk, silhouettes);
      const double tolerance = 100.0 * std::pow(10.0, -power) / CircularLight(sun).radius + 1e-11;
      ASSERT_EQ(far.facets.size(), supports.facets.size());
      for (std::size_t i = 0; i < far.facets.size(); ++i) {
        ASSERT_EQ(far.facets[i].edge, supports.facets[i].edge);
        ASSERT_EQ(far.facets[i].kind, supports.facets[i].kind);
        ASSERT_EQ(far.facets[i].next, supports.facets[i].next);
        ASSERT_NEAR(far.facets[i].rim_angle, supports.facets[i].rim_angle, tolerance);
      }
      ASSERT_EQ(far.cones.size(), supports.cones.size());
      const ShadowMesh far_sheets = extrude_sheets(mesh, disk, silhouettes, options);
      ASSERT_EQ(far_sheets.triangles, sheets.triangles);
      for (std::size_t i = 0; i < sheets.positions.size(); ++i)
        ASSERT_LE(glm::length(far_sheets.positions[i] - sheets.positions[i]), 10.0 * tolerance);
    }
  }
}

/// Of points about the caster, how many are inside one volume only. Both lights leave `outside` alone.
int disagreements(const ShadowMesh& a, const ShadowMesh& b, const Bounds& caster, const Vec3& outside) {
  const testing::TriangleTree first(a.positions, a.triangles), second(b.positions, b.triangles);
  testing::RandomInputs random(7);
  int count = 0;
  for (int i = 0; i < 2'000; ++i) {
    const Vec3 x = caster.center() + 3.0 * random.uniform_point(caster.radius());
    const int in_first = testing::winding_number(first, x, outside, 0.01, random),
              in_second = testing::winding_number(second, x, outside, 0.01, random);
    count += (in_first >= 1) != (in_second >= 1);
  }
  return count;
}

/// With a bound of the caster's size, and with that which is ten times as large as caster and light together.
TEST(FarDisks, VolumesConverge) {
  for (const TriangleMesh& mesh :
       {make_torus({5, 0, -2}, 1.0, 0.3, 12, 8), make_icosphere({5, 0, -2}, 1.0, 2)}) {
    for (const double bound : {6.0, 0.0}) {
      for (const DistantLight& sun : kSuns) {
        VolumeOptions options;
        options.extrude.bound_center = mesh.bounds().center();
        options.extrude.bound_radius = bound;
        const ShadowVolumes at_infinity = build_shadow_volumes(mesh, sun, options);
        const Vec3 outside = testing::unshadowed_point(sun, mesh.bounds(), 1.0);
        int last = 0;
        for (int power = kFirstPower; power <= kLastPower; power += 3) {
          const ShadowVolumes far =
              build_shadow_volumes(mesh, far_disk(sun, mesh, std::pow(10.0, power)), options);
          last = disagreements(far.penumbra, at_infinity.penumbra, mesh.bounds(), outside) +
                 disagreements(far.umbra, at_infinity.umbra, mesh.bounds(), outside);
          EXPECT_LE(last, 20.0 * std::pow(10.0, 3 - power)) << "at 1e" << power << ", bound " << bound;
        }
        EXPECT_EQ(last, 0);
      }
    }
  }
}

// ---- shadows of known shape

/// A cube of half side 1 under a light straight above it, whose rays lean by at most 1/4. The umbra narrows
/// below the bottom's edges by 1/4 for each unit of height, the penumbra widens below the top's.
TEST(DistantShadows, OfACubeUnderTheSunAtNoon) {
  const TriangleMesh cube = make_box(Vec3(0.0), Vec3(1.0));
  const CircularLight sun = DistantLight{{0, -7, 0}, 2.0 * std::atan(0.25) * 180.0 / 3.14159265358979323846};
  VolumeOptions options;
  options.extrude.bound_radius = 12.0;
  const ShadowVolumes v = build_shadow_volumes(cube, sun, options);
  EXPECT_EQ(v.umbra.guarantee, Guarantee::kExact);
  for (const double y : {-10.0, -4.9, -2.0, -1.5}) {
    const double umbra = 1.0 - 0.25 * (-1.0 - y), penumbra = 1.0 + 0.25 * (1.0 - y);
    for (const double beyond : {-1e-9, 1e-9}) {
      const int inside = beyond < 0.0;
      if (umbra > 0.0) {
        EXPECT_EQ(testing::winding_at(v.umbra, sun, {umbra + beyond, y, 0.3 * umbra}), inside) << y;
        EXPECT_EQ(testing::winding_at(v.umbra, sun, {0.3 * umbra, y, -umbra - beyond}), inside) << y;
      }
    }
    // The polygon of 16 corners has one along u, 2% beyond the disk.
    EXPECT_EQ(testing::winding_at(v.penumbra, sun, {penumbra - 1e-9, y, 0.2}), 1) << y;
    EXPECT_EQ(testing::winding_at(v.penumbra, sun, {1.0 + 1.02 * (penumbra - 1.0), y, 0.2}), 0) << y;
    EXPECT_EQ(testing::winding_at(v.umbra, sun, {0, y, 0}), umbra > 0.0) << y;
  }
  EXPECT_EQ(testing::winding_at(v.umbra, sun, {0, 0, 0}), 1);
  EXPECT_EQ(testing::winding_at(v.penumbra, sun, {0, 1.001, 0}), 0);
}

TEST(DistantShadows, EndBeyondTheBound) {
  const TriangleMesh ball = make_icosphere({5, 6, 7}, 1.0, 2);
  for (const double radius : {0.0, 0.5, 50.0}) {
    VolumeOptions options{.sheets = true};
    options.extrude.bound_center = Vec3(5, 6, 7);
    options.extrude.bound_radius = radius;
    const DistantLight sun{{1, -2, 1}, 0.53};
    const ShadowVolumes v = build_shadow_volumes(ball, sun, options);
    const double bound = radius == 0.0 ? 10.0 * ball.bounds().radius() : radius;
    double least = 1e300, most = 0.0;
    for (const Vec3& p : v.penumbra.positions) {
      const double height = glm::dot(p - Vec3(5, 6, 7), light_frame(sun).w);
      if (height > 1.0) least = std::min(least, height), most = std::max(most, height);
    }
    EXPECT_GE(least, bound);
    EXPECT_LE(most, 2.0 * std::max(bound, 4.0));
  }
}

TEST(DistantShadows, EverythingIsInFront) {
  // Faces that a disk's plane would cut are whole: one cell for the cube wherever it is.
  for (const double y : {-1e6, 0.0, 1e6}) {
    const TriangleMesh cube = make_box({0, y, 0}, Vec3(1.0));
    const ShadowVolumes v = build_shadow_volumes(cube, DistantLight{{0.2, -1, 0.1}, 1.0});
    EXPECT_EQ(v.penumbra.cells, 1u);
    EXPECT_EQ(v.umbra.guarantee, Guarantee::kExact);
    EXPECT_FALSE(v.umbra.triangles.empty());
  }
}

}  // namespace
}  // namespace penumbra
