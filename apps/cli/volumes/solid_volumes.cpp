#include "apps/cli/volumes/solid_volumes.h"

#include <cmath>
#include <cstdlib>

#include "apps/common/messages.h"
#include "apps/common/outputs.h"
#include "apps/common/scene_volumes.h"
#include "penumbra/mesh/error.h"
#include "penumbra/render/solids/extrude_solid.h"
#include "penumbra/volumes/checks/validate.h"

namespace penumbra::apps {
namespace {

struct Wanted {
  const char* name;
  ShadowLevel level;
  std::filesystem::path file;
};

std::vector<Wanted> wanted(const VolumeArguments& arguments) {
  const bool all = !arguments.writes_volumes();
  std::vector<Wanted> out;
  if (all || !arguments.umbra.empty()) out.push_back({"umbra", {ShadowLevel::Kind::kUmbra}, arguments.umbra});
  if (all || !arguments.penumbra.empty())
    out.push_back({"penumbra", {ShadowLevel::Kind::kPenumbra}, arguments.penumbra});
  if (!arguments.level_file.empty())
    out.push_back({"level", {ShadowLevel::Kind::kFraction, arguments.level}, arguments.level_file});
  return out;
}

/// Scene units, 0 for the usual.
double tolerance_of(const std::string& text, double diagonal) {
  if (text.empty()) return 0.0;
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  const bool percent = *end == '%';
  if (end == text.c_str() || end[percent ? 1 : 0] != '\0' || !(value > 0.0) || std::isinf(value))
    throw UsageError("--tolerance " + text +
                     " is no length above 0; give scene units such as 0.01, or a share of the "
                     "caster's size such as 1%");
  return percent ? value / 100.0 * diagonal : value;
}

nlohmann::json solid_report(const ShadowSolid& solid) {
  nlohmann::json report = {{"triangles", solid.mesh.triangles.size()},
                           {"vertices", solid.mesh.positions.size()},
                           {"guarantee", name_of(solid.mesh.guarantee)},
                           {"volume", solid.volume},
                           {"area", solid.area},
                           {"tolerance", solid.tolerance},
                           {"proved", solid.proved},
                           {"to_prove", solid.to_prove},
                           {"grid_points", solid.grid_points},
                           {"grid_triangles", solid.grid_triangles},
                           {"evaluations", solid.evaluations}};
  for (const StageTime& stage : solid.stages) report["milliseconds"][stage.name] = stage.milliseconds;
  return report;
}

bool is_good(const SurfaceFindings& f) {
  return f.triangles == 0 ||
         (f.closed() && f.degenerate.empty() && f.self_intersections.empty() && f.bounds_a_volume);
}

/// Some casters whose solids are one.
struct Part {
  std::uint32_t object = 0;
  std::vector<SceneObject> casters;
};

std::vector<Part> parts_of(const Scene& scene, bool merge) {
  std::vector<Part> parts;
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    if (!scene.objects[i].casts) continue;
    if (!merge || parts.empty()) parts.push_back({static_cast<std::uint32_t>(i), {}});
    parts.back().casters.push_back(scene.objects[i]);
  }
  return parts;
}

class Writer {
 public:
  Writer(const VolumeArguments& arguments, const Scene& scene, const LightShape& light)
      : arguments_(arguments), scene_(scene), light_(light), line_("solids") {}

  VolumeReport run(const std::string& name) {
    const std::vector<Wanted> kinds = wanted(arguments_);
    const std::vector<Part> parts = parts_of(scene_, arguments_.merge);
    if (parts.empty()) complain("warning: no object of the scene casts; the solids are empty");
    std::vector<std::vector<ShadowMesh>> meshes(kinds.size());
    out_.json = {{"objects", nlohmann::json::array()}};
    if (!name.empty()) out_.json["light"] = name;
    const auto count = static_cast<double>(parts.size() * kinds.size());
    double done = 0.0;
    for (const Part& part : parts) {
      const Casters casters(part.casters, arguments_.common.threads);
      nlohmann::json report = {{"object", part.object}, {"mesh", part.casters.front().name}};
      if (arguments_.merge) report["merged"] = part.casters.size();
      for (std::size_t k = 0; k < kinds.size(); ++k, done += 1.0)
        meshes[k].push_back(make(casters, part, kinds[k],
                                 part_of(line_.callback(), done / count, (done + 1.0) / count), report));
      out_.json["objects"].push_back(report);
    }
    for (std::size_t k = 0; k < kinds.size(); ++k)
      if (!kinds[k].file.empty()) write(file_of_light(kinds[k].file, name), merge(meshes[k]));
    return std::move(out_);
  }

 private:
  void write(const std::filesystem::path& file, const ShadowMesh& solid) {
    write_shadow_mesh(file, solid);
    say_written(arguments_.common.verbose, file);
    if (solid.triangles.empty() && !out_.json["objects"].empty())
      complain("warning: " + shown_name(file) +
               " is empty: at this --tolerance no caster hides as much of the light as it asks for");
  }

  ShadowMesh make(const Casters& casters, const Part& part, const Wanted& kind, const Progress& progress,
                  nlohmann::json& report) {
    Bounds box;
    for (const SceneObject& object : part.casters) box.add(object.mesh.bounds());
    const ShadowSolid solid =
        extrude_solid(casters, light_, kind.level,
                      {.tolerance = tolerance_of(arguments_.tolerance, 2.0 * box.radius()),
                       .bound = solid_bound_for(scene_),
                       .hollow = arguments_.hollow,
                       .object = part.object,
                       .progress = progress});
    report[kind.name] = solid_report(solid);
    if (arguments_.common.verbose)
      for (const StageTime& stage : solid.stages)
        complain("object " + std::to_string(part.object) + " " + kind.name + " " + stage.name + " " +
                 std::to_string(stage.milliseconds) + " ms");
    if (arguments_.check) check_surface_of(solid.mesh, part, kind.name, report);
    return solid.mesh;
  }

  void check_surface_of(const ShadowMesh& mesh, const Part& part, const std::string& kind,
                        nlohmann::json& report) {
    const SurfaceFindings f = check_surface(mesh.positions, mesh.triangles);
    const bool good = is_good(f);
    report[kind]["check"] = {{"good", good},
                             {"closed", f.closed()},
                             {"degenerate", f.degenerate.size()},
                             {"self_intersections", f.self_intersections.size()},
                             {"pieces", f.pieces},
                             {"bounds_a_volume", f.bounds_a_volume}};
    out_.findings += "object " + std::to_string(part.object) + " " + kind + ": " +
                     std::to_string(f.triangles) + " triangles" +
                     (f.triangles == 0 ? ", empty"
                      : good           ? ", bound a volume"
                                       : ", NOT SOUND") +
                     "\n";
    out_.good = out_.good && good;
  }

  const VolumeArguments& arguments_;
  const Scene& scene_;
  const LightShape& light_;
  ProgressLine line_;
  VolumeReport out_;
};

}  // namespace

void require_tolerance(const VolumeArguments& arguments) {
  tolerance_of(arguments.tolerance, 1.0);
}

std::filesystem::path file_of_light(const std::filesystem::path& path, const std::string& light) {
  if (light.empty() || path.empty()) return path;
  std::filesystem::path named = path;
  return named.replace_filename(path.stem().string() + "." + light + path.extension().string());
}

VolumeReport write_solids(const VolumeArguments& arguments, const Scene& scene, const LightShape& light,
                          const std::string& name) {
  return Writer(arguments, scene, light).run(name);
}

}  // namespace penumbra::apps
