// penumbra section: where a plane cuts meshes, as curves.
#include <CLI/CLI.hpp>
#include <algorithm>

#include "apps/cli/commands.h"
#include "apps/common/messages.h"
#include "apps/common/options.h"
#include "apps/common/outputs.h"
#include "penumbra/mesh/error.h"
#include "penumbra/mesh/io/polygon_soup.h"
#include "penumbra/volumes/sections/plane_section.h"

namespace penumbra::apps {
namespace {

constexpr const char* kFooter = R"(Examples:
  penumbra volumes scene.json --umbra u.ply --penumbra p.ply
  penumbra section p.ply u.ply --point 0,0,0 --output shadow.svg
  penumbra section p.ply --point 0,1,0 --normal 1,0,0 --output wall.ply --report -
SVG shows the plane against its normal, in scene units, one path a mesh, the largest first, with areas and a scale bar. PLY has
vertices and edges in space, each edge with the number of its mesh. Closed surfaces give closed curves. Area and length are in scene units.)";

struct Arguments {
  CommonOptions common;
  std::vector<std::filesystem::path> meshes;
  std::filesystem::path output, report;
  std::vector<double> point, normal{0.0, 1.0, 0.0};
};

void check(const Arguments& arguments) {
  if (arguments.output.empty() && arguments.report.empty())
    throw UsageError("nothing to do; give --output or --report");
  if (!arguments.output.empty()) require_extension("--output", arguments.output, section_extensions(), false);
  require_writable(arguments.output);
  require_writable(arguments.report);
  require_apart({{"--output", arguments.output}, {"--report", arguments.report}}, arguments.meshes);
}

nlohmann::json report_of(const NamedSection& s) {
  const auto closed = std::ranges::count_if(s.section.curves, &SectionCurve::closed);
  return {{"mesh", s.name},
          {"curves", s.section.curves.size()},
          {"closed_curves", closed},
          {"length", s.section.length},
          {"area", s.section.area}};
}

void run(const Arguments& arguments) {
  const auto vector = [](const std::vector<double>& v) { return Vec3(v[0], v[1], v[2]); };
  const SectionPlane plane{vector(arguments.point), vector(arguments.normal)};
  std::vector<NamedSection> sections;
  nlohmann::json report = {{"sections", nlohmann::json::array()}};
  for (const std::filesystem::path& path : arguments.meshes) {
    const TriangleMesh mesh = read_mesh(path);
    sections.push_back({path.filename().string(), plane_section(mesh.positions(), mesh.triangles(), plane)});
    report["sections"].push_back(report_of(sections.back()));
    if (sections.back().section.curves.empty()) complain("warning: the plane does not cut " + path.string());
  }
  if (!arguments.output.empty()) {
    write_sections(arguments.output, sections, plane);
    say_written(arguments.common.verbose, arguments.output);
  }
  if (!arguments.report.empty()) write_json(arguments.report, report);
}

}  // namespace

void add_section_command(CLI::App& app) {
  CLI::App& command =
      *app.add_subcommand("section", "Where a plane cuts meshes, such as solids, as curves (SVG or PLY)");
  auto arguments = std::make_shared<Arguments>();
  command.add_option("MESH", arguments->meshes, "Meshes, one path of the picture each")->required();
  command.add_option("--point", arguments->point, "A point of the plane")
      ->required()
      ->delimiter(',')
      ->expected(3)
      ->check(require_finite)
      ->type_name("X,Y,Z");
  command
      .add_option("--normal", arguments->normal, "Normal of the plane; otherwise 0,1,0: the plane is level")
      ->delimiter(',')
      ->expected(3)
      ->check(require_finite)
      ->type_name("X,Y,Z");
  command.add_option("--output", arguments->output, "Where the curves go")->type_name("FILE");
  command
      .add_option("--report", arguments->report,
                  "Write number, length and area of the curves as JSON; - is standard output")
      ->type_name("FILE");
  add_common_options(command, arguments->common);
  command.footer(kFooter);
  command.callback([arguments] {
    check(*arguments);
    run(*arguments);
  });
}

}  // namespace penumbra::apps
