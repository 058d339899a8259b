// Every mesh of data/meshes and data/regressions under twenty-nine lights, degenerate ones among them: either
// a named error, or volumes that are closed and finite, silhouettes that balance, and neither a point in
// shadow outside of the penumbra volume nor one inside of the umbra volume that sees light. Large meshes are
// given only some of the lights, chosen by their name; PENUMBRA_LONG=1 in the environment: all.
#include "tests/volumes/checks/light_poses.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <glm/geometric.hpp>
#include <iostream>

#include "penumbra/mesh/error.h"
#include "penumbra/mesh/io/polygon_soup.h"
#include "tests/volumes/checks/soundness.h"
#include "tests/volumes/convex_pieces.h"
#include "tests/volumes/light_samples.h"
#include "tests/volumes/shadow_oracle.h"
#include "tests/volumes/triangle_tree.h"

namespace penumbra {
namespace {

constexpr std::uint64_t kSeed = 20;

/// One mesh under one light.
class PoseCheck {
 public:
  PoseCheck(const TriangleMesh& mesh, const testing::Pose& pose)
      : mesh_(moved(mesh, pose)), light_(moved(pose.light, pose)), box_(mesh_.bounds()) {
    const double size = box_.radius();
    const Vec3 margin(size);
    if (!light_.is_distant() && glm::length(light_.center - box_.center()) < 10.0 * size)
      box_.add(light_.center);
    box_.add(box_.low - margin);
    box_.add(box_.high + margin);
  }

  void run(int points) {
    ExtrudeOptions options;
    options.bound_center = box_.center();
    options.bound_radius = box_.radius();
    ShadowVolumes volumes;
    testing::expect_sound(mesh_, light_, volumes, options);
    if (::testing::Test::HasFatalFailure()) return;
    const testing::TriangleTree caster(mesh_.positions(), mesh_.triangles()),
        umbra(volumes.umbra.positions, volumes.umbra.triangles);
    testing::ConvexPieces penumbra(volumes.penumbra.positions, volumes.penumbra.triangles, light_);
    testing::ShadowOracle oracle(mesh_, light_);
    for (int i = 0; i < points; ++i) {
      const Vec3 x = i % 2 ? near(volumes.penumbra) : anywhere();
      if (side_of_light_plane(x, light_) != Sign::kPositive) continue;
      if (penumbra.winding_number(x, 1) >= 1) {
        ++inside_;
      } else {
        ++outside_;
        ASSERT_FALSE(is_shaded(oracle, caster, x)) << "point " << i << " is outside of the penumbra volume";
      }
      if (volumes.umbra.triangles.empty() || winding(umbra, x) < 1) continue;
      ++dark_;
      ASSERT_TRUE(is_dark(caster, x)) << "point " << i << " in the umbra volume sees light";
    }
  }
  int inside() const { return inside_; }
  int outside() const { return outside_; }
  int dark() const { return dark_; }

 private:
  static TriangleMesh moved(const TriangleMesh& mesh, const testing::Pose& pose) {
    std::vector<Vec3> positions(mesh.positions().begin(), mesh.positions().end());
    for (Vec3& p : positions) p = pose.scale * p + pose.offset;
    return TriangleMesh::build(positions, mesh.triangles());
  }
  static CircularLight moved(CircularLight light, const testing::Pose& pose) {
    if (light.is_distant()) return light;
    light.center = pose.scale * light.center + pose.offset;
    light.radius *= pose.scale;
    return light;
  }

  Vec3 anywhere() {
    Vec3 x;
    for (int k = 0; k < 3; ++k) x[k] = random_.uniform(box_.low[k], box_.high[k]);
    return x;
  }

  /// By a triangle of the volume, rather where its corners are near.
  Vec3 near(const ShadowMesh& volume) {
    for (int attempt = 0; attempt < 100 && !volume.triangles.empty(); ++attempt) {
      const IndexedTriangle& t = volume.triangles[static_cast<std::size_t>(
          random_.integer(0, static_cast<int>(volume.triangles.size()) - 1))];
      Vec3 weight(random_.uniform(0, 1), random_.uniform(0, 1), random_.uniform(0, 1));
      weight *= weight * weight;
      Vec3 x = std::pow(10.0, random_.uniform(-6, -1)) * mesh_.bounds().radius() * random_.direction();
      for (int k = 0; k < 3; ++k) x += weight[k] / (weight.x + weight.y + weight.z) * volume.positions[t[k]];
      Bounds with_x = box_;
      with_x.add(x);
      if (with_x.low == box_.low && with_x.high == box_.high) return x;
    }
    return anywhere();
  }

