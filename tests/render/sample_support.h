// What tests of methods share that count the reference's light samples: how many samples off the reference
// they are.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "penumbra/render/visibility.h"
#include "render/light/area_light.h"
#include "render/light/light_samples.h"
#include "tests/render/method_support.h"

namespace penumbra::testing {

inline OptionValues light_samples(std::uint64_t count, std::uint64_t seed = 1) {
  return {{"samples", count}, {"seed", seed}};
}

/// Receivers in penumbra, those that differ between a method and the reference, and by how many samples in
/// all.
struct SamplesOff {
  std::size_t partly = 0, receivers = 0;
  double samples = 0.0;
};

/// Of V, or of O where `with_unoccluded`, for `count` samples.
inline SamplesOff off_reference(const std::string& method, const std::vector<SceneObject>& objects,
                                const LightShape& light, const Receivers& receivers, int count,
                                bool with_unoccluded = false) {
  const Casters casters(objects);
  const auto by = [&](const std::string& name) {
    const MethodResult result = visibility(casters, light, receivers,
                                           {.method = name,
                                            .options = light_samples(static_cast<std::uint64_t>(count), 5),
                                            .with_unoccluded = with_unoccluded});
    return with_unoccluded ? result.unoccluded : result.visibility;
  };
  const Values ours = by(method), rays = by("reference");
  SamplesOff out;
  EXPECT_EQ(ours.size(), rays.size());
  for (std::size_t i = 0; i < ours.size(); ++i) {
    out.partly += rays[i] > 0.0f && rays[i] < 1.0f;
    out.receivers += ours[i] != rays[i];
    out.samples += std::abs(ours[i] - rays[i]) * static_cast<float>(count);
  }
  return out;
}

/// Float rays may pass an edge within 1e-7 on the other side: one receiver in a thousand, by a sample or two.
inline void expect_ties_only(const SamplesOff& off, const std::string& name) {
  std::printf("%-28s %5zu in penumbra, %3zu differ, by %.0f samples\n", name.c_str(), off.partly,
              off.receivers, off.samples);
  EXPECT_LE(off.receivers, 1 + off.partly / 1000) << name;
  EXPECT_LE(off.samples, 2.0 * static_cast<double>(off.receivers)) << name;
}

/// A rectangle where the disk is, turned about its axis.
inline RectangleLight rectangle_for(const DiskLight& disk) {
  const LightFrame frame = light_frame(disk);
  return {.center = disk.center,
          .normal = disk.normal,
          .tangent = frame.u + 0.3 * frame.v,
          .half_extents = {0.5 * disk.radius, 1.5 * disk.radius}};
}

/// The samples of a receiver, in the world; of a distant light directions.
inline std::vector<Vec3> samples_of(const LightShape& shape, std::uint32_t key, int count) {
  const AreaLight light = area_light(shape);
  const detail::Strata strata(count);
  std::vector<Vec3> out;
  for (int i = 0; i < strata.count(); ++i) {
    const auto column = static_cast<float>(i % strata.columns), row = static_cast<float>(i / strata.columns);
    const detail::DiskPoint p = detail::disk_sample(key, static_cast<std::uint32_t>(i), column, row,
                                                    1.0f / static_cast<float>(strata.columns),
                                                    1.0f / static_cast<float>(strata.rows));
    out.push_back(light.center + light.half.x * (double{p.x} * light.axes.u + double{p.y} * light.axes.v));
  }
  return out;
}

/// Of 4,096 samples: half of the light behind the edge of a large sheet, the share on one side of a chord.
inline void expect_area_beside_chord(const std::string& method) {
  RowOfReceivers row(-0.85, 1.05);
  const Values seen = MethodUnderTest(method)({rectangle(0.1, 60, -60, 60, 1.0)}, kUnitDisk,
                                              {.points = row.points}, light_samples(4096));
  // The edge at x = 0.1 in z = 1, projected from height 2.
  for (std::size_t i = 0; i < seen.size(); ++i)
    EXPECT_NEAR(seen[i], half_plane_area(row.points[i].x + 2.0 * (0.1 - row.points[i].x)), 0.004)
        << row.points[i].x;
}

/// Around a box: under lights anywhere the same as the reference; behind the light and under a point light.
inline void expect_reference_under_lights_anywhere(const std::string& method) {
  const std::vector<SceneObject> objects{{"box", make_box(Vec3(0.0), {1, 1, 1}), Vec3(0.8), true}};
  Random random(3);
  std::vector<Vec3> around;
  for (int i = 0; i < 2'000; ++i) around.push_back(random.point(4.0));
  const LightShape lights[] = {DiskLight{{0, 0.3, 0}, {0.2, -1, 0.1}, 0.4},    // inside
                               DiskLight{{0.9, 0.2, 0.1}, {0.3, -1, 0}, 0.5},  // through a side
                               DiskLight{{0, 1e7, 0}, {0, -1, 0}, 1e6},        // far
                               DiskLight{{0, 3, 0}, {0, -1, 0}, 30.0},         // wide
                               DiskLight{{0, 3, 0}, {0, -1, 0}, 1e-6},         // small
                               DistantLight{{0.3, -1, 0.2}, 5.0}};
  for (const LightShape& light : lights)
    expect_ties_only(off_reference(method, objects, light, {.points = around}, 64), name_of(light));
  const MethodUnderTest seen(method);
  const std::vector<TriangleMesh> box{objects.front().mesh};
  const std::vector<Vec3> behind{{0, 4, 0}, {0, 5, 0}}, below{{0, -3, 0}, {5, -3, 0}};
  EXPECT_EQ(seen(box, DiskLight{{0, 4, 0}, {0, -1, 0}, 0.5}, {.points = behind}), (Values{0, 0}));
  EXPECT_EQ(seen(box, DiskLight{{0, 4, 0}, {0, -1, 0}, 0.0}, {.points = below}), (Values{0, 1}))
      << "a point light";
}

}  // namespace penumbra::testing
