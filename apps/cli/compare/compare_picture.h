// compare --picture and --signed-difference.
#pragma once

#include <span>
#include <string>

#include "apps/cli/compare/comparison.h"
#include "apps/common/picture.h"

namespace penumbra::apps {

/// Error that saturates the colors: the smallest of 0.01, 0.02, 0.05 … 1 that 99% of the penumbra's pixels
/// stay within.
double difference_scale(const Comparison& comparison);

/// An image and what is wrong with its visibility.
struct JudgedImage {
  const Image& image;
  std::string name;
  /// The channel that was compared.
  std::string channel;
  const Comparison& comparison;
};

/// Image minus reference: blue where too dark, red where too bright, gray where nothing was compared.
Picture difference_picture(const JudgedImage& judged, double scale);

/// From the left: the images, their reference, and each image's signed difference, with captions and the
/// scale of the differences. All images are of one size and have the same reference. `reference` is null
/// where it was traced: all are then shown as visibility.
Picture side_by_side(std::span<const JudgedImage> images, const Image* reference,
                     const std::string& reference_name, double exposure_stops);

}  // namespace penumbra::apps
