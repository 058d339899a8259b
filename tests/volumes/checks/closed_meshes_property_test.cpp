// Every closed mesh of data/ under a disk and three suns with many points, half of them within 1e-3 scene
// units of a produced surface: no point that is not fully lit is outside of the penumbra volume (by
// triangles, in rationals where doubles leave doubt, and by rays of tests/oracle), and from no point in the
// umbra volume does any ray of tests/oracle reach the light. Meshes are scaled to radius 1. PENUMBRA_LONG=1
// in the environment asks for thirty times the points.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <future>
#include <iostream>

#include "penumbra/mesh/io/polygon_soup.h"
#include "penumbra/volumes/convex_umbra.h"
#include "penumbra/volumes/volumes.h"
#include "tests/oracle/oracle.h"
#include "tests/oracle/signs.h"
#include "tests/volumes/containment_check.h"
#include "tests/volumes/light_samples.h"
#include "tests/volumes/triangle_tree.h"

namespace penumbra {
namespace {

constexpr std::uint64_t kSeed = 1'000'000;
constexpr int kParts = 4;  // that run at the same time, each with a seed of its own

/// How much is asked of one mesh under one light.
struct Effort {
  int penumbra_points, umbra_points, umbra_rays;
};

Effort effort_of(Effort usual) {
  const int times = std::getenv("PENUMBRA_LONG") ? 30 : 1;
  return {times * usual.penumbra_points, times * usual.umbra_points, usual.umbra_rays};
}

constexpr int kOutsideRays = 64;  // from a point outside of the penumbra volume; rationals judge it as well

struct Case {
  TriangleMesh mesh;
  oracle::Light given;
  CircularLight light = DiskLight{};
  Bounds box;
  ShadowMesh umbra, penumbra;
};

Case make_case(const TriangleMesh& mesh, const oracle::Light& given, const CircularLight& light) {
  Case c;
  std::vector<Vec3> positions;
  for (const Vec3& p : mesh.positions())
    positions.push_back((p - mesh.bounds().center()) / mesh.bounds().radius());
  c.mesh = TriangleMesh::build(positions, mesh.triangles());
  c.given = given;
  c.light = light;
  c.box.add(Vec3(-2.0, -2.5, -2.0));
  c.box.add(Vec3(2.0, 3.0, 2.0));
  ExtrudeOptions options;
  options.bound_center = c.box.center();
  options.bound_radius = c.box.radius();
  const Classification classes = classify_faces(c.mesh, c.light);
  c.penumbra = extrude_penumbra(c.mesh, c.light, classes, options);
  c.umbra = convex_umbra(c.mesh, c.light, classes, options);
  return c;
}

/// Points in the umbra volume: half by its surface, half anywhere.
class UmbraCheck {
 public:
  UmbraCheck(const Case& c, const oracle::Oracle& judge, int rays, std::uint64_t seed)
      : case_(c),
        judge_(judge),
        rays_(rays),
        seed_(seed),
        random_(seed),
        outside_(testing::unshadowed_point(c.light, c.mesh.bounds(), 1.0)),
        umbra_(c.umbra.positions, c.umbra.triangles) {}

  /// How many of the points were inside, and how many of these see light.
  std::pair<long, long> run(int count) {
    if (case_.umbra.triangles.empty()) return {0, 0};
    long inside = 0, wrong = 0;
    for (int i = 0; i < count && wrong < 3; ++i) {
      const Vec3 x = i % 2 ? near_surface() : anywhere();
      if (testing::winding_number(umbra_, x, outside_, 0.1, random_) < 1) continue;
      ++inside;
      if (judge_.unoccluded(x, {}, case_.given, rays_, seed_ + static_cast<std::uint64_t>(i)) == 0.0)
        continue;
      if (is_on_face(x)) continue;
      ++wrong;
      ADD_FAILURE() << "seed " << seed_ << ", point " << i << ": (" << x.x << ", " << x.y << ", " << x.z
                    << ") is in the umbra volume and sees light";
    }
    return {inside, wrong};
  }

 private:
  /// A face hides nothing from what lies on it, so O jumps there, and the umbra volume reaches up to it. x
  /// lies in the face's plane as far as double can tell.
  bool is_on_face(const Vec3& x) const {
    const std::span<const IndexedTriangle> faces = case_.mesh.triangles();
    return std::any_of(faces.begin(), faces.end(), [&](const IndexedTriangle& t) {
      const std::span<const Vec3> p = case_.mesh.positions();
      const Vec3 &a = p[t[0]], &b = p[t[1]], &c = p[t[2]], normal = glm::cross(b - a, c - a);
      const auto is_inside = [&](const Vec3& from, const Vec3& to) {
        return glm::dot(normal, glm::cross(to - from, x - from)) >= 0.0;
      };
      return oracle::side_of_face(x, {a, b, c}) == 0 && is_inside(a, b) && is_inside(b, c) && is_inside(c, a);
    });
  }

  Vec3 anywhere() {
    for (;;) {
      Vec3 x;
      for (int k = 0; k < 3; ++k) x[k] = random_.uniform(case_.box.low[k], case_.box.high[k]);
      if (side_of_light_plane(x, case_.light) == Sign::kPositive) return x;
    }
  }

