#include "apps/cli/study/measure/measure.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "penumbra/mesh/error.h"

namespace penumbra::apps {
namespace {

constexpr double kLongFrame = 150.0;    // ms; caches of another setting do not matter to it
constexpr double kDearFrame = 2'000.0;  // ms; the first frame says enough
constexpr double kRestless = 0.1;       // quartiles further apart than this part of the median
constexpr int kMostRounds = 3;          // times as many rounds as asked for, while the machine is busy

RenderOptions options_of(const Setting& setting, const StudyView& view) {
  return {.method = setting.method, .options = setting.options, .width = view.width, .height = view.height};
}

RenderResult draw(Renderer& renderer, const RenderOptions& options) {
  renderer.forget();
  return renderer.render(options);
}

/// The first frame and its times, and what it shows.
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
    out.stages = std::move(result.stages);
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

/// The frame of the default method beside which others are timed; nothing where it does not take the light.
class Partner {
 public:
  Partner(Renderer& renderer, const StudyView& view)
      : renderer_(renderer),
        options_{.method = kDefaultMethod, .options = {}, .width = view.width, .height = view.height},
        is_there_(takes(method_named(kDefaultMethod), renderer.scene().lights.front().shape)) {}

  std::optional<double> frame_ms() const {
    return is_there_ ? std::optional(timed_frame(renderer_, options_, 0.0).frame_ms) : std::nullopt;
  }

 private:
  Renderer& renderer_;
  RenderOptions options_;
  bool is_there_;
};

/// One setting among others.
class Turn {
 public:
  Turn(Renderer& renderer, RenderOptions options, const Partner& partner)
      : options_(std::move(options)), measured_(begin(renderer, options_)) {
    expected_ms_ = measured_.frames.empty() ? 0.0 : measured_.frames.front();
    measured_.frames.clear();
    const StageTimes stages = std::exchange(measured_.stages, {});
    if (expected_ms_ > kDearFrame) add(expected_ms_, stages, partner.frame_ms());
  }

  /// A setting that is left out.
  explicit Turn(std::string why) { measured_.refused = std::move(why); }

  /// Of the first frame; 0 where there is none.
  double expected_ms() const { return expected_ms_; }
  bool is_due(int round, int rounds) const {
    if (!measured_.refused.empty() || expected_ms_ > kDearFrame) return false;
    return round < rounds || are_restless(measured_.over_default);
  }
  void draw(Renderer& renderer, std::optional<double> partner_ms) {
    const RenderResult frame = timed_frame(renderer, options_, expected_ms_);
    add(frame.frame_ms, frame.stages, partner_ms);
  }
  Measured end() {
    measured_.stages = stages_.medians();
    return std::move(measured_);
  }

 private:
  void add(double frame_ms, const StageTimes& stages, std::optional<double> partner_ms) {
    measured_.frames.push_back(frame_ms);
    if (partner_ms) measured_.over_default.push_back(frame_ms / *partner_ms);
    stages_.add(stages);
  }

  RenderOptions options_;
  Measured measured_;
  double expected_ms_ = 0.0;
  StageTable stages_;
};

}  // namespace

Quartiles quartiles_of(std::vector<double> values) {
  if (values.empty()) return {};
  std::ranges::sort(values);
  const std::size_t n = values.size();
  return {values[n / 4], values[n / 2], values[n - 1 - n / 4]};
}

std::vector<Measured> measure_in_turn(Renderer& renderer, const StudyView& view,
                                      std::span<const Setting> settings, int rounds, TooLong& too_long) {
  const Partner partner(renderer, view);
  std::vector<Turn> turns;
  for (const Setting& setting : settings) {
    if (const auto why = too_long.why_not(setting)) {
      turns.emplace_back(*why);
      continue;
    }
    turns.emplace_back(renderer, options_of(setting, view), partner);
    too_long.saw(setting, turns.back().expected_ms());
  }
  for (int round = 0; round < kMostRounds * rounds; ++round) {
    std::vector<Turn*> due;
    for (Turn& turn : turns)
      if (turn.is_due(round, rounds)) due.push_back(&turn);
    if (due.empty()) break;
    const std::optional<double> partner_ms = partner.frame_ms();
    for (Turn* turn : due) turn->draw(renderer, partner_ms);
  }
  std::vector<Measured> out;
  for (Turn& turn : turns) out.push_back(turn.end());
  return out;
}

}  // namespace penumbra::apps
