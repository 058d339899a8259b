// What the colors of overlays mean, at the lower left of the picture.
#pragma once

#include <vector>

#include "apps/viewer/state/state.h"

struct ImDrawList;

namespace penumbra::viewer {

struct LegendEntry {
  unsigned color;     ///< ImGui's; 0: a heading
  const char* text;   ///< a literal
  bool line = false;  ///< drawn as a line, else as a square
};
/// Of all that is shown, from the top. Empty where nothing needs one.
std::vector<LegendEntry> legend_of(const State& state);

/// With its lower left corner there, pixels. Returns its height.
float draw_legend(ImDrawList& list, const std::vector<LegendEntry>& legend, float left, float bottom);

}  // namespace penumbra::viewer
