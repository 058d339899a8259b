// What a scene asks of its pictures beyond lights and surfaces. Nothing here changes a visibility.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "penumbra/mesh/types.h"

namespace penumbra {

/// What a PNG shows where no surface is seen, or one that is not opaque.
struct Background {
  /// Light gray. Exposure does not change it.
  std::array<unsigned char, 3> srgb{230, 230, 230};
  /// In its place nothing: the PNG has an alpha channel.
  bool transparent = false;
  friend bool operator==(const Background&, const Background&) = default;
};

/// From "#rrggbb" (sRGB), "white", "black" or "transparent". Throws UsageError that lists these.
Background parse_background(std::string_view text);
/// "#rrggbb" or "transparent".
std::string to_text(const Background& background);

/// Samples along each side of a pixel: at most so many.
inline constexpr int kMostAntialias = 16;

struct PictureSettings {
  /// Fill light: the radiance of a sky that nothing hides, above a ground half as bright. A surface gets
  /// albedo · ambient · (3 + n·up) / 4 for its shading normal n and the camera's up.
  Vec3 ambient{0.0};
  Background background{};
  /// Samples along each side of a pixel. A wish: programs hand it to RenderOptions.
  int antialias = 1;
  /// Disks and rectangles are seen as what they are: they have their radiance in front, and are black behind.
  /// Distant lights are not.
  bool show_lights = false;
};

}  // namespace penumbra