  bool is_shaded(testing::ShadowOracle& oracle, const testing::TriangleTree& caster, const Vec3& x) const {
    return light_.radius > 0.0 ? oracle.is_partly_hidden(x) : blocked(caster, x, end(x, 0)).value_or(false);
  }

  int winding(const testing::TriangleTree& volume, const Vec3& x) {
    const double size = mesh_.bounds().radius();
    return testing::winding_number(volume, x, testing::unshadowed_point(light_, mesh_.bounds(), size),
                                   0.1 * size, random_);
  }

  /// Nothing where the segment only touches an edge or a corner.
  static std::optional<bool> blocked(const testing::TriangleTree& caster, const Vec3& x, const Vec3& p) {
    bool touches = false;
    const bool hit = caster.find([&](const Bounds& box) { return testing::segment_meets_box(x, p - x, box); },
                                 [&](std::uint32_t i) {
                                   const auto c = testing::crossing(x, p, caster.corner(i, 0),
                                                                    caster.corner(i, 1), caster.corner(i, 2));
                                   touches = touches || !c;
                                   return c.value_or(0) != 0;
                                 });
    if (hit) return true;
    return touches ? std::nullopt : std::optional(false);
  }

  bool is_dark(const testing::TriangleTree& caster, const Vec3& x) const {
    for (int k = 0; k < kRays; ++k)
      if (!blocked(caster, x, end(x, k)).value_or(true)) return false;
    return true;
  }

  /// Of the k-th ray from x.
  Vec3 end(const Vec3& x, int k) const {
    const Bounds& caster = mesh_.bounds();
    return testing::end_towards_light(light_, light_frame(light_), x, k, kRays,
                                      glm::length(x - caster.center()) + 2.0 * caster.radius());
  }

  static constexpr int kRays = 64;

  TriangleMesh mesh_;
  CircularLight light_;
  Bounds box_;
  testing::RandomInputs random_{kSeed};
  int inside_ = 0, outside_ = 0, dark_ = 0;
};

std::vector<std::filesystem::path> all_meshes() {
  std::vector<std::filesystem::path> files;
  for (const char* folder : {"meshes", "regressions/meshes"}) {
    for (const auto& entry :
         std::filesystem::directory_iterator(std::filesystem::path(PENUMBRA_DATA) / folder)) {
      if (entry.path().extension() != ".md") files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

class EveryMesh : public ::testing::TestWithParam<std::filesystem::path> {};

TEST_P(EveryMesh, UnderTwentyNineLights) {
  constexpr std::size_t kLarge = 5'000, kFamilies = 5;
  TriangleMesh mesh;
  try {
    mesh = read_mesh(GetParam());
  } catch (const MeshError& error) {
    EXPECT_TRUE(GetParam().filename().string().starts_with("bad-")) << error.what();
    return;
  }
  const bool large = mesh.triangles().size() > kLarge, all = !large || std::getenv("PENUMBRA_LONG");
  // The oracle goes to rationals wherever doubles leave doubt: for large meshes, seconds a point.
  const int points = !large ? 200 : std::clamp(static_cast<int>(100'000 / mesh.triangles().size()), 4, 100);
  const std::vector<testing::Pose> poses = testing::light_poses(mesh);
  ASSERT_EQ(poses.size(), 29u);
  int checked = 0, refused = 0, inside = 0, outside = 0, dark = 0;
  const std::size_t step = all ? 1 : 2 * kFamilies;
  const std::size_t first = all ? 0 : GetParam().stem().string().size() % kFamilies;
  for (std::size_t i = first; i < poses.size(); i += step) {
    SCOPED_TRACE(poses[i].name);
    try {
      PoseCheck check(mesh, poses[i]);
      check.run(points);
      inside += check.inside();
      outside += check.outside();
      dark += check.dark();
      ++checked;
    } catch (const Error& error) {
      ++refused;
      std::cout << "  " << poses[i].name << ": " << error.what() << "\n";
    }
    if (HasFailure()) break;
  }
  std::cout << "  " << GetParam().filename().string() << ": " << mesh.triangles().size() << " faces, "
            << checked << " lights, " << refused << " refused; points " << inside << " in penumbra volumes, "
            << outside << " outside, " << dark << " in umbra volumes\n";
  EXPECT_GT(checked, 0);
}

INSTANTIATE_TEST_SUITE_P(Data, EveryMesh, ::testing::ValuesIn(all_meshes()), [](const auto& file) {
  std::string name = file.param.stem().string();
  std::replace_if(
      name.begin(), name.end(), [](char c) { return !std::isalnum(c); }, '_');
  return name;
});

}  // namespace
}  // namespace penumbra
