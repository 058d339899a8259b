// penumbra classify: face classes and silhouettes of every object, without volumes.
#include <CLI/CLI.hpp>
#include <cstdio>

#include "apps/cli/commands.h"
#include "apps/cli/reports.h"
#include "apps/common/options.h"
#include "apps/common/outputs.h"

namespace penumbra::apps {
namespace {

constexpr const char* kFooter = R"(Examples:
  penumbra classify scene.json
  penumbra classify scene.json --json > classes.json
Classes: 0 none-frontfacing, 1 mixed, 2 all-frontfacing; a face whose plane touches the light is mixed. Tiers say which
arithmetic decided: plain double with an error bound, intervals, or exact rationals. Faces and edges are numbered as the
mesh is after building (see penumbra inspect); "input" is the face's number in the file's triangles.)";

struct Arguments {
  CommonOptions common;
  SceneInput scene;
  std::string light = "0";  ///< name or number
  bool json = false;
};

nlohmann::json edge_list(const TriangleMesh& mesh, const std::vector<EdgeId>& edges) {
  nlohmann::json list = nlohmann::json::array();
  for (const EdgeId id : edges) {
    const Edge& edge = mesh.edges()[index(id)];
    list.push_back({index(id), index(edge.from), index(edge.to)});
  }
  return list;
}

nlohmann::json full_report(const SceneObject& object, const Classification& classes,
                           const Silhouettes& silhouettes) {
  nlohmann::json report = classification_report(classes);
  report["mesh"] = object.name;
  report["casts"] = object.casts;
  report["silhouettes"] = silhouette_report(silhouettes);
  nlohmann::json& faces = report["face_classes"] = nlohmann::json::array();
  for (const FaceClass each : classes.faces) faces.push_back(static_cast<int>(each));
  nlohmann::json& inputs = report["input"] = nlohmann::json::array();
  for (const std::uint32_t each : object.mesh.source_triangles()) inputs.push_back(each);
  report["edges"] = {{"columns", {"edge", "from", "to"}},
                     {"umbra", edge_list(object.mesh, silhouettes.umbra)},
                     {"penumbra", edge_list(object.mesh, silhouettes.penumbra)},
                     {"band", edge_list(object.mesh, silhouettes.band)}};
  return report;
}

std::string table_row(std::size_t number, const SceneObject& object, const Classification& classes,
                      const Silhouettes& silhouettes) {
  char row[256];
  std::snprintf(row, sizeof row, "%6zu %9zu %9zu %9zu %9zu %8zu %8zu %8zu %9zu %8zu %8zu  ", number,
                classes.faces.size(), classes.all_front, classes.mixed, classes.none_front,
                silhouettes.umbra.size(), silhouettes.penumbra.size(), silhouettes.band.size(),
                classes.tally.filter, classes.tally.interval, classes.tally.exact);
  return row + object.name + (object.casts ? "" : " (does not cast)") + "\n";
}

void run(const Arguments& arguments) {
  const ThreadLimit limit(arguments.common.threads);
  const Scene scene = load(arguments.scene);
  const Light& of = scene.lights[scene.light_index(arguments.light)];
  const CircularLight light = require_circular(of.shape, "penumbra classify");
  nlohmann::json report = nlohmann::json::array();
  std::string table =
      "object     faces     front     mixed      none    umbra  penumbra    band    filter interval    exact "
      " mesh\n";
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const SceneObject& object = scene.objects[i];
    const ShadowVolumes found = build_shadow_volumes(object.mesh, light, {.penumbra = false, .umbra = false});
    if (arguments.json)
      report.push_back(full_report(object, found.classes, found.silhouettes));
    else
      table += table_row(i, object, found.classes, found.silhouettes);
  }
  if (!arguments.json) return print(table);
  // One line: indented lists of faces would be as many lines.
  const nlohmann::json whole = {{"class_names", {"none_front", "mixed", "all_front"}}, {"objects", report}};
  print(whole.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

}  // namespace

void add_classify_command(CLI::App& app) {
  CLI::App& command = *app.add_subcommand(
      "classify", "How each face looks from a disk or a distant light, both silhouettes and the band");
  auto arguments = std::make_shared<Arguments>();
  add_scene_input(command, arguments->scene);
  command.add_option("--light", arguments->light, "The light, by name or number")
      ->type_name("NAME|N")
      ->capture_default_str();
  command.add_flag("--json", arguments->json, "Print JSON with every face's class and the edge lists");
  add_common_options(command, arguments->common);
  command.footer(kFooter);
  command.callback([arguments] { run(*arguments); });
}

}  // namespace penumbra::apps
