#include "apps/cli/study/pictures/study_pictures.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <functional>

#include "apps/cli/study/pictures/webp.h"

namespace penumbra::apps {
namespace {

constexpr int kMostColumns = 320;

using Rgb = std::array<unsigned char, 3>;

/// Every `step`-th pixel of every `step`-th row.
std::string thinned(int width, int height, int step, const std::function<Rgb(std::size_t)>& color_of) {
  const int columns = (width + step - 1) / step, rows = (height + step - 1) / step;
  std::vector<unsigned char> bytes;
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x) {
      const Rgb color = color_of(static_cast<std::size_t>(y * step) * static_cast<std::size_t>(width) +
                                 static_cast<std::size_t>(x * step));
      bytes.insert(bytes.end(), color.begin(), color.end());
    }
  return encode_webp(columns, rows, bytes);
}

unsigned char to_byte(double value) {
  return static_cast<unsigned char>(std::lround(std::clamp(value, 0.0, 255.0)));
}

unsigned char error_byte(double error) {
  return to_byte(128.0 + 127.0 * std::copysign(std::sqrt(std::min(1.0, std::abs(error))), error));
}

float luminance(const Image& image, std::size_t i) {
  return 0.2126f * image.at("R")[i] + 0.7152f * image.at("G")[i] + 0.0722f * image.at("B")[i];
}

}  // namespace

int thinning_of(int width) {
  return std::max(1, (width + kMostColumns - 1) / kMostColumns);
}

LitPicture make_lit_picture(Image image) {
  std::vector<float> values;
  for (std::size_t i = 0; i < image.at("A").size(); ++i)
    if (image.at("A")[i] > 0.0f) values.push_back(luminance(image, i));
  LitPicture out{std::move(image), 0.0};
  if (values.empty()) return out;
  const auto bright = values.begin() + static_cast<std::ptrdiff_t>(values.size() * 99 / 100);
  std::nth_element(values.begin(), bright, values.end());
  if (*bright > 0.0f) out.exposure_stops = -std::log2(static_cast<double>(*bright));
  return out;
}

std::string encode_lit(const LitPicture& lit) {
  const std::vector<unsigned char> srgb = encode_srgb(lit.image, lit.exposure_stops);
  return thinned(lit.image.width, lit.image.height, thinning_of(lit.image.width), [&](std::size_t i) {
    return Rgb{srgb[3 * i], srgb[3 * i + 1], srgb[3 * i + 2]};
  });
}

std::string encode_reference(const LitPicture& lit, std::span<const float> reference) {
  const std::vector<float>& unshadowed = lit.image.at("visibility");
  return thinned(lit.image.width, lit.image.height, thinning_of(lit.image.width), [&](std::size_t i) {
    const auto value = static_cast<unsigned>(std::lround(65'535.0 * static_cast<double>(reference[i])));
    return Rgb{static_cast<unsigned char>(value >> 8), static_cast<unsigned char>(value & 255),
               to_byte(255.0 * static_cast<double>(unshadowed[i]))};
  });
}

std::string encode_error(const Image& image, std::span<const float> visibility,
                         std::span<const float> reference, std::span<const std::int8_t> region,
                         int step_factor) {
  const std::vector<float>& alpha = image.at("A");
  return thinned(image.width, image.height, step_factor * thinning_of(image.width), [&](std::size_t i) {
    if (alpha[i] == 0.0f) return Rgb{0, 0, 0};
    const int certified = region.empty() ? 0 : region[i] == 0 ? 1 : region[i] == 2 ? 2 : 0;
    return Rgb{error_byte(static_cast<double>(visibility[i]) - static_cast<double>(reference[i])),
               static_cast<unsigned char>(100 * certified), 0};
  });
}

std::string file_name_of(const std::string& text) {
  std::string name = text;
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '.' && c != '-') c = '-';
  return name;
}

}  // namespace penumbra::apps
