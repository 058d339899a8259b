// What each export writes.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <span>

#include "apps/common/scene_volumes.h"
#include "apps/viewer/work/exports.h"
#include "apps/viewer/work/fresh_name.h"
#include "mesh/vectors.h"
#include "penumbra/render/solids/extrude_solid.h"
#include "penumbra/volumes/volumes.h"

namespace penumbra::viewer {
namespace {

constexpr int kPictures = 24;  // of a sequence
/// Of the casters' diagonal: what extrude_solid takes where nothing is asked for.
constexpr double kUsualDetail = 0.01;

struct NamedMesh {
  std::string end;  ///< of the file's name
  ShadowMesh mesh;
};

/// Nothing is written before all is made.
void write(const std::filesystem::path& folder, const std::string& stem, std::span<const NamedMesh> meshes) {
  for (const NamedMesh& each : meshes) write_shadow_mesh(folder / (stem + each.end), each.mesh);
}

std::string size_of(const ShadowMesh& mesh) {
  return mesh.triangles.empty() ? "is empty" : "has " + std::to_string(mesh.triangles.size()) + " triangles";
}

std::vector<SceneObject> casting(const Scene& scene) {
  std::vector<SceneObject> casters = scene.objects;
  std::erase_if(casters, [](const SceneObject& each) { return !each.casts; });
  return casters;
}

std::string export_solids(const std::filesystem::path& folder, const State& state, const Progress& progress) {
  const Scene scene = current_scene(state);
  const LightShape light = scene.lights[state.selected].shape;
  require_circular(light, "exporting solids");
  const Casters casters(casting(scene));
  if (casters.objects().empty()) return "nothing is exported: no object of the scene casts";
  const auto first = std::ranges::find_if(scene.objects, &SceneObject::casts);
  SolidOptions options{.bound = apps::solid_bound_for(scene),
                       .object = static_cast<std::uint32_t>(first - scene.objects.begin())};
  if (state.overlays.detail < kUsualDetail)
    options.tolerance = 2.0 * state.overlays.detail * scene.caster_bounds().radius();
  const auto solid = [&](ShadowLevel::Kind kind, double begin, double end) {
    options.progress = part_of(progress, begin, end);
    return extrude_solid(casters, light, {kind}, options).mesh;
  };
  const NamedMesh made[] = {{"-umbra.ply", solid(ShadowLevel::Kind::kUmbra, 0.0, 0.5)},
                            {"-penumbra.ply", solid(ShadowLevel::Kind::kPenumbra, 0.5, 1.0)}};
  const std::string stem = fresh_stem(folder, state, {made[0].end, made[1].end});
  write(folder, stem, made);
  return "saved " + (folder / (stem + "-{umbra,penumbra}.ply")).string() + ": the umbra " +
         size_of(made[0].mesh) + ", the penumbra " + size_of(made[1].mesh);
}

std::string export_cells(const std::filesystem::path& folder, const State& state, const Progress& progress) {
  const Scene scene = current_scene(state);
  const CircularLight light = require_circular(scene.lights[state.selected].shape, "exporting volumes");
  VolumeOptions options{.sheets = true, .extrude = apps::extrude_options_for(scene, light)};
  std::vector<ShadowMesh> sheets, penumbra, umbra;
  const auto count = static_cast<double>(scene.objects.size());
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    if (!scene.objects[i].casts) continue;
    const auto begin = static_cast<double>(i);
    options.extrude.object = static_cast<std::uint32_t>(i);
    options.extrude.progress = part_of(progress, begin / count, (begin + 1.0) / count);
    ShadowVolumes made = build_shadow_volumes(scene.objects[i].mesh, light, options);
    sheets.push_back(std::move(made.sheets));
    penumbra.push_back(std::move(made.penumbra));
    umbra.push_back(std::move(made.umbra));
  }
  const NamedMesh made[] = {{"-sheets.ply", merge(sheets)},
                            {"-penumbra-cells.ply", merge(penumbra)},
                            {"-umbra-cells.ply", merge(umbra)}};
  const std::string stem = fresh_stem(folder, state, {made[0].end, made[1].end, made[2].end});
  write(folder, stem, made);
  return "saved " + (folder / (stem + "-{sheets,penumbra-cells,umbra-cells}.ply")).string();
}

std::string export_sequence(const std::filesystem::path& folder, const State& state,
                            const Progress& progress) {
  const Scene scene = current_scene(state);
  const Display display{state.exposure, scene.picture.background};
  Renderer renderer(scene);
  RenderOptions options = state.left;
  for (int i = 0; i < kPictures; ++i) {
    State moved = state;
    moved.set_handled(light_on_path(state, static_cast<double>(i) / (kPictures - 1)));
    renderer.set_light(state.selected, moved.lights[state.selected]);
    options.progress = part_of(progress, static_cast<double>(i) / kPictures, (i + 1.0) / kPictures);
    char end[32];
    std::snprintf(end, sizeof end, "-path-%03d.png", i + 1);
    write_png(folder / (state.path.stem().string() + end), renderer.render(options).image, display);
  }
  return "saved " + std::to_string(kPictures) + " pictures " +
         (folder / (state.path.stem().string() + "-path-*.png")).string();
}

}  // namespace

const Export kSolidExport{"umbra and penumbra", export_solids};
const Export kCellExport{"sheets and cells", export_cells};
const Export kSequenceExport{"pictures of the light's way", export_sequence};

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

}  // namespace penumbra::viewer
