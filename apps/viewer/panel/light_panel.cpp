#include "apps/viewer/panel/light_panel.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "mesh/vectors.h"

namespace penumbra::viewer {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

// Tilt from straight down and the compass direction it leans to; the normal changes only where a slider
// moves.
void tilt_sliders(DiskLight& light, Places& places) {
  const Vec3 n = detail::unit(light.normal);
  double tilt = kDegrees * std::acos(std::clamp(-n.y, -1.0, 1.0));
  double turn = std::hypot(n.x, n.z) > 1e-9 ? kDegrees * std::atan2(n.x, n.z) : 0.0;
  bool changed = slider(places, "Tilt", tilt, 0.0, 180.0, "%.1f° from straight down");
  changed |= slider(places, "Turn", turn, -180.0, 180.0, "%.1f° about y");
  if (!changed) return;
  tilt = std::clamp(tilt, 0.01, 179.99);  // so that the turn is not forgotten
  const double level = std::sin(tilt / kDegrees);
  light.normal = {level * std::sin(turn / kDegrees), -std::cos(tilt / kDegrees),
                  level * std::cos(turn / kDegrees)};
}

// Which of several lights is edited.
void light_choice(State& state, Places& places) {
  if (state.lights.size() < 2) return;
  std::vector<std::string> names;
  for (const Light& light : state.lights) names.push_back(light.name);
  state.selected = combo(places, "Light", state.selected, names);
}

// A disk, or the disk around a rectangle.
void near_sliders(State& state, Places& places) {
  const double size = std::max(state.casters.radius(), 1e-6);
  const Vec3 middle = state.casters.center();
  DiskLight light = state.handled().disk;
  const DiskLight before = light;
  slider(places, "x", light.center.x, middle.x - 6.0 * size, middle.x + 6.0 * size, "%.3f");
  slider(places, "y", light.center.y, middle.y - 6.0 * size, middle.y + 6.0 * size, "%.3f");
  slider(places, "z", light.center.z, middle.z - 6.0 * size, middle.z + 6.0 * size, "%.3f");
  tilt_sliders(light, places);
  slider(places, "Radius", light.radius, 0.0, 2.0 * size, "%.3f");
  if (light != before) state.set_handled(light);
}

void distant_sliders(State& state, Places& places) {
  DistantLight light = std::get<DistantLight>(state.shape());
  Heading heading = heading_of(light);
  bool changed = slider(places, "Azimuth", heading.azimuth, -180.0, 180.0, "%.1f° from z to x");
  changed |= slider(places, "Elevation", heading.elevation, -90.0, 90.0, "%.1f°");
  if (changed) {
    heading.elevation = std::clamp(heading.elevation, -89.99, 89.99);  // so that the azimuth is not forgotten
    light.direction = direction_from(heading);
  }
  slider(places, "Angle", light.angle_degrees, 0.0, 120.0, "%.3f°", ImGuiSliderFlags_Logarithmic);
  if (light != std::get<DistantLight>(state.shape())) state.set_shape(light);
}

// The brightest of three colors; their proportions are kept.
void brightness_slider(Vec3& color, const char* label, const char* format, Places& places) {
  double brightest = std::max({color.x, color.y, color.z});
  const Vec3 hue = brightest > 0.0 ? color / brightest : Vec3(1.0);
  if (slider(places, label, brightest, 0.01, 1000.0, format, ImGuiSliderFlags_Logarithmic))
    color = hue * brightest;
}

}  // namespace

void light_section(State& state, Places& places) {
  if (!ImGui::CollapsingHeader("Light##section", ImGuiTreeNodeFlags_DefaultOpen)) return;
  light_choice(state, places);
  Vec3& radiance = state.lights[state.selected].radiance;
  if (!std::holds_alternative<DistantLight>(state.shape())) {
    near_sliders(state, places);
    ImGui::Checkbox("Keeps shining at the same point when dragged", &state.aim);
    note_place(places, "Aim");
    help_on_hover(
        "While its arrows or its center are dragged the light turns to the point on its axis that it shone "
        "at.");
    return brightness_slider(radiance, "Radiance", "%.3g W/(m² sr)", places);
  }
  distant_sliders(state, places);
  const double factor = irradiance_per_radiance(std::get<DistantLight>(state.shape()));
  const Vec3 before = radiance * factor;
  Vec3 irradiance = before;
  brightness_slider(irradiance, "Irradiance", "%.3g W/m²", places);
  if (irradiance != before) radiance = irradiance / factor;
}

}  // namespace penumbra::viewer
