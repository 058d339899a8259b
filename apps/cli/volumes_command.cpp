// penumbra volumes: umbra and penumbra volumes of a scene's casters as meshes.
#include "penumbra/volumes/volumes.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <numeric>

#include "apps/cli/commands.h"
#include "apps/cli/reports.h"
#include "apps/cli/solids/solid_volumes.h"
#include "apps/common/messages.h"
#include "apps/common/options.h"
#include "apps/common/outputs.h"
#include "apps/common/parse_errors.h"
#include "apps/common/scene_volumes.h"
#include "penumbra/mesh/error.h"
#include "penumbra/volumes/checks/checks.h"

namespace penumbra::apps {
namespace {

constexpr const char* kFooter = R"(Examples:
  penumbra volumes bunny.ply --penumbra p.ply
  penumbra volumes scene.json --umbra u.ply --penumbra p.ply --report -
  penumbra volumes scene.json --sheets s.obj --cone-segments 32
  penumbra volumes bunny.ply --form solid --umbra u.ply --penumbra p.ply --check
  penumbra volumes bunny.ply --penumbra - > p.ply
  penumbra volumes scene.json --check
Each file holds all casters; - is PLY on standard output. In PLY every triangle says its object (index in the scene), kind and source (face, edge or
vertex of that object's mesh, by kind). Inside a volume is where its winding number is at least 1: every point that an
object partly or wholly hides from the light is inside its penumbra volume, and only points that it wholly hides are inside
its umbra volume: all of them where the object is one convex body (guarantee exact), else as many as the convex and
star-shaped bodies in it hide alone (contained). --check ends with exit code 1 where a volume is not closed, or umbra, hard
shadow and penumbra do not lie inside each other; pieces that cross each other are no fault. Sheets are facets and cone patches, closed only
for convex casters. Lights are disks or distant; volumes end beyond a sphere around all objects. Lengths are scene units.)";

struct Arguments {
  CommonOptions common;
  SceneInput scene;
  std::filesystem::path umbra, penumbra, sheets, report, level_file;
  std::string form = "cells", tolerance;
  double level = 0.5;
  std::string light;  ///< name or number; empty: each
  bool merge = false, check = false;
  int cone_segments = ExtrudeOptions{}.cone_segments;

