// Lightmaps: texels and lookups against rays in double (tests/oracle), tiles, borders, quantities.
#include "penumbra/render/bake/lightmap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <numbers>

#include "penumbra/mesh/error.h"
#include "penumbra/mesh/shapes.h"
#include "penumbra/render/scene/scene.h"
#include "tests/render/bake/baked_room.h"

namespace penumbra {
namespace {

using test::Errors;
using test::TexturedFace;

constexpr int kRays = 4096, kFewRays = 256;

/// The room, its map of 256 × 256 texels, and the oracle. Made once.
class Room {
 public:
  static const Room& get() {
    static const Room room;
    return room;
  }

  double truth(const TexturedFace& face, std::size_t light, const Vec3& point, std::uint64_t seed,
               int rays = kRays) const {
    return oracle_->visibility(point, face.normal(), oracle::CasterFace{face.object, FaceId{face.face}},
                               testing::oracle_light(scene.lights[light].shape), rays, seed);
  }

  Scene scene = load_scene(PENUMBRA_DATA "/bake/room.json").scene;
  Casters casters{scene.objects};
  BakeSource source{.casters = casters, .lights = scene.lights};
  TextureAtlas atlas = make_atlas(scene.objects, {.size = 256});
  Lightmap map = bake_lightmap(source, atlas);
  /// Without fitting.
  Lightmap means = bake_lightmap(source, atlas, {.fit_borders = false});
  std::vector<TexturedFace> faces;

 private:
  Room() {
    std::vector<TriangleMesh> meshes;
    for (const SceneObject& object : scene.objects) meshes.push_back(object.mesh);
    oracle_.emplace(meshes);
    const std::string path = ::testing::TempDir() + "penumbra-room-" + std::to_string(getpid()) + ".obj";
    write_atlas_mesh(path, scene.objects, atlas);
    faces = test::read_textured_faces(path, atlas.width, atlas.height);
    std::filesystem::remove(path);
  }

  std::optional<oracle::Oracle> oracle_;
};

/// Calls `visit(x, y)` for texels that lie in the face with all four corners: no edge of the mesh cuts them.
template <class Visit>
void for_each_whole_texel(const TexturedFace& face, const Visit& visit) {
  double low[2] = {1e9, 1e9}, high[2] = {0, 0};
  for (const glm::dvec2& p : face.uv)
    for (int k = 0; k < 2; ++k) low[k] = std::min(low[k], p[k]), high[k] = std::max(high[k], p[k]);
  for (int y = static_cast<int>(low[1]); y < high[1]; ++y)
    for (int x = static_cast<int>(low[0]); x < high[0]; ++x)
      if (face.contains({x, y}) && face.contains({x + 1, y}) && face.contains({x, y + 1}) &&
          face.contains({x + 1, y + 1}))
        visit(x, y);
}

TEST(Lightmap, TexelsAreWhatRaysInDoubleSay) {
  const Room& room = Room::get();
  Errors all, penumbra;
  std::size_t number = 0;
  for (const TexturedFace& face : room.faces)
    for_each_whole_texel(face, [&](int x, int y) {
      if (++number % 131 != 0) return;
      const glm::dvec2 center(x + 0.5, y + 0.5);
      const Vec3 point = face.point(face.weights(center));
      for (std::size_t light = 0; light < room.scene.lights.size(); ++light) {
        const double truth = room.truth(face, light, point, number);
        const double error =
            room.map.channels[light][static_cast<std::size_t>(y * room.map.width + x)] - truth;
        all.add(error);
        if (truth > 0.0 && truth < 1.0) penumbra.add(error);
      }
    });
  std::printf("%zu texels, RMSE %.5f; in penumbra %zu, RMSE %.5f, worst %.4f\n", all.count, all.rms(),
              penumbra.count, penumbra.rms(), penumbra.worst);
  EXPECT_GT(all.count, 600u);
  EXPECT_GT(penumbra.count, 60u);
  EXPECT_LE(all.rms(), 0.002);
  EXPECT_LE(penumbra.rms(), 0.002);
}

/// A place on a face, and what each lamp gives it.
struct Place {
  const TexturedFace* face;
  glm::dvec2 at;
  std::vector<double> truths;

