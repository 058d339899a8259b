#include "apps/viewer/light_drawing.h"

#include <imgui.h>

#include <glm/geometric.hpp>

namespace penumbra::viewer {
namespace {

constexpr ImU32 kYellow = IM_COL32(255, 214, 64, 255), kOutline = IM_COL32(20, 20, 20, 200);
constexpr ImU32 kMarked = IM_COL32(255, 255, 255, 255);
constexpr ImU32 kAxisColors[3] = {IM_COL32(235, 72, 72, 255), IM_COL32(86, 200, 86, 255),
                                  IM_COL32(84, 136, 250, 255)};
constexpr Handle kAxes[3] = {Handle::kAxisX, Handle::kAxisY, Handle::kAxisZ};

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
  void knob(const Vec3& p, ImU32 color, float radius) const {
    const auto at = projection_.project(p);
    if (!at) return;
    list_.AddCircleFilled(place(*at), radius + 1.5f, kOutline);
    list_.AddCircleFilled(place(*at), radius, color);
  }
  void letter(const Vec3& p, const char* text, ImU32 color) const {
    const auto at = projection_.project(p);
    if (at) list_.AddText({place(*at).x + 8.0f, place(*at).y - 7.0f}, color, text);
  }

 private:
  ImDrawList& list_;
  const Projection& projection_;
};

}  // namespace

void draw_light(ImDrawList& list, const DiskLight& light, const Projection& projection, Handle marked) {
  const HandleShape shape = handle_shape(light, projection);
  const Pen pen(list, projection);
  const auto color = [&](Handle handle, ImU32 usual) { return handle == marked ? kMarked : usual; };
  const auto width = [&](Handle handle) { return handle == marked ? 3.0f : 2.0f; };
  for (std::size_t i = 0; i < shape.rim.size(); ++i)
    pen.line(shape.rim[i], shape.rim[(i + 1) % shape.rim.size()], color(Handle::kRim, kYellow),
             width(Handle::kRim));
  for (std::size_t k = 0; k < 3; ++k) {
    const ImU32 axis = color(kAxes[k], kAxisColors[k]);
    pen.line(shape.center, shape.axis_tips[k], axis, width(kAxes[k]));
    pen.knob(shape.axis_tips[k], axis, 5.0f);
    constexpr const char* kLetters[3] = {"x", "y", "z"};
    pen.letter(shape.axis_tips[k], kLetters[k], axis);
  }
  pen.line(shape.center, shape.normal_tip, color(Handle::kNormal, kYellow), width(Handle::kNormal));
  pen.knob(shape.normal_tip, color(Handle::kNormal, kYellow), 6.0f);
  pen.knob(shape.rim_knob, color(Handle::kRim, kYellow), 5.0f);
  pen.knob(shape.center, color(Handle::kCenter, IM_COL32(255, 240, 200, 255)), 5.0f);
}

}  // namespace penumbra::viewer
