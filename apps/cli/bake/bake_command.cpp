// penumbra bake: visibility averaged over the faces or around the vertices of an object, as PLY or NPY.
#include <CLI/CLI.hpp>
#include <cmath>
#include <ostream>

#include "apps/cli/bake/bake.h"
#include "apps/cli/commands.h"
#include "apps/cli/sun/surface.h"
#include "apps/common/messages.h"
#include "apps/common/method_options.h"
#include "apps/common/options.h"
#include "apps/common/outputs.h"
#include "mesh/io/little_endian.h"
#include "mesh/io/npy.h"
#include "mesh/io/write_file.h"
#include "penumbra/mesh/error.h"

namespace penumbra::apps {
namespace {

constexpr const char* kFooter = R"(Examples:
  penumbra bake scene.json --object 1 --to vertices --output lit.ply
  penumbra bake city.json --object houses.off --to faces --side 8 --output lit.npy
  penumbra bake valley.json --object dem.tif --to vertices --output lit.ply
A value is the fraction of the light's area that is seen, 0 to 1, averaged over a face or around a vertex. PLY has the mesh and the
property visibility; NPY has the values alone, float32, in the mesh's order. Without area a value is NaN.)";

struct Arguments {
  CommonOptions common;
  SceneInput scene;
  std::string object = "0", to, light;
  std::filesystem::path output;
  BakeOptions bake;
};

void write_ply(std::ostream& out, const Surface& surface, const std::vector<float>& values, bool vertices) {
  const char* property = "property float visibility\n";
  out << "ply\nformat binary_little_endian 1.0\nelement vertex " << surface.positions.size()
      << "\nproperty double x\nproperty double y\nproperty double z\n"
      << (vertices ? property : "") << "element face " << surface.triangles.size()
      << "\nproperty list uchar int vertex_indices\n"
      << (vertices ? "" : property) << "end_header\n";
  std::string bytes;
  for (std::size_t v = 0; v < surface.positions.size(); ++v) {
    for (int k = 0; k < 3; ++k) detail::append_little_endian(bytes, surface.positions[v][k]);
    if (vertices) detail::append_little_endian(bytes, values[v]);
  }
  for (std::size_t f = 0; f < surface.triangles.size(); ++f) {
    detail::append_little_endian(bytes, std::uint8_t{3});
    for (const std::uint32_t v : surface.triangles[f])
      detail::append_little_endian(bytes, static_cast<std::int32_t>(v));
    if (!vertices) detail::append_little_endian(bytes, values[f]);
  }
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

void run(Arguments& arguments) {
  require_extension("--output", arguments.output, {".ply", ".npy"}, false);
  require_writable(arguments.output);
  arguments.bake.vertices = arguments.to == "vertices";
  const MethodInfo& method = method_named(arguments.bake.visibility.method);
  if (method.needs_pixels) throw UsageError("method " + method.name + " takes pictures alone; use another");
  const ThreadLimit limit(arguments.common.threads);
  const Scene scene = load(arguments.scene);
  require_apart({{"--output", arguments.output}}, scene.files);
  const Surface surface = surface_of(scene, arguments.object);
  const std::size_t light = arguments.light.empty() ? 0 : scene.light_index(arguments.light);
  ProgressLine line("baking");
  arguments.bake.visibility.progress = line.callback();
  const Casters casters(scene.objects, arguments.common.threads);
  const std::vector<float> values = bake(casters, surface, scene.lights[light].shape, arguments.bake);
  write_file(arguments.output, [&](std::ostream& out) {
    if (extension_of(arguments.output) == ".ply")
      return write_ply(out, surface, values, arguments.bake.vertices);
    detail::write_npy_header(out, {values.size()});
    out.write(reinterpret_cast<const char*>(values.data()),
              static_cast<std::streamsize>(values.size() * sizeof(float)));
  });
  say_written(arguments.common.verbose, arguments.output);
}

}  // namespace

void add_bake_command(CLI::App& app) {
  CLI::App& command =
      *app.add_subcommand("bake", "Visibility averaged over the faces or around the vertices of an object");
  auto arguments = std::make_shared<Arguments>();
  add_scene_input(command, arguments->scene);
  command.add_option("--to", arguments->to, "faces or vertices")
      ->check(CLI::IsMember({"faces", "vertices"}))
      ->required();
  command.add_option("-o,--output", arguments->output, "PLY or NPY")->required()->type_name("FILE");
  command.add_option("--object", arguments->object, "The object or heightfield, by name or number")
      ->capture_default_str()
      ->type_name("NAME|N");
  command.add_option("--light", arguments->light, "The light, by name or number; otherwise the first")
      ->type_name("NAME|N");
  command.add_option("--side", arguments->bake.side, "Each face is looked at in the middle of N² parts")
      ->check(CLI::Range(1, 64))
      ->capture_default_str()
      ->type_name("N");
  command.add_option("-m,--method", arguments->bake.visibility.method, "How visibility is computed")
      ->capture_default_str();
  add_method_options(command, arguments->bake.visibility.options);
  add_common_options(command, arguments->common);
  command.footer(kFooter);
  command.callback([arguments] { run(*arguments); });
}

}  // namespace penumbra::apps
