// What terrain hides: a ridge in closed form; tiles against one mesh written by hand, and against rays in
// double.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>

#include "penumbra/render/visibility.h"
#include "tests/oracle/oracle.h"
#include "tests/render/scene/heightfield/height_support.h"

namespace penumbra {
namespace {

using Terrain = testing::HeightFiles;
constexpr double kDegree = std::numbers::pi / 180.0;

/// The share of a disk on the lit side of a straight edge at δ radii from its center.
double beyond(double d) {
  d = std::clamp(d, -1.0, 1.0);
  return 0.5 + (std::asin(d) + d * std::sqrt(1.0 - d * d)) / std::numbers::pi;
}

/// A level plain with a ridge along x at z = 0, 5 high, and the sun behind it at 20 degrees. In the plane
/// across the sun the ridge is a level line, as far above the sun's center as the tangent of the angle
/// between both is long.
TEST_F(Terrain, ASunOverARidgeIsTheClosedForm) {
  std::vector<std::vector<float>> heights(41, std::vector<float>(41, 0.0f));
  heights[8] = std::vector<float>(41, 5.0f);
  write_npy("ridge.npy", heights);
  const Scene scene = scene_of(R"("heightfield": "ridge.npy", "tile": 5, "translation": [-20, 0, -8])");
  const double elevation = 20.0 * kDegree, angle = 1.5;
  const DistantLight sun{{0.0, -std::sin(elevation), std::cos(elevation)}, angle};
  std::vector<Vec3> points, normals;
  for (double z = 12.5; z < 15.5; z += 0.04) points.emplace_back(0.3, 0.0, z), normals.emplace_back(0, 1, 0);
  const Casters casters(scene.objects);
  const Receivers receivers{.points = points, .normals = normals, .objects = {}, .faces = {}};
  const MethodResult exact = visibility(casters, sun, receivers);
  const MethodResult rays =
      visibility(casters, sun, receivers, {.method = "rays", .options = {{"samples", std::uint64_t{4096}}}});
  std::size_t partly = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double above = std::atan2(5.0, points[i].z) - elevation;
    const double expected = beyond(-std::tan(above) / std::tan(0.5 * angle * kDegree));
    EXPECT_NEAR(exact.visibility[i], expected, 2e-6) << points[i].z;
    EXPECT_NEAR(rays.visibility[i], expected, 0.01) << points[i].z;
    partly += expected > 0.0 && expected < 1.0;
  }
  EXPECT_GT(partly, 20u);
  EXPECT_LT(partly, points.size());
}

/// The same heights as tiles, and as one mesh whose corners are written here.
class TiledTerrain : public Terrain {
 protected:
  static constexpr std::uint32_t kSide = 29;

  TiledTerrain() {
    std::mt19937 random(20261130);
    heights_.assign(kSide, std::vector<float>(kSide));
    for (auto& row : heights_)
      for (float& height : row) height = 1.5f * static_cast<float>(random()) / 4294967296.0f;
    write_npy("rough.npy", heights_);
    tiled_ = scene_of(R"("heightfield": "rough.npy", "tile": 4)");
    std::vector<Vec3> posts;
    std::vector<IndexedTriangle> faces;
    for (std::uint32_t r = 0; r < kSide; ++r)
      for (std::uint32_t c = 0; c < kSide; ++c) {
        posts.emplace_back(c, heights_[r][c], r);
        const std::uint32_t at = r * kSide + c;
        if (r + 1 == kSide || c + 1 == kSide) continue;
        faces.push_back({at, at + kSide, at + 1});
        faces.push_back({at + 1, at + kSide, at + kSide + 1});
      }
    whole_.push_back({.name = "by hand", .mesh = TriangleMesh::build(posts, faces)});
    // Every post, and points above.
    std::uniform_real_distribution<double> place(1.0, kSide - 2.0), height(0.0, 1.6);
    points_ = posts;
    for (int i = 0; i < 600; ++i) {
      const double x = place(random), z = place(random);
      points_.emplace_back(x, height(random), z);
    }
  }

  std::vector<float> seen(const Casters& casters, const LightShape& light, const char* method) const {
    VisibilityOptions options{.method = method};
    if (method != std::string("silhouette")) options.options = {{"samples", std::uint64_t{64}}};
    return visibility(casters, light, {.points = points_, .normals = {}, .objects = {}, .faces = {}}, options)
        .visibility;
  }

  std::vector<std::vector<float>> heights_;
  Scene tiled_;
  std::vector<SceneObject> whole_;
  std::vector<Vec3> points_;
};

const LightShape kLowSun = DistantLight{{0.9, -0.25, 0.4}, 4.0};
const LightShape kLamp = DiskLight{{9.0, 3.0, 12.0}, {0.1, -1.0, 0.2}, 1.0};

TEST_F(TiledTerrain, BordersHideNothing) {
  const Casters tiled(tiled_.objects), whole(whole_);
  for (const LightShape& light : {kLowSun, kLamp})
    for (const char* method : {"silhouette", "rays", "reference"}) {
      const std::vector<float> a = seen(tiled, light, method), b = seen(whole, light, method);
      double most = 0.0;
      std::size_t partly = 0;
      for (std::size_t i = 0; i < a.size(); ++i) {
        most = std::max(most, double{std::abs(a[i] - b[i])});
        partly += b[i] > 0.0f && b[i] < 1.0f;
      }
      std::printf("%-10s %zu of %zu in penumbra, tiles differ by %.1e\n", method, partly, a.size(), most);
      EXPECT_GT(partly, 60u);
      EXPECT_LE(most, method == std::string("silhouette") ? 2e-5 : 0.0) << method;
    }
}

TEST_F(TiledTerrain, IsWhatRaysInDoubleSee) {
  const Casters tiled(tiled_.objects);
  std::vector<TriangleMesh> meshes;
  for (const SceneObject& object : whole_) meshes.push_back(object.mesh);
  const oracle::Oracle truth(meshes);
  for (const bool far : {true, false}) {
    const std::vector<float> ours = seen(tiled, far ? kLowSun : kLamp, "silhouette");
    const oracle::Light light =
        far ? oracle::Light(std::get<DistantLight>(kLowSun)) : oracle::Light(std::get<DiskLight>(kLamp));
    double squares = 0.0;
    std::size_t judged = 0;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (i % 8 != 0 && (ours[i] == 0.0f || ours[i] == 1.0f)) continue;
      ++judged;
      const double expected = truth.unoccluded(points_[i], {}, light, 1024, i);
      squares += (ours[i] - expected) * (ours[i] - expected);
      EXPECT_NEAR(ours[i], expected, 0.03) << i;
    }
    EXPECT_LT(std::sqrt(squares / static_cast<double>(judged)), 0.004);
  }
}

}  // namespace
}  // namespace penumbra