  Vec3 near_surface() {
    const ShadowMesh& u = case_.umbra;
    for (int attempt = 0; attempt < 100; ++attempt) {
      const IndexedTriangle& t =
          u.triangles[static_cast<std::size_t>(random_.integer(0, static_cast<int>(u.triangles.size()) - 1))];
      Vec3 weight(random_.uniform(0, 1), random_.uniform(0, 1), random_.uniform(0, 1));
      Vec3 x = std::pow(random_.uniform(0, 1), 3.0) * testing::kNearSurface * random_.direction();
      for (int k = 0; k < 3; ++k) x += weight[k] / (weight.x + weight.y + weight.z) * u.positions[t[k]];
      if (side_of_light_plane(x, case_.light) == Sign::kPositive) return x;
    }
    return anywhere();
  }

  const Case& case_;
  const oracle::Oracle& judge_;
  int rays_;
  std::uint64_t seed_;
  testing::RandomInputs random_;
  Vec3 outside_;
  testing::TriangleTree umbra_;
};

struct Figures {
  testing::ContainmentFigures penumbra;
  long in_umbra = 0, false_umbra = 0;
};

Figures check_part(const Case& c, const oracle::Oracle& judge, const Effort& effort, std::uint64_t seed) {
  Figures figures;
  testing::ContainmentCheck penumbra(c.mesh, c.light, c.penumbra, c.box, seed);
  std::uint64_t rays_seed = seed;
  penumbra.run(effort.penumbra_points / kParts, [&](const Vec3& x) {
    return judge.unoccluded(x, {}, c.given, kOutsideRays, ++rays_seed) < 1.0;
  });
  figures.penumbra = penumbra.figures();
  std::tie(figures.in_umbra, figures.false_umbra) =
      UmbraCheck(c, judge, effort.umbra_rays, seed).run(effort.umbra_points / kParts);
  return figures;
}

std::vector<std::filesystem::path> closed_meshes() {
  std::vector<std::filesystem::path> files;
  for (const char* folder : {"meshes", "scenes"}) {
    for (const auto& entry :
         std::filesystem::directory_iterator(std::filesystem::path(PENUMBRA_DATA) / folder)) {
      const auto extension = entry.path().extension();
      if ((extension == ".ply" || extension == ".off") && read_mesh(entry.path()).is_closed())
        files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

template <class Light>
void expect_no_wrong_point(const std::filesystem::path& file, const std::string& name, const Light& light,
                           const Effort& effort) {
  const Case c = make_case(read_mesh(file), light, light);
  const oracle::Oracle judge(std::span(&c.mesh, 1));
  std::vector<std::future<Figures>> parts;
  for (int k = 0; k < kParts; ++k)
    parts.push_back(
        std::async(std::launch::async, check_part, std::cref(c), std::cref(judge), effort, kSeed + k));
  Figures all;
  for (auto& part : parts) {
    const Figures figures = part.get();
    all.penumbra.add(figures.penumbra);
    all.in_umbra += figures.in_umbra;
    all.false_umbra += figures.false_umbra;
  }
  std::cout << "  " << file.stem().string() << ", " << name << ": " << c.mesh.triangles().size() << " faces, "
            << all.penumbra.text() << "; of " << effort.umbra_points << " points in the "
            << name_of(c.umbra.guarantee) << " umbra " << all.in_umbra << ", false " << all.false_umbra
            << "\n";
  EXPECT_EQ(all.penumbra.outside, 0);
  EXPECT_EQ(all.false_umbra, 0);
  EXPECT_GT(all.penumbra.shaded(), effort.penumbra_points / 100);
}

class EveryClosedMesh : public ::testing::TestWithParam<std::filesystem::path> {};

TEST_P(EveryClosedMesh, NoFalseUmbraAndNoMissedPenumbra) {
  expect_no_wrong_point(GetParam(), "disk", DiskLight{{0.3, 3.0, 0.2}, {0.05, -1.0, 0.1}, 0.3},
                        effort_of({30'000, 4'000, 4'096}));
}

/// The sun, a sun as large as a hand at arm's length and low, and a great part of the sky.
TEST_P(EveryClosedMesh, NoFalseUmbraAndNoMissedPenumbraUnderSuns) {
  const Effort effort = effort_of({4'000, 4'000, 1'024});
  expect_no_wrong_point(GetParam(), "sun", DistantLight{{0.05, -1.0, 0.1}, 0.53}, effort);
  expect_no_wrong_point(GetParam(), "low sun", DistantLight{{3.0, -1.0, -1.5}, 10.0}, effort);
  expect_no_wrong_point(GetParam(), "wide sun", DistantLight{{-0.2, -0.9, 0.3}, 60.0}, effort);
}

INSTANTIATE_TEST_SUITE_P(Data, EveryClosedMesh, ::testing::ValuesIn(closed_meshes()), [](const auto& file) {
  std::string name = file.param.stem().string();
  std::replace_if(
      name.begin(), name.end(), [](char ch) { return !std::isalnum(ch); }, '_');
  return name;
});

}  // namespace
}  // namespace penumbra
