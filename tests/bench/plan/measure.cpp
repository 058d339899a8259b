#include "tests/bench/plan/measure.h"

#include <algorithm>
#include <cmath>
#include <ctime>

#include "apps/cli/plan/plan_json.h"
#include "apps/common/stats.h"
#include "render/plan/auto_method.h"
#include "render/plan/sample/ray_error.h"

namespace penumbra::bench {
namespace {

constexpr double kCores = 2.0;

double processor_ms() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

template <class Work>
double ms_of(const Work& work) {
  const double before = processor_ms();
  work();
  return (processor_ms() - before) / kCores;
}

double rounded(double value, double unit) {
  return std::round(value / unit) * unit;
}

/// What plans say of rays: nineteen times of twenty the RMSE is less.
double kept_rmse(const LightFacts& facts, const Setting& setting) {
  const auto number = [&](const char* name) {
    const auto found = setting.options.find(name);
    return found == setting.options.end() ? 0 : static_cast<int>(std::get<std::uint64_t>(found->second));
  };
  return rounded(
      std::sqrt(detail::squared_error_kept(facts.sampled, number("samples"), number("areas-up-to"))), 1e-6);
}

}  // namespace

MeasuredScene::MeasuredScene(Scene scene, const MeasureOptions& options)
    : scene_(std::move(scene)),
      options_(options),
      rays_(scene_, 1),
      surface_(apps::surface_by_oracle(scene_, options.width, options.height)) {
  surface_.revision = new_revision();
  if (options_.judged > 0) trace_references();
}

/// At pixels that a few rays find partly lit: a choice that no method has a part in.
void MeasuredScene::trace_references() {
  constexpr std::size_t kLooked = 6'000;
  constexpr int kFewRays = 32;
  const apps::Judge judge(scene_, scene_.lights.front().shape);
  std::vector<std::uint32_t> seen;
  for (std::uint32_t i = 0; i < surface_.size(); ++i)
    if (surface_.hit(i)) seen.push_back(i);
  seen = apps::some_of(std::move(seen), kLooked);
  const std::vector<float> rough = judge.visibility(surface_, seen, kFewRays, 7);
  const std::vector<float> open = judge.unoccluded(surface_, seen, kFewRays, 7);
  for (std::size_t k = 0; k < seen.size(); ++k)
    if (open[k] > 0.0f && open[k] < 1.0f && rough[k] > 0.0f) penumbra_.push_back(seen[k]);
  penumbra_ = apps::some_of(std::move(penumbra_), options_.judged);
  const auto fill = [&](std::vector<float>& reference, std::uint64_t seed) {
    const std::vector<float> values = judge.visibility(surface_, penumbra_, options_.judge_samples, seed);
    reference.assign(surface_.size(), 1.0f);
    for (std::size_t k = 0; k < penumbra_.size(); ++k) reference[penumbra_[k]] = values[k];
  };
  fill(first_, 101);
  fill(second_, 102);
  penumbra_ = true_penumbra(first_, second_, penumbra_);
}

/// The least time of several frames, and what the first one took beside it.
MeasuredScene::Run MeasuredScene::run(const std::string& method, const OptionValues& options,
                                      bool timed) const {
  constexpr double kEnough = 80.0;  // milliseconds
  constexpr int kMost = 6;
  const MethodInfo& info = method_named(method);
  const OptionValues values = completed(info.options, options);
  const std::unique_ptr<Method> made = info.make(scene_);
  Run out;
  const Progress progress;
  const auto frame = [&] {
    return ms_of([&] {
      out.last = made->run({.rays = rays_,
                            .light = scene_.lights.front().shape,
                            .receivers = surface_.receivers(),
                            .options = values,
                            .progress = progress});
    });
  };
  const double first = frame();
  double sum = 0.0;
  out.times.frame = first;
  for (int i = 0; timed && i < kMost && sum < kEnough; ++i) {
    made->forget();
    const double again = frame();
    sum += again;
    out.times.frame = std::min(out.times.frame, again);
  }
  out.times.setup = first - out.times.frame;
  return out;
}

nlohmann::json MeasuredScene::judged(const Run& run) const {
  nlohmann::json out = {{"frame_ms", rounded(run.times.frame, 0.01)},
                        {"setup_ms", rounded(run.times.setup, 0.01)}};
  if (penumbra_.empty()) return out;
  const ErrorFigures figures = error_figures(run.last.visibility, first_, second_, penumbra_);
  out["rmse"] = rounded(figures.rmse, 1e-6);
  out["low"] = rounded(figures.rmse_low, 1e-6);
  out["high"] = rounded(figures.rmse_high, 1e-6);
  return out;
}

nlohmann::json MeasuredScene::planned(const std::vector<Setting>& settings) const {
  LightFacts facts;
  double least = 1e300;
  for (int i = 0; i < 5; ++i) least = std::min(least, ms_of([&] { facts = plan({}).facts; }));
  nlohmann::json out = {{"facts", apps::to_json(facts)}, {"plan_ms", rounded(least, 0.001)}};
  for (const Setting& setting : settings)
    if (setting.options.contains("samples")) out["kept"][setting.name] = kept_rmse(facts, setting);
  return out;
}

LightPlan MeasuredScene::plan(const PlanRequest& request) const {
  return plan_light(scene_, rays_, scene_.lights.front().shape, surface_.receivers(), request);
}

nlohmann::json MeasuredScene::by_auto(double budget, bool timed) const {
  const Run done = run("auto", {{"max-error", budget}}, timed);
  nlohmann::json out = judged(done);
  const LightPlan plan = this->plan({.max_error = budget});
  out["budget"] = budget;
  out["method"] = plan.method;
  out["options"] = apps::to_json(plan.options);
  out["reason"] = plan.decisions.empty() ? "" : plan.decisions.back().reason;
  out["predicted_ms"] = rounded(plan.milliseconds, 0.01);
  out["predicted_error"] = plan.error;
  return out;
}

nlohmann::json MeasuredScene::row(const std::vector<Setting>& settings, const std::vector<double>& budgets,
                                  bool timed) const {
  nlohmann::json out = planned(settings);
  out["judged_pixels"] = penumbra_.size();
  for (const Setting& setting : settings) {
    const Run done = run(setting.method, setting.options, timed);
    nlohmann::json& json = out["measured"][setting.name] = judged(done);
    const Count* open = find(done.last.counts, "open");
    if (open && setting.method == "rays") json["open"] = std::get<std::uint64_t>(open->value);
  }
  for (const double budget : budgets) out["auto"].push_back(by_auto(budget, timed));
  return out;
}

}  // namespace penumbra::bench
