#include "apps/viewer/work/draft.h"

#include <algorithm>

namespace penumbra::viewer {
namespace {

/// Milliseconds. 25 pictures a second leave 40, of which the window takes some until it asks for the next
/// one.
constexpr double kBudget = 36.0;
/// A draft that is being shown may take so much longer before it becomes coarser, so that it does not change
/// back and forth.
constexpr double kSlack = 1.15;
/// Of what is known, the part that one more draft replaces: one that something else on the machine held up
/// changes nothing.
constexpr double kNewest = 0.5;
/// Drafts, about two seconds.
constexpr int kMostPatience = 64;
/// Of a draft's time, so much is taken not to depend on its size when a finer one is thought of.
constexpr double kFixed = 0.3;
/// A finer draft of which nothing is known is tried where it is expected to take no more than so many
/// budgets: on a busy machine much more of a draft's time does not depend on its size. In vain it is tried
/// less and less often.
constexpr double kVentured = 2.0;

OptionValue value_now(const OptionSchema& option, const RenderOptions& options) {
  const auto given = options.options.find(option.name);
  return given == options.options.end() ? option.usual : given->second;
}

/// The option's value for drafts, unless what is chosen costs less already.
OptionValue cheaper(const OptionSchema& option, const RenderOptions& options) {
  const OptionValue now = value_now(option, options);
  const auto* number = std::get_if<std::uint64_t>(&now);
  const auto* most = std::get_if<std::uint64_t>(&*option.draft);
  return number && most && *number > 0 && *number < *most ? now : *option.draft;
}

}  // namespace

bool DraftPolicy::is_as_cheap(const RenderOptions& options) {
  const auto& schema = method_named(options.method).options;
  return std::ranges::all_of(schema, [&](const OptionSchema& option) {
    return !option.draft || cheaper(option, options) == value_now(option, options);
  });
}

RenderOptions DraftPolicy::draft_of(const RenderOptions& options) const {
  RenderOptions draft = options;
  for (const OptionSchema& option : method_named(options.method).options)
    if (option.draft) draft.options[option.name] = cheaper(option, options);
  if (reduction_ == 1) return draft;
  draft.width = (options.width + reduction_ - 1) / reduction_;
  draft.height = (options.height + reduction_ - 1) / reduction_;
  return draft;
}

void DraftPolicy::note(int reduction, double milliseconds, bool camera_moved) {
  if (camera_moved != camera_moved_) known_ = {};
  camera_moved_ = camera_moved;
  for (Known& each : known_) each.believed = std::max(0, each.believed - 1);
  Known& k = known(reduction);
  k.milliseconds = k.believed > 0 ? k.milliseconds + kNewest * (milliseconds - k.milliseconds) : milliseconds;
  const bool is_slow = k.milliseconds > kSlack * kBudget;
  k.believed = k.patience;
  k.patience = is_slow ? std::min(2 * k.patience, kMostPatience) : kFirstPatience;
}

/// From what one of that reduction took not long ago, else by the pixels.
double DraftPolicy::expected(int another, int reduction, double milliseconds) const {
  const Known& k = known_[static_cast<std::size_t>(another)];
  if (k.believed > 0) return k.milliseconds;
  const double times = static_cast<double>(reduction) / another;
  const double fixed = another < reduction ? kFixed : 0.0;
  return milliseconds * (fixed + (1.0 - fixed) * times * times);
}

/// As fine as is expected to keep the budget, from what one of `shown` takes.
void DraftPolicy::choose(int shown) {
  reduction_ = shown;
  double now = known(shown).milliseconds;
  if (now > kSlack * kBudget) {
    while (reduction_ < kCoarsest && now > kBudget)
      now = expected(++reduction_, shown, known(shown).milliseconds);
    return;
  }
  while (reduction_ > 1) {
    const double finer = expected(reduction_ - 1, reduction_, now);
    const bool is_known = known(reduction_ - 1).believed > 0;
    if (finer > (is_known ? kBudget : kVentured * kBudget)) break;
    now = finer;
    --reduction_;
  }
}

void DraftPolicy::start(double milliseconds) {
  known_ = {};
  known(1).milliseconds = milliseconds;
  choose(1);
}

void DraftPolicy::took(double milliseconds, bool camera_moved) {
  note(reduction_, milliseconds, camera_moved);
  choose(reduction_);
}

void DraftPolicy::took_in_full(double milliseconds, bool camera_moved, bool as_cheap) {
  if (milliseconds > kBudget && !as_cheap) return;
  note(1, milliseconds, camera_moved);
  choose(1);
}

}  // namespace penumbra::viewer
