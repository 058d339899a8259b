#include "apps/cli/volumes/cell_volumes.h"

#include <cstdio>

#include "apps/cli/reports.h"
#include "apps/common/messages.h"
#include "apps/common/outputs.h"
#include "apps/common/scene_volumes.h"
#include "penumbra/volumes/checks/checks.h"
#include "penumbra/volumes/volumes.h"

namespace penumbra::apps {
namespace {

// What all casters together produced.
struct Volumes {
  std::vector<ShadowMesh> umbra, penumbra, sheets;
  nlohmann::json objects = nlohmann::json::array();
  std::size_t caster_faces = 0;
  std::string findings;  ///< of --check, for a person
  bool good = true;
};

struct Wanted {
  bool umbra, penumbra, sheets;
};

/// Sheets alone where the volumes are solids.
Wanted wanted(const VolumeArguments& arguments) {
  const bool all = arguments.only_report() || arguments.check, cells = !arguments.solid();
  return {.umbra = cells && (all || !arguments.umbra.empty()),
          .penumbra = cells && (all || !arguments.penumbra.empty()),
          .sheets = !arguments.sheets.empty()};
}

void add_object(const VolumeArguments& arguments, const SceneObject& object, std::size_t number,
                const CircularLight& light, VolumeOptions options, const Progress& progress,
                Volumes& volumes) {
  options.extrude.progress = part_of(progress, 0.0, arguments.check ? 0.5 : 1.0);
  const std::size_t faces = object.mesh.triangles().size();
  ShadowVolumes made = build_shadow_volumes(object.mesh, light, options);
  nlohmann::json report = classification_report(made.classes);
  report["object"] = number;
  report["mesh"] = object.name;
  report["build"] = build_report(object.mesh.report());
  report["silhouettes"] = silhouette_report(made.silhouettes);
  if (options.sheets) report["sheets"] = shadow_report(made.sheets, faces);
  if (options.penumbra) report["penumbra"] = shadow_report(made.penumbra, faces);
  if (options.umbra) report["umbra"] = shadow_report(made.umbra, faces);
  if (arguments.check && !arguments.solid()) {
    StageClock clock;
    const VolumeFindings findings = validate(object.mesh, light, made.umbra, made.penumbra, options.extrude,
                                             {.progress = part_of(progress, 0.5, 1.0)});
    clock.finish("check");
    made.stages.push_back(clock.stages().front());
    report["check"] = check_report(findings);
    volumes.findings += check_text(number, object.name, findings);
    volumes.good = volumes.good && findings.good();
  }
  for (const StageTime& stage : made.stages) report["milliseconds"][stage.name] = stage.milliseconds;
  volumes.objects.push_back(report);
  volumes.caster_faces += faces;
  volumes.sheets.push_back(std::move(made.sheets));
  volumes.penumbra.push_back(std::move(made.penumbra));
  volumes.umbra.push_back(std::move(made.umbra));
}

Volumes build_volumes(const VolumeArguments& arguments, const Scene& scene, const CircularLight& light) {
  Volumes volumes;
  const Wanted made = wanted(arguments);
  VolumeOptions options{.sheets = made.sheets,
                        .penumbra = made.penumbra,
                        .umbra = made.umbra,
                        .extrude = extrude_options_for(scene, light)};
  options.extrude.cone_segments = arguments.cone_segments;
  ProgressLine line("volumes");
  const Progress progress = line.callback();
  const auto count = static_cast<double>(scene.objects.size());
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    if (!scene.objects[i].casts) continue;
    options.extrude.object = static_cast<std::uint32_t>(i);
    const Progress part =
        part_of(progress, static_cast<double>(i) / count, static_cast<double>(i + 1) / count);
    add_object(arguments, scene.objects[i], i, light, options, part, volumes);
  }
  if (volumes.objects.empty()) complain("warning: no object of the scene casts; the volumes are empty");
  return volumes;
}

void say(const nlohmann::json& objects) {
  for (const nlohmann::json& object : objects)
    for (const auto& [stage, milliseconds] : object["milliseconds"].items()) {
      char line[128];
      std::snprintf(line, sizeof line, "object %d %-12s %9.2f ms", object["object"].get<int>(), stage.c_str(),
                    milliseconds.get<double>());
      complain(line);
    }
}

/// Of a volume of casters.
std::string why_empty(const std::string& volume) {
  if (volume == "umbra") return "no convex or star-shaped part of a caster hides the whole light alone";
  return "no caster has a face in front of the light";
}

/// Writes one light's volumes; returns its report. `light`: its name where several lights are written.
nlohmann::json write(const VolumeArguments& arguments, const Volumes& volumes, const std::string& light) {
  nlohmann::json report = {{"objects", volumes.objects}};
  if (!light.empty()) report["light"] = light;
  const auto write_one = [&](const char* name, bool wanted, const std::filesystem::path& path,
                             const std::vector<ShadowMesh>& parts) {
    const ShadowMesh whole = merge(parts);
    if (wanted && !path.empty()) {
      const std::filesystem::path file = file_of_light(path, light);
      write_shadow_mesh(file, whole);
      say_written(arguments.common.verbose, file);
      if (whole.triangles.empty() && !parts.empty())
        complain("warning: " + shown_name(file) + " is empty: " + why_empty(name));
    }
    if (arguments.merge && wanted && !parts.empty())
      report["scene"][name] = shadow_report(whole, volumes.caster_faces);
  };
  const Wanted made = wanted(arguments);
  write_one("sheets", made.sheets, arguments.sheets, volumes.sheets);
  write_one("penumbra", made.penumbra, arguments.penumbra, volumes.penumbra);
  write_one("umbra", made.umbra, arguments.umbra, volumes.umbra);
  return report;
}

}  // namespace

VolumeReport write_cells(const VolumeArguments& arguments, const Scene& scene, const CircularLight& light,
                         const std::string& name) {
  const Volumes volumes = build_volumes(arguments, scene, light);
  if (arguments.common.verbose) say(volumes.objects);
  return {write(arguments, volumes, name), volumes.findings, volumes.good};
}

}  // namespace penumbra::apps
