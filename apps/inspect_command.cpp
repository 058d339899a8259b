// penumbra inspect: what there is to know about a mesh before its shadow is computed.
#include "mesh/inspect.h"

#include <CLI/CLI.hpp>

#include "apps/commands.h"
#include "apps/outputs.h"
#include "mesh/polygon_soup.h"

namespace penumbra::apps {
namespace {

constexpr const char* kFooter = R"(Examples:
  penumbra inspect bunny.ply
  penumbra inspect bunny.ply --json > bunny.json
A mesh that is not closed or not manifold still casts a shadow: its boundary edges belong to every silhouette band.)";

struct Arguments {
  std::filesystem::path mesh;
  bool json = false;
};

void run(const Arguments& arguments) {
  const MeshFindings findings = inspect(read_mesh(arguments.mesh));
  std::string text = arguments.json ? penumbra::to_json(findings) : penumbra::to_text(findings);
  if (!text.ends_with('\n')) text += '\n';
  print(text);
}

}  // namespace

void add_inspect_command(CLI::App& app) {
  CLI::App& command = *app.add_subcommand("inspect", "Counts, openness, orientation and defects of a mesh");
  auto arguments = std::make_shared<Arguments>();
  command.add_option("MESH", arguments->mesh, "Mesh file: OBJ, PLY, OFF or STL")->required();
  command.add_flag("--json", arguments->json, "Print JSON");
  command.footer(kFooter);
  command.callback([arguments] { run(*arguments); });
}

}  // namespace penumbra::apps
