#include "apps/viewer/work/exports.h"

#include <chrono>
#include <cmath>
#include <cstdio>

#include "apps/common/scene_volumes.h"
#include "mesh/vectors.h"
#include "penumbra/volumes/volumes.h"

namespace penumbra::viewer {
namespace {

constexpr int kPictures = 24;  // of a sequence

}  // namespace

std::string export_volumes(const std::filesystem::path& folder, const State& state) {
  const Scene scene = current_scene(state);
  const CircularLight light = require_circular(scene.lights[state.selected].shape, "exporting volumes");
  VolumeOptions options{.sheets = true, .extrude = apps::extrude_options_for(scene, light)};
  std::vector<ShadowMesh> sheets, penumbra, umbra;
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    if (!scene.objects[i].casts) continue;
    options.extrude.object = static_cast<std::uint32_t>(i);
    ShadowVolumes made = build_shadow_volumes(scene.objects[i].mesh, light, options);
    sheets.push_back(std::move(made.sheets));
    penumbra.push_back(std::move(made.penumbra));
    umbra.push_back(std::move(made.umbra));
  }
  const std::string stem = state.path.stem().string();
  write_shadow_mesh(folder / (stem + "-sheets.ply"), merge(sheets));
  write_shadow_mesh(folder / (stem + "-penumbra.ply"), merge(penumbra));
  write_shadow_mesh(folder / (stem + "-umbra.ply"), merge(umbra));
  return "saved " + (folder / (stem + "-{sheets,penumbra,umbra}.ply")).string();
}

HandledLight light_on_path(const State& state, double t) {
  const HandledLight start = handled(state.model->lights[state.selected].shape, state.casters);
  HandledLight light = state.handled();
  if (t >= 1.0) return light;
  const DiskLight &from = start.disk, to = light.disk;
  light.disk.center = (1.0 - t) * from.center + t * to.center;
  light.disk.radius = std::lerp(from.radius, to.radius, t);
  const Vec3 normal = (1.0 - t) * detail::unit(from.normal) + t * detail::unit(to.normal);
  // Opposite ends: the start's, until the end.
  light.disk.normal = detail::largest_component(normal) > 1e-6 ? normal : from.normal;
  return light;
}

std::string export_sequence(const std::filesystem::path& folder, const State& state) {
  const Scene scene = current_scene(state);
  const Display display{state.exposure, scene.picture.background};
  Renderer renderer(scene);
  for (int i = 0; i < kPictures; ++i) {
    State moved = state;
    moved.set_handled(light_on_path(state, static_cast<double>(i) / (kPictures - 1)));
    renderer.set_light(state.selected, moved.lights[state.selected]);
    char end[32];
    std::snprintf(end, sizeof end, "-path-%03d.png", i + 1);
    write_png(folder / (state.path.stem().string() + end), renderer.render(state.left).image, display);
  }
  return "saved " + std::to_string(kPictures) + " pictures " +
         (folder / (state.path.stem().string() + "-path-*.png")).string();
}

Exports::~Exports() {
  if (task_.valid()) task_.wait();
}

std::string Exports::start(std::string (*work)(const std::filesystem::path&, const State&),
                           const std::filesystem::path& folder, const State& state) {
  if (task_.valid()) return "another export is still running";
  task_ = std::async(std::launch::async, [work, folder, state, wake = wake_] {
    std::string line;
    try {
      line = work(folder, state);
    } catch (const std::exception& e) {
      line = e.what();
    }
    wake();
    return line;
  });
  return "exporting";
}

std::string Exports::news() {
  const bool done = task_.valid() && task_.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
  return done ? task_.get() : std::string();
}

}  // namespace penumbra::viewer
