#include <array>

#include "tests/yardstick/judging.h"
#include "tests/yardstick/parts.h"

namespace penumbra::yardstick {
namespace {

struct OddLight {
  const char* name;
  LightShape shape;
};

// Over and in a box of side 1 that stands on the floor at the origin.
std::vector<OddLight> odd_lights() {
  return {
      {"inside_the_box", DiskLight{{0, 0.5, 0}, {0, -1, 0}, 0.2}},
      {"in_the_top_face", DiskLight{{0.1, 1, 0}, {0, 1, 0}, 0.2}},
      {"in_the_top_face_facing_down", DiskLight{{0.1, 1, 0}, {0, -1, 0}, 0.2}},
      {"just_above_the_top_face", DiskLight{{0.1, 1.0 + 1e-9, 0}, {0, -1, 0}, 0.2}},
      {"through_the_box", DiskLight{{0.5, 0.7, 0.1}, {0.3, -1, 0.2}, 0.6}},
      {"plane_cuts_the_box", DiskLight{{3, 0.5, 0}, {0, -1, 0.1}, 0.3}},
      {"facing_away", DiskLight{{-10, 10, 0}, {-1, 1, 0}, 0.2}},
      {"on_the_floor_facing_up", DiskLight{{-1.5, 0, 0}, {0, 1, 0}, 0.4}},
      {"on_the_floor_facing_the_box", DiskLight{{-3, 0, 0}, {1, 0, 0}, 0.4}},
      {"through_the_floor", DiskLight{{-3, 0.1, 0.2}, {1, -0.1, 0}, 0.7}},
      {"larger_than_the_box", DiskLight{{-1, 3, 0}, {0.2, -1, 0}, 5.0}},
      {"touching_a_corner", DiskLight{{0.5, 1, 0.5}, {1, 1, 1}, 0.3}},
      {"a_point", DiskLight{{-2, 4, 1}, {0.4, -1, 0}, 0.0}},
      {"tiny", DiskLight{{-2, 4, 1}, {0.4, -1, 0}, 1e-9}},
      {"sun_from_below", DistantLight{{0.3, 1, 0.1}, 2.0}},
      {"sun_along_the_floor", DistantLight{{1, 0, 0.2}, 2.0}},
      {"sun_along_two_sides", DistantLight{{0, -1, 0}, 2.0}},
      {"sun_of_angle_0", DistantLight{{0.6, -1, 0.1}, 0.0}},
      {"sun_of_120_degrees", DistantLight{{0.6, -1, 0.1}, 120.0}},
  };
}

}  // namespace

void judge_lights(Report& report) {
  if (!report.wants("lights")) return;
  const Scene usual = scene_named("ground_2e1");
  JudgedScene base(usual);
  for (const bool casts : {false, true})
    for (const OddLight& light : odd_lights()) {
      const std::string line = std::string("lights/") + light.name + (casts ? "_casting_floor" : "");
      if (!report.wants(line)) continue;
      Scene scene = usual;
      scene.lights.front().shape = light.shape;
      scene.objects.front().casts = casts;
      JudgedScene judged(std::move(scene));
      judge_all(report, line, judged, &base, contenders());
    }
}

}  // namespace penumbra::yardstick
