// What tests of single methods share: a method in one call, a unit light over receivers in a row, and what
// every method must do with empty scenes, bad settings and lights anywhere.
#pragma once

#include <gtest/gtest.h>

#include <initializer_list>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "penumbra/mesh/error.h"
#include "penumbra/render/visibility.h"
#include "tests/render/render_support.h"

namespace penumbra::testing {

/// In z = 0 about the origin, shining towards +z.
inline const DiskLight kUnitDisk{Vec3(0.0), {0, 0, 1}, 1.0};

/// Receivers at height 2 over the unit disk, on no mesh; normals towards the light.
struct RowOfReceivers {
  RowOfReceivers(double low, double high, double step = 0.05) {
    for (double x = low; x < high; x += step) points.emplace_back(x, 0.3, 2.0);
    normals.assign(points.size(), {0, 0, -1});
  }
  Receivers receivers() const { return {.points = points, .normals = normals}; }
  std::vector<Vec3> points, normals;
};

/// Triangles that are open, cross each other, are wound at random, and have edges of three faces.
inline TriangleMesh triangles_that_are_no_surface(Random& random) {
  std::vector<Vec3> points;
  std::vector<IndexedTriangle> triangles;
  for (std::uint32_t i = 0; i < 60; ++i) {
    const Vec3 at = random.point(0.8);
    for (int k = 0; k < 5; ++k) points.push_back(at + random.point(0.4));
    const std::uint32_t v = 5 * i;
    triangles.push_back({v, v + 1, v + 2});
    triangles.push_back(i % 2 == 0 ? IndexedTriangle{v, v + 1, v + 3} : IndexedTriangle{v + 1, v, v + 3});
    if (i % 3 == 0) triangles.push_back({v + 1, v, v + 4});
  }
  return TriangleMesh::build(points, triangles);
}

class MethodUnderTest {
 public:
  explicit MethodUnderTest(std::string name) : name_(std::move(name)) {}

  Values operator()(const std::vector<TriangleMesh>& casters, const LightShape& light,
                    const Receivers& receivers, const OptionValues& options = {}) const {
    return visibility(Casters(casters), light, receivers, {.method = name_, .options = options}).visibility;
  }

  /// Nothing casts: what is before the light is lit. `tolerance`: of what lies under a roof.
  void expect_empty_scenes_are_lit(float tolerance = 0.0f) const {
    const std::vector<Vec3> points{{0, 0.3, 2}, {0.1, 0.3, 2}, {0, 0, -1}};
    const std::vector<std::int32_t> objects{-1, 0, 0};
    EXPECT_EQ((*this)({}, kUnitDisk, {.points = points}), (Values{1, 1, 0}))
        << "the last is behind the light";
    EXPECT_TRUE((*this)({}, kUnitDisk, {}).empty());
    const Values under =
        (*this)({rectangle(-60, 60, -60, 60, 1.0)}, kUnitDisk, {.points = points, .objects = objects});
    EXPECT_EQ(under[0], 1.0f) << "no receiver";
    EXPECT_LE(under[1], tolerance);
    EXPECT_EQ(under[2], 0.0f);
  }

  void expect_are_refused(std::initializer_list<const char*> options,
                          std::initializer_list<OptionValue> values) const {
    const std::vector<Vec3> points{{0, 0.3, 2}};
    for (const OptionValue& bad : values)
      for (const char* option : options)
        EXPECT_THROW((*this)({}, kUnitDisk, {.points = points}, {{option, bad}}), UsageError) << option;
  }

  /// Around a box, under lights in it, through a side of it, far, wide, small and distant.
  void expect_lights_anywhere_do(std::size_t receivers, const OptionValues& options = {},
                                 std::span<const LightShape> lights = lights_anywhere()) const {
    Random random(3);
    std::vector<Vec3> around;
    for (std::size_t i = 0; i < receivers; ++i) around.push_back(random.point(4.0));
    const std::vector<TriangleMesh> box{make_box(Vec3(0.0), {1, 1, 1})};
    for (const LightShape& light : lights)
      for (const float v : (*this)(box, light, {.points = around}, options))
        EXPECT_TRUE(v >= 0.0f && v <= 1.0f) << v;
  }

  /// The last one is distant.
  static std::span<const LightShape> lights_anywhere() {
    static const std::vector<LightShape> lights{
        DiskLight{{0, 0.3, 0}, {0.2, -1, 0.1}, 0.4}, DiskLight{{0.9, 0.2, 0.1}, {0.3, -1, 0}, 0.5},
        DiskLight{{0, 1e9, 0}, {0, -1, 0}, 1e8},     DiskLight{{0, 3, 0}, {0, -1, 0}, 30.0},
        DiskLight{{0, 3, 0}, {0, -1, 0}, 1e-6},      DistantLight{{0.3, -1, 0.2}, 170.0}};
    return lights;
  }

 private:
  std::string name_;
};

}  // namespace penumbra::testing
