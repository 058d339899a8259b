#include <algorithm>
#include <filesystem>

#include "apps/cli/compare/judge.h"
#include "tests/render/random_poses.h"
#include "tests/yardstick/judging.h"
#include "tests/yardstick/parts.h"

namespace penumbra::yardstick {
namespace {

constexpr PictureSize kSize{320, 240};
constexpr int kRays = 256, kNear = 2;
constexpr std::size_t kOthers = 10'000;
constexpr std::uint64_t kSeed = 3;

/// Closed, open, with holes, not manifold, in many pieces: those of the tests of certificates.
const char* const kMeshes[] = {"armadillo.ply",  "blobby-shuffled.ply",     "bunny.ply",   "dog-house.ply",
                               "doll-house.ply", "elephant-with-holes.ply", "fandisk.ply", "homer.ply",
                               "knot1.ply",      "snowden_lo.ply"};
constexpr std::uint64_t kPoses = 10, kFirstPose = 20'240'917;

/// Certified pixels near one that is not, and some of the others.
std::vector<std::uint32_t> suspects(const std::vector<std::int8_t>& region) {
  std::vector<std::uint32_t> near, others;
  for (int y = 0; y < kSize.height; ++y)
    for (int x = 0; x < kSize.width; ++x) {
      const auto at = [&](int i, int j) {
        return region[static_cast<std::size_t>(std::clamp(j, 0, kSize.height - 1) * kSize.width +
                                               std::clamp(i, 0, kSize.width - 1))];
      };
      const auto i = static_cast<std::uint32_t>(y * kSize.width + x);
      if (region[i] != 0 && region[i] != 2) continue;
      bool is_near = false;
      for (int v = -kNear; v <= kNear; ++v)
        for (int u = -kNear; u <= kNear; ++u) is_near = is_near || at(x + u, y + v) != region[i];
      (is_near ? near : others).push_back(i);
    }
  others = apps::some_of(std::move(others), kOthers);
  near.insert(near.end(), others.begin(), others.end());
  return near;
}

void judge_scene(Report& report, const std::string& line, const Scene& scene) {
  Contender method = contender("silhouette");
  method.size = kSize;
  JudgedScene judged(scene);
  if (!judged.takes(method)) return;
  const RenderResult picture = judged.draw(method);
  const SurfaceBuffer surface = apps::surface_by_oracle(scene, kSize.width, kSize.height);
  std::size_t certified = 0, wrong = 0;
  for (std::size_t k = 0; k < scene.lights.size(); ++k) {
    const std::vector<std::int8_t>& region = picture.lights[k].region;
    std::vector<std::uint32_t> pixels = suspects(region);
    std::erase_if(pixels, [&](std::uint32_t i) {
      return !surface.hit(i) || surface.object[i] != picture.surface.object[i] ||
             surface.face[i] != picture.surface.face[i];
    });
    certified += pixels.size();
    const std::vector<float> values(region.begin(), region.end());
    wrong +=
        apps::Judge(scene, scene.lights[k].shape).contradicted(surface, pixels, values, kRays, kSeed).size();
  }
  report.add(line, certified > 0 && wrong == 0, text("%6zu certificates, wrong %zu", certified, wrong));
}

}  // namespace

void judge_certificates(Report& report) {
  if (!report.wants("certificates")) return;
  std::vector<std::string> scenes;
  for (const auto& entry : std::filesystem::directory_iterator(PENUMBRA_DATA "/scenes"))
    if (entry.path().extension() == ".json") scenes.push_back(entry.path().stem().string());
  std::ranges::sort(scenes);
  for (const std::string& name : scenes)
    if (report.wants("certificates/" + name))
      report.attempt("certificates/" + name,
                     [&] { judge_scene(report, "certificates/" + name, scene_named(name)); });
  for (const char* mesh : kMeshes)
    for (std::uint64_t pose = 0; pose < kPoses; ++pose) {
      const std::string line = "certificates/" + std::filesystem::path(mesh).stem().string() +
                               text("_pose_%d", static_cast<int>(pose));
      if (!report.wants(line)) continue;
      report.attempt(line, [&] {
        judge_scene(
            report, line,
            testing::load_pose(testing::random_pose(std::string("meshes/") + mesh, kFirstPose + pose)));
      });
    }
}

}  // namespace penumbra::yardstick
