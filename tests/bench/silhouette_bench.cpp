// The accurate rung against rays: medians of interleaved frames, visibility alone.
#include <cstdio>
#include <string>

#include "render/silhouette.h"
#include "tests/bench/bench_support.h"

namespace penumbra::bench {
namespace {

constexpr int kFrames = 5;
constexpr int kSamples = 256;

struct Times {
  std::vector<double> silhouette, rays, reference;
};

double total(const std::vector<StageTime>& stages) {
  double sum = 0.0;
  for (const StageTime& s : stages) sum += s.milliseconds;
  return sum;
}

/// One frame by each method, so that whatever else the machine does meets all three.
void time_frame(const Scene& scene, const RayScene& rays, const SurfaceBuffer& surface, Times& times) {
  ReferenceOptions options;
  options.samples = kSamples;
  times.silhouette.push_back(total(silhouette_visibility(scene, rays, surface).stages));
  SilhouetteOptions certify;
  certify.integrate = false;
  const SilhouetteResult certified = silhouette_visibility(scene, rays, surface, certify);
  const ReferenceResult open = trace_reference(scene, rays, surface, certified.open, options);
  times.rays.push_back(total(certified.stages) + open.milliseconds);
  std::vector<std::uint32_t> pixels(surface.size());
  std::iota(pixels.begin(), pixels.end(), 0u);
  times.reference.push_back(trace_reference(scene, rays, surface, pixels, options).milliseconds);
}

}  // namespace

void time_silhouettes(const std::string& name) {
  const Scene scene = load_scene(std::string(PENUMBRA_DATA) + "/scenes/" + name + ".json").scene;
  const RayScene rays(scene, 0);
  const SurfaceBuffer surface = make_surface_buffer(scene, rays, 640, 480);
  Times times;
  for (int i = 0; i <= kFrames; ++i) {
    if (i == 1) times = {};  // the first frame warms up
    time_frame(scene, rays, surface, times);
  }
  const SilhouetteCounts c = silhouette_visibility(scene, rays, surface).counts;
  const double ours = median(times.silhouette);
  std::printf(
      "%-24s silhouette %8.1f ms; rays %d only where open %6.1f×, everywhere %6.1f× that; %zu integrated, "
      "%.1f "
      "edges each of %.1f listed; %.1f MiB of lists\n",
      name.c_str(), ours, kSamples, median(times.rays) / ours, median(times.reference) / ours, c.integrated,
      static_cast<double>(c.segments) / static_cast<double>(std::max<std::size_t>(1, c.integrated)),
      static_cast<double>(c.listed_edges) /
          static_cast<double>(std::max<std::size_t>(1, c.tiles - c.empty_tiles)),
      static_cast<double>(c.bytes) / 1048576.0);
  std::fflush(stdout);
}

}  // namespace penumbra::bench
