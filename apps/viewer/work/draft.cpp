#include "apps/viewer/work/draft.h"

#include <algorithm>

namespace penumbra::viewer {
namespace {

constexpr double kBudget = 36.0;  // ms: leaves 14 of 50 to the window
constexpr int kCoarsest = 6;

/// The option's value for drafts, unless what is chosen costs less already.
OptionValue cheaper(const OptionSchema& option, const RenderOptions& options) {
  const auto given = options.options.find(option.name);
  const OptionValue now = given == options.options.end() ? option.usual : given->second;
  const auto* number = std::get_if<std::uint64_t>(&now);
  const auto* most = std::get_if<std::uint64_t>(&*option.draft);
  return number && most && *number > 0 && *number < *most ? now : *option.draft;
}

}  // namespace

RenderOptions DraftPolicy::draft_of(const RenderOptions& options) const {
  RenderOptions draft = options;
  for (const OptionSchema& option : method_named(options.method).options)
    if (option.draft) draft.options[option.name] = cheaper(option, options);
  if (reduction_ == 1) return draft;
  draft.width = (options.width + reduction_ - 1) / reduction_;
  draft.height = (options.height + reduction_ - 1) / reduction_;
  return draft;
}

void DraftPolicy::took(double milliseconds) {
  if (milliseconds > kBudget && reduction_ < kCoarsest) {
    ++reduction_;
    return;
  }
  if (reduction_ == 1) return;
  // One step finer costs so many times the pixels; a margin keeps the picture from changing back and forth.
  const double finer = static_cast<double>(reduction_) / (reduction_ - 1);
  if (milliseconds * finer * finer < 0.7 * kBudget) --reduction_;
}

}  // namespace penumbra::viewer
