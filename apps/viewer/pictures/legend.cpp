#include "apps/viewer/pictures/legend.h"

#include <imgui.h>

#include <algorithm>

#include "apps/viewer/pictures/overlay_colors.h"

namespace penumbra::viewer {
namespace {

unsigned opaque(const OverlayColor& c) {
  return IM_COL32(c.r, c.g, c.b, 255);
}

void add_shown(Shown shown, std::vector<LegendEntry>& legend) {
  if (shown == Shown::kRegion)
    legend.insert(legend.end(), {{opaque(kRegionLit), "proved to be lit"},
                                 {opaque(kRegionPartly), "in the penumbra"},
                                 {opaque(kRegionUmbra), "proved to be in umbra"},
                                 {opaque(kRegionUnknown), "not proved"}});
  if (shown == Shown::kVisibility)
    legend.insert(legend.end(), {{IM_COL32(255, 255, 255, 255), "sees all of the light"},
                                 {IM_COL32(0, 0, 0, 255), "sees nothing of it"}});
}

void add_solids(const Overlays& o, std::vector<LegendEntry>& legend) {
  if (o.umbra_solid || o.umbra) legend.push_back({opaque(kUmbraColor), "umbra: all of the light is hidden"});
  if (o.penumbra_solid || o.penumbra)
    legend.push_back({opaque(kPenumbraColor), "penumbra: some of the light is hidden"});
}

}  // namespace

std::vector<LegendEntry> legend_of(const State& state) {
  std::vector<LegendEntry> legend;
  const Overlays& o = state.overlays;
  if (state.arrangement != Arrangement::kDifference) add_shown(state.shown, legend);
  add_solids(o, legend);
  if (o.sheets)
    legend.insert(legend.end(), {{opaque(kPenumbraFacetColor), "penumbra facets, of edges"},
                                 {opaque(kPenumbraConeColor), "penumbra cones, of vertices"},
                                 {opaque(kUmbraFacetColor), "umbra facets, of edges"},
                                 {opaque(kUmbraCapColor), "umbra caps, of faces"}});
  if (o.faces)
    legend.insert(legend.end(), {{opaque(kAllFrontColor), "faces all of the light"},
                                 {opaque(kMixedColor), "faces some of the light"},
                                 {opaque(kNoneFrontColor), "faces away from the light"}});
  if (o.silhouettes)
    legend.insert(legend.end(), {{opaque(kPenumbraColor), "penumbra silhouette", true},
                                 {opaque(kUmbraColor), "umbra silhouette", true}});
  if (o.band) legend.push_back({opaque(kBandColor), "may be a silhouette", true});
  return legend;
}

float draw_legend(ImDrawList& list, const std::vector<LegendEntry>& legend, float left, float bottom) {
  if (legend.empty()) return 0.0f;
  const float font = ImGui::GetFontSize(), pitch = 1.35f * font, pad = 0.5f * font;
  float width = 0.0f;
  for (const LegendEntry& each : legend) width = std::max(width, ImGui::CalcTextSize(each.text).x);
  const float height = static_cast<float>(legend.size()) * pitch + 2.0f * pad;
  const float top = bottom - height;
  list.AddRectFilled({left, top}, {left + width + 1.6f * font + 2.0f * pad, bottom},
                     IM_COL32(20, 20, 24, 200), 4.0f);
  for (std::size_t i = 0; i < legend.size(); ++i) {
    const float y = top + pad + static_cast<float>(i) * pitch, x = left + pad, middle = y + 0.5f * font;
    if (legend[i].line)
      list.AddLine({x, middle}, {x + font, middle}, legend[i].color, 3.0f);
    else
      list.AddRectFilled({x, y + 1.0f}, {x + font, y + font}, legend[i].color, 2.0f);
    list.AddText({x + 1.6f * font, y}, IM_COL32(240, 240, 240, 255), legend[i].text);
  }
  return height;
}

}  // namespace penumbra::viewer
