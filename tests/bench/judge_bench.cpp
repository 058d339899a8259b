// Methods against the oracle: rays in double without offset, which share nothing with what they judge.
#include <tbb/parallel_for.h>

#include <cstdio>
#include <optional>
#include <random>

#include "penumbra/render/renderer.h"
#include "tests/bench/bench_support.h"
#include "tests/oracle/oracle.h"

namespace penumbra::bench {
namespace {

constexpr std::size_t kPixels = 20'000;  // of those that see a surface, chosen by chance
constexpr int kOracleRays = 1'024, kReferenceRays = 4'096;

std::vector<std::uint32_t> chosen_pixels(const SurfaceBuffer& surface) {
  std::vector<std::uint32_t> seen;
  for (std::uint32_t i = 0; i < surface.size(); ++i)
    if (surface.hit(i)) seen.push_back(i);
  std::mt19937_64 random(4);
  std::shuffle(seen.begin(), seen.end(), random);
  seen.resize(std::min(seen.size(), kPixels));
  return seen;
}

/// Visibility of the chosen pixels by the oracle.
class OracleTruth {
 public:
  OracleTruth(const Scene& scene, const SurfaceBuffer& surface, const std::vector<std::uint32_t>& pixels)
      : first_(pixels.size()), second_(pixels.size()) {
    std::vector<TriangleMesh> casters;
    std::vector<std::int32_t> caster_of;
    for (const SceneObject& object : scene.objects) {
      caster_of.push_back(object.casts ? static_cast<std::int32_t>(casters.size()) : -1);
      if (object.casts) casters.push_back(object.mesh);
    }
    const oracle::Oracle oracle(casters);
    const DiskLight& light = require_disk(shape_of(scene), "the oracle");
    tbb::parallel_for(std::size_t{0}, pixels.size(), [&](std::size_t k) {
      const std::uint32_t i = pixels[k];
      const std::int32_t caster = caster_of[static_cast<std::size_t>(surface.object[i])];
      std::optional<oracle::CasterFace> own;
      if (caster >= 0) own = oracle::CasterFace{static_cast<std::uint32_t>(caster), FaceId{surface.face[i]}};
      const auto ask = [&](std::uint64_t seed) {
        return static_cast<float>(
            oracle.visibility(surface.position[i], surface.normal[i], own, light, kOracleRays, seed));
      };
      first_[k] = ask(2 * i), second_[k] = ask(2 * i + 1);
    });
    std::vector<std::uint32_t> all(pixels.size());
    std::iota(all.begin(), all.end(), 0u);
    penumbra_ = true_penumbra(first_, second_, all);
  }
  /// Of values at the chosen pixels, over true penumbra.
  double rmse(const std::vector<float>& values) const {
    return error_figures(values, first_, second_, penumbra_).rmse;
  }
  std::size_t penumbra() const { return penumbra_.size(); }

 private:
  std::vector<float> first_, second_;
  std::vector<std::uint32_t> penumbra_;
};

void measure(Record& record, const std::string& name) {
  Renderer renderer(bench_scene(name));
  const Scene& scene = renderer.scene();
  const RenderResult exact = renderer.render({.method = "silhouette"});
  const std::vector<std::uint32_t> pixels = chosen_pixels(exact.surface);
  const OracleTruth truth(scene, exact.surface, pixels);
  const auto at_pixels = [&](const std::vector<float>& visibility) {
    std::vector<float> out;
    for (const std::uint32_t i : pixels) out.push_back(visibility[i]);
    return out;
  };
  record.add(name + "/pixels in penumbra", "pixels", static_cast<double>(truth.penumbra()));
  record.add(name + "/silhouette", "1", truth.rmse(at_pixels(exact.lights.front().visibility)));
  const RenderResult d_buffer = renderer.render({.method = "dbuffer"});
  record.add(name + "/dbuffer", "1", truth.rmse(at_pixels(d_buffer.lights.front().visibility)));
  const RayScene rays(scene, 0);
  record.add(name + "/reference", "1",
             truth.rmse(trace_reference(rays, shape_of(scene), exact.surface.receivers(), pixels,
                                        {.samples = kReferenceRays})
                            .visibility));
}

}  // namespace

void bench_judge(Record& record, const SceneNames& scenes) {
  for (const std::string& name : scenes) measure(record, name);
}

}  // namespace penumbra::bench
