// What methods take and how far they are off on one scene.
//
// Times are those of the processor on one thread, halved for two cores: other work on the machine and idle
// threads change them less than the wall's clock. Errors are of V, by rays in double without offset that
// share nothing with render (tests/oracle).
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/cli/compare/judge.h"
#include "penumbra/render/image/error_figures.h"
#include "penumbra/render/method.h"
#include "penumbra/render/plan/plan.h"
#include "render/rays/ray_scene.h"

namespace penumbra::bench {

struct MeasureOptions {
  int width = 320, height = 240;
  /// Pixels in penumbra at which the judge looks, and its rays at each, twice. Without pixels errors are not
  /// judged.
  std::size_t judged = 1'000;
  int judge_samples = 4'096;
};

/// One method with options, as a row has it.
struct Setting {
  std::string name, method;
  OptionValues options;
};

/// Milliseconds.
struct Times {
  double frame = 0.0, setup = 0.0;
};

/// A scene with one light as its camera sees it. The camera is the judge's.
class MeasuredScene {
 public:
  MeasuredScene(Scene scene, const MeasureOptions& options);

  /// planned(), a "measured" for each setting, and an "auto" for each budget. `timed`: else each is run once,
  /// and times mean nothing.
  nlohmann::json row(const std::vector<Setting>& settings, const std::vector<double>& budgets,
                     bool timed = true) const;
  /// Facts of the plan, the milliseconds that it takes, and for each setting with rays the RMSE that it says
  /// is "kept" nineteen times of twenty.
  nlohmann::json planned(const std::vector<Setting>& settings) const;

 private:
  struct Run {
    Times times;
    MethodResult last;
  };
  Run run(const std::string& method, const OptionValues& options, bool timed) const;
  nlohmann::json judged(const Run& run) const;
  nlohmann::json by_auto(double budget, bool timed) const;
  LightPlan plan(const PlanRequest& request) const;
  void trace_references();

  Scene scene_;
  MeasureOptions options_;
  RayScene rays_;
  SurfaceBuffer surface_;
  std::vector<float> first_, second_;
  std::vector<std::uint32_t> penumbra_;
};

}  // namespace penumbra::bench
