#include "apps/cli/compare/compare_picture.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace penumbra::apps {
namespace {

constexpr Picture::Color kPaper{255, 255, 255}, kInk{20, 20, 20}, kNothing{230, 230, 230};
constexpr int kCaption = 40, kGap = 8, kBaseline = (kCaption - 14) / 2;

Picture from_bytes(const Image& image, const std::vector<unsigned char>& rgb) {
  Picture picture(image.width, image.height, kNothing);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const unsigned char* pixel = &rgb[static_cast<std::size_t>(y * image.width + x) * 3];
      picture.set(x, y, {pixel[0], pixel[1], pixel[2]});
    }
  return picture;
}

Picture gray_picture(const Image& image, const std::vector<float>& values,
                     const std::vector<std::uint32_t>& pixels) {
  Picture picture(image.width, image.height, kNothing);
  for (const std::uint32_t i : pixels) {
    const auto gray = static_cast<unsigned char>(std::lround(255.0f * std::clamp(values[i], 0.0f, 1.0f)));
    picture.set(static_cast<int>(i) % image.width, static_cast<int>(i) / image.width, {gray, gray, gray});
  }
  return picture;
}

std::string signed_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%+g", value);
  return text;
}

// "-0.1 [blue … red] +0.1", its right end at x.
void draw_scale(Picture& picture, int right, int y, double scale) {
  constexpr int kBar = 96;
  const std::string low = signed_text(-scale), high = signed_text(scale);
  const int high_x = right - Picture::width_of(high);
  const int bar_x = high_x - kGap - kBar;
  const int low_x = bar_x - kGap - Picture::width_of(low);
  picture.fill(low_x - kGap, 0, picture.width() - low_x + kGap, kCaption, kPaper);
  picture.write(high_x, y, high, kInk);
  picture.write(low_x, y, low, kInk);
  for (int i = 0; i < kBar; ++i) picture.fill(bar_x + i, y, 1, 14, signed_color(2.0 * i / (kBar - 1) - 1.0));
}

}  // namespace

double difference_scale(const Comparison& comparison) {
  const ErrorFigures& figures = comparison.penumbra.empty() ? comparison.all : comparison.in_penumbra;
  for (const double scale : {0.01, 0.02, 0.05, 0.1, 0.2, 0.5})
    if (figures.p99_absolute <= scale) return scale;
  return 1.0;
}

Picture difference_picture(const JudgedImage& judged, double scale) {
  const Image& image = judged.image;
  const std::vector<float>& visibility = image.at(judged.channel);
  Picture picture(image.width, image.height, kNothing);
  for (const std::uint32_t i : judged.comparison.judged) {
    const double difference = double{visibility[i]} - double{judged.comparison.reference[i]};
    picture.set(static_cast<int>(i) % image.width, static_cast<int>(i) / image.width,
                signed_color(difference / scale));
  }
  return picture;
}

Picture side_by_side(std::span<const JudgedImage> images, const Image* reference,
                     const std::string& reference_name, double exposure_stops) {
  const JudgedImage& first = images.front();
  bool colors = reference && reference->has("R");
  double scale = 0.0;
  for (const JudgedImage& judged : images) {
    colors = colors && judged.image.has("R");
    scale = std::max(scale, difference_scale(judged.comparison));
  }
  const int step = first.image.width + kGap, panels = 2 * static_cast<int>(images.size()) + 1;
  Picture picture(panels * step + kGap, first.image.height + kCaption + kGap, kPaper);
  int left = kGap;
  const auto add = [&](const Picture& panel, const std::string& caption) {
    picture.draw(left, kCaption, panel);
    picture.fill(left - kGap / 2, 0, picture.width() - left, kCaption,
                 kPaper);  // where the caption before was too long
    picture.write(left, kBaseline, caption, kInk);
    left += step;
  };
  const auto shown = [&](const Image& source, const std::vector<float>& visibility) {
    return colors ? from_bytes(source, encode_srgb(source, exposure_stops))
                  : gray_picture(first.image, visibility, first.comparison.judged);
  };
  for (const JudgedImage& judged : images)
    add(shown(judged.image, judged.image.at(judged.channel)), judged.name);
  add(shown(reference ? *reference : first.image, first.comparison.reference), reference_name);
  for (const JudgedImage& judged : images)
    add(difference_picture(judged, scale), images.size() == 1 ? "error" : judged.name + ", error");
  draw_scale(picture, picture.width() - kGap, kBaseline, scale);
  return picture;
}

}  // namespace penumbra::apps
