// compare --picture and --signed-difference.
#pragma once

#include <string>

#include "apps/cli/comparison.h"
#include "apps/common/picture.h"

namespace penumbra::apps {

/// Error that saturates the colours: the smallest of 0.01, 0.02, 0.05 … 1 that 99% of the penumbra's pixels
/// stay within.
double difference_scale(const Comparison& comparison);

/// Image minus reference: blue where too dark, red where too bright, grey where nothing was compared.
Picture difference_picture(const Image& image, const Comparison& comparison, double scale);

/// Image, reference and signed difference side by side, with captions and the scale. `reference` is null
/// where it was traced: both are then shown as visibility.
Picture side_by_side(const Image& image, const std::string& name, const Image* reference,
                     const std::string& reference_name, const Comparison& comparison, double exposure_stops);

}  // namespace penumbra::apps
