#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#define STBI_WRITE_NO_STDIO
#include <stb_image_write.h>

#include <cassert>
#include <cmath>
#include <string>

#include "mesh/io/write_file.h"
#include "penumbra/mesh/error.h"
#include "penumbra/render/image/image.h"

namespace penumbra {
namespace {

constexpr unsigned char kBackground = 230;  // light gray, sRGB

// IEC 61966-2-1, linear [0, 1] to 8 bits.
unsigned char to_srgb(float linear) {
  if (!(linear > 0.0f)) return 0;  // NaN too
  if (linear >= 1.0f) return 255;
  const float encoded =
      linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
  return static_cast<unsigned char>(std::lround(255.0f * encoded));
}

void append(void* text, void* data, int size) {
  static_cast<std::string*>(text)->append(static_cast<const char*>(data), static_cast<std::size_t>(size));
}

}  // namespace

std::vector<unsigned char> encode_srgb(const Image& image, double exposure_stops) {
  const std::vector<float>* rgb[3] = {&image.at("R"), &image.at("G"), &image.at("B")};
  const std::vector<float>& alpha = image.at("A");
  const auto gain = static_cast<float>(std::exp2(exposure_stops));
  std::vector<unsigned char> bytes(alpha.size() * 3);
  for (std::size_t i = 0; i < alpha.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c)
      bytes[3 * i + c] = alpha[i] == 0.0f ? kBackground : to_srgb((*rgb[c])[i] * gain);
  return bytes;
}

void write_png(const std::filesystem::path& path, const Image& image, double exposure_stops) {
  write_png(path, image.width, image.height, encode_srgb(image, exposure_stops));
}

void write_png(const std::filesystem::path& path, int width, int height,
               const std::vector<unsigned char>& rgb) {
  assert(rgb.size() == static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 3);
  std::string png;
  if (!stbi_write_png_to_func(append, &png, width, height, 3, rgb.data(), 3 * width))
    throw SystemError(path.string() + ": cannot be encoded as PNG; not enough memory");
  write_file(path,
             [&png](std::ostream& out) { out.write(png.data(), static_cast<std::streamsize>(png.size())); });
}

}  // namespace penumbra
