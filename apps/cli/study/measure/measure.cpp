#include "apps/cli/study/measure.h"

#include <algorithm>
#include <map>

#include "penumbra/mesh/error.h"

namespace penumbra::apps {
namespace {

constexpr double kLongFrame = 150.0;    // ms; caches of another setting do not matter to it
constexpr double kDearFrame = 2'000.0;  // ms; one timed frame says enough
constexpr double kRestless = 0.1;       // quartiles further apart than this part of the median
constexpr int kMostRounds = 3;          // times as many rounds as asked for, while the machine is busy

RenderOptions options_of(const Setting& setting, const StudyView& view) {
  return {.method = setting.method, .options = setting.options, .width = view.width, .height = view.height};
}

RenderResult draw(Renderer& renderer, const RenderOptions& options) {
  renderer.forget();
  return renderer.render(options);
}

/// The warm-up frame, and what it shows.
Measured begin(Renderer& renderer, const RenderOptions& options) {
  Measured out;
  try {
    RenderResult result = draw(renderer, options);
    MethodFrame& frame = result.lights.front();
    out.visibility = std::move(frame.visibility);
    out.region = std::move(frame.region);
    out.renderer = std::move(frame.renderer);
    out.counts = std::move(frame.counts);
    out.image = std::move(result.image);
    out.frames = {result.frame_ms};
  } catch (const UsageError& e) {
    out.refused = e.what();
  }
  return out;
}

RenderResult timed_frame(Renderer& renderer, const RenderOptions& options, double expected_ms) {
  if (expected_ms < kLongFrame) draw(renderer, options);
  return draw(renderer, options);
}

/// Times of the stages by name, one a frame, in the order of the first frame.
class StageTable {
 public:
  void add(const StageTimes& stages) {
    for (const StageTime& stage : stages) {
      if (!times_.contains(stage.name)) names_.push_back(stage.name);
      times_[stage.name].push_back(stage.milliseconds);
    }
  }
  StageTimes medians() const {
    StageTimes out;
    for (const std::string& name : names_) out.push_back({name, quartiles_of(times_.at(name)).median});
    return out;
  }

 private:
  std::vector<std::string> names_;
  std::map<std::string, std::vector<double>> times_;
};

bool are_restless(const std::vector<double>& ratios) {
  const Quartiles q = quartiles_of(ratios);
  return q.high - q.low > kRestless * q.median;
}

}  // namespace

Quartiles quartiles_of(std::vector<double> values) {
  if (values.empty()) return {};
  std::ranges::sort(values);
  const std::size_t n = values.size();
  return {values[n / 4], values[n / 2], values[n - 1 - n / 4]};
}

std::vector<Measured> measure_in_turn(Renderer& renderer, const StudyView& view,
                                      std::span<const Setting> settings, int rounds) {
  std::vector<Measured> out;
  std::vector<double> expected;
  for (const Setting& setting : settings) {
    out.push_back(begin(renderer, options_of(setting, view)));
    expected.push_back(out.back().frames.empty() ? 0.0 : out.back().frames.front());
    out.back().frames.clear();
  }
  const RenderOptions partner = {
      .method = kDefaultMethod, .options = {}, .width = view.width, .height = view.height};
  const bool with_partner = takes(method_named(kDefaultMethod), renderer.scene().lights.front().shape);
  std::vector<StageTable> stages(settings.size());
  const auto is_measured = [&](std::size_t k, int round) {
    if (!out[k].refused.empty()) return false;
    if (round == 0) return true;
    return expected[k] <= kDearFrame && (round < rounds || are_restless(out[k].over_default));
  };
  for (int round = 0; round < kMostRounds * rounds; ++round) {
    std::vector<std::size_t> measured;
    for (std::size_t k = 0; k < settings.size(); ++k)
      if (is_measured(k, round)) measured.push_back(k);
    if (measured.empty()) break;
    const double unit = with_partner ? timed_frame(renderer, partner, 0.0).frame_ms : 0.0;
    for (const std::size_t k : measured) {
      const RenderResult frame = timed_frame(renderer, options_of(settings[k], view), expected[k]);
      out[k].frames.push_back(frame.frame_ms);
      if (with_partner) out[k].over_default.push_back(frame.frame_ms / unit);
      stages[k].add(frame.stages);
    }
  }
  for (std::size_t k = 0; k < settings.size(); ++k) out[k].stages = stages[k].medians();
  return out;
}

}  // namespace penumbra::apps
