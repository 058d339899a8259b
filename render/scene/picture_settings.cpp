#include "penumbra/render/scene/picture_settings.h"

#include <charconv>
#include <cstdio>

#include "penumbra/mesh/error.h"

namespace penumbra {

Background parse_background(std::string_view text) {
  if (text == "transparent") return {.transparent = true};
  if (text == "white") return {.srgb = {255, 255, 255}};
  if (text == "black") return {.srgb = {0, 0, 0}};
  unsigned number = 0;
  const char* end = text.data() + text.size();
  if (text.size() == 7 && text.front() == '#') {
    const auto [stop, error] = std::from_chars(text.data() + 1, end, number, 16);
    if (error == std::errc() && stop == end)
      return {.srgb = {static_cast<unsigned char>(number >> 16),
                       static_cast<unsigned char>(number >> 8 & 255),
                       static_cast<unsigned char>(number & 255)}};
  }
  throw UsageError("background \"" + std::string(text) +
                   "\" is no color; give #rrggbb, white, black or transparent");
}

std::string to_text(const Background& background) {
  if (background.transparent) return "transparent";
  char text[8];
  std::snprintf(text, sizeof text, "#%02x%02x%02x", background.srgb[0], background.srgb[1],
                background.srgb[2]);
  return text;
}

}  // namespace penumbra