  Place(const Room& room, const TexturedFace& of, const std::array<double, 3>& weights, std::uint64_t seed)
      : face(&of), at(of.place(weights)) {
    for (std::size_t light = 0; light < room.scene.lights.size(); ++light)
      truths.push_back(room.truth(of, light, of.point(weights), seed, kFewRays));
  }
  double error(const Lightmap& map, std::size_t light) const {
    return map.look_up(light, at) - truths[light];
  }
};

Errors errors_at(const std::vector<Place>& places, const Lightmap& map) {
  Errors errors;
  for (const Place& place : places)
    for (std::size_t light = 0; light < place.truths.size(); ++light) errors.add(place.error(map, light));
  return errors;
}

TEST(Lightmap, LookupsAreRightAlongTheWallsEdges) {
  const Room& room = Room::get();
  std::vector<Place> places;
  for (const TexturedFace& face : room.faces) {
    if (face.object != 0) continue;
    for (int i = 1; i < 40; i += 4)
      for (std::size_t k = 0; k < 3; ++k) {
        std::array<double, 3> at{0.001, 0.001, 0.001};
        at[k] = 0.999 * i / 40.0;
        at[(k + 1) % 3] = 1.0 - 0.001 - at[k];
        places.emplace_back(room, face, at, places.size());
      }
  }
  const double fitted = errors_at(places, room.map).rms(), without = errors_at(places, room.means).rms();
  std::printf("%zu places along edges of the room: RMSE %.4f, without fitting %.4f\n", places.size(), fitted,
              without);
  EXPECT_LE(fitted, without);
}

/// A plate over a floor, under a disk.
std::vector<SceneObject> plate_and_floor() {
  return {{.name = "floor", .mesh = make_plane(2)},
          {.name = "plate", .mesh = make_box({0, 1, 0}, {0.5, 0.01, 0.5})}};
}
const std::vector<Light> kDisk{
    {.name = "disk", .shape = DiskLight{{0.2, 3, 0.1}, {0, -1, 0}, 0.6}, .radiance = {2, 3, 4}}};

/// A floor in two charts, one of them turned by 20 degrees, neither along texels; the seam runs through the
/// penumbra of a plate.
struct DividedFloor {
  static constexpr double kSeam = 0.37, kTexels = 20.0;

  std::vector<Vec3> corners{{-2, 0, -2}, {kSeam, 0, -2}, {2, 0, -2}, {-2, 0, 2}, {kSeam, 0, 2}, {2, 0, 2}};
  std::vector<IndexedTriangle> faces{{0, 4, 1}, {0, 3, 4}, {1, 5, 2}, {1, 4, 5}};
  std::vector<SceneObject> objects{{.name = "floor", .mesh = TriangleMesh::build(corners, faces)},
                                   {.name = "plate", .mesh = make_box({0, 1, 0}, {0.5, 0.01, 0.5})}};
  Casters casters{objects};
  BakeSource source{.casters = casters, .lights = kDisk};

