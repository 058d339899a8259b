#include "apps/viewer/work/draft.h"

#include <algorithm>

namespace penumbra::viewer {
namespace {

constexpr double kBudget = 36.0;  // ms: leaves 14 of 50 to the window
constexpr int kCoarsest = 6;
constexpr int kDraftRays = 16;
constexpr int kDraftTexels = 256;

}  // namespace

RenderOptions DraftPolicy::draft_of(const RenderOptions& options) const {
  RenderOptions draft = options;
  draft.reference.samples = std::min(options.reference.samples, reduction_ > 2 ? kDraftRays / 4 : kDraftRays);
  if (reduction_ == 1) return draft;
  draft.width = (options.width + reduction_ - 1) / reduction_;
  draft.height = (options.height + reduction_ - 1) / reduction_;
  if (options.d_buffer.size == 0 || options.d_buffer.size > kDraftTexels) draft.d_buffer.size = kDraftTexels;
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