  bool wants_umbra() const { return !umbra.empty() || only_report() || check; }
  bool wants_penumbra() const { return !penumbra.empty() || only_report() || check; }
  bool wants_sheets() const { return !sheets.empty(); }
  bool only_report() const {
    return umbra.empty() && penumbra.empty() && sheets.empty() && level_file.empty();
  }
  /// Where results go, of which one may be standard output. What --check finds goes there unless the report does.
  std::vector<std::filesystem::path> destinations() const {
    std::vector<std::filesystem::path> all = {umbra, penumbra, sheets, level_file, report};
    if (check && !is_standard(report)) all.emplace_back("-");
    return all;
  }
  bool solid() const { return form == "solid"; }
};

// What all casters together produced.
struct Volumes {
  std::vector<ShadowMesh> umbra, penumbra, sheets;
  nlohmann::json objects = nlohmann::json::array();
  std::size_t caster_faces = 0;
  std::string findings;  ///< of --check, for a person
  bool good = true;
};

/// All that is written for lights of these names.
std::vector<Output> outputs_of(const Arguments& arguments, const std::vector<std::string>& lights) {
  std::vector<Output> outputs = {{"--report", arguments.report}};
  for (const std::string& light : lights) {
    outputs.push_back({"--umbra", file_of_light(arguments.umbra, light)});
    outputs.push_back({"--penumbra", file_of_light(arguments.penumbra, light)});
    outputs.push_back({"--sheets", file_of_light(arguments.sheets, light)});
    outputs.push_back({"--level-file", file_of_light(arguments.level_file, light)});
  }
  return outputs;
}

void require_good(const std::vector<Output>& outputs, const std::vector<std::filesystem::path>& inputs) {
  for (const Output& output : outputs) require_writable(output.path);
  require_apart(outputs, inputs);
}

void check(const Arguments& arguments) {
  if (arguments.only_report() && arguments.report.empty() && !arguments.check)
    throw UsageError("nothing to do; give --umbra, --penumbra, --sheets, --report or --check");
  if (arguments.solid() && arguments.wants_sheets())
    throw UsageError("--sheets are no solid; leave out --form solid");
  if (!arguments.solid() && (!arguments.level_file.empty() || !arguments.tolerance.empty()))
    throw UsageError("--level-file and --tolerance are for solids; add --form solid");
  const std::vector<Output> outputs = outputs_of(arguments, {""});
  for (const auto& [option, path] : outputs)
    if (!path.empty() && option != "--report")
      require_extension(option, path, shadow_mesh_extensions(), true);
  require_one_stdout(arguments.destinations());
  require_good(outputs, {arguments.scene.path});
}

/// Of several lights there are several volumes.
void require_files(const Arguments& arguments) {
  for (const auto& path : {arguments.umbra, arguments.penumbra, arguments.sheets, arguments.level_file})
    if (is_standard(path))
      throw UsageError(
          "volumes of several lights would go to standard output; choose one by --light, or name a file");
}

/// One line for each option that was given and has no effect.
void say_what_is_ignored(const Arguments& arguments, const CLI::App& command) {
  if (arguments.merge && arguments.report.empty() && !arguments.solid())
    say_ignored("--merge", "files hold all casters anyway, and there is no --report");
  if (command.count("--level") > 0 && arguments.level_file.empty())
    say_ignored("--level", "there is no --level-file");
  if (command.count("--cone-segments") > 0 && arguments.solid())
    say_ignored("--cone-segments", "solids have no cones; --tolerance decides how round they are");
}

void add_object(const Arguments& arguments, const SceneObject& object, std::size_t number,
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
  if (arguments.check) {
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

Volumes build_volumes(const Arguments& arguments, const Scene& scene, const CircularLight& light) {
  Volumes volumes;
  VolumeOptions options{.sheets = arguments.wants_sheets(),
                        .penumbra = arguments.wants_penumbra(),
                        .umbra = arguments.wants_umbra(),
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
nlohmann::json write(const Arguments& arguments, const Volumes& volumes, const std::string& light) {
  nlohmann::json report = {{"objects", volumes.objects}};
  if (!light.empty()) report["light"] = light;
  const auto write_one = [&](const char* name, bool wanted, const std::filesystem::path& path,
                             const std::vector<ShadowMesh>& parts) {
    const ShadowMesh whole = merge(parts);
    if (!path.empty()) {
      const std::filesystem::path file = file_of_light(path, light);
      write_shadow_mesh(file, whole);
      say_written(arguments.common.verbose, file);
      if (whole.triangles.empty() && !parts.empty())
        complain("warning: " + shown_name(file) + " is empty: " + why_empty(name));
    }
    if (arguments.merge && wanted && !parts.empty())
      report["scene"][name] = shadow_report(whole, volumes.caster_faces);
  };
  write_one("sheets", arguments.wants_sheets(), arguments.sheets, volumes.sheets);
  write_one("penumbra", arguments.wants_penumbra(), arguments.penumbra, volumes.penumbra);
  write_one("umbra", arguments.wants_umbra(), arguments.umbra, volumes.umbra);
  return report;
}

std::vector<std::size_t> chosen_lights(const Arguments& arguments, const Scene& scene) {
  if (!arguments.light.empty()) return {scene.light_index(arguments.light)};
  std::vector<std::size_t> all(scene.lights.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  return all;
}

SolidArguments solid_arguments(const Arguments& arguments) {
  return {.umbra = arguments.umbra,
          .penumbra = arguments.penumbra,
          .level_file = arguments.level_file,
          .level = arguments.level,
          .tolerance = arguments.tolerance,
          .merge = arguments.merge,
          .check = arguments.check,
          .verbose = arguments.common.verbose,
          .threads = arguments.common.threads};
}

/// The volumes of one light in either form: report, findings for a person, and whether a check found them good.
SolidReport make_and_write(const Arguments& arguments, const Scene& scene, const Light& light,
                           const CircularLight& circular, const std::string& name) {
  if (arguments.solid()) return write_solids(solid_arguments(arguments), scene, light.shape, name);
  const Volumes volumes = build_volumes(arguments, scene, circular);
  if (arguments.common.verbose) say(volumes.objects);
  return {write(arguments, volumes, name), volumes.findings, volumes.good};
}

void run(const Arguments& arguments) {
  const ThreadLimit limit(arguments.common.threads);
  const Scene scene = load(arguments.scene);
  const std::vector<std::size_t> lights = chosen_lights(arguments, scene);
  std::vector<CircularLight> circular;
  for (const std::size_t k : lights)
    circular.push_back(require_circular(
        scene.lights[k].shape,
        "penumbra volumes" +
            (lights.size() > 1 ? ", of light " + scene.lights[k].name + ", (see --light)" : "")));
  std::vector<std::string> names;
  for (const std::size_t k : lights) names.push_back(lights.size() > 1 ? scene.lights[k].name : "");
  if (names.size() > 1) require_files(arguments);
  require_good(outputs_of(arguments, names), scene.files);
  nlohmann::json reports = nlohmann::json::array();
  bool good = true;
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const std::string& name = names[i];
    const SolidReport volumes = make_and_write(arguments, scene, scene.lights[lights[i]], circular[i], name);
    reports.push_back(volumes.json);
    if (arguments.check && arguments.report != "-")
      print((name.empty() ? "" : "light " + name + "\n") + volumes.findings);
    good = good && volumes.good;
  }
  if (!arguments.report.empty()) {
    write_json(arguments.report, lights.size() > 1 ? nlohmann::json{{"lights", reports}} : reports.front());
    say_written(arguments.common.verbose, arguments.report);
  }
  if (!good) throw SystemError("the volumes did not pass --check; please report the scene with this output");
}

}  // namespace

void add_volumes_command(CLI::App& app) {
  CLI::App& command = *app.add_subcommand(
      "volumes", "Umbra and penumbra volumes as meshes (" + shadow_mesh_format_names() + ")");
  auto arguments = std::make_shared<Arguments>();
  add_scene_input(command, arguments->scene);
  command
      .add_option("--umbra", arguments->umbra,
                  "Where the whole light is hidden (never too large; may be empty)")
      ->type_name("FILE");
  command
      .add_option("--penumbra", arguments->penumbra, "Where some of the light is hidden (never too small)")
      ->type_name("FILE");
  command.add_option("--sheets", arguments->sheets, "Facets and cone patches of both, to look at")
      ->type_name("FILE");
  command.add_flag(
      "--merge", arguments->merge,
      "One volume for the whole scene (inside: winding number at least 1 over all triangles), and its "
      "figures in the report; otherwise each object's triangles are a volume of their own");
  command
      .add_option(
          "--light", arguments->light,
          "Only for this light, by name or number; otherwise for each, in files called FILE.LIGHT.ply where "
          "the scene has several")
      ->type_name("NAME|N");
  command
      .add_option(
          "--form", arguments->form,
          "solid: one closed surface a caster, without self-intersections, for other tools; cells: a sum of "
          "convex pieces, made in milliseconds")
      ->check([](const std::string& word) {
        return require_one_of({"cells", "solid"}, word);
      })
      ->capture_default_str();
  command
      .add_option("--tolerance", arguments->tolerance,
                  "Of solids: detail of this size is kept, in scene units or as a share of the caster's size "
                  "such as 1%; "
                  "otherwise 1%")
      ->type_name("LENGTH");
  command
      .add_option("--level-file", arguments->level_file,
                  "A solid in which at most the fraction --level of the light is seen")
      ->type_name("FILE");
  command.add_option("--level", arguments->level, "Fraction of the light for --level-file")
      ->check(CLI::Range(0.001, 0.999))
      ->capture_default_str();
  command.add_flag("--check", arguments->check,
                   "Say whether the volumes are closed, cross themselves and lie inside each other");
  command.add_option("--cone-segments", arguments->cone_segments, "Corners of the polygon around the disk")
      ->check(CLI::Range(3, 4'096))
      ->capture_default_str();
  command
      .add_option("--report", arguments->report,
                  "Write counts, guarantees and milliseconds of each object as JSON; - is standard output")
      ->type_name("FILE");
  add_common_options(command, arguments->common);
  command.footer(kFooter);
  command.callback([arguments, &command] {
    check(*arguments);
    if (arguments->solid()) check(solid_arguments(*arguments));
    say_what_is_ignored(*arguments, command);
    run(*arguments);
  });
}

}  // namespace penumbra::apps
