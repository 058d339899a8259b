// penumbra inspect: what there is to know about a mesh before its shadow is computed.
#include "penumbra/mesh/inspect.h"

#include <CLI/CLI.hpp>
#include <optional>
#include <span>

#include "apps/cli/commands.h"
#include "apps/cli/inspect_reports.h"
#include "apps/common/options.h"
#include "apps/common/outputs.h"
#include "penumbra/mesh/error.h"
#include "penumbra/mesh/io/polygon_soup.h"

namespace penumbra::apps {
namespace {

constexpr const char* kFooter = R"(Examples:
  penumbra inspect bunny.ply
  penumbra inspect bunny.ply --json > bunny.json
  penumbra inspect scan.obj --repair mended.ply
A mesh that is not closed or not manifold still casts a shadow: its boundary edges belong to every silhouette band.
--repair works component by component: closed, oriented and outward ones stay as they are; ones that become so when repeated
faces are dropped, seams stitched and faces turned are mended; open, non-manifold and self-intersecting ones are left as they
are. The report says which, what was done and why.)";

struct Arguments {
  std::filesystem::path mesh, repair;
  bool json = false;
};

void check(const Arguments& arguments) {
  if (arguments.repair.empty()) return;
  require_extension("--repair", arguments.repair, mesh_extensions(), false);
  require_writable(arguments.repair);
  require_apart({{"--repair", arguments.repair}}, {arguments.mesh});
}

PolygonSoup read(const Arguments& arguments) {
  if (!is_standard(arguments.mesh)) return read_polygon_soup(arguments.mesh);
  const std::string bytes = read_standard_input();
  return parse_polygon_soup(std::as_bytes(std::span(bytes)), kStandardInput);
}

RepairResult repair_file(const Arguments& arguments, const PolygonSoup& soup) {
  RepairResult result = repair(soup.positions, triangulate(soup).triangles);
  // What could not be mended stays as it is.
  write_mesh(arguments.repair,
             TriangleMesh::build(result.positions, result.triangles, {.flip_inside_out = false}));
  return result;
}

std::string text_of(const MeshFindings& findings, const std::optional<RepairResult>& repaired) {
  return to_text(findings) + (repaired ? to_text(*repaired) : "");
}

std::string json_of(const MeshFindings& findings, const std::optional<RepairResult>& repaired) {
  nlohmann::ordered_json report = findings_report(findings);
  if (repaired) report["repair"] = repair_report(*repaired);
  return report.dump(2) + "\n";
}

void run(const Arguments& arguments) {
  check(arguments);
  const PolygonSoup soup = read(arguments);
  require_apart({{"--repair", arguments.repair}}, soup.material_paths);
  const MeshFindings findings =
      inspect(load_mesh(soup, is_standard(arguments.mesh) ? kStandardInput : arguments.mesh.string()));
  std::optional<RepairResult> repaired;
  if (!arguments.repair.empty()) repaired = repair_file(arguments, soup);
  print(arguments.json ? json_of(findings, repaired) : text_of(findings, repaired));
}

}  // namespace

void add_inspect_command(CLI::App& app) {
  CLI::App& command = *app.add_subcommand("inspect", "Counts, openness, orientation and defects of a mesh");
  auto arguments = std::make_shared<Arguments>();
  command.add_option("MESH", arguments->mesh, "Mesh file: " + mesh_format_names() + "; - is standard input")
      ->required();
  command.add_flag("--json", arguments->json, "Print JSON");
  command
      .add_option("--repair", arguments->repair,
                  "Write the mesh with mendable components mended (" + mesh_format_names() +
                      "), and say what was done")
      ->type_name("FILE");
  command.footer(kFooter);
  command.callback([arguments] { run(*arguments); });
}

}  // namespace penumbra::apps
