// Random poses: certificates against rays without the horizon, visibility against many rays.
//
// Short by default; PENUMBRA_LONG=1 in the environment runs ten times the poses.
#include <gtest/gtest.h>

#include <cstdlib>

#include "render/silhouette/light_rays.h"
#include "render/silhouette/silhouette_visibility.h"
#include "tests/render/random_poses.h"
#include "tests/render/render_support.h"

namespace penumbra {
namespace {

using testing::Random;

constexpr std::uint64_t kSeed = 20'240'917;

int poses() {
  return std::getenv("PENUMBRA_LONG") ? 100 : 10;
}

Vec3 rotated(const Vec3& p, const Vec3& axis, double angle) {
  return p * std::cos(angle) + glm::cross(axis, p) * std::sin(angle) +
         axis * (glm::dot(axis, p) * (1.0 - std::cos(angle)));
}

/// Ten shapes, closed and open, convex and not.
TriangleMesh shape(int kind) {
  switch (kind) {
    case 0:
      return make_box(Vec3(0.0), {0.6, 0.4, 0.5});
    case 1:
      return make_icosphere(Vec3(0.0), 0.7, 2);
    case 2:
      return make_torus(Vec3(0.0), 0.6, 0.25, 20, 12);
    case 3:
      return make_cylinder(Vec3(0.0), 0.3, 0.9, 12);
    case 4:
      return make_random_triangles(Vec3(0.0), 0.8, 0.3, 40, 3);
    case 5:
      return make_triangle({-0.8, 0, -0.5}, {0.8, 0.1, -0.4}, {0.1, -0.1, 0.9});
    case 6:
      return make_plane(0.7, 2);
    case 7:
      return make_box(Vec3(0.0), {1.0, 0.02, 0.7});
    case 8:
      return make_icosphere(Vec3(0.0), 0.15, 1);
    default:
      return make_torus(Vec3(0.0), 0.8, 0.05, 24, 6);
  }
}

/// A caster somewhere above the floor, or touching it, or up in the light; a light that leans.
Scene random_scene(Random& random, int kind) {
  const Vec3 axis = random.direction(),
             shift{random.uniform(-0.8, 0.8), random.uniform(0.0, 2.6), random.uniform(-0.8, 0.8)};
  const double angle = random.uniform(0.0, 6.3);
  const TriangleMesh mesh = shape(kind);
  std::vector<Vec3> points;
  for (const Vec3& p : mesh.positions()) points.push_back(rotated(p, axis, angle) + shift);
  Scene scene;
  testing::light_of(scene) = {{random.uniform(-1, 1), random.uniform(2.5, 4), random.uniform(-1, 1)},
                              Vec3(0, -1, 0) + random.point(0.3),
                              random.spread(0.05, 1.5)};
  scene.camera = {{random.uniform(-4, 4), random.uniform(2, 5), 5}, {0, 0.6, 0}, {0, 1, 0}, 40};
  scene.objects.push_back({"floor", make_plane(3.0, 2), Vec3(0.8), kind % 2 == 0});
  scene.objects.push_back({"caster",
                           testing::mesh_of(points, {mesh.triangles().begin(), mesh.triangles().end()}),
                           Vec3(0.8), true});
  return scene;
}

/// Whether some point of the disk that rays found otherwise is so in double as well.
bool confirmed(const Scene& scene, const Vec3& x, bool certified_lit) {
  const LightFrame f = light_frame(testing::light_of(scene));
  Random random(1);
  for (int i = 0; i < 400; ++i) {
    const double radius = testing::light_of(scene).radius * std::sqrt(random.uniform(0.0, 1.0));
    const glm::dvec2 p = radius * random.unit2();
    const testing::Blocked b =
        testing::is_blocked(scene, x, testing::light_of(scene).center + p.x * f.u + p.y * f.v);
    if (b.clear && b.hidden == certified_lit) return true;
  }
  return false;
}

struct Certified {
  std::size_t lit = 0, umbra = 0, suspects = 0;
};

/// Compares with 64 rays and confirms in double; false for the first contradiction.
bool certificates_hold(const Scene& scene, Certified& counts) {
  const testing::View view(scene, 160, 120);
  const SilhouetteResult r = view.see_silhouettes();
  const auto o = trace_reference(view.rays, testing::light_of(scene), view.surface.receivers(),
                                 testing::every_pixel(view.surface), {.samples = 64, .seed = 7}, true)
                     .unoccluded;
  for (std::size_t i = 0; i < o.size(); ++i) {
    if (r.region[i] < 0 || is_behind(testing::light_of(scene), view.surface.position[i])) continue;
    const bool is_lit = r.region[i] == 0;
    ++(is_lit ? counts.lit : counts.umbra);
    if (o[i] == (is_lit ? 1.0f : 0.0f)) continue;
    ++counts.suspects;
    const Vec3 x = view.surface.position[i];
    if (!confirmed(scene, x, is_lit)) continue;
    std::printf("pixel %zu region %d O %g\n", i, int(r.region[i]), o[i]);
    return false;
  }
  return true;
}

struct Differences {
  double worst = 0.0;
  std::size_t far = 0, pixels = 0;
};

/// Against 64 rays, and 4,096 where those differ by more than .08.
void compare_with_rays(const Scene& scene, const std::string& what, Differences& d) {
  const testing::View view(scene, 160, 120);
  const SilhouetteResult r = view.see_silhouettes();
  const auto all = testing::every_pixel(view.surface);
  const testing::Values coarse = view.trace(all, 64, 11);
  testing::Pixels suspects;
  for (const std::uint32_t i : all)
    if (std::abs(r.visibility[i] - coarse[i]) > 0.08f) suspects.push_back(i);
  const testing::Values fine = view.trace(suspects, 4096, 12);
  d.pixels += all.size();
  for (std::size_t k = 0; k < suspects.size(); ++k) {
    const double off = std::abs(r.visibility[suspects[k]] - fine[k]);
    if (off > 0.05)
      std::printf("  %s pixel %u: %.4f instead of %.4f\n", what.c_str(), suspects[k],
                  r.visibility[suspects[k]], fine[k]);
    d.worst = std::max(d.worst, off);
    d.far += off > 0.25 ? 1 : 0;
  }
}

/// Closed, open, with holes, not manifold, in many pieces.
const char* const kMeshes[] = {"armadillo.ply",  "blobby-shuffled.ply",     "bunny.ply",   "dog-house.ply",
                               "doll-house.ply", "elephant-with-holes.ply", "fandisk.ply", "homer.ply",
                               "knot1.ply",      "snowden_lo.ply"};

std::string label(int pose, int kind) {
  return "pose " + std::to_string(pose) + " shape " + std::to_string(kind);
}

TEST(SilhouetteProperty, CertificatesHoldInRandomPoses) {
  Random random(kSeed);
  Certified counts;
  for (int pose = 0; pose < poses(); ++pose)
    for (int kind = 0; kind < 10; ++kind)
      ASSERT_TRUE(certificates_hold(random_scene(random, kind), counts))
          << "seed " << kSeed << " " << label(pose, kind);
  std::printf("%zu certified lit, %zu umbra; float rays differ at %zu, none confirmed\n", counts.lit,
              counts.umbra, counts.suspects);
  EXPECT_GT(counts.lit, 100'000u);
  EXPECT_GT(counts.umbra, 1'000u);
}

TEST(SilhouetteProperty, NoPixelIsFarOffInRandomPoses) {
  Random random(kSeed + 1);
  Differences d;
  for (int pose = 0; pose < poses(); ++pose)
    for (int kind = 0; kind < 10; ++kind) compare_with_rays(random_scene(random, kind), label(pose, kind), d);
  std::printf("%zu pixels, off by at most %.4f where 64 rays differ by more than .08\n", d.pixels, d.worst);
  EXPECT_EQ(d.far, 0u) << "seed " << kSeed + 1;
}

// The same for meshes of data/meshes: one pose each, ten in the long run.
TEST(SilhouetteProperty, MeshesInRandomPoses) {
  Certified counts;
  Differences d;
  for (int pose = 0; pose < poses() / 10; ++pose)
    for (const char* mesh : kMeshes) {
      const testing::Pose p =
          testing::random_pose(std::string("meshes/") + mesh, kSeed + static_cast<std::uint64_t>(pose));
      const Scene scene = testing::load_pose(p);
      EXPECT_TRUE(certificates_hold(scene, counts)) << p.name;
      compare_with_rays(scene, p.name, d);
    }
  std::printf("%zu certified lit, %zu umbra; float rays differ at %zu, none confirmed; off by at most %.4f\n",
              counts.lit, counts.umbra, counts.suspects, d.worst);
  EXPECT_EQ(d.far, 0u) << "seed " << kSeed;
}

}  // namespace
}  // namespace penumbra
