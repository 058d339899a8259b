#include "apps/viewer/compose.h"

#include "apps/picture.h"

namespace penumbra::viewer {

Pixels picture_of(const Side& side, double exposure) {
  const Image& image = side.result->image;
  return {image.width, image.height, encode_srgb(image, exposure)};
}

Pixels difference_of(const Side& left, const Side& right, double scale) {
  const Image& image = left.result->image;
  const std::vector<float>&a = image.at("visibility"), &b = right.result->image.at("visibility");
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

}  // namespace penumbra::viewer
