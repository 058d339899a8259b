// Every closed mesh of data/ with many points, half of them within 1e-3 scene units of a produced surface: no
// point that is not fully lit is outside of the penumbra volume (by triangles, in rationals where doubles
// leave doubt), and from no point in the umbra volume does any of 4,096 rays reach the disk. Meshes are
// scaled to radius 1. 100,000 points a mesh; PENUMBRA_LONG=1 in the environment: 1,000,000.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <future>
#include <iostream>

#include "penumbra/mesh/io/polygon_soup.h"
#include "penumbra/volumes/convex_umbra.h"
#include "penumbra/volumes/volumes.h"
#include "tests/volumes/containment_check.h"
#include "tests/volumes/light_samples.h"
#include "tests/volumes/triangle_tree.h"

namespace penumbra {
namespace {

constexpr std::uint64_t kSeed = 1'000'000;
constexpr int kParts = 4;  // that run at the same time, each with a seed of its own

int point_count() {
  return std::getenv("PENUMBRA_LONG") ? 1'000'000 : 100'000;
}

struct Case {
  TriangleMesh mesh;
  CircularLight light = DiskLight{};
  Bounds box;
  ShadowMesh umbra, penumbra;
};

Case make_case(const TriangleMesh& mesh, const CircularLight& light) {
  Case c;
  std::vector<Vec3> positions;
  for (const Vec3& p : mesh.positions())
    positions.push_back((p - mesh.bounds().center()) / mesh.bounds().radius());
  c.mesh = TriangleMesh::build(positions, mesh.triangles());
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
  UmbraCheck(const Case& c, std::uint64_t seed)
      : case_(c),
        seed_(seed),
        random_(seed),
        frame_(light_frame(c.light)),
        outside_(testing::unshadowed_point(c.light, c.mesh.bounds(), 1.0)),
        caster_(c.mesh.positions(), c.mesh.triangles()),
        umbra_(c.umbra.positions, c.umbra.triangles) {}

  /// How many of the points were inside, and how many of these see light.
  std::pair<long, long> run(int count) {
    if (case_.umbra.triangles.empty()) return {0, 0};
    long inside = 0, wrong = 0;
    for (int i = 0; i < count && wrong < 3; ++i) {
      const Vec3 x = i % 2 ? near_surface() : anywhere();
      if (testing::winding_number(umbra_, x, outside_, 0.1, random_) < 1) continue;
      ++inside;
      if (!sees_light(x)) continue;
      ++wrong;
      ADD_FAILURE() << "seed " << seed_ << ", point " << i << ": (" << x.x << ", " << x.y << ", " << x.z
                    << ") is in the umbra volume and sees light";
    }
    return {inside, wrong};
  }

 private:
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

  /// Exact for each ray; one that touches an edge is taken to be blocked.
  bool sees_light(const Vec3& x) const {
    constexpr int kRays = 4096;
    for (int s = 0; s < kRays; ++s) {
      const Vec3 p = testing::end_towards_light(case_.light, frame_, x, s, kRays, 2.0 * case_.box.radius());
      const bool blocked = caster_.find(
          [&](const Bounds& box) { return testing::segment_meets_box(x, p - x, box); },
          [&](std::uint32_t i) {
            return testing::crossing(x, p, caster_.corner(i, 0), caster_.corner(i, 1), caster_.corner(i, 2))
                       .value_or(1) != 0;
          });
      if (!blocked) return true;
    }
    return false;
  }

  const Case& case_;
  std::uint64_t seed_;
  testing::RandomInputs random_;
  LightFrame frame_;
  Vec3 outside_;
  testing::TriangleTree caster_, umbra_;
};

struct Figures {
  testing::ContainmentFigures penumbra;
  long in_umbra = 0, false_umbra = 0;
};

/// The umbra takes a tenth of the points: each that is inside costs 4,096 rays.
Figures check_part(const Case& c, int points, std::uint64_t seed) {
  Figures figures;
  testing::ContainmentCheck penumbra(c.mesh, c.light, c.penumbra, c.box, seed);
  penumbra.run(points - points / 10);
  figures.penumbra = penumbra.figures();
  std::tie(figures.in_umbra, figures.false_umbra) = UmbraCheck(c, seed).run(points / 10);
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

void expect_no_wrong_point(const std::filesystem::path& file, const std::string& name,
                           const CircularLight& light, int points) {
  const Case c = make_case(read_mesh(file), light);
  std::vector<std::future<Figures>> parts;
  for (int k = 0; k < kParts; ++k)
    parts.push_back(std::async(std::launch::async, check_part, std::cref(c), points / kParts, kSeed + k));
  Figures all;
  for (auto& part : parts) {
    const Figures figures = part.get();
    all.penumbra.add(figures.penumbra);
    all.in_umbra += figures.in_umbra;
    all.false_umbra += figures.false_umbra;
  }
  std::cout << "  " << file.stem().string() << ", " << name << ": " << c.mesh.triangles().size() << " faces, "
            << all.penumbra.text() << "; of " << points / 10 << " points in the "
            << name_of(c.umbra.guarantee) << " umbra " << all.in_umbra << ", false " << all.false_umbra
            << "\n";
  EXPECT_EQ(all.penumbra.outside, 0);
  EXPECT_EQ(all.false_umbra, 0);
  EXPECT_GT(all.penumbra.shaded(), points / 100);
}

class EveryClosedMesh : public ::testing::TestWithParam<std::filesystem::path> {};

TEST_P(EveryClosedMesh, NoFalseUmbraAndNoMissedPenumbra) {
  expect_no_wrong_point(GetParam(), "disk", DiskLight{{0.3, 3.0, 0.2}, {0.05, -1.0, 0.1}, 0.3},
                        point_count());
}

/// The sun, a sun as large as a hand at arm's length and low, and a great part of the sky.
TEST_P(EveryClosedMesh, NoFalseUmbraAndNoMissedPenumbraUnderSuns) {
  const int points = std::getenv("PENUMBRA_LONG") ? 100'000 : 10'000;
  expect_no_wrong_point(GetParam(), "sun", DistantLight{{0.05, -1.0, 0.1}, 0.53}, points);
  expect_no_wrong_point(GetParam(), "low sun", DistantLight{{3.0, -1.0, -1.5}, 10.0}, points);
  expect_no_wrong_point(GetParam(), "wide sun", DistantLight{{-0.2, -0.9, 0.3}, 60.0}, points);
}

INSTANTIATE_TEST_SUITE_P(Data, EveryClosedMesh, ::testing::ValuesIn(closed_meshes()), [](const auto& file) {
  std::string name = file.param.stem().string();
  std::replace_if(
      name.begin(), name.end(), [](char ch) { return !std::isalnum(ch); }, '_');
  return name;
});

}  // namespace
}  // namespace penumbra
