#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#define STBI_WRITE_NO_STDIO
#include <stb_image_write.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include "mesh/io/write_file.h"
#include "penumbra/mesh/error.h"
#include "penumbra/render/image/image.h"
#include "render/image/srgb.h"

namespace penumbra {
namespace {

unsigned char to_srgb(float linear) {
  static const detail::SrgbTable table;
  return table(linear);
}

float to_linear(unsigned char srgb) {
  const float encoded = static_cast<float>(srgb) / 255.0f;
  return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

/// One channel of a pixel: `color` is multiplied by alpha, `behind` is linear.
unsigned char over(float color, float alpha, float behind) {
  if (alpha >= 1.0f) return to_srgb(color);
  // What lies on top is clipped by itself, so that an edge between bright and dark is as wide as any other.
  return to_srgb(std::clamp(color, 0.0f, alpha) + (1.0f - alpha) * behind);
}

void append(void* text, void* data, int size) {
  static_cast<std::string*>(text)->append(static_cast<const char*>(data), static_cast<std::size_t>(size));
}

}  // namespace

std::vector<unsigned char> encode_srgb(const Image& image, const Display& display) {
  const std::vector<float>* rgb[3] = {&image.at("R"), &image.at("G"), &image.at("B")};
  const std::vector<float>& alpha = image.at("A");
  const auto gain = static_cast<float>(std::exp2(display.exposure_stops));
  const auto& behind = display.background.srgb;
  const float linear[3] = {to_linear(behind[0]), to_linear(behind[1]), to_linear(behind[2])};
  const std::size_t channels = display.background.transparent ? 4 : 3;
  std::vector<unsigned char> bytes(alpha.size() * channels);
  for (std::size_t i = 0; i < alpha.size(); ++i) {
    unsigned char* pixel = &bytes[channels * i];
    for (std::size_t c = 0; c < 3; ++c) {
      const float color = (*rgb[c])[i] * gain;
      if (channels == 4)
        pixel[c] = alpha[i] > 0.0f ? to_srgb(color / alpha[i]) : 0;
      else
        pixel[c] = alpha[i] == 0.0f ? behind[c] : over(color, alpha[i], linear[c]);
    }
    if (channels == 4) pixel[3] = static_cast<unsigned char>(std::lround(255.0f * alpha[i]));
  }
  return bytes;
}

std::vector<unsigned char> encode_srgb(const Image& image, double exposure_stops) {
  return encode_srgb(image, Display{.exposure_stops = exposure_stops});
}

namespace {

void write_bytes(const std::filesystem::path& path, int width, int height, int channels,
                 const std::vector<unsigned char>& bytes) {
  assert(bytes.size() == static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
                             static_cast<std::size_t>(channels));
  // The encoder counts bytes in int.
  if ((std::int64_t{width} * channels + 1) * height > std::numeric_limits<int>::max())
    throw SystemError(path.string() + ": " + std::to_string(width) + "x" + std::to_string(height) +
                      " pixels are too many for a PNG; write a smaller picture, or an EXR");
  std::string png;
  if (!stbi_write_png_to_func(append, &png, width, height, channels, bytes.data(), channels * width))
    throw SystemError(path.string() + ": cannot be encoded as PNG; not enough memory");
  write_file(path,
             [&png](std::ostream& out) { out.write(png.data(), static_cast<std::streamsize>(png.size())); });
}

}  // namespace

void write_png(const std::filesystem::path& path, const Image& image, const Display& display) {
  write_bytes(path, image.width, image.height, display.background.transparent ? 4 : 3,
              encode_srgb(image, display));
}

void write_png(const std::filesystem::path& path, const Image& image, double exposure_stops) {
  write_png(path, image, Display{.exposure_stops = exposure_stops});
}

void write_png(const std::filesystem::path& path, int width, int height,
               const std::vector<unsigned char>& rgb) {
  write_bytes(path, width, height, 3, rgb);
}

}  // namespace penumbra
