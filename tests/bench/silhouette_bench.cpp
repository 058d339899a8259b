// The silhouette method against rays, visibility alone; what is certified; how frames grow with faces and
// with the light.
#include <algorithm>
#include <cstdio>
#include <string>

#include "penumbra/mesh/shapes.h"
#include "render/rays/camera_rays.h"
#include "render/silhouette/edge_hierarchies.h"
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

/// A scene ready to be timed: rays, hierarchies and receivers are made once.
class Stand {
 public:
  explicit Stand(Scene of)
      : scene_(std::move(of)),
        rays_(scene_, 0),
        hierarchies_(scene_),
        surface_(make_surface_buffer(scene_, rays_, 640, 480)) {}
  Stand(const Stand&) = delete;

  SilhouetteResult frame(const SilhouetteOptions& options = {}) {
    return silhouette_visibility(scene_, rays_, hierarchies_, testing::light_of(scene_), surface_.receivers(),
                                 options);
  }
  ReferenceResult trace(const std::vector<std::uint32_t>& pixels, int samples,
                        bool unoccluded = false) const {
    ReferenceOptions options;
    options.samples = samples;
    return trace_reference(rays_, shape_of(scene_), surface_.receivers(), pixels, options, unoccluded);
  }
  const Scene& scene() const { return scene_; }
  const RayScene& rays() const { return rays_; }
  const SurfaceBuffer& surface() const { return surface_; }
  double hierarchy_ms() const { return hierarchies_.milliseconds(); }

 private:
  Scene scene_;
  RayScene rays_;
  detail::EdgeHierarchies hierarchies_;
  SurfaceBuffer surface_;
};

/// One frame by each method, so that whatever else the machine does meets all three.
void time_frame(Stand& stand, Times& times) {
  times.silhouette.push_back(total_ms(stand.frame().stages));
  SilhouetteOptions certify;
  certify.integrate = false;
  const SilhouetteResult certified = stand.frame(certify);
  times.rays.push_back(total_ms(certified.stages) + stand.trace(certified.open, kSamples).milliseconds);
  times.reference.push_back(stand.trace(all_pixels(stand.surface()), kSamples).milliseconds);
}

/// Of the pixels that no face overlaps those that are certified lit, by geometry; of those that no one of
/// 1,024 rays without the horizon finds free, those that are certified to be in umbra.
struct CertifiedShares {
  double lit, umbra;
};

CertifiedShares certified_shares(const Stand& stand, const std::vector<std::int8_t>& region) {
  std::vector<std::uint32_t> open;
  double umbra = 0.0, may_be_umbra = 0.0;
  for (std::uint32_t i = 0; i < region.size(); ++i) {
    if (!stand.surface().hit(i)) continue;
    if (region[i] < 0) open.push_back(i);
    umbra += region[i] == 2 ? 1.0 : 0.0;
  }
  for (const float o : stand.trace(open, 1024, true).unoccluded) may_be_umbra += o == 0.0f ? 1.0 : 0.0;
  const double lit =
      testing::certified_share_of_free(stand.scene(), stand.surface(), region, 5'000'000).share;
  return {lit, umbra + may_be_umbra > 0.0 ? umbra / (umbra + may_be_umbra) : 1.0};
}

/// The frame, and how many times that of the first stand it takes; frames of both are interleaved.
void time_growth(Record& record, const std::string& what, Stand& first, Stand& stand) {
  constexpr int kPairs = 25;
  std::vector<double> times, before;
  for (int i = 0; i <= kPairs; ++i) {
    const double one = total_ms(first.frame().stages), other = total_ms(stand.frame().stages);
    if (i == 0) continue;  // warms up
    before.push_back(one);
    times.push_back(other);
  }
  const SilhouetteCounts c = stand.frame().counts;
  const std::string path = what + "/" + std::to_string(c.faces) + " faces";
  record.add(path + "/band edges", "1", static_cast<double>(c.band_edges));
  record.add(path + "/visibility", "ms", times);
  record.add(path + "/times the first", "1", paired_ratios(times, before));
}

void time_radii(Record& record, const std::string& name) {
  for (const double scale : {0.25, 0.5, 1.0, 2.0, 4.0}) {
    Scene scene = bench_scene(name);
    testing::light_of(scene).radius *= scale;
    Stand stand(scene);
    Times times;
    for (int i = 0; i <= kFrames; ++i) time_frame(stand, times);
    char radius[16];
    std::snprintf(radius, sizeof radius, "%g", testing::light_of(scene).radius);
    const std::string path = name + "/radius " + radius;
    record.add(path + "/silhouette", "ms", times.silhouette);
    record.add(path + "/rays", "ms", times.rays);
    record.add(path + "/reference", "ms", times.reference);
  }
}

void time_scene(Record& record, const std::string& name) {
  Stand stand(bench_scene(name));
  Times times;
  for (int i = 0; i <= kFrames; ++i) {
    if (i == 1) times = {};  // the first frame warms up
    time_frame(stand, times);
  }
  const SilhouetteResult r = stand.frame();
  const CertifiedShares shares = certified_shares(stand, r.region);
  const auto each = [](std::size_t sum, std::size_t count) {
    return static_cast<double>(sum) / static_cast<double>(std::max<std::size_t>(1, count));
  };
  const Truth truth(stand.scene(), stand.rays(), stand.surface(), 1024);
  const ErrorFigures error = error_figures(r.visibility, truth.first, truth.second, truth.penumbra);
  record.add(name + "/RMSE", "1", error.rmse);
  record.add(name + "/RMSE at least", "1", error.rmse_low);
  record.add(name + "/RMSE at most", "1", error.rmse_high);
  record.add(name + "/silhouette", "ms", times.silhouette);
  record.add(name + "/rays : silhouette", "1", paired_ratios(times.rays, times.silhouette));
  record.add(name + "/reference : silhouette", "1", paired_ratios(times.reference, times.silhouette));
  record.add(name + "/edges across the disk", "a receiver", each(r.counts.segments, r.counts.integrated));
  record.add(name + "/certified of lit", "1", shares.lit);
  record.add(name + "/certified of umbra", "1", shares.umbra);
  record.add(name + "/lists", "MiB", static_cast<double>(r.counts.bytes) / 1048576.0);
  record.add(name + "/hierarchy of edges", "ms", stand.hierarchy_ms());
  record.add(name + "/hierarchy of faces", "ms", stand.rays().build_ms());
}

}  // namespace

void bench_silhouette(Record& record, const SceneNames& scenes) {
  for (const std::string& name : scenes) time_scene(record, name);
}

void bench_growth(Record& record, const SceneNames&) {
  Scene scene = bench_scene("sphere-medium");
  SceneObject& caster = scene.objects.back();
  const Bounds box = bounds_of(caster.mesh.positions());
  const auto sphere = [&](int levels) {
    caster.mesh = make_icosphere(box.center(), 0.5 * (box.high.x - box.low.x), levels);
    return scene;
  };
  Stand coarse_sphere(sphere(3));
  for (int levels = 3; levels <= 8; ++levels) {
    Stand stand(sphere(levels));
    time_growth(record, "sphere", coarse_sphere, stand);
  }
  Scene torus = bench_scene("torus-medium");
  Stand coarse_torus(torus);
  for (int i = 0; i <= 5; ++i) {
    if (i > 0) torus.objects.back().mesh = testing::cut_in_four(torus.objects.back().mesh);
    Stand stand(torus);
    time_growth(record, "torus, cut in four", coarse_torus, stand);
  }
  time_radii(record, "knot1-medium");
}

}  // namespace penumbra::bench
