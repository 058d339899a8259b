#include "mesh/io/read_mtl.h"

#include <algorithm>
#include <cmath>

#include "mesh/io/cursor.h"

namespace penumbra::detail {
namespace {

std::optional<Vec3> read_color(TextCursor& cursor) {
  Vec3 color(0.0);
  for (int k = 0; k < 3; ++k) {
    const std::string_view token = cursor.token_of_line();
    if (k > 0 && token.empty()) {
      color[k] = color[0];
    } else if (!parse_number(token, color[k]) || !std::isfinite(color[k])) {
      return std::nullopt;
    }
    color[k] = std::clamp(color[k], 0.0, 1.0);
  }
  return color;
}

}  // namespace

MaterialLibrary read_mtl(std::span<const std::byte> bytes) {
  MaterialLibrary library;
  TextCursor cursor(as_text(bytes), {}, '#', true);
  while (!cursor.at_end()) {
    const std::string_view keyword = cursor.token_of_line();
    if (keyword == "newmtl") {
      library.materials.push_back({.name = cursor.name_of_line()});
    } else if (keyword == "Kd" && !library.materials.empty()) {
      library.materials.back().color = read_color(cursor);
    } else if (keyword == "map_Kd") {
      library.has_textures = true;
    }
    cursor.rest_of_line();
    cursor.skip_line();
  }
  return library;
}

}  // namespace penumbra::detail
