#include <algorithm>
#include <cmath>
#include <numbers>

#include "penumbra/render/renderer.h"
#include "render/silhouette/areas/visible_area.h"
#include "render/silhouette/edges/unit_light.h"
#include "tests/render/silhouette/areas/area_by_columns.h"
#include "tests/render/silhouette/areas/regular_patterns.h"
#include "tests/yardstick/judging.h"
#include "tests/yardstick/parts.h"

namespace penumbra::yardstick {
namespace {

constexpr int kOfEachKind = 40;

/// V as the silhouette method would have it: rays to the aims tell whether anything is visible.
double seen(const testing::RegularPattern& pattern, detail::VisibleArea& visible_area,
            detail::VisibleAreaResult& out) {
  const detail::DiskPart part(pattern.horizon);
  detail::ClippedSegments clipped;
  detail::clip_segments(pattern.segments, 0, part, clipped);
  visible_area.compute(clipped, part, SilhouetteOptions().rows, 0.0, out);
  const bool is_free = std::ranges::any_of(
      out.aims, [&](const glm::dvec2& aim) { return testing::faces_over(pattern.segments, aim) == 0; });
  return is_free ? out.area / std::numbers::pi : 0.0;
}

struct KindFigures {
  int count = 0, exact = 0, unresolved = 0;
  double squares = 0.0, most = 0.0;
};

KindFigures figures_of(int kind, int kinds) {
  detail::VisibleArea visible_area;
  KindFigures f;
  for (int i = 0; i < kOfEachKind; ++i) {
    const testing::RegularPattern pattern = testing::regular_pattern(kind + kinds * i, 700);
    detail::VisibleAreaResult result;
    const double error =
        seen(pattern, visible_area, result) -
        testing::AreaByColumns(pattern.segments, pattern.horizon.normal, pattern.horizon.delta).visible();
    ++f.count;
    f.exact += result.method == detail::AreaMethod::kSlabs ? 1 : 0;
    f.unresolved += result.resolved ? 0 : 1;
    f.squares += error * error;
    f.most = std::max(f.most, std::abs(error));
  }
  return f;
}

/// Layers of slats above a floor, under a disk. Angles are those that the slats are seen under on the light,
/// against the first family of rows; periods are as the floor's middle sees them, light radii.
struct Layers {
  std::string name;
  struct Layer {
    double degrees, period, duty, height;
  };
  std::vector<Layer> layers;
};

std::vector<Layers> scenes_of_layers() {
  constexpr double kRow = 2.0 / 64.0, kOther = -71.05;
  return {{"blinds", {{0.0, kRow, 0.5, 2.0}}},
          {"blinds_beside", {{0.5, 1.01 * kRow, 0.5, 2.0}}},
          {"blinds_other", {{kOther, 4.0 / 3.0 * kRow, 0.5, 2.0}}},
          {"slits", {{0.0, 2.0 * kRow, 0.95, 2.0}}},
          {"wires", {{0.2, 3.0 * kRow, 0.05, 2.0}}},
          {"moire", {{0.0, kRow, 0.5, 2.0}, {0.4, 1.03 * kRow, 0.5, 1.9}}},
          {"crossed", {{0.0, 2.0 * kRow, 0.4, 2.0}, {90.0, 2.0 * kRow, 0.4, 1.95}}},
          {"both_families", {{0.0, 2.0 * kRow, 0.4, 2.0}, {kOther, 8.0 / 3.0 * kRow, 0.4, 1.95}}},
          {"lattice", {{45.0, 2.828 * kRow, 0.5, 2.0}, {-45.0, 2.828 * kRow, 0.5, 1.95}}},
          {"lattice_low", {{20.0, 1.88 * kRow, 0.4, 2.0}, {-20.0, 1.88 * kRow, 0.4, 1.95}}}};
}

constexpr double kLightHeight = 4.0, kRadius = 0.5;

/// A layer's slats. `degrees` count from the first axis of the frame in which rows lie along it.
TriangleMesh slats_of(const Layers::Layer& layer, const DiskLight& light) {
  const double angle = layer.degrees * std::numbers::pi / 180.0;
  const detail::UnitLight frame(light);
  const Vec3 along = frame.world_direction({std::cos(angle), std::sin(angle), 0});
  const Vec3 across = frame.world_direction({-std::sin(angle), std::cos(angle), 0});
  const double scale =
      kRadius * layer.height / kLightHeight;  // what the floor sees at the light, at the layer
  const double step = layer.period * scale;
  std::vector<Vec3> corners;
  std::vector<IndexedTriangle> faces;
  const int count = static_cast<int>(1.5 / step);
  for (int k = -count; k <= count; ++k) {
    const auto first = static_cast<std::uint32_t>(corners.size());
    for (const double y : {k * step, (k + layer.duty) * step})
      for (const double x : {-1.5, 1.5}) corners.push_back(Vec3(0, layer.height, 0) + x * along + y * across);
    faces.push_back({first, first + 1, first + 3});
    faces.push_back({first, first + 3, first + 2});
  }
  return TriangleMesh::build(corners, faces);
}

Scene scene_of(const Layers& layers) {
  Scene scene;
  const DiskLight light{{0, kLightHeight, 0}, {0, -1, 0}, kRadius};
  scene.lights.push_back({.shape = light});
  scene.camera = {{0.3, 1.2, 0.9}, {0, 0, 0}, {0, 1, 0}, 50};
  const std::vector<Vec3> floor{{-9, 0, -9}, {9, 0, -9}, {9, 0, 9}, {-9, 0, 9}};
  scene.objects.push_back({"floor",
                           TriangleMesh::build(floor, std::vector<IndexedTriangle>{{0, 2, 1}, {0, 3, 2}}),
                           Vec3(0.8), false});
  for (std::size_t i = 0; i < layers.layers.size(); ++i)
    scene.objects.push_back({text("layer %zu", i), slats_of(layers.layers[i], light), Vec3(0.8), true});
  return scene;
}

}  // namespace

void judge_patterns(Report& report) {
  const auto& kinds = testing::pattern_kinds();
  for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
    const std::string name = "patterns/" + kinds[kind] + "/silhouette";
    if (!report.wants(name)) continue;
    const KindFigures f = figures_of(static_cast<int>(kind), static_cast<int>(kinds.size()));
    const double rmse = std::sqrt(f.squares / f.count);
    report.add(name, rmse <= kPatternLimits.rmse && f.most <= kPatternLimits.most && f.unresolved == 0,
               text("%d patterns, RMSE %.5f, at most %.4f; exact %d, unresolved %d", f.count, rmse, f.most,
                    f.exact, f.unresolved));
  }
  for (const Layers& layers : scenes_of_layers()) {
    const std::string name = "patterns/scene_" + layers.name;
    if (!report.wants(name + "/silhouette")) continue;
    JudgedScene scene(scene_of(layers));
    const Verdict& v = scene.verdict(contender("silhouette"));
    report.add(name + "/silhouette",
               v.trouble.empty() && v.penumbra > 1000 && v.rmse <= kPatternLimits.rmse &&
                   v.most <= kPatternLimits.most && v.contradicted == 0,
               text_of(v));
  }
}

}  // namespace penumbra::yardstick
