// Methods that find O as they find V, once more and without the receivers' horizon.
#pragma once

#include <utility>

#include "penumbra/render/method.h"

namespace penumbra::detail {

/// V by `see(true, progress)` and, where O is wanted, O by `see(false, progress)`, whose results are
/// MethodResults. The stages are of both, all else is that of V. Cost: one call of `see`, or two.
template <class See>
MethodResult see_with_unoccluded(const MethodInput& input, const See& see) {
  const double first = input.with_unoccluded ? 0.5 : 1.0;
  MethodResult out = see(true, part_of(input.progress, 0.0, first));
  if (!input.with_unoccluded) return out;
  MethodResult open = see(false, part_of(input.progress, first, 1.0));
  out.unoccluded = std::move(open.visibility);
  out.stages.insert(out.stages.end(), open.stages.begin(), open.stages.end());
  return out;
}

/// The same where `see` gives a method's own result, of visibility, stages and counts. `to_counts` makes its
/// counts Counts.
template <class See, class ToCounts>
MethodResult see_with_unoccluded(const MethodInput& input, const See& see, const ToCounts& to_counts) {
  return see_with_unoccluded(input, [&](bool horizon, const Progress& progress) {
    auto seen = see(horizon, progress);
    MethodResult out;
    out.visibility = std::move(seen.visibility);
    out.stages = std::move(seen.stages);
    out.counts = to_counts(seen.counts);
    return out;
  });
}

}  // namespace penumbra::detail
