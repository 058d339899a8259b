#include "apps/viewer/pictures/picture_view.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "apps/common/picture.h"
#include "apps/viewer/handles/light_drawing.h"
#include "apps/viewer/panel/words.h"
#include "apps/viewer/pictures/compose.h"
#include "apps/viewer/pictures/legend.h"

namespace penumbra::viewer {
namespace {

constexpr int kTextureSide = 112;  // pixels

void label(ImDrawList& list, ImVec2 at, const std::string& text) {
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  list.AddRectFilled({at.x - 6, at.y - 3}, {at.x + size.x + 6, at.y + size.y + 3}, IM_COL32(20, 20, 24, 200),
                     4);
  list.AddText(at, IM_COL32(255, 255, 255, 255), text.c_str());
}

std::string title_of(const Side& side) {
  std::string text = words_of_method(side.options.method);
  if (side.rays) text += ", " + with_commas(static_cast<std::size_t>(side.rays)) + " rays";
  return text;
}

// Pictures a second while something moves, else what the picture took.
std::string pace_of(const Frame& frame, const PictureView::Marks& marks) {
  char text[64];
  if (marks.settled || frame.final || marks.per_second < 2)
    std::snprintf(text, sizeof text, "%.0f ms", frame.milliseconds);
  else
    std::snprintf(text, sizeof text, "%d pictures a second", marks.per_second);
  if (marks.settled || frame.final || frame.reduction < 2) return text;
  return text + std::string(", draft 1/") + std::to_string(frame.reduction);
}

// The colors of the difference with their numbers, with the lower left corner there.
void draw_scale(ImDrawList& list, float left, float bottom, double scale) {
  constexpr int kSteps = 160;
  const float font = ImGui::GetFontSize(), top = bottom - 3.4f * font;
  char low[32], high[32];
  std::snprintf(low, sizeof low, "−%.3f", scale);
  std::snprintf(high, sizeof high, "+%.3f", scale);
  list.AddRectFilled({left, top}, {left + kSteps + font, bottom}, IM_COL32(20, 20, 24, 200), 4.0f);
  const float x = left + 0.5f * font, y = top + 0.5f * font;
  for (int i = 0; i < kSteps; ++i) {
    const apps::Picture::Color c = apps::signed_color(2.0 * i / (kSteps - 1) - 1.0);
    const float at = x + static_cast<float>(i);
    list.AddRectFilled({at, y}, {at + 1.0f, y + font}, IM_COL32(c.r, c.g, c.b, 255));
  }
  list.AddText({x, y + 1.3f * font}, IM_COL32_WHITE, low);
  list.AddText({x + kSteps - ImGui::CalcTextSize(high).x, y + 1.3f * font}, IM_COL32_WHITE, high);
}

const std::vector<TexturePicture>& textures_of(const Frame& frame) {
  return frame.sides.front().result->lights[frame.selected].textures;
}

}  // namespace

void PictureView::upload(const State& state) {
  if (uploaded_ == frame_ && exposure_ == state.exposure && scale_ == state.difference_scale &&
      shown_ == state.shown)
    return;
  uploaded_ = frame_;
  exposure_ = state.exposure;
  scale_ = state.difference_scale;
  shown_ = state.shown;
  if (!frame_ || frame_->sides.empty()) return;
  const bool draft = frame_->reduction > 1;
  left_.upload(picture_of(*frame_, frame_->sides.front(), shown_, exposure_), draft);
  textures_.upload(mosaic_of(textures_of(*frame_), kTextureSide));
  if (frame_->sides.size() < 2) return;
  right_.upload(picture_of(*frame_, frame_->sides.back(), shown_, exposure_), draft);
  difference_.upload(difference_of(*frame_, scale_), draft);
}

void PictureView::draw_picture(const State& state) const {
  if (!frame_ || frame_->sides.empty()) return;
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  // A draft's last pixels may reach beyond the picture: it shows whole pixels of `reduction` a side.
  const Image& image = frame_->sides.front().result->image;
  const auto reduction = static_cast<float>(frame_->reduction);
  const bool draft = frame_->reduction > 1;
  const ImVec2 size = draft ? ImVec2(static_cast<float>(image.width) * reduction,
                                     static_cast<float>(image.height) * reduction)
                            : ImVec2(static_cast<float>(image.width), static_cast<float>(image.height));
  const auto width = static_cast<float>(state.left.width), height = static_cast<float>(state.left.height);
  list.PushClipRect({0, 0}, {width, height});
  const bool two = frame_->sides.size() == 2 && state.two_sided();
  if (two && state.arrangement == Arrangement::kDifference) {
    list.AddImage(difference_.id(), {0, 0}, size);
  } else {
    list.AddImage(left_.id(), {0, 0}, size);
    if (two) {
      const auto x = static_cast<float>(std::round(state.divider * state.left.width));
      list.PushClipRect({x, 0}, {width, height}, true);
      list.AddImage(right_.id(), {0, 0}, size);
      list.PopClipRect();
    }
  }
  list.PopClipRect();
}

// At the lower right, each with its name.
void PictureView::draw_textures(ImDrawList& list, float width, float height) const {
  if (!frame_ || frame_->sides.empty()) return;
  const std::vector<TexturePicture>& all = textures_of(*frame_);
  if (all.empty()) {
    constexpr const char* kNone = "textures: only D-buffer and occlusion textures have them";
    return label(list, {width - ImGui::CalcTextSize(kNone).x - 12, height - ImGui::GetFontSize() - 12},
                 kNone);
  }
  const int count = static_cast<int>(all.size()), columns = std::min(4, count),
            rows = (count + columns - 1) / columns;
  constexpr float kPitch = kTextureSide + 1;
  const ImVec2 low{width - static_cast<float>(columns) * kPitch - 6,
                   height - static_cast<float>(rows) * kPitch - 6};
  list.AddImage(
      textures_.id(), low,
      {low.x + static_cast<float>(columns) * kPitch - 1, low.y + static_cast<float>(rows) * kPitch - 1});
  for (int i = 0; i < count; ++i)
    label(list,
          {low.x + static_cast<float>(i % columns) * kPitch + 6,
           low.y + static_cast<float>(i / columns) * kPitch + 4},
          all[static_cast<std::size_t>(i)].name);
}

void PictureView::draw_titles(ImDrawList& list, const State& state, const Marks& marks) const {
  const bool two = frame_->sides.size() == 2 && state.two_sided();
  const std::string left = title_of(frame_->sides.front()), right = title_of(frame_->sides.back());
  const std::string pace = pace_of(*frame_, marks);
  if (!two) return label(list, {12, 10}, left + ", " + pace);
  if (state.arrangement == Arrangement::kDifference)
    return label(list, {12, 10}, left + " minus " + right + ": blue too dark, red too bright; " + pace);
  label(list, {12, 10}, left + ", both " + pace);
  label(list, {static_cast<float>(state.left.width) - ImGui::CalcTextSize(right.c_str()).x - 12, 10}, right);
}

void PictureView::draw_marks(const State& state, const Marks& marks) const {
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const auto width = static_cast<float>(state.left.width), height = static_cast<float>(state.left.height);
  list.PushClipRect({0, 0}, {width, height});
  if (state.overlays.light)
    draw_light(list, state.handled(), Projection(state.camera, state.left.width, state.left.height),
               marks.pointer.handle());
  if (frame_ && frame_->sides.size() == 2 && state.arrangement == Arrangement::kSplit) {
    const auto x = static_cast<float>(std::round(state.divider * state.left.width));
    list.AddLine({x, 0}, {x, height}, IM_COL32(255, 255, 255, 255),
                 marks.pointer.over_divider() ? 3.0f : 1.0f);
  }
  if (!plain_) {
    float bottom = height - 10.0f;
    if (state.arrangement == Arrangement::kDifference) {
      draw_scale(list, 10.0f, bottom, state.difference_scale);
      bottom -= 4.0f * ImGui::GetFontSize();
    }
    draw_legend(list, legend_of(state), 10.0f, bottom);
    if (frame_ && !frame_->sides.empty()) draw_titles(list, state, marks);
  }
  if (state.overlays.textures) draw_textures(list, width, height);
  list.PopClipRect();
}

}  // namespace penumbra::viewer
