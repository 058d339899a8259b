#include "apps/cli/compare/comparison.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <map>
#include <numeric>
#include <utility>

#include "apps/cli/compare/figures.h"
#include "apps/cli/compare/judge.h"
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

constexpr int kCertificateSamples = 256;
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

// Moves the pixels for which `agrees` is false out of the comparison; false where they and those that are
// missing are too many.
template <class Agrees>
bool keep_agreeing(Comparison& comparison, Agrees agrees, std::size_t missing = 0) {
  std::vector<std::uint32_t>& judged = comparison.judged;
  const std::size_t before = judged.size();
  std::erase_if(judged, [&](std::uint32_t i) { return !agrees(i); });
  comparison.skipped = before - judged.size() + missing;
  return static_cast<double>(comparison.skipped) <= kMaxDisagreement * static_cast<double>(before);
}

bool same_point(const Image& image, const SurfaceBuffer& surface, std::size_t i, double tolerance) {
  if (image.at("object")[i] != static_cast<float>(surface.object[i])) return false;
  const Vec3 point(image.at("P.X")[i], image.at("P.Y")[i], image.at("P.Z")[i]);
  return glm::distance(point, surface.position[i]) <= tolerance;
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
  set_figures(comparison, image.at(channel), {reference.at(channel), reference.at(channel)}, false);
  return comparison;
}

struct SceneComparison::State {
  State(const Scene& scene, const Judged& wanted, const TraceOptions& options);

  Comparison compare(const Image& image);

 private:
  void see(const Image& image);
  /// Receivers of the image that are those of the scene. Throws SceneError where too few are.
  void keep_those_of_scene(Comparison& comparison, const Image& image) const;
  std::vector<float> trace(const std::vector<std::uint32_t>& pixels, int samples, std::uint64_t seed,
                           const std::string& label);
  /// The same, of pixels of which some were asked for before: those are not traced again.
  std::vector<float> trace_again(const std::vector<std::uint32_t>& pixels, int samples, std::uint64_t seed,
                                 const std::string& label);
  void trace_references(const std::vector<std::uint32_t>& pixels);
  void check_certificates(Comparison& comparison, const Image& image) const;

  const Scene& scene_;
  const TraceOptions options_;
  const std::size_t light_;
  const Judged judged_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::optional<RayScene> rays_;  // one of the two traces
  std::optional<Judge> judge_;
  SurfaceBuffer surface_;
  std::vector<std::uint32_t> chosen_;  // by the oracle, ascending
  References references_;
  std::vector<bool> traced_;
  std::map<std::uint32_t, float> traced_again_;  // of the worst pixels of every image so far
  std::size_t rays_traced_ = 0;
};

SceneComparison::State::State(const Scene& scene, const Judged& wanted, const TraceOptions& options)
    : scene_(scene),
      options_(options),
      light_(light_of(scene, wanted)),
      judged_{wanted.object, scene.lights.size() > 1 ? scene.lights[light_].name : ""} {}

void SceneComparison::State::see(const Image& image) {
  if (options_.oracle_pixels > 0) {
    judge_.emplace(scene_, scene_.lights[light_].shape);
    surface_ = surface_by_oracle(scene_, image.width, image.height);
    std::vector<std::uint32_t> seen;
    for (std::uint32_t i = 0; i < surface_.size(); ++i)
      if (surface_.hit(i) && (!judged_.object || *judged_.object == surface_.object[i])) seen.push_back(i);
    chosen_ = options_.pixels.empty() ? some_of(std::move(seen), options_.oracle_pixels) : options_.pixels;
  } else {
    rays_.emplace(scene_, options_.threads);
    surface_ = make_surface_buffer(scene_, *rays_, image.width, image.height);
  }
  references_.first.assign(surface_.size(), 1.0f);
  references_.second.assign(surface_.size(), 1.0f);
  traced_.assign(surface_.size(), false);
}

void SceneComparison::State::keep_those_of_scene(Comparison& comparison, const Image& image) const {
  Bounds bounds = scene_.bounds();
  bounds.add(scene_.camera.eye);
  const double tolerance = kPositionTolerance * (bounds.radius() + glm::length(bounds.center()));
  const std::vector<float>& objects = image.at("object");
  std::size_t missing = 0;  // what the scene has and the image has not
  for (std::size_t i = 0; i < surface_.size(); ++i)
    missing += surface_.hit(i) && (judged_.object ? surface_.object[i] == *judged_.object &&
                                                        objects[i] != static_cast<float>(*judged_.object)
                                                  : objects[i] < 0.0f);
  if (!keep_agreeing(
          comparison, [&](std::uint32_t i) { return same_point(image, surface_, i, tolerance); }, missing))
    throw SceneError("the image was not rendered from this scene: they disagree at " +
                     std::to_string(comparison.skipped) +
                     " pixels; give the scene that it was rendered from");
}

