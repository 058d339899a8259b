#include "apps/viewer/pictures/picture_view.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "apps/common/picture.h"
#include "apps/viewer/handles/light_drawing.h"
#include "apps/viewer/pictures/compose.h"

namespace penumbra::viewer {
namespace {

constexpr int kTextureSide = 112;  // pixels

void label(ImDrawList& list, ImVec2 at, const std::string& text) {
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  list.AddRectFilled({at.x - 4, at.y - 2}, {at.x + size.x + 4, at.y + size.y + 2}, IM_COL32(20, 20, 20, 190),
                     3);
  list.AddText(at, IM_COL32(255, 255, 255, 255), text.c_str());
}

std::string title_of(const Side& side) {
  std::string text = side.options.method;
  if (side.rays) text += ", " + std::to_string(side.rays) + " rays";
  return text;
}

// The colors of the difference with their numbers, at the lower left.
void draw_scale(ImDrawList& list, float bottom, double scale) {
  constexpr int kSteps = 120;
  for (int i = 0; i < kSteps; ++i) {
    const apps::Picture::Color c = apps::signed_color(2.0 * i / (kSteps - 1) - 1.0);
    const float x = 70.0f + static_cast<float>(i);
    list.AddRectFilled({x, bottom - 26.0f}, {x + 1.0f, bottom - 12.0f}, IM_COL32(c.r, c.g, c.b, 255));
  }
  char text[32];
  std::snprintf(text, sizeof text, "%+.3f", -scale);
  label(list, {12.0f, bottom - 26.0f}, text);
  std::snprintf(text, sizeof text, "%+.3f", scale);
  label(list, {200.0f, bottom - 26.0f}, text);
}

const std::vector<TexturePicture>& textures_of(const Frame& frame) {
  return frame.sides.front().result->lights[frame.selected].textures;
}

}  // namespace

void PictureView::update(const State& state, std::shared_ptr<const Frame> frame) {
  if (frame == frame_ && exposure_ == state.exposure && scale_ == state.difference_scale &&
      shown_ == state.shown)
    return;
  frame_ = std::move(frame);
  exposure_ = state.exposure;
  scale_ = state.difference_scale;
  shown_ = state.shown;
  if (!frame_ || frame_->sides.empty()) return;
  left_.upload(picture_of(*frame_, frame_->sides.front(), shown_, exposure_));
  textures_.upload(mosaic_of(textures_of(*frame_), kTextureSide));
  if (frame_->sides.size() < 2) return;
  right_.upload(picture_of(*frame_, frame_->sides.back(), shown_, exposure_));
  difference_.upload(difference_of(*frame_, scale_));
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
  if (all.empty())
    return label(list, {width - 330, height - 24}, "textures: with dbuffer or occlusion-textures");
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

void PictureView::draw_marks(const State& state, const Pointer& pointer, bool settled) const {
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const auto width = static_cast<float>(state.left.width), height = static_cast<float>(state.left.height);
  list.PushClipRect({0, 0}, {width, height});
  if (state.overlays.light)
    draw_light(list, state.handled(), Projection(state.camera, state.left.width, state.left.height),
               pointer.handle());
  if (frame_ && frame_->sides.size() == 2 && state.arrangement == Arrangement::kSplit) {
    const auto x = static_cast<float>(std::round(state.divider * state.left.width));
    list.AddLine({x, 0}, {x, height}, IM_COL32(255, 255, 255, 255), pointer.over_divider() ? 3.0f : 1.0f);
    label(list, {10, 10}, title_of(frame_->sides.front()));
    const std::string right = title_of(frame_->sides.back());
    label(list, {width - ImGui::CalcTextSize(right.c_str()).x - 12, 10}, right);
  }
  if (frame_ && frame_->sides.size() == 2 && state.arrangement == Arrangement::kDifference) {
    label(list, {10, 10},
          title_of(frame_->sides.front()) + " minus " + title_of(frame_->sides.back()) +
              ": blue too dark, red too bright");
    draw_scale(list, height, state.difference_scale);
  }
  if (state.overlays.textures) draw_textures(list, width, height);
  if (!settled && frame_ && !frame_->final)
    label(list, {10, height - 54},
          frame_->reduction > 1 ? "draft 1/" + std::to_string(frame_->reduction) : std::string("draft"));
  list.PopClipRect();
}

}  // namespace penumbra::viewer
