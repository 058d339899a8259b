// Sizes of the window's parts. All follow the height of the font.
#pragma once

namespace penumbra::viewer {

struct Look {
  /// Height of the font, pixels.
  float font = 15.0f;

  /// Of the panel beside the picture, pixels.
  int panel_width() const { return static_cast<int>(22.0f * font); }
  /// Of the status line below picture and panel, pixels.
  int status_height() const { return static_cast<int>(1.8f * font); }
};

}  // namespace penumbra::viewer
