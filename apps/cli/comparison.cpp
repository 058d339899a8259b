#include "apps/cli/comparison.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>

#include "apps/cli/judge.h"
#include "apps/common/messages.h"
#include "penumbra/mesh/error.h"
#include "render/rays/camera_rays.h"
#include "render/rays/ray_scene.h"
#include "render/rays/reference.h"

namespace penumbra::apps {
namespace {

// Rays in float may decide an outline's pixel otherwise on another machine. More disagreement than this means
// another scene or camera.
constexpr double kMaxDisagreement = 1e-3;
// Of P, relative to the scene: channels are float, positions double.
constexpr double kPositionTolerance = 1e-5;

constexpr int kResamples = 65'536;
constexpr double kWorstFraction = 0.02;
constexpr std::size_t kWorstAtLeast = 1'000;
// Two references, then the worst pixels again. No seed that a person would give a rendering: against itself a
// noisy image would look free of error.
constexpr std::uint64_t kSeeds[3] = {0x9e3779b97f4a7c15, 0xbf58476d1ce4e5b9, 0x94d049bb133111eb};

// Receivers of the image: every pixel that sees a surface, of one object where asked.
std::vector<std::uint32_t> receivers(const Image& image, const Judged& judged) {
  const std::optional<int>& object = judged.object;
  const std::vector<float>& objects = image.at("object");
  const std::vector<float>& visibility = image.at(judged.channel());
  std::vector<std::uint32_t> pixels;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    if (!(objects[i] >= 0.0f) || (object && objects[i] != static_cast<float>(*object))) continue;
    if (!std::isfinite(visibility[i]))
      throw UsageError("visibility of pixel " + std::to_string(i) + " is not finite; render the image again");
    pixels.push_back(static_cast<std::uint32_t>(i));
  }
  if (pixels.empty())
    throw UsageError(object ? "no pixel sees object " + std::to_string(*object) + "; see the `object` channel"
                            : "no pixel sees a surface; there is nothing to compare");
  return pixels;
}

// Moves the pixels for which `agrees` is false out of the comparison; false where they are too many.
template <class Agrees>
bool keep_agreeing(Comparison& comparison, Agrees agrees) {
  std::vector<std::uint32_t>& judged = comparison.judged;
  const std::size_t before = judged.size();
  std::erase_if(judged, [&](std::uint32_t i) { return !agrees(i); });
  comparison.skipped = before - judged.size();
  return static_cast<double>(comparison.skipped) <= kMaxDisagreement * static_cast<double>(before);
}

bool same_point(const Image& image, const SurfaceBuffer& surface, std::size_t i, double tolerance) {
  if (image.at("object")[i] != static_cast<float>(surface.object[i])) return false;
  const Vec3 point(image.at("P.X")[i], image.at("P.Y")[i], image.at("P.Z")[i]);
  return glm::distance(point, surface.position[i]) <= tolerance;
}

struct References {
  std::vector<float> first, second;
};

std::vector<float> spread(const std::vector<float>& values, const std::vector<std::uint32_t>& pixels,
                          std::size_t size) {
  std::vector<float> image(size, 1.0f);
  for (std::size_t k = 0; k < pixels.size(); ++k) image[pixels[k]] = values[k];
  return image;
}

// Traces visibility at pixels of one scene, keeping count of rays.
class Tracer {
 public:
  Tracer(const RayScene& rays, const LightShape& light, const SurfaceBuffer& surface, Comparison& comparison)
      : rays_(rays), light_(light), surface_(surface), comparison_(comparison) {}

  std::vector<float> trace(const std::vector<std::uint32_t>& pixels, int samples, std::uint64_t seed,
                           const std::string& label) {
    ProgressLine progress(label);
    ReferenceResult result = trace_reference(rays_, light_, surface_.receivers(), pixels,
                                             {.samples = samples, .seed = seed}, false, progress.callback());
    comparison_.rays += result.rays;
    return std::move(result.visibility);
  }