std::vector<float> SceneComparison::State::trace(const std::vector<std::uint32_t>& pixels, int samples,
                                                 std::uint64_t seed, const std::string& label) {
  ProgressLine line(label);
  const Progress progress = progress_on(line, options_.quiet);
  if (judge_) {
    rays_traced_ += pixels.size() * static_cast<std::size_t>(samples);
    return judge_->visibility(surface_, pixels, samples, seed, progress);
  }
  ReferenceResult result = trace_reference(*rays_, scene_.lights[light_].shape, surface_.receivers(), pixels,
                                           {.samples = samples, .seed = seed}, false, progress);
  rays_traced_ += result.rays;
  return std::move(result.visibility);
}

std::vector<float> SceneComparison::State::trace_again(const std::vector<std::uint32_t>& pixels, int samples,
                                                       std::uint64_t seed, const std::string& label) {
  std::vector<std::uint32_t> missing;
  std::ranges::copy_if(pixels, std::back_inserter(missing),
                       [&](std::uint32_t i) { return !traced_again_.contains(i); });
  const std::vector<float> values = trace(missing, samples, seed, label);
  for (std::size_t k = 0; k < missing.size(); ++k) traced_again_[missing[k]] = values[k];
  std::vector<float> out;
  for (const std::uint32_t i : pixels) out.push_back(traced_again_.at(i));
  return out;
}

void SceneComparison::State::trace_references(const std::vector<std::uint32_t>& pixels) {
  std::vector<std::uint32_t> missing;
  std::ranges::copy_if(pixels, std::back_inserter(missing), [&](std::uint32_t i) { return !traced_[i]; });
  if (missing.empty()) return;
  const auto fill = [&](std::vector<float>& reference, int k) {
    const std::vector<float> values =
        trace(missing, options_.samples, kSeeds[k], "reference " + std::to_string(k + 1) + " of 2");
    for (std::size_t j = 0; j < missing.size(); ++j) reference[missing[j]] = values[j];
  };
  fill(references_.first, 0);
  fill(references_.second, 1);
  for (const std::uint32_t i : missing) traced_[i] = true;
}

void SceneComparison::State::check_certificates(Comparison& comparison, const Image& image) const {
  const std::string channel = judged_.light.empty() ? "region" : "region." + judged_.light;
  if (!judge_ || !image.has(channel)) return;
  const std::vector<float>& region = image.at(channel);
  comparison.certified = static_cast<std::size_t>(std::ranges::count_if(
      comparison.judged, [&](std::uint32_t i) { return region[i] == 0.0f || region[i] == 2.0f; }));
  ProgressLine line("certificates");
  comparison.contradicted = judge_
                                ->contradicted(surface_, comparison.judged, region, kCertificateSamples,
                                               kSeeds[2], progress_on(line, options_.quiet))
                                .size();
}

Comparison SceneComparison::State::compare(const Image& image) {
  Comparison comparison;
  comparison.judged = receivers(image, judged_);
  if (surface_.size() == 0) see(image);
  if (image.width != surface_.width || image.height != surface_.height)
    throw UsageError("the images differ in size; render both with the same --size");
  keep_those_of_scene(comparison, image);
  if (judge_) {
    std::vector<std::uint32_t> both;
    std::ranges::set_intersection(comparison.judged, chosen_, std::back_inserter(both));
    comparison.judged = std::move(both);
  }
  trace_references(comparison.judged);
  const std::vector<float>& method = image.at(judged_.channel());
  comparison.samples = options_.samples;
  set_figures(comparison, method, references_, options_.quiet);
  if (options_.resample && !comparison.penumbra.empty()) {
    const auto again = [this](const std::vector<std::uint32_t>& pixels, int samples) {
      return trace_again(pixels, samples, kSeeds[2], "worst pixels again");
    };
    resample_worst(comparison, method, references_, again, judge_.has_value(), options_.quiet);
  }
  check_certificates(comparison, image);
  const auto now = std::chrono::steady_clock::now();
  comparison.rays = std::exchange(rays_traced_, 0);
  comparison.seconds = std::chrono::duration<double>(now - std::exchange(start_, now)).count();
  return comparison;
}

SceneComparison::SceneComparison(const Scene& scene, const Judged& judged, const TraceOptions& options)
    : state_(std::make_unique<State>(scene, judged, options)) {}
SceneComparison::~SceneComparison() = default;

Comparison SceneComparison::compare(const Image& image) {
  return state_->compare(image);
}

}  // namespace penumbra::apps
