#include "apps/viewer/state/status.h"

#include "apps/common/outputs.h"
#include "apps/viewer/handles/light_handles.h"

namespace penumbra::viewer {
namespace {

nlohmann::json to_json(const Vec3& v) {
  return {v.x, v.y, v.z};
}

nlohmann::json handle_places(const State& state) {
  const Projection projection(state.camera, state.left.width, state.left.height);
  const HandleShape shape = handle_shape(state.handled(), projection);
  nlohmann::json places = nlohmann::json::object();
  const auto add = [&](Handle handle, const Vec3& p) {
    if (const auto at = projection.project(p)) places[name_of(handle)] = {at->x, at->y};
  };
  for (std::size_t k = 0; k < shape.axis_tips.size(); ++k) add(kAxisHandles[k], shape.axis_tips[k]);
  add(Handle::kCenter, shape.center);
  add(Handle::kRim, shape.rim_knob);
  add(Handle::kNormal, shape.normal_tip);
  return places;
}

nlohmann::json light_report(const State& state) {
  const DiskLight disk = state.handled().disk;
  nlohmann::json json = {
      {"center", to_json(disk.center)}, {"normal", to_json(disk.normal)}, {"radius", disk.radius}};
  if (const auto* distant = std::get_if<DistantLight>(&state.shape())) {
    json["direction"] = to_json(distant->direction);
    json["angle_degrees"] = distant->angle_degrees;
  }
  return json;
}

// Those that are on, by name.
nlohmann::json overlays_on(const Overlays& o) {
  nlohmann::json on = nlohmann::json::array();
  for (const auto& [name, flag] : kOverlayFlags)
    if (o.*flag) on.push_back(name);
  return on;
}

nlohmann::json report(const StatusInput& input) {
  const State& state = input.state;
  nlohmann::json json = {
      {"settled", input.settled},
      {"holding", input.holding},
      {"message", input.message},
      {"activity", input.activity},
      {"file", state.path.string()},
      {"method", state.left.method},
      {"against", state.right.method},
      {"arrangement", static_cast<int>(state.arrangement)},
      {"divider", state.divider},
      {"shown", static_cast<int>(state.shown)},
      {"cut", state.overlays.cut},
      {"cut_axis", static_cast<int>(state.overlays.cut_axis)},
      {"minimised", input.minimised},
      {"unsaved", input.unsaved},
      {"can_undo", input.can_undo},
      {"can_redo", input.can_redo},
      {"dialog", input.dialog},
      {"solid_detail", input.solid_detail},
      {"overlays", overlays_on(state.overlays)},
      {"picture", {state.left.width, state.left.height}},
      {"light", light_report(state)},
      {"lights", state.lights.size()},
      {"selected", state.selected},
      {"camera", {{"eye", to_json(state.camera.eye)}, {"target", to_json(state.camera.target)}}},
      {"handles", handle_places(state)}};
  for (const auto& [name, at] : input.places) json["widgets"][name] = {at.x, at.y};
  if (!input.frame) return json;
  json["frame"] = {{"number", input.frame->number},
                   {"final", input.frame->final},
                   {"reduction", input.frame->reduction},
                   {"refining", input.frame->refining},
                   {"milliseconds", input.frame->milliseconds},
                   {"trouble", input.frame->trouble},
                   {"per_second", input.per_second}};
  for (const Side& side : input.frame->sides) json["frame"]["rays"].push_back(side.rays);
  return json;
}

}  // namespace

void StatusFile::update(const StatusInput& input) {
  if (!path_.empty()) write(report(input));
}

void StatusFile::update_empty(const std::map<std::string, PicturePoint>& places, const std::string& message) {
  if (path_.empty()) return;
  nlohmann::json json = {{"settled", false}, {"holding", false}, {"empty", true}, {"message", message}};
  for (const auto& [name, at] : places) json["widgets"][name] = {at.x, at.y};
  write(json);
}

void StatusFile::write(const nlohmann::json& json) {
  std::string text = apps::to_text(json);
  if (text == written_) return;
  apps::write_json(path_, json);
  written_ = std::move(text);
}

}  // namespace penumbra::viewer
