#include "apps/viewer/panel/status_line.h"

#include <imgui.h>

#include <algorithm>
#include <cstdio>

#include "apps/viewer/panel/widgets.h"
#include "apps/viewer/panel/words.h"

namespace penumbra::viewer {
namespace {

// As much of it as fits into so many pixels. Cuts between UTF-8 characters.
std::string shortened(const std::string& text, float room) {
  if (ImGui::CalcTextSize(text.c_str()).x <= room) return text;
  std::string cut = text;
  while (!cut.empty() && ImGui::CalcTextSize((cut + "…").c_str()).x > room) {
    while (!cut.empty() && (static_cast<unsigned char>(cut.back()) & 0xC0) == 0x80) cut.pop_back();
    if (!cut.empty()) cut.pop_back();
  }
  return cut + "…";
}

std::string one_line(std::string text) {
  std::ranges::replace(text, '\n', ' ');
  return text;
}

// A method's draft may have fewer rays at full size; how many is told below.
std::string draft_in_words(const Frame& frame) {
  if (frame.reduction < 2) return "full size";
  std::string text = "draft";
  if (!frame.sides.empty() && frame.sides.front().result) {
    const Image& image = frame.sides.front().result->image;
    text += " of " + std::to_string(image.width) + " × " + std::to_string(image.height);
  }
  return text + ", 1/" + std::to_string(frame.reduction) + " of full size";
}

}  // namespace

std::string picture_in_words(const Frame* frame, bool settled) {
  if (!frame) return "making the first picture";
  if (!frame->trouble.empty()) return "no picture";
  std::string text = settled ? "final picture" : draft_in_words(*frame);
  for (const Side& side : frame->sides)
    if (side.rays)
      text += ", " + with_commas(static_cast<std::size_t>(side.rays)) + " rays a pixel" +
              (frame->refining ? ", refining" : "");
  if (!frame->error) return text;
  char error[96];
  std::snprintf(error, sizeof error, "; error in the penumbra: %.2g RMSE, at most %.3f", frame->error->rmse,
                frame->error->max_absolute);
  return text + error;
}

void draw_status_line(const StatusLineInput& input) {
  ImGui::SetNextWindowPos({0.0f, static_cast<float>(input.y)});
  ImGui::SetNextWindowSize({static_cast<float>(input.width), static_cast<float>(input.height)});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1.0f, 1.0f});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding,
                      {0.6f * ImGui::GetFontSize(), 0.4f * ImGui::GetFontSize()});
  ImGui::PushStyleColor(ImGuiCol_WindowBg, {0.17f, 0.18f, 0.2f, 1.0f});
  ImGui::Begin("status", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoFocusOnAppearing);
  const float width = ImGui::GetContentRegionAvail().x;
  const float right = ImGui::CalcTextSize(input.activity.c_str()).x;
  const float room = std::max(width - right - 2.0f * ImGui::GetFontSize(), 0.4f * width);
  ImGui::TextUnformatted(shortened(one_line(input.message), room).c_str());
  help_on_hover(input.message);
  ImGui::SameLine(std::max(room, width - right) + ImGui::GetStyle().WindowPadding.x);
  ImGui::TextDisabled("%s", input.activity.c_str());
  ImGui::End();
  ImGui::PopStyleColor();
  ImGui::PopStyleVar(2);
}

}  // namespace penumbra::viewer
