// The silhouette method against rays: medians of interleaved frames, visibility alone; what is certified; and how
// frames grow with faces and with the light.
#include <cstdio>
#include <string>

#include "penumbra/mesh/shapes.h"
#include "render/silhouette/silhouette_visibility.h"
#include "tests/bench/bench_support.h"
#include "tests/render/silhouette/face_overlap.h"
#include "tests/render/silhouette/subdivide.h"

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

/// Of the pixels that no face overlaps those that are certified lit, by geometry; of those that no one of
/// 1,024 rays without the horizon finds free, those that are certified to be in umbra.
struct CertifiedShares {
  double lit, umbra;
};

CertifiedShares certified_shares(const Scene& scene, const RayScene& rays, const SurfaceBuffer& surface,
                                 const std::vector<std::int8_t>& region) {
  std::vector<std::uint32_t> open;
  double umbra = 0.0, may_be_umbra = 0.0;
  for (std::uint32_t i = 0; i < region.size(); ++i) {
    if (!surface.hit(i)) continue;
    if (region[i] < 0) open.push_back(i);
    umbra += region[i] == 2 ? 1.0 : 0.0;
  }
  ReferenceOptions options;
  options.samples = 1024;
  for (const float o : trace_reference(scene, rays, surface, open, options, true).unblocked)
    may_be_umbra += o == 0.0f ? 1.0 : 0.0;
  return {testing::certified_share_of_free(scene, rays, surface, region, 5'000'000).share,
          umbra + may_be_umbra > 0.0 ? umbra / (umbra + may_be_umbra) : 1.0};
}

/// A scene ready to be timed.
struct Stand {
  explicit Stand(const Scene& of)
      : scene(of), rays(scene, 0), surface(make_surface_buffer(scene, rays, 640, 480)) {}
  SilhouetteResult frame() const { return silhouette_visibility(scene, rays, surface); }
  Scene scene;
  RayScene rays;
  SurfaceBuffer surface;
};

/// One line: faces, band edges, median frame, and as a multiple of the first scene's; frames of both are
/// interleaved.
void time_growth(const char* what, const Stand& first, const Stand& stand) {
  constexpr int kPairs = 25;
  std::vector<double> times, ratios;
  for (int i = 0; i <= kPairs; ++i) {
    const double before = total(first.frame().stages), time = total(stand.frame().stages);
    if (i == 0) continue;  // warms up
    times.push_back(time);
    ratios.push_back(time / before);
  }
  const SilhouetteCounts c = stand.frame().counts;
  std::printf("%-24s %8zu faces, %7zu edges in the band: %7.1f ms, %.2f× the first; %.1f MiB\n", what,
              c.faces, c.band_edges, median(times), median(ratios), static_cast<double>(c.bytes) / 1048576.0);
  std::fflush(stdout);
}

Scene bench_scene(const std::string& name) {
  return load_scene(std::string(PENUMBRA_DATA) + "/scenes/" + name + ".json").scene;
}

}  // namespace

void time_silhouettes(const std::string& name) {
  const Scene scene = bench_scene(name);
  const RayScene rays(scene, 0);
  const SurfaceBuffer surface = make_surface_buffer(scene, rays, 640, 480);
  Times times;
  for (int i = 0; i <= kFrames; ++i) {
    if (i == 1) times = {};  // the first frame warms up
    time_frame(scene, rays, surface, times);
  }
  const SilhouetteResult r = silhouette_visibility(scene, rays, surface);
  const SilhouetteCounts& c = r.counts;
  const CertifiedShares shares = certified_shares(scene, rays, surface, r.region);
  const double ours = median(times.silhouette);
  std::printf(
      "%-24s silhouette %8.1f ms; rays %d only where open %6.1f×, everywhere %6.1f× that; %zu integrated, "
      "%.1f edges each of %.1f listed; certified: %.4f of what no face overlaps, %.3f of umbra; %.1f MiB of "
      "lists, "
      "peak %.0f MiB\n",
      name.c_str(), ours, kSamples, median(times.rays) / ours, median(times.reference) / ours, c.integrated,
      static_cast<double>(c.segments) / static_cast<double>(std::max<std::size_t>(1, c.integrated)),
      static_cast<double>(c.listed_edges) /
          static_cast<double>(std::max<std::size_t>(1, c.tiles - c.empty_tiles)),
      shares.lit, shares.umbra, static_cast<double>(c.bytes) / 1048576.0, peak_memory_mib());
  std::fflush(stdout);
}

void time_silhouette_growth() {
  Scene scene = bench_scene("sphere-medium");
  SceneObject& caster = scene.objects.back();
  const Bounds box = bounds_of(caster.mesh.positions());
  const auto sphere = [&](int levels) {
    caster.mesh = make_icosphere(box.center(), 0.5 * (box.high.x - box.low.x), levels);
    return Stand(scene);
  };
  const Stand coarse_sphere = sphere(3);
  for (int levels = 3; levels <= 8; ++levels) time_growth("sphere", coarse_sphere, sphere(levels));
  Scene torus = bench_scene("torus-medium");
  const Stand coarse_torus(torus);
  for (int i = 0; i <= 5; ++i) {
    if (i > 0) torus.objects.back().mesh = testing::cut_in_four(torus.objects.back().mesh);
    time_growth("torus, cut in four", coarse_torus, Stand(torus));
  }
  for (const double scale : {0.25, 0.5, 1.0, 2.0, 4.0}) {
    scene = bench_scene("knot1-medium");
    scene.light.radius *= scale;
    const RayScene rays(scene, 0);
    const SurfaceBuffer surface = make_surface_buffer(scene, rays, 640, 480);
    Times times;
    for (int i = 0; i <= kFrames; ++i) time_frame(scene, rays, surface, times);
    std::printf("knot1, radius %-9.3g silhouette %7.1f ms, rays only where open %7.1f, everywhere %7.1f\n",
                scene.light.radius, median(times.silhouette), median(times.rays), median(times.reference));
    std::fflush(stdout);
  }
}

}  // namespace penumbra::bench
