#include "apps/cli/judge.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <mutex>
#include <random>

namespace penumbra::apps {
namespace {

constexpr std::uint64_t kChoice = 0xd1b54a32d192ed03;  // of the pixels: the same for every picture

std::vector<TriangleMesh> casters_of(const Scene& scene) {
  std::vector<TriangleMesh> meshes;
  for (const SceneObject& object : scene.objects)
    if (object.casts) meshes.push_back(object.mesh);
  return meshes;
}

}  // namespace

Judge::Judge(const Scene& scene, const DiskLight& light) : light_(light), oracle_(casters_of(scene)) {
  std::int32_t casters = 0;
  for (const SceneObject& object : scene.objects) caster_of_.push_back(object.casts ? casters++ : -1);
}

std::vector<float> Judge::visibility(const SurfaceBuffer& surface, const std::vector<std::uint32_t>& pixels,
                                     int samples, std::uint64_t seed, const Progress& progress) const {
  std::vector<float> out(pixels.size());
  std::atomic<std::size_t> done{0};
  std::atomic<bool> stop{false};
  std::mutex reporting;
  tbb::parallel_for(std::size_t{0}, pixels.size(), [&](std::size_t k) {
    if (stop) return;
    const std::uint32_t i = pixels[k];
    const std::int32_t caster = caster_of_[static_cast<std::size_t>(surface.object[i])];
    std::optional<oracle::CasterFace> own;
    if (caster >= 0) own = oracle::CasterFace{static_cast<std::uint32_t>(caster), FaceId{surface.face[i]}};
    // Each pixel has a seed of its own, so that errors of neighbors do not add up.
    out[k] = static_cast<float>(oracle_.visibility(surface.position[i], surface.normal[i], own, light_,
                                                   samples, seed + 0x9e3779b97f4a7c15 * (i + 1)));
    ++done;
    if (!progress) return;
    const std::unique_lock lock(reporting, std::try_to_lock);
    if (lock && !progress(static_cast<double>(done) / static_cast<double>(pixels.size()))) stop = true;
  });
  if (stop) throw Cancelled();
  return out;
}

std::vector<std::uint32_t> some_of(std::vector<std::uint32_t> pixels, std::size_t count) {
  if (pixels.size() <= count) return pixels;
  std::mt19937_64 random(kChoice);
  for (std::size_t k = 0; k < count; ++k) std::swap(pixels[k], pixels[k + random() % (pixels.size() - k)]);
  pixels.resize(count);
  std::sort(pixels.begin(), pixels.end());
  return pixels;
}

}  // namespace penumbra::apps
