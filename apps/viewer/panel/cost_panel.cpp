#include "apps/viewer/panel/cost_panel.h"

#include <imgui.h>

#include <algorithm>
#include <cfloat>
#include <cstdio>

#include "apps/viewer/panel/words.h"

namespace penumbra::viewer {
namespace {

void stage_bars(const RenderResult& result) {
  double longest = 1e-9;
  for (const StageTime& stage : result.stages) longest = std::max(longest, stage.milliseconds);
  const float font = ImGui::GetFontSize();
  for (const StageTime& stage : result.stages) {
    char text[64];
    std::snprintf(text, sizeof text, "%.1f ms", stage.milliseconds);
    ImGui::ProgressBar(static_cast<float>(stage.milliseconds / longest), {9.0f * font, 1.1f * font}, text);
    ImGui::SameLine();
    ImGui::TextUnformatted(stage.name.c_str());
  }
}

void side_costs(const Side& side) {
  const RenderResult& result = *side.result;
  ImGui::Text("%s, %d × %d: %.1f ms", words_of_method(side.options.method).c_str(), result.image.width,
              result.image.height, result.frame_ms);
  stage_bars(result);
  for (const MethodFrame& frame : result.lights)
    for (const Count& count : frame.counts)
      ImGui::TextDisabled("%s: %s", count.name.c_str(), to_text(count.value).c_str());
}

}  // namespace

void cost_section(const Frame* frame, const Costs& costs) {
  if (!ImGui::CollapsingHeader("Cost") || !frame) return;
  ImGui::Text("%d pictures in the last second; %.0f MiB", costs.per_second(),
              static_cast<double>(resident_bytes()) / (1 << 20));
  const std::vector<float>& history = costs.history();
  ImGui::PlotHistogram("##ms", history.data(), static_cast<int>(history.size()), 0, "ms a picture", 0.0f,
                       FLT_MAX, {-1.0f, 3.0f * ImGui::GetFontSize()});
  for (const Side& side : frame->sides) side_costs(side);
}

}  // namespace penumbra::viewer
