// A comparison's figures: of all pixels by two references, and of the worst pixels by more rays.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "apps/cli/compare/comparison.h"
#include "apps/common/messages.h"

namespace penumbra::apps {

/// Visibility by two independent references, one entry a pixel of the image.
struct References {
  std::vector<float> first, second;
};

/// Visibility of these pixels, each by so many rays.
using TraceAgain = std::function<std::vector<float>(const std::vector<std::uint32_t>&, int)>;

/// Progress on a terminal, unless nobody is to see it.
Progress progress_on(ProgressLine& line, bool quiet);

/// Sets references, penumbra and figures of the pixels in `judged`. `method` is V, one a pixel of the image.
void set_figures(Comparison& comparison, const std::vector<float>& method, const References& references,
                 bool quiet);

/// Traces the worst pixels again and sets p99 and maximum anew: in the largest errors the references' noise
/// had a share. Nothing else is corrected, since replacing chosen pixels would bias the means. Where p99 is
/// far above that noise it changes little by it, and only the few worst pixels are traced. The oracle's rays,
/// which take some ten times as long as Embree's, trace fewer.
void resample_worst(Comparison& comparison, const std::vector<float>& method, References references,
                    const TraceAgain& trace, bool by_oracle, bool quiet);

}  // namespace penumbra::apps
