#include "apps/viewer/state/state_file.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <utility>

#include "apps/common/outputs.h"
#include "apps/viewer/state/method_settings.h"
#include "penumbra/mesh/error.h"
#include "penumbra/mesh/io/polygon_soup.h"

namespace penumbra::viewer {
namespace {

constexpr std::array kArrangements{std::pair(Arrangement::kSingle, "single"),
                                   std::pair(Arrangement::kSplit, "split"),
                                   std::pair(Arrangement::kDifference, "difference")};

constexpr std::array kShown{std::pair(Shown::kPicture, "picture"),
                            std::pair(Shown::kVisibility, "visibility"),
                            std::pair(Shown::kRegion, "certified")};

constexpr std::array kCutAxes{std::pair(CutAxis::kLight, "light"), std::pair(CutAxis::kX, "x"),
                              std::pair(CutAxis::kY, "y"), std::pair(CutAxis::kZ, "z")};

nlohmann::json to_json(const Vec3& v) {
  return {v.x, v.y, v.z};
}

nlohmann::json to_json(const RenderOptions& options) {
  nlohmann::json json = {{"method", options.method}};
  for (const OptionSchema& option : method_named(options.method).options)
    json[option.name] = value_of(options, option);
  return json;
}

void read(const nlohmann::json& json, RenderOptions& options) {
  options.method = method_named(json.at("method").get<std::string>()).name;
  for (const auto& [name, value] : json.items())
    if (name != "method") set(options, name, value.get<std::string>());
}

nlohmann::json viewer_settings(const State& state) {
  nlohmann::json json = {{"left", to_json(state.left)},
                         {"right", to_json(state.right)},
                         {"divider", state.divider},
                         {"exposure", state.exposure},
                         {"difference_scale", state.difference_scale},
                         {"cut", state.overlays.cut},
                         {"detail", state.overlays.detail},
                         {"aim", state.aim},
                         {"probe", state.probe},
                         {"light", state.selected}};
  for (const auto& [value, name] : kArrangements)
    if (value == state.arrangement) json["arrangement"] = name;
  for (const auto& [value, name] : kShown)
    if (value == state.shown) json["shown"] = name;
  for (const auto& [value, name] : kCutAxes)
    if (value == state.overlays.cut_axis) json["cut_axis"] = name;
  for (const auto& [name, flag] : kOverlayFlags) json["overlays"][name] = state.overlays.*flag;
  return json;
}

// A path that leads from the new file's folder to what the old one named.
std::string moved_path(const std::string& mesh, const std::filesystem::path& from_folder,
                       const std::filesystem::path& to_folder) {
  // Links are followed: the system takes .. from where they lead.
  const auto real = [](const std::filesystem::path& path) {
    return std::filesystem::weakly_canonical(std::filesystem::absolute(path));
  };
  return real(from_folder / mesh).lexically_proximate(real(to_folder)).string();
}

// The objects of a document made for a bare mesh leave out the floor, which has no file.
nlohmann::json floor_entry(const std::filesystem::path& path, const SceneObject& floor) {
  const std::string name = path.stem().string() + "-floor.ply";
  write_mesh(path.parent_path() / name, floor.mesh);
  return {{"mesh", name},
          {"albedo", to_json(floor.albedo)},
          {"casts", floor.casts},
          {"fade", {floor.fade.from, floor.fade.to}}};
}

void write_distant(const Light& light, const DistantLight& distant, nlohmann::json& json) {
  json["direction"] = to_json(distant.direction);
  json["angle_degrees"] = distant.angle_degrees;
  json["irradiance"] = to_json(light.radiance * irradiance_per_radiance(distant));
  json.erase("radiance");
}

void write_light(const Light& light, nlohmann::json& json) {
  if (const auto* distant = std::get_if<DistantLight>(&light.shape))
    return write_distant(light, *distant, json);
  const DiskLight disk = disk_around(light.shape);
  json["center"] = to_json(disk.center);
  json["normal"] = to_json(disk.normal);
  json["radiance"] = to_json(light.radiance);
  if (const auto* rectangle = std::get_if<RectangleLight>(&light.shape)) {
    json["tangent"] = to_json(rectangle->tangent);
    json["half_extents"] = {rectangle->half_extents.x, rectangle->half_extents.y};
  } else {
    json["radius"] = disk.radius;
  }
}

nlohmann::json scene_document(const std::filesystem::path& path, const State& state) {
  nlohmann::json document = nlohmann::json::parse(state.model->document);
  if (!document.contains("objects"))
    throw UsageError(
        "a scene of a glTF file cannot be saved as a scene file; save the picture, or change the glTF file");
  const bool bare = document.contains("x-made-for");
  const std::filesystem::path folder = bare ? std::filesystem::path() : state.path.parent_path();
  for (nlohmann::json& object : document["objects"])
    for (const char* key : {"mesh", "heightfield"})
      if (object.contains(key))
        object[key] = moved_path(object[key].get<std::string>(), folder, path.parent_path());
  if (bare) {
    document["objects"].insert(document["objects"].begin(), floor_entry(path, state.model->objects.front()));
    document.erase("x-made-for");
    document.erase("antialias");  // what is shown has one sample a pixel
  }
  // A light that was left alone keeps its numbers as they were written.
  for (std::size_t i = 0; i < state.lights.size(); ++i)
    if (!(state.lights[i] == state.model->lights[i])) write_light(state.lights[i], document["lights"][i]);
  document["camera"] = {{"eye", to_json(state.camera.eye)},
                        {"target", to_json(state.camera.target)},
                        {"up", to_json(state.camera.up)},
                        {"fov_y_degrees", state.camera.fov_y_degrees}};
  document["x-viewer"] = viewer_settings(state);
  return document;
}

std::string quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

}  // namespace

void save_state(const std::filesystem::path& path, const State& state) {
  apps::require_writable(path);
  apps::write_json(path, scene_document(path, state));
}

void read_viewer_settings(const nlohmann::json& settings, State& state) {
  read(settings.at("left"), state.left);
  read(settings.at("right"), state.right);
  for (const auto& [value, name] : kArrangements)
    if (settings.value("arrangement", "") == name) state.arrangement = value;
  for (const auto& [value, name] : kShown)
    if (settings.value("shown", "") == name) state.shown = value;
  for (const auto& [value, name] : kCutAxes)
    if (settings.value("cut_axis", "") == name) state.overlays.cut_axis = value;
  state.divider = std::clamp(settings.value("divider", state.divider), 0.02, 0.98);
  state.exposure = settings.value("exposure", state.exposure);
  state.difference_scale = std::clamp(settings.value("difference_scale", state.difference_scale), 0.005, 1.0);
  state.overlays.cut = std::clamp(settings.value("cut", state.overlays.cut), 0.0, 1.0);
  state.overlays.detail = std::clamp(settings.value("detail", state.overlays.detail), kFinest, kCoarsest);
  state.aim = settings.value("aim", state.aim);
  state.probe = settings.value("probe", state.probe);
  state.selected = std::min(settings.value("light", state.selected), state.lights.size() - 1);
  const nlohmann::json overlays = settings.value("overlays", nlohmann::json::object());
  for (const auto& [name, flag] : kOverlayFlags)
    state.overlays.*flag = overlays.value(name, state.overlays.*flag);
}

std::string headless_command(const std::filesystem::path& scene, const State& state) {
  char size[64];
  std::snprintf(size, sizeof size, " --size %dx%d", state.left.width, state.left.height);
  std::string command = "penumbra render " + quoted(scene.string()) + " --method " + state.left.method + size;
  command += settings_arguments(state.left);
  if (state.exposure != 0.0) command += " --exposure " + nlohmann::json(state.exposure).dump();
  return command + " --output " + quoted(scene.stem().string() + ".png");
}

}  // namespace penumbra::viewer
