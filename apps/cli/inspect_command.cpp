// penumbra inspect: what there is to know about a mesh before its shadow is computed.
#include "penumbra/mesh/inspect.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "apps/cli/commands.h"
#include "apps/common/outputs.h"
#include "penumbra/mesh/error.h"
#include "penumbra/mesh/io/polygon_soup.h"
#include "penumbra/volumes/checks/repair.h"

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

RepairResult repair_file(const Arguments& arguments) {
  require_extension("--repair", arguments.repair, {".ply", ".obj", ".off", ".stl"}, false);
  require_writable(arguments.repair);
  const PolygonSoup soup = read_polygon_soup(arguments.mesh);
  RepairResult result = repair(soup.positions, triangulate(soup).triangles);
  write_mesh(arguments.repair, TriangleMesh::build(result.positions, result.triangles));
  return result;
}

void run(const Arguments& arguments) {
  const MeshFindings findings = inspect(read_mesh(arguments.mesh));
  std::string text = arguments.json ? penumbra::to_json(findings) : penumbra::to_text(findings);
  if (!arguments.repair.empty()) {
    const RepairResult repaired = repair_file(arguments);
    if (arguments.json) {
      nlohmann::ordered_json both = nlohmann::ordered_json::parse(text);
      both["repair"] = nlohmann::ordered_json::parse(to_json(repaired));
      text = both.dump(2);
    } else {
      text += to_text(repaired);
    }
  }
  if (!text.ends_with('\n')) text += '\n';
  print(text);
}

}  // namespace

void add_inspect_command(CLI::App& app) {
  CLI::App& command = *app.add_subcommand("inspect", "Counts, openness, orientation and defects of a mesh");
  auto arguments = std::make_shared<Arguments>();
  command.add_option("MESH", arguments->mesh, "Mesh file: OBJ, PLY, OFF or STL")->required();
  command.add_flag("--json", arguments->json, "Print JSON");
  command
      .add_option(
          "--repair", arguments->repair,
          "Write the mesh with mendable components mended (PLY, OBJ, OFF or STL), and say what was done")
      ->type_name("FILE");
  command.footer(kFooter);
  command.callback([arguments] { run(*arguments); });
}

}  // namespace penumbra::apps
