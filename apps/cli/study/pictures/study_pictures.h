// study: pictures that the page puts together. The page shows a setting by what it is off from the reference,
// so that one small file a setting is enough.
//
// Every file is a lossless WebP of 8-bit RGB at up to 320 pixels a row: of larger pictures every second
// pixel, or third, and so on, as they are, not averaged.
//
//   CASE.lit.webp            sRGB of the scene without shadows, at the exposure that makes its bright parts
//                            white
//   CASE.reference.webp      red and green: V of the reference times 65,535, high byte and low byte; blue: V
//                            without shadows
//   CASE-SETTING.webp        red: 128 + 127 sign(e) √|e| of the error e of V, 1 to 255 (0: no surface);
//                            green: 1 where certified lit, 2 where in umbra, times 100; blue: 0
//   CASE-SETTING.small.webp  of that every second pixel, across and down
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "penumbra/render/image/image.h"

namespace penumbra::apps {

/// What a case looks like without shadows.
struct LitPicture {
  Image image;
  /// Stops that make its 99th percentile of luminance white.
  double exposure_stops = 0.0;
};
LitPicture make_lit_picture(Image image);

/// Of a picture so wide every so many pixels are shown, across and down.
int thinning_of(int width);

std::string encode_lit(const LitPicture& lit);
std::string encode_reference(const LitPicture& lit, std::span<const float> reference);
/// `region` may be empty. `step_factor` 2: the small one.
std::string encode_error(const Image& image, std::span<const float> visibility,
                         std::span<const float> reference, std::span<const std::int8_t> region,
                         int step_factor);

/// Letters, digits, points and hyphens of a text, all others as hyphens.
std::string file_name_of(const std::string& text);

}  // namespace penumbra::apps
