// Geometry over the picture, without a window.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <glm/geometric.hpp>

#include "apps/viewer/pictures/cut.h"

namespace penumbra::viewer {
namespace {

Scene data_scene(const std::string& name) {
  return load_scene(std::filesystem::path(PENUMBRA_DATA) / "scenes" / (name + ".json")).scene;
}

Overlays everything() {
  Overlays o;
  o.faces = o.silhouettes = o.band = o.sheets = o.penumbra = o.umbra = true;
  return o;
}

/// Of the scene's vertices along the light, from the geometry's start.
std::pair<double, double> extent(const Scene& scene, const OverlayGeometry& g, const Vec3& direction) {
  std::pair<double, double> range(INFINITY, -INFINITY);
  for (const SceneObject& object : scene.objects)
    for (const Vec3& p : object.mesh.positions()) {
      const double along = glm::dot(p - g.start, glm::normalize(direction));
      range = {std::min(range.first, along), std::max(range.second, along)};
    }
  return range;
}

TEST(OverlayGeometry, OfADistantLightBeginsAtTheScenesFirstPoint) {
  const Scene scene = data_scene("boxes-sun");
  const DistantLight& sun = std::get<DistantLight>(scene.lights[0].shape);
  const OverlayGeometry g = make_overlay_geometry(scene, sun, everything());
  const auto [first, last] = extent(scene, g, sun.direction);
  EXPECT_NEAR(first, 0.0, 1e-9);
  EXPECT_NEAR(last, g.reach, 1e-9);
  for (const auto* list : {&g.scene, &g.faces, &g.lines, &g.sheets}) EXPECT_FALSE(list->empty());
  for (const OverlayVertex& v : g.scene) EXPECT_LE(std::hypot(v.x, v.y, v.z), g.bound);
}

// A lamp that is far away is drawn from the scene on as well: single precision holds what is near the origin.
TEST(OverlayGeometry, OfALampFarAwayIsThatOfADistantLight) {
  const Scene scene = data_scene("boxes-sun");
  const DistantLight& sun = std::get<DistantLight>(scene.lights[0].shape);
  const OverlayGeometry far = make_overlay_geometry(scene, sun, everything());
  const double distance = 1e9;
  const OverlayGeometry lamp =
      make_overlay_geometry(scene,
                            DiskLight{-distance * glm::normalize(sun.direction), sun.direction,
                                      distance * CircularLight(sun).radius},
                            everything());
  EXPECT_EQ(lamp.origin, far.origin);
  EXPECT_EQ(lamp.bound, far.bound);
  EXPECT_NEAR(lamp.reach, far.reach, 1e-9);
  ASSERT_EQ(lamp.sheets.size(), far.sheets.size());
  // Pieces may come in another order.
  for (const OverlayVertex& a : far.sheets) {
    float nearest = INFINITY;
    for (const OverlayVertex& b : lamp.sheets)
      nearest = std::min(nearest, std::hypot(a.x - b.x, a.y - b.y, a.z - b.z));
    ASSERT_LT(nearest, 1e-4f);
  }
}

TEST(OverlayGeometry, OfALampNearbyBeginsInItsPlane) {
  const Scene scene = data_scene("boxes-medium");
  const DiskLight& lamp = std::get<DiskLight>(scene.lights[0].shape);
  const OverlayGeometry g = make_overlay_geometry(scene, lamp, everything());
  EXPECT_NEAR(glm::dot(g.start - lamp.center, lamp.normal), 0.0, 1e-9);
  EXPECT_NEAR(extent(scene, g, lamp.normal).second, g.reach, 1e-9);
}

TEST(Cut, HalfWayAlongAnAxisGoesThroughTheMiddleOfTheCasters) {
  State state;
  LoadedScene loaded = load_scene(std::filesystem::path(PENUMBRA_DATA) / "meshes/bunny.ply");
  state = opened("bunny.ply", loaded, state);
  state.overlays.cut = 0.5;
  const OverlayGeometry g = make_overlay_geometry(current_scene(state), state.circular(), state.overlays);
  for (const auto& [axis, unit] :
       {std::pair(CutAxis::kX, Vec3(1, 0, 0)), {CutAxis::kY, Vec3(0, 1, 0)}, {CutAxis::kZ, Vec3(0, 0, 1)}}) {
    state.overlays.cut_axis = axis;
    const Cut cut = cut_of(state, g);
    EXPECT_TRUE(cut.cuts);
    EXPECT_EQ(cut.axis, unit);
    EXPECT_NEAR(cut.most, glm::dot(state.casters.center() - g.origin, unit), 1e-12);
  }
  state.overlays.cut = 1.0;
  EXPECT_FALSE(cut_of(state, g).cuts);
}

}  // namespace
}  // namespace penumbra::viewer
