#include <algorithm>
#include <filesystem>
#include <map>
#include <string>

#include "render/rays/camera_rays.h"
#include "tests/render/silhouette/merge/merged_difference.h"
#include "tests/yardstick/parts.h"

namespace penumbra::yardstick {
namespace {

constexpr std::uint64_t kCasters = 300;
constexpr int kMostFaces = 100'000;
// Limits of what merging faces does to V: anywhere, and over each caster's penumbra.
constexpr double kMostMoved = 0.01, kMostRmse = 0.001;

/// Of casters of one kind of body.
struct KindOfBody {
  std::string name;
  int casters = 0, merged = 0, moved_too_far = 0;
  double worst_rmse = 0.0;
  testing::MergedDifference all;

  void add(const testing::MergedDifference& d) {
    ++casters;
    merged += d.merged > 0 ? 1 : 0;
    moved_too_far += d.most > kMostMoved || d.rmse() > kMostRmse ? 1 : 0;
    worst_rmse = std::max(worst_rmse, d.rmse());
    all += d;
  }
  void report(Report& report) const {
    report.add(
        name, casters > 0 && merged > 0 && moved_too_far == 0 && all.contradictions == 0,
        text("%d casters, %d with merged faces, %d moved too far: at most %.5f, RMSE up to %.5f; wrong %zu",
             casters, merged, moved_too_far, all.most, worst_rmse, all.contradictions));
  }
};

}  // namespace

void judge_merging(Report& report) {
  const std::string bump = "merging/bump_plate/silhouette";
  if (report.wants(bump)) {
    const Scene scene =
        load_scene(std::filesystem::path(PENUMBRA_DATA) / "regressions/merging/bump_plate.json").scene;
    KindOfBody kind;
    kind.name = bump;
    kind.add(testing::merged_difference(scene, make_surface_buffer(scene, RayScene(scene, 0), 640, 480)));
    kind.report(report);
  }

  std::map<bool, KindOfBody> kinds;  // flat or not
  for (const bool flat : {true, false})
    if (const std::string name = flat ? "merging/plates/silhouette" : "merging/bodies/silhouette";
        report.wants(name))
      kinds[flat].name = name;
  if (kinds.empty()) return;
  for (std::uint64_t seed = 1; seed <= kCasters; ++seed) {
    const testing::AdversarialScene s = testing::adversarial_scene(seed, kMostFaces);
    const auto kind = kinds.find(s.body == "plate" || s.body == "slab");
    if (kind != kinds.end()) kind->second.add(testing::merged_difference(s.scene, s.receivers));
  }
  for (const auto& [flat, kind] : kinds) kind.report(report);
}

}  // namespace penumbra::yardstick
