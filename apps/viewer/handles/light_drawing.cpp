#include "apps/viewer/handles/light_drawing.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace penumbra::viewer {
namespace {

constexpr ImU32 kYellow = IM_COL32(255, 214, 64, 255), kOutline = IM_COL32(20, 20, 20, 200);
constexpr ImU32 kMarked = IM_COL32(255, 255, 255, 255);
constexpr ImU32 kAxisColors[3] = {IM_COL32(235, 72, 72, 255), IM_COL32(86, 200, 86, 255),
                                  IM_COL32(84, 136, 250, 255)};

ImVec2 place(const PicturePoint& p) {
  return {static_cast<float>(p.x), static_cast<float>(p.y)};
}

class Pen {
 public:
  Pen(ImDrawList& list, const Projection& projection) : list_(list), projection_(projection) {}

  void line(const Vec3& a, const Vec3& b, ImU32 color, float width) const {
    const auto from = projection_.project(a), to = projection_.project(b);
    if (!from || !to) return;
    list_.AddLine(place(*from), place(*to), kOutline, width + 2.0f);
    list_.AddLine(place(*from), place(*to), color, width);
  }
  // Nothing where part of it is not in front of the eye.
  void disk(const std::vector<Vec3>& rim, ImU32 color, float width) const {
    std::vector<ImVec2> corners;
    for (const Vec3& p : rim) {
      const auto at = projection_.project(p);
      if (!at) return;
      corners.push_back(place(*at));
    }
    const int count = static_cast<int>(corners.size());
    list_.AddConvexPolyFilled(corners.data(), count, IM_COL32(255, 224, 120, 70));
    list_.AddPolyline(corners.data(), count, kOutline, ImDrawFlags_Closed, width + 2.0f);
    list_.AddPolyline(corners.data(), count, color, ImDrawFlags_Closed, width);
  }
  void knob(const Vec3& p, ImU32 color, float radius) const {
    const auto at = projection_.project(p);
    if (!at) return;
    list_.AddCircleFilled(place(*at), radius + 1.5f, kOutline);
    list_.AddCircleFilled(place(*at), radius, color);
  }
  void letter(const Vec3& p, const char* text, ImU32 color) const {
    const auto at = projection_.project(p);
    if (!at) return;
    const ImVec2 corner{place(*at).x + 8.0f, place(*at).y - 7.0f};
    list_.AddText({corner.x + 1.0f, corner.y + 1.0f}, kOutline, text);
    list_.AddText(corner, color, text);
  }

 private:
  ImDrawList& list_;
  const Projection& projection_;
};

// Where the light is outside the picture: an arrow at the border that points to it.
void draw_pointer_to_light(ImDrawList& list, const Vec3& center, const Projection& projection, ImVec2 size) {
  const Vec3 offset = center - projection.eye();
  ImVec2 way{static_cast<float>(glm::dot(offset, projection.right())),
             static_cast<float>(-glm::dot(offset, projection.up()))};
  if (const auto at = projection.project(center)) {
    if (at->x >= 0.0 && at->y >= 0.0 && at->x < size.x && at->y < size.y) return;
    way = {static_cast<float>(at->x) - 0.5f * size.x, static_cast<float>(at->y) - 0.5f * size.y};
  }
  const float length = std::max(std::hypot(way.x, way.y), 1e-6f);
  const ImVec2 unit{way.x / length, way.y / length};
  const float room = std::min((0.5f * size.x - 20.0f) / std::max(std::abs(unit.x), 1e-6f),
                              (0.5f * size.y - 20.0f) / std::max(std::abs(unit.y), 1e-6f));
  const ImVec2 tip{0.5f * size.x + room * unit.x, 0.5f * size.y + room * unit.y};
  const ImVec2 tail{tip.x - 16.0f * unit.x, tip.y - 16.0f * unit.y};
  const ImVec2 side{-7.0f * unit.y, 7.0f * unit.x};
  list.AddTriangleFilled(tip, {tail.x + side.x, tail.y + side.y}, {tail.x - side.x, tail.y - side.y},
                         kYellow);
  constexpr const char* kText = "light: Shift+Home shows it";
  const ImVec2 room_for_text = ImGui::CalcTextSize(kText);
  const float x = std::min(tail.x + 12.0f, size.x - room_for_text.x - 6.0f);
  list.AddRectFilled({x - 4.0f, tail.y - 8.0f}, {x + room_for_text.x + 4.0f, tail.y + room_for_text.y - 4.0f},
                     kOutline, 3.0f);
  list.AddText({x, tail.y - 6.0f}, kYellow, kText);
}

}  // namespace

void draw_light(ImDrawList& list, const HandledLight& light, const Projection& projection, Handle marked) {
  const ImVec2 low = list.GetClipRectMin(), high = list.GetClipRectMax();
  draw_pointer_to_light(list, light.disk.center, projection, {high.x - low.x, high.y - low.y});
  const HandleShape shape = handle_shape(light, projection);
  const Pen pen(list, projection);
  const auto color = [&](Handle handle, ImU32 usual) { return handle == marked ? kMarked : usual; };
  const auto width = [&](Handle handle) { return handle == marked ? 3.0f : 2.0f; };
  pen.disk(shape.rim, color(Handle::kRim, kYellow), width(Handle::kRim));
  for (std::size_t k = 0; k < shape.axis_tips.size(); ++k) {
    const ImU32 axis = color(kAxisHandles[k], kAxisColors[k]);
    pen.line(shape.center, shape.axis_tips[k], axis, width(kAxisHandles[k]));
    pen.knob(shape.axis_tips[k], axis, 5.0f);
    constexpr const char* kLetters[3] = {"x", "y", "z"};
    pen.letter(shape.axis_tips[k], kLetters[k], axis);
  }
  pen.line(shape.center, shape.normal_tip, color(Handle::kNormal, kYellow), width(Handle::kNormal));
  pen.knob(shape.normal_tip, color(Handle::kNormal, kYellow), 6.0f);
  if (light.middle) pen.line(shape.center, shape.rim_knob, color(Handle::kRim, kYellow), 1.0f);
  pen.knob(shape.rim_knob, color(Handle::kRim, kYellow), 5.0f);
  pen.knob(shape.center, color(Handle::kCenter, IM_COL32(255, 240, 200, 255)), 5.0f);
}

}  // namespace penumbra::viewer
