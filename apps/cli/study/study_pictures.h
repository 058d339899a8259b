// study: pictures that the page puts together. The page shows a setting by what it is off from the reference, so that one
// small file a setting is enough.
//
// Every file is an 8-bit RGB PNG at up to 320 pixels a row: of larger pictures every second pixel, or third, and so on,
// as they are, not averaged.
//
//   CASE.lit.png        sRGB of the scene without shadows, at the exposure that makes its bright parts white
//   CASE.reference.png  red and green: V of the reference times 65,535, high byte and low byte; blue: V without shadows
//   CASE-SETTING.png    red: 128 + 127 sign(e) √|e| of the error e of V, 1 to 255 (0: no surface); green: 1 where certified
//                       lit, 2 where in umbra, times 100; blue: 0
#pragma once

#include <cstdint>
#include <filesystem>
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

void write_lit(const std::filesystem::path& path, const LitPicture& lit);
void write_reference(const std::filesystem::path& path, const LitPicture& lit,
                     std::span<const float> reference);
/// `region` may be empty.
void write_error(const std::filesystem::path& path, const Image& image, std::span<const float> visibility,
                 std::span<const float> reference, std::span<const std::int8_t> region);

/// Letters, digits, points and hyphens of a text, all others as hyphens.
std::string file_name_of(const std::string& text);

}  // namespace penumbra::apps
