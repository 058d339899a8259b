// penumbra volumes: umbra and penumbra volumes of a scene's casters as meshes.
#include <CLI/CLI.hpp>
#include <numeric>

#include "apps/cli/commands.h"
#include "apps/cli/volumes/cell_volumes.h"
#include "apps/cli/volumes/solid_volumes.h"
#include "apps/common/messages.h"
#include "apps/common/outputs.h"
#include "apps/common/parse_errors.h"
#include "penumbra/mesh/error.h"
#include "penumbra/volumes/shadow_mesh.h"

namespace penumbra::apps {
namespace {

constexpr const char* kFooter = R"(Examples:
  penumbra volumes bunny.ply --umbra u.ply --penumbra p.ply --check
  penumbra volumes scene.json --umbra u.ply --tolerance 0.5% --report -
  penumbra volumes scene.json --level 0.5 --level-file half.ply
  penumbra volumes scene.json --form cells --umbra u.ply --penumbra p.ply
  penumbra volumes scene.json --sheets s.obj --cone-segments 32
  penumbra volumes bunny.ply --penumbra - > p.ply
  penumbra volumes scene.json --check
Each file holds all casters; - is PLY on standard output. In PLY every triangle says its object (index in the scene) and kind. Solids are closed surfaces without
self-intersections. Guarantee certified: it is proved that all inside an umbra is in umbra, or that nothing outside of a penumbra
is in penumbra. Guarantee within: points that were tried say so, and a few others may not. Cells are sums of convex pieces; inside is where their
winding number is at least 1, and triangles also say their source (face, edge or vertex of that object's mesh, by kind). A
penumbra of cells holds all that an object partly or wholly hides from the light, an umbra of cells only what it wholly hides:
all of it where the object is one convex body (guarantee exact), else as much as the convex and star-shaped bodies
in it hide alone (contained). Without files, --check and --report are of cells. --check ends with exit code 1 where a volume is not
closed, a solid crosses itself, or umbra, hard shadow and penumbra of cells do not lie inside each other. Sheets are
facets and cone patches, closed only for convex casters. Lights are disks or distant; solids end in a box around all objects,
cells beyond a sphere. Lengths are scene units.)";

/// All that is written for lights of these names.
std::vector<Output> outputs_of(const VolumeArguments& arguments, const std::vector<std::string>& lights) {
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

void check(const VolumeArguments& arguments) {
  if (arguments.only_report() && arguments.report.empty() && !arguments.check)
    throw UsageError("nothing to do; give --umbra, --penumbra, --sheets, --report or --check");
  if (!arguments.solid() &&
      (!arguments.level_file.empty() || !arguments.tolerance.empty() || arguments.hollow))
    throw UsageError("--level-file, --tolerance and --hollow are for solids; use --form solid");
  if (arguments.solid()) require_tolerance(arguments);
  const std::vector<Output> outputs = outputs_of(arguments, {""});
  for (const auto& [option, path] : outputs)
    if (!path.empty() && option != "--report")
      require_extension(option, path, shadow_mesh_extensions(), true);
  require_one_stdout(arguments.destinations());
  require_good(outputs, {arguments.scene.path});
}

/// Of several lights there are several volumes.
void require_files(const VolumeArguments& arguments) {
  for (const auto& path : {arguments.umbra, arguments.penumbra, arguments.sheets, arguments.level_file})
    if (is_standard(path))
      throw UsageError(
          "volumes of several lights would go to standard output; choose one by --light, or name a file");
}

/// One line for each option that was given and has no effect.
void say_what_is_ignored(const VolumeArguments& arguments, const CLI::App& command) {
  if (arguments.merge && arguments.report.empty() && !arguments.solid())
    say_ignored("--merge", "files hold all casters anyway, and there is no --report");
  if (command.count("--level") > 0 && arguments.level_file.empty())
    say_ignored("--level", "there is no --level-file");
  if (command.count("--cone-segments") > 0 && arguments.solid() && arguments.sheets.empty())
    say_ignored("--cone-segments", "solids have no cones; --tolerance decides how round they are");
}

std::vector<std::size_t> chosen_lights(const VolumeArguments& arguments, const Scene& scene) {
  if (!arguments.light.empty()) return {scene.light_index(arguments.light)};
  std::vector<std::size_t> all(scene.lights.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  return all;
}

/// The volumes of one light.
VolumeReport make_and_write(const VolumeArguments& arguments, const Scene& scene, const Light& light,
                            const CircularLight& circular, const std::string& name) {
  if (!arguments.solid()) return write_cells(arguments, scene, circular, name);
  VolumeReport out = write_solids(arguments, scene, light.shape, name);
  if (!arguments.sheets.empty())
    out.json["sheets"] = write_cells(arguments, scene, circular, name).json["objects"];
  return out;
}

void run(const VolumeArguments& arguments) {
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
    const VolumeReport volumes = make_and_write(arguments, scene, scene.lights[lights[i]], circular[i], name);
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
  auto arguments = std::make_shared<VolumeArguments>();
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
  command.add_flag("--merge", arguments->merge,
                   "One volume for the whole scene; otherwise each object has its own");
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
          "convex pieces, made in milliseconds; otherwise solid for files, cells without")
      ->check([](const std::string& word) {
        return require_one_of({"cells", "solid"}, word);
      })
      ->type_name("solid|cells");
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
  command.add_flag("--hollow", arguments->hollow,
                   "Of solids: without the bodies of the casters, which otherwise belong to them");
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
    say_what_is_ignored(*arguments, command);
    run(*arguments);
  });
}

}  // namespace penumbra::apps
