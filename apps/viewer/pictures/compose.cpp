#include "apps/viewer/pictures/compose.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "apps/common/picture.h"
#include "apps/viewer/pictures/overlay_colors.h"

namespace penumbra::viewer {

namespace {

using Color = std::array<unsigned char, 3>;

Color region_color(float region) {
  const OverlayColor& c = region < 0.0f    ? kRegionUnknown
                          : region == 0.0f ? kRegionLit
                          : region == 1.0f ? kRegionPartly
                                           : kRegionUmbra;
  return {c.r, c.g, c.b};
}

Color visibility_color(float visibility) {
  const auto gray = static_cast<unsigned char>(std::lround(255.0f * std::clamp(visibility, 0.0f, 1.0f)));
  return {gray, gray, gray};
}

}  // namespace

Pixels picture_of(const Frame& frame, const Side& side, Shown shown, double exposure) {
  const Image& image = side.result->image;
  if (shown != Shown::kPicture) {
    const std::vector<float>& values =
        image.at(frame.channel(shown == Shown::kRegion ? "region" : "visibility"));
    Pixels pixels{image.width, image.height, std::vector<unsigned char>(3 * values.size(), 230)};
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (!side.result->surface.hit(i)) continue;
      const Color color = shown == Shown::kRegion ? region_color(values[i]) : visibility_color(values[i]);
      std::copy(color.begin(), color.end(), pixels.rgb.begin() + static_cast<std::ptrdiff_t>(3 * i));
    }
    return pixels;
  }
  Display display{.exposure_stops = exposure, .background = frame.model->picture.background};
  display.background.transparent = false;  // the window has nothing behind it
  return {image.width, image.height, encode_srgb(image, display)};
}

Pixels difference_of(const Frame& frame, double scale) {
  const Side &left = frame.sides.front(), &right = frame.sides.back();
  const std::string channel = frame.channel("visibility");
  const Image& image = left.result->image;
  const std::vector<float>&a = image.at(channel), &b = right.result->image.at(channel);
  Pixels pixels{image.width, image.height, std::vector<unsigned char>(3 * a.size(), 230)};
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (!left.result->surface.hit(i)) continue;
    const apps::Picture::Color color = apps::signed_color((double{a[i]} - double{b[i]}) / scale);
    pixels.rgb[3 * i] = color.r;
    pixels.rgb[3 * i + 1] = color.g;
    pixels.rgb[3 * i + 2] = color.b;
  }
  return pixels;
}

Pixels mosaic_of(const std::vector<TexturePicture>& textures, int side) {
  if (textures.empty()) return {};
  const int count = static_cast<int>(textures.size()), columns = std::min(4, count),
            rows = (count + columns - 1) / columns, pitch = side + 1;
  Pixels pixels{columns * pitch - 1, rows * pitch - 1, {}};
  pixels.rgb.assign(3 * static_cast<std::size_t>(pixels.width) * static_cast<std::size_t>(pixels.height), 70);
  for (int i = 0; i < count; ++i) {
    const TexturePicture& each = textures[static_cast<std::size_t>(i)];
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) {
        const int from_x = x * each.size / side, from_y = (side - 1 - y) * each.size / side;
        const std::size_t from = static_cast<std::size_t>(from_y) * static_cast<std::size_t>(each.size) +
                                 static_cast<std::size_t>(from_x);
        const int to = (i / columns * pitch + y) * pixels.width + i % columns * pitch + x;
        std::fill_n(pixels.rgb.begin() + 3 * static_cast<std::ptrdiff_t>(to), 3, each.values[from]);
      }
  }
  return pixels;
}

}  // namespace penumbra::viewer
