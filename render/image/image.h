// Images: named float channels, read and written as EXR, shown as PNG.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "penumbra/render/scene/picture_settings.h"

namespace penumbra {

/// Row 0 is at the top. Channel names as in docs/exr-channels.md: R G B A, visibility, region, object, P.X …,
/// N.X ….
struct Image {
  int width = 0, height = 0;
  std::map<std::string, std::vector<float>> channels;  ///< width·height each, row-major
  /// What an EXR says of itself, as text by name. Of a file that was read: what begins with "penumbra".
  std::map<std::string, std::string> metadata{};

  std::vector<float>& add(const std::string& name, float value = 0.0f);
  const std::vector<float>& at(
      const std::string& name) const;  ///< throws UsageError naming the missing channel
  bool has(const std::string& name) const { return channels.count(name) != 0; }
};

/// 32-bit float channels, ZIP compressed. Whole or not at all. Throws SystemError.
void write_exr(const std::filesystem::path& path, const Image& image);
/// Every channel, converted to float. Throws UsageError for what is not a readable EXR.
Image read_exr(const std::filesystem::path& path);

/// What a picture is shown as.
struct Display {
  double exposure_stops = 0.0;
  Background background{};
};

/// 8-bit sRGB of R G B times 2^exposure, clipped, over the background by A; width·height·3, or where the
/// background is transparent width·height·4 with alpha, as PNG has it: colors are not multiplied by it. R G B
/// are multiplied by A; what is seen through it is blended in linear light.
std::vector<unsigned char> encode_srgb(const Image& image, const Display& display = {});
std::vector<unsigned char> encode_srgb(const Image& image, double exposure_stops);
/// The same as a PNG file. Whole or not at all. Throws SystemError.
void write_png(const std::filesystem::path& path, const Image& image, const Display& display = {});
void write_png(const std::filesystem::path& path, const Image& image, double exposure_stops);

/// 8-bit RGB already encoded, width·height·3. For pictures made of pictures.
void write_png(const std::filesystem::path& path, int width, int height,
               const std::vector<unsigned char>& rgb);

}  // namespace penumbra
