// penumbra field: how much of a light each point of a grid sees.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>

#include "apps/cli/commands.h"
#include "apps/common/messages.h"
#include "apps/common/options.h"
#include "apps/common/outputs.h"
#include "apps/common/scene_volumes.h"
#include "penumbra/mesh/error.h"
#include "penumbra/render/solids/light_field.h"

namespace penumbra::apps {
namespace {

constexpr const char* kFooter = R"(Examples:
  penumbra field scene.json --grid 128 --output seen.vti
  penumbra field bunny.ply --voxel 0.02 --output seen.npy
Each value is the fraction of the light that a point sees: 0 in umbra and behind the light, 1 where nothing is hidden. The
grid fills the box of all objects and a little more. VTI is VTK's image data (ParaView), float32; NPY is an array of shape (z, y, x),
float32; VDB is a grid of OpenVDB, sparse where all or nothing is seen. Lengths are scene units.)";

struct Arguments {
  CommonOptions common;
  SceneInput scene;
  std::filesystem::path output;
  std::string light;
  int grid = 64;
  double voxel = 0.0;
};

/// `grid` points along the longest side, or points `voxel` apart; nearly cubes.
std::array<int, 3> counts_for(const Bounds& box, const Arguments& arguments) {
  const Vec3 size = box.high - box.low;
  const double longest = std::max({size.x, size.y, size.z});
  const double step = arguments.voxel > 0.0 ? arguments.voxel : longest / (arguments.grid - 1);
  std::array<int, 3> counts;
  for (int k = 0; k < 3; ++k)
    counts[static_cast<std::size_t>(k)] =
        static_cast<int>(std::clamp(std::round(size[k] / step) + 1.0, 2.0, 1e6));
  return counts;
}

void run(const Arguments& arguments) {
  require_extension("--output", arguments.output, light_field_extensions(), false);
  require_light_field_format(arguments.output);
  require_writable(arguments.output);
  const ThreadLimit limit(arguments.common.threads);
  const Scene scene = load(arguments.scene);
  require_apart({{"--output", arguments.output}}, scene.files);
  const std::size_t light = arguments.light.empty() ? 0 : scene.light_index(arguments.light);
  const Bounds box = solid_bound_for(scene);
  ProgressLine line("field");
  const LightField field =
      light_field(Casters(scene.objects, arguments.common.threads), scene.lights[light].shape, box,
                  counts_for(box, arguments), line.callback());
  write_light_field(arguments.output, field);
  say_written(arguments.common.verbose, arguments.output);
}

}  // namespace

void add_field_command(CLI::App& app) {
  CLI::App& command = *app.add_subcommand(
      "field", "The fraction of a light that each point of a grid sees (VTI, NPY or VDB)");
  auto arguments = std::make_shared<Arguments>();
  add_scene_input(command, arguments->scene);
  command.add_option("--output", arguments->output, "Where the field goes")->required()->type_name("FILE");
  auto* grid = command.add_option("--grid", arguments->grid, "Points along the longest side")
                   ->check(CLI::Range(2, 2048))
                   ->capture_default_str();
  command.add_option("--voxel", arguments->voxel, "Distance of points, scene units")
      ->check(require_finite)
      ->check(CLI::PositiveNumber)
      ->excludes(grid);
  command.add_option("--light", arguments->light, "The light, by name or number; otherwise the first")
      ->type_name("NAME|N");
  add_common_options(command, arguments->common);
  command.footer(kFooter);
  command.callback([arguments] { run(*arguments); });
}

}  // namespace penumbra::apps
