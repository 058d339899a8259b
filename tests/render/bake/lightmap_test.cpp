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
                               test::oracle_light(scene.lights[light].shape), rays, seed);
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
    const std::string path = testing::TempDir() + "penumbra-room-" + std::to_string(getpid()) + ".obj";
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
        const double error = room.map.channels[light][static_cast<std::size_t>(y * room.map.width + x)] - truth;
        all.add(error);
        if (truth > 0.0 && truth < 1.0) penumbra.add(error);
      }
    });
  std::printf("%zu texels, RMSE %.5f; in penumbra %zu, RMSE %.5f, worst %.4f\n", all.count, all.rms(),
              penumbra.count, penumbra.rms(), penumbra.worst);
  EXPECT_GT(all.count, 600u);
  EXPECT_GT(penumbra.count, 100u);
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
  double error(const Lightmap& map, std::size_t light) const { return map.look_up(light, at) - truths[light]; }
};

Errors errors_at(const std::vector<Place>& places, const Lightmap& map) {
  Errors errors;
  for (const Place& place : places)
    for (std::size_t light = 0; light < place.truths.size(); ++light) errors.add(place.error(map, light));
  return errors;
}

/// Two places, one on each side of every third edge of an object, one after the other: of edges on borders of charts, and of others.
struct Sides {
  std::vector<Place> seams, inside;
};
Sides both_sides_of_edges(const Room& room, std::uint32_t object) {
  Sides out;
  std::vector<const TexturedFace*> faces;
  for (const TexturedFace& face : room.faces)
    if (face.object == object) faces.push_back(&face);
  const TriangleMesh& mesh = room.scene.objects[object].mesh;
  std::uint64_t seed = 0;
  for (std::size_t e = 0; e < mesh.edges().size(); e += 3) {
    const Edge& edge = mesh.edges()[e];
    if (edge.is_boundary()) continue;
    std::array<glm::dvec2, 2> ends[2];
    std::vector<Place> places;
    for (std::size_t side = 0; side < 2; ++side) {
      const std::size_t f = index(side == 0 ? edge.left : edge.right);
      std::array<double, 3> weights{0.002, 0.002, 0.002};
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t v = mesh.triangles()[f][k];
        if (v == index(edge.from)) ends[side][0] = faces[f]->uv[k], weights[k] = 0.499;
        if (v == index(edge.to)) ends[side][1] = faces[f]->uv[k], weights[k] = 0.499;
      }
      places.emplace_back(room, *faces[f], weights, ++seed);
    }
    auto& list = ends[0] != ends[1] ? out.seams : out.inside;
    list.insert(list.end(), places.begin(), places.end());
  }
  return out;
}

TEST(Lightmap, NoSeamShowsOnARoundBody) {
  const Room& room = Room::get();
  constexpr std::uint32_t kBall = 2;
  const Sides sides = both_sides_of_edges(room, kBall);
  const double fitted = errors_at(sides.seams, room.map).rms(), without = errors_at(sides.seams, room.means).rms(),
               inside = errors_at(sides.inside, room.map).rms();
  std::printf("%zu places at seams: RMSE %.4f, without fitting %.4f; %zu inside of charts: %.4f\n",
              sides.seams.size(), fitted, without, sides.inside.size(), inside);
  EXPECT_GT(sides.seams.size(), 60u);
  EXPECT_LE(fitted, 1.25 * inside) << "a border is as good as any other place";
  EXPECT_LT(fitted, 0.75 * without);
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
  return {{.name = "floor", .mesh = make_plane(2)}, {.name = "plate", .mesh = make_box({0, 1, 0}, {0.5, 0.01, 0.5})}};
}
const std::vector<Light> kDisk{{.name = "disk", .shape = DiskLight{{0.2, 3, 0.1}, {0, -1, 0}, 0.6}, .radiance = {2, 3, 4}}};

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
  const Casters casters({{.name = "floor", .mesh = make_plane(2)}, {.name = "ball", .mesh = make_icosphere({0, 9, 0}, 0.1, 0)}});
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
  const Casters casters({{.name = "floor", .mesh = make_plane(2)}, {.name = "plate", .mesh = TriangleMesh::build(wide, faces)}});
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