 private:
  const RayScene& rays_;
  const LightShape& light_;
  const SurfaceBuffer& surface_;
  Comparison& comparison_;
};

std::vector<std::uint32_t> worst_pixels(const std::vector<float>& method, const Comparison& comparison) {
  std::vector<std::uint32_t> pixels = comparison.penumbra;
  const auto share = static_cast<std::size_t>(std::ceil(kWorstFraction * static_cast<double>(pixels.size())));
  const std::size_t count = std::min(pixels.size(), std::max(share, kWorstAtLeast));
  const auto error = [&](std::uint32_t i) { return std::abs(method[i] - comparison.reference[i]); };
  std::partial_sort(pixels.begin(), pixels.begin() + static_cast<std::ptrdiff_t>(count), pixels.end(),
                    [&](std::uint32_t a, std::uint32_t b) {
                      const float ea = error(a), eb = error(b);
                      return ea != eb ? ea > eb : a < b;
                    });
  pixels.resize(count);
  return pixels;
}

void set_figures(Comparison& comparison, const std::vector<float>& method, const References& references) {
  comparison.reference.resize(method.size());
  for (std::size_t i = 0; i < method.size(); ++i)
    comparison.reference[i] = 0.5f * references.first[i] + 0.5f * references.second[i];
  comparison.penumbra = true_penumbra(references.first, references.second, comparison.judged);
  comparison.all = error_figures(method, references.first, references.second, comparison.judged);
  comparison.in_penumbra = error_figures(method, references.first, references.second, comparison.penumbra);
}

// The largest errors are those in which the reference's noise had a share: only p99 and the maximum are
// corrected, since replacing chosen pixels would bias the means.
void resample_worst(Comparison& comparison, const std::vector<float>& method, References references,
                    Tracer& tracer) {
  const std::vector<std::uint32_t> pixels = worst_pixels(method, comparison);
  const std::vector<float> values = tracer.trace(pixels, kResamples, kSeeds[2], "worst pixels again");
  for (std::size_t k = 0; k < pixels.size(); ++k)
    references.first[pixels[k]] = references.second[pixels[k]] = comparison.reference[pixels[k]] = values[k];
  const auto correct = [&](ErrorFigures& figures, const std::vector<std::uint32_t>& selected) {
    const ErrorFigures again = error_figures(method, references.first, references.second, selected);
    figures.p99_absolute = again.p99_absolute;
    figures.max_absolute = again.max_absolute;
  };
  correct(comparison.all, comparison.judged);
  correct(comparison.in_penumbra, comparison.penumbra);
  comparison.resampled = pixels.size();
  comparison.resamples = kResamples;
}

/// Of several lights one has to be named.
void require_channel(const Image& image, const Judged& judged) {
  if (image.has(judged.channel())) return;
  std::string names;
  for (const auto& [name, values] : image.channels)
    if (name.starts_with("visibility.")) names += (names.empty() ? "" : ", ") + name.substr(11);
  if (!names.empty())
    throw UsageError("the image has several lights; choose one of " + names + " with --light");
}

std::size_t light_of(const Scene& scene, const Judged& judged) {
  if (!judged.light.empty()) return scene.light_index(judged.light);
  if (scene.lights.size() == 1) return 0;
  std::string names;
  for (const Light& light : scene.lights) names += (names.empty() ? "" : ", ") + light.name;
  throw UsageError("the scene has several lights; choose one of " + names + " with --light");
}

}  // namespace

Comparison compare_images(const Image& image, const Image& reference, const Judged& judged) {
  if (image.width != reference.width || image.height != reference.height)
    throw UsageError("the images differ in size: " + std::to_string(image.width) + "x" +
                     std::to_string(image.height) + " and " + std::to_string(reference.width) + "x" +
                     std::to_string(reference.height) + "; render both with the same --size");
  require_channel(image, judged);
  require_channel(reference, judged);
  Comparison comparison;
  comparison.judged = receivers(image, judged);
  const std::vector<float>& theirs = reference.at("object");
  if (!keep_agreeing(comparison, [&](std::uint32_t i) { return image.at("object")[i] == theirs[i]; }))
    throw UsageError("the images do not show the same scene: objects differ at " +
                     std::to_string(comparison.skipped) + " pixels; render both from one scene");
  receivers(reference, {std::nullopt, judged.light});  // refuses visibility that is not finite
  const std::string channel = judged.channel();
  set_figures(comparison, image.at(channel), {reference.at(channel), reference.at(channel)});
  return comparison;
}

Comparison compare_to_scene(const Image& image, const Scene& scene, const Judged& wanted,
                            const TraceOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  const std::size_t light = light_of(scene, wanted);
  const Judged judged{wanted.object, scene.lights.size() > 1 ? scene.lights[light].name : ""};
  Comparison comparison;
  comparison.judged = receivers(image, judged);
  const RayScene rays(scene, options.threads);
  const SurfaceBuffer surface = make_surface_buffer(scene, rays, image.width, image.height);
  Bounds bounds = scene.bounds();
  bounds.add(scene.camera.eye);
  const double tolerance = kPositionTolerance * (bounds.radius() + glm::length(bounds.center()));
  if (!keep_agreeing(comparison, [&](std::uint32_t i) { return same_point(image, surface, i, tolerance); }))
    throw SceneError("the image was not rendered from this scene: they disagree at " +
                     std::to_string(comparison.skipped) +
                     " pixels; give the scene that it was rendered from");

  Tracer tracer(rays, scene.lights[light].shape, surface, comparison);
  std::optional<Judge> judge;
  if (options.oracle_pixels > 0) {
    judge.emplace(scene, require_disk(scene.lights[light].shape, "--judge double"));
    comparison.judged = some_of(std::move(comparison.judged), options.oracle_pixels);
  }
  const auto reference = [&](int k) {
    const std::string label = "reference " + std::to_string(k + 1) + " of 2";
    if (!judge)
      return spread(tracer.trace(comparison.judged, options.samples, kSeeds[k], label), comparison.judged,
                    surface.size());
    ProgressLine progress(label);
    comparison.rays += comparison.judged.size() * static_cast<std::size_t>(options.samples);
    return spread(
        judge->visibility(surface, comparison.judged, options.samples, kSeeds[k], progress.callback()),
        comparison.judged, surface.size());
  };
  References references{.first = reference(0), .second = reference(1)};
  const std::vector<float>& method = image.at(judged.channel());
  comparison.samples = options.samples;
  set_figures(comparison, method, references);
  if (!judge && !comparison.penumbra.empty())
    resample_worst(comparison, method, std::move(references), tracer);
  comparison.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return comparison;
}

}  // namespace penumbra::apps