  static glm::dvec2 left(const Vec3& p) { return {3.3 + kTexels * (p.x + 2.0), 4.6 + kTexels * (p.z + 2.0)}; }
  static glm::dvec2 right(const Vec3& p) {
    const double c = std::cos(0.35), s = std::sin(0.35), x = kTexels * (p.x - kSeam),
                 z = kTexels * (p.z + 2.0);
    return {92.0 + c * x - s * z, 6.0 + s * x + c * z};
  }
  TextureAtlas atlas() const {
    TextureAtlas atlas{.width = 128, .height = 100, .uv = {{}, {}}};
    for (std::size_t f = 0; f < 4; ++f) {
      FaceUv& uv = atlas.uv[0].emplace_back();
      for (std::size_t k = 0; k < 3; ++k) uv[k] = (f < 2 ? left : right)(corners[faces[f][k]]);
    }
    return atlas;
  }
  /// Lookups on both sides of the seam, and between them.
  struct Seam {
    Errors from_truth, steps;
  };
  Seam seam(const Lightmap& map, const oracle::Oracle& oracle) const {
    Seam out;
    for (int i = 0; i < 80; ++i) {
      const Vec3 p(kSeam, 0, -1.98 + 0.05 * i);
      const double truth = oracle.visibility(p, {0, 1, 0}, {}, testing::oracle_light(kDisk[0].shape), 1024,
                                             static_cast<std::uint64_t>(i));
      const double a = map.look_up(0, left(p)), b = map.look_up(0, right(p));
      out.from_truth.add(a - truth);
      out.from_truth.add(b - truth);
      out.steps.add(a - b);
    }
    return out;
  }
};

TEST(Lightmap, NoSeamShowsWhereAFloorIsDivided) {
  const DividedFloor floor;
  const std::vector<TriangleMesh> meshes{floor.objects[0].mesh, floor.objects[1].mesh};
  const oracle::Oracle oracle(meshes);
  const TextureAtlas atlas = floor.atlas();
  const auto fitted = floor.seam(bake_lightmap(floor.source, atlas), oracle);
  const auto means = floor.seam(bake_lightmap(floor.source, atlas, {.fit_borders = false}), oracle);
  std::printf("seam: RMSE %.4f, steps %.4f, worst %.4f; without fitting %.4f, steps %.4f, worst %.4f\n",
              fitted.from_truth.rms(), fitted.steps.rms(), fitted.steps.worst, means.from_truth.rms(),
              means.steps.rms(), means.steps.worst);
  // Below a step of a display of 8 bits, .004; the worst, below four: where the penumbra begins and ends
  // within a texel.
  EXPECT_LE(fitted.steps.rms(), 0.003);
  EXPECT_LE(fitted.steps.worst, 0.015);
  EXPECT_LE(fitted.from_truth.rms(), 0.003);
  EXPECT_GT(means.steps.rms(), 3.0 * fitted.steps.rms()) << "fitting does nothing";
}

TEST(Lightmap, TilesMakeNoDifference) {
  const Casters casters(plate_and_floor());
  const BakeSource source{.casters = casters, .lights = kDisk};
  const TextureAtlas atlas = make_atlas(casters.objects(), {.size = 100});
  const Lightmap coarse = bake_lightmap(source, atlas), fine = bake_lightmap(source, atlas, {.tile = 16});
  Errors errors;
  for (std::size_t i = 0; i < coarse.channels[0].size(); ++i)
    errors.add(coarse.channels[0][i] - fine.channels[0][i]);
  EXPECT_LE(errors.worst, 2e-3);
  EXPECT_EQ(coarse.coverage, fine.coverage);
  // The same tiles in another order, from another baker: bit for bit.
  const LightmapBaker first(source, atlas, {.tile = 16}), second(source, atlas, {.tile = 16});
  std::vector<std::vector<float>> values(first.tiles());
  for (std::size_t t = values.size(); t-- > 0;) values[t] = (t % 2 ? first : second).bake(t);
  const Lightmap mixed = first.finish([&](std::size_t t) { return values[t]; });
  EXPECT_EQ(mixed.channels, fine.channels);
}

TEST(Lightmap, EveryTexelThatIsTouchedHasAValue) {
  const Casters casters({{.name = "floor", .mesh = make_plane(2)}});
  const std::vector<Light> lights{{.shape = DistantLight{{0, -1, 0}, 1}}};
  const BakeSource source{.casters = casters, .lights = lights};
  const TextureAtlas atlas = make_atlas(casters.objects(), {.size = 64, .objects = {0}});
  const Lightmap map = bake_lightmap(source, atlas);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) {
      const auto i = static_cast<std::size_t>(y * 64 + x);
      bool is_near = false;
      for (int b = std::max(0, y - 2); b <= std::min(63, y + 2); ++b)
        for (int a = std::max(0, x - 2); a <= std::min(63, x + 2); ++a)
          is_near = is_near || map.coverage[static_cast<std::size_t>(b * 64 + a)] > 0.0f;
      if (is_near) {
        EXPECT_GT(map.channels[0][i], 0.9f) << x << "," << y;
      }
    }
}

TEST(Lightmap, SamplesAverageOverTexels) {
  // A shadow whose edge runs through the middle of texels: half of each is lit.
  const std::vector<Vec3> wide{{-9, 3, -9}, {0.1, 3, -9}, {0.1, 3, 9}, {-9, 3, 9}};
  const std::vector<IndexedTriangle> faces{{0, 2, 1}, {0, 3, 2}};
  const Casters casters({{.name = "floor", .mesh = make_plane(2)},
                         {.name = "plate", .mesh = TriangleMesh::build(wide, faces)}});
  const std::vector<Light> lights{{.shape = DistantLight{{0, -1, 0}, 0.01}}};
  const BakeSource source{.casters = casters, .lights = lights};
  const TextureAtlas atlas = make_atlas(casters.objects(), {.texel = 0.2, .objects = {0}});
  const auto count_between = [&](int samples) {
    const Lightmap map = bake_lightmap(source, atlas, {.samples = samples, .fit_borders = false});
    std::size_t count = 0;
    for (std::size_t i = 0; i < map.coverage.size(); ++i)
      if (map.coverage[i] == 1.0f && std::abs(map.channels[0][i] - 0.5f) < 0.1f) ++count;
    return count;
  };
  EXPECT_EQ(count_between(8), 20u) << "one row of 20 texels";
}

TEST(Lightmap, IrradianceOfAnOpenFloorIsAnIntegral) {
  const Casters casters({{.name = "floor", .mesh = make_plane(2)}});
  const BakeSource source{.casters = casters, .lights = kDisk, .quantity = BakeQuantity::kIrradiance};
  const TextureAtlas atlas = make_atlas(casters.objects(), {.texel = 0.25});
  const Lightmap map = bake_lightmap(source, atlas);
  ASSERT_EQ(map.channels.size(), 3u);
  for (const Vec3& point : {Vec3(0.125, 0, 0.375), Vec3(-1.125, 0, 1.375), Vec3(1.625, 0, -1.375)}) {
    const std::uint32_t face = [&] {
      for (std::uint32_t f = 0; f < 2; ++f) {
        const glm::dvec2 at = place_in_atlas(atlas, casters.objects()[0].mesh, 0, f, point);
        const FaceUv& uv = atlas.uv[0][f];
        const TexturedFace textured{.at = {}, .uv = uv};
        // Clamped to the face where the point lies outside.
        const Vec3 back = [&] {
          const auto w = textured.weights(at);
          Vec3 p(0.0);
          for (std::size_t k = 0; k < 3; ++k)
            p += w[k] * casters.objects()[0].mesh.positions()[casters.objects()[0].mesh.triangles()[f][k]];
          return p;
        }();
        if (std::abs(back.x - point.x) + std::abs(back.z - point.z) < 1e-9) return f;
      }
      return 0u;
    }();
    const glm::dvec2 at = place_in_atlas(atlas, casters.objects()[0].mesh, 0, face, point);
    double integral = 0.0;  // of cos² / d² over the disk, in rings
    constexpr int kRings = 200, kSides = 200;
    for (int i = 0; i < kRings; ++i)
      for (int k = 0; k < kSides; ++k) {
        const double r = 0.6 * (i + 0.5) / kRings, a = 2.0 * std::numbers::pi * (k + 0.5) / kSides;
        const double x = 0.2 + r * std::cos(a) - point.x, z = 0.1 + r * std::sin(a) - point.z;
        const double d2 = x * x + 9.0 + z * z;
        integral += 9.0 / (d2 * d2) * r * (0.6 / kRings) * (2.0 * std::numbers::pi / kSides);
      }
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_NEAR(map.look_up(c, at), (2.0 + static_cast<double>(c)) * integral, 2e-3 * integral);
  }
}

TEST(Lightmap, RefusesOptionsAndValuesOutsideOfTheirDomain) {
  const Casters casters(plate_and_floor());
  const BakeSource source{.casters = casters, .lights = kDisk};
  const TextureAtlas atlas = make_atlas(casters.objects(), {.size = 64});
  EXPECT_THROW(LightmapBaker(source, atlas, {.tile = 1}), UsageError);
  EXPECT_THROW(LightmapBaker(source, atlas, {.samples = 0}), UsageError);
  EXPECT_THROW(LightmapBaker(source, atlas, {.dilation = -1}), UsageError);
  const LightmapBaker baker(source, atlas);
  EXPECT_THROW(baker.finish([](std::size_t) { return std::vector<float>(3); }), UsageError);
  int asked = 0;
  EXPECT_THROW(bake_lightmap(source, atlas, {}, [&](double) { return ++asked < 2; }), Cancelled);
}

}  // namespace
}  // namespace penumbra
