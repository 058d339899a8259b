#include "apps/cli/study/case_judge.h"

#include <numeric>
#include <optional>

#include "render/rays/camera_rays.h"
#include "render/rays/ray_scene.h"
#include "render/rays/reference.h"

namespace penumbra::apps {
namespace {

constexpr ReferenceOptions kCertificateRays{.samples = 256, .seed = 0x2545f4914f6cdd1d};

/// O of every pixel.
std::vector<float> trace_unoccluded(const StudyCase& seen, int threads) {
  const RayScene rays(seen.scene, threads);
  const SurfaceBuffer surface = make_surface_buffer(seen.scene, rays, seen.view.width, seen.view.height);
  std::vector<std::uint32_t> pixels(surface.size());
  std::iota(pixels.begin(), pixels.end(), 0u);
  return trace_reference(rays, seen.scene.lights.front().shape, surface.receivers(), pixels, kCertificateRays,
                         true)
      .unoccluded;
}

TraceOptions by_rays(const JudgeOptions& options) {
  return {
      .samples = options.samples, .threads = options.threads, .resample = options.resample, .quiet = true};
}

TraceOptions by_double(const JudgeOptions& options) {
  return {.samples = options.double_samples,
          .threads = options.threads,
          .oracle_pixels = options.double_pixels,
          .resample = false,
          .quiet = true};
}

nlohmann::json figures_json(const ErrorFigures& f) {
  return {{"pixels", f.pixels},          {"rmse", f.rmse},        {"rmse_low", f.rmse_low},
          {"rmse_high", f.rmse_high},    {"mean", f.mean},        {"mean_absolute", f.mean_absolute},
          {"median", f.median_absolute}, {"p99", f.p99_absolute}, {"max", f.max_absolute}};
}

}  // namespace

struct CaseJudge::State {
  State(const StudyCase& seen_, const JudgeOptions& options_)
      : seen(seen_),
        options(options_),
        rays(seen_.scene, {}, by_rays(options_)),
        in_double(seen_.scene, {}, by_double(options_)) {}

  void check_certificates(const Measured& measured, Verdict& verdict);

  const StudyCase& seen;
  const JudgeOptions options;
  SceneComparison rays, in_double;
  std::optional<std::vector<float>> unoccluded;
};

void CaseJudge::State::check_certificates(const Measured& measured, Verdict& verdict) {
  if (measured.region.empty()) return;
  if (!unoccluded) unoccluded = trace_unoccluded(seen, options.threads);
  for (const std::uint32_t i : verdict.by_rays.judged) {
    if (measured.region[i] != 0 && measured.region[i] != 2) continue;
    ++verdict.certified;
    verdict.contradicted += (*unoccluded)[i] != (measured.region[i] == 0 ? 1.0f : 0.0f);
  }
}

CaseJudge::CaseJudge(const StudyCase& seen, const JudgeOptions& options)
    : state_(std::make_unique<State>(seen, options)) {}
CaseJudge::~CaseJudge() = default;

Verdict CaseJudge::judge(const Measured& measured) {
  Verdict verdict;
  verdict.by_rays = state_->rays.compare(measured.image);
  if (state_->options.double_pixels > 0) verdict.by_double = state_->in_double.compare(measured.image);
  state_->check_certificates(measured, verdict);
  return verdict;
}

nlohmann::json to_json(const Verdict& verdict) {
  nlohmann::json out = {{"penumbra", figures_json(verdict.by_rays.in_penumbra)},
                        {"all", figures_json(verdict.by_rays.all)},
                        {"samples", verdict.by_rays.samples},
                        {"resampled", verdict.by_rays.resampled}};
  if (verdict.by_double.samples > 0)
    out["double"] = {{"penumbra", figures_json(verdict.by_double.in_penumbra)},
                     {"all", figures_json(verdict.by_double.all)},
                     {"certified", verdict.by_double.certified},
                     {"contradicted", verdict.by_double.contradicted}};
  if (verdict.certified > 0)
    out["certificates"] = {{"pixels", verdict.certified}, {"contradicted", verdict.contradicted}};
  return out;
}

}  // namespace penumbra::apps
