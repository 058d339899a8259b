#include "apps/cli/bake/bake_arguments.h"

#include <CLI/CLI.hpp>

#include "apps/common/messages.h"
#include "apps/common/method_options.h"
#include "penumbra/mesh/error.h"

namespace penumbra::apps {
namespace {

constexpr const char *kLightmapGroup = "Lightmap", *kFaceGroup = "Faces and vertices";

void add_lightmap_options(CLI::App& command, BakeArguments& arguments) {
  const char* group = kLightmapGroup;
  command.add_option("--lightmap", arguments.lightmap, "A texture of the objects' light, EXR")
      ->type_name("FILE")
      ->group(group);
  command.add_option("--mesh", arguments.mesh, "The objects with the texture's coordinates, .glb or .obj")
      ->type_name("FILE")
      ->group(group);
  command
      .add_option("--picture", arguments.picture,
                  "The scene as its camera sees it, lit by the texture: PNG or EXR")
      ->type_name("FILE")
      ->group(group);
  command.add_option("--size", arguments.picture_size, "Of the picture, pixels")
      ->capture_default_str()
      ->type_name("WxH")
      ->group(group);
  add_exposure_option(command, arguments.exposure_stops, "Of the picture as PNG, in stops");
  command.get_option("--exposure")->group(group);
  command.add_option("--texels", arguments.atlas.size, "Sides of the texture, texels")
      ->check(CLI::Range(16, 16'384))
      ->capture_default_str()
      ->type_name("N")
      ->group(group);
  command
      .add_option("--texel", arguments.atlas.texel,
                  "Side of a texel, scene units; the texture is as large as it has to be")
      ->check(CLI::PositiveNumber)
      ->type_name("L")
      ->group(group);
  command.add_option("--padding", arguments.atlas.padding, "Empty texels between charts")
      ->check(CLI::Range(0, 64))
      ->capture_default_str()
      ->type_name("N")
      ->group(group);
  command
      .add_option("--chart-angle", arguments.atlas.chart_degrees,
                  "Neighboring faces are one chart while normals turn by no more, degrees")
      ->check(CLI::Range(0.0, 75.0))
      ->capture_default_str()
      ->type_name("A")
      ->group(group);
  command
      .add_option("--uv-set", arguments.scene.uv_set,
                  "Instead of charts: the texture coordinates that the glTF file has as TEXCOORD_N")
      ->check(CLI::Range(0, 15))
      ->type_name("N")
      ->excludes("--texel", "--padding", "--chart-angle")
      ->group(group);
  command.add_option("--texel-samples", arguments.map.samples, "A texel is the mean over N² squares")
      ->check(CLI::Range(1, 64))
      ->capture_default_str()
      ->type_name("N")
      ->group(group);
  command.add_option("--dilation", arguments.map.dilation, "Texels around charts that get values")
      ->check(CLI::Range(0, 64))
      ->capture_default_str()
      ->type_name("N")
      ->group(group);
}

void add_face_options(CLI::App& command, BakeArguments& arguments) {
  const char* group = kFaceGroup;
  command.add_option("--to", arguments.to, "faces or vertices")
      ->check(CLI::IsMember({"faces", "vertices"}))
      ->group(group);
  command.add_option("-o,--output", arguments.output, "Their values, PLY or NPY")
      ->type_name("FILE")
      ->group(group);
  command.add_option("--side", arguments.faces.side, "Each face is looked at in the middle of N² parts")
      ->check(CLI::Range(1, 64))
      ->capture_default_str()
      ->type_name("N")
      ->group(group);
}

}  // namespace

void add_bake_options(CLI::App& command, BakeArguments& arguments) {
  add_scene_input(command, arguments.scene);
  command
      .add_option("--quantity", arguments.quantity,
                  "visibility: of each light. irradiance: of all together, red, green and blue")
      ->check(CLI::IsMember({"visibility", "irradiance"}))
      ->capture_default_str();
  command
      .add_option("--object", arguments.objects,
                  "An object, by name or number; may be repeated for a lightmap. Otherwise all, or the first")
      ->type_name("NAME|N");
  command
      .add_option("--light", arguments.lights, "A light, by name or number; may be repeated. Otherwise all")
      ->type_name("NAME|N");
  command
      .add_option("--back", arguments.backs,
                  "An object that gets light on the back of its faces: a room that is one closed mesh")
      ->type_name("NAME|N");
  command
      .add_option(
          "--parts", arguments.parts,
          "Folder for parts that are done, so that a bake that ended goes on; otherwise beside the result")
      ->type_name("DIR");
  add_lightmap_options(command, arguments);
  add_face_options(command, arguments);
  command.add_option("-m,--method", arguments.visibility.method, "How visibility is computed")
      ->capture_default_str();
  add_method_options(command, arguments.visibility.options);
  add_common_options(command, arguments.common);
}

std::filesystem::path BakeArguments::parts_folder() const {
  if (!parts.empty()) return parts;
  return (is_lightmap() ? lightmap : output).string() + ".parts";
}

void require_usable(const BakeArguments& arguments) {
  if (arguments.is_lightmap() == !arguments.to.empty())
    throw UsageError("say what is baked: --lightmap FILE, or --to faces or vertices with --output FILE");
  if (arguments.is_lightmap()) {
    if (!arguments.output.empty())
      throw UsageError("--output belongs to --to; a lightmap goes to --lightmap");
    require_extension("--lightmap", arguments.lightmap, {".exr"}, false);
    if (!arguments.mesh.empty()) require_extension("--mesh", arguments.mesh, {".glb", ".obj"}, false);
    if (!arguments.picture.empty())
      require_extension("--picture", arguments.picture, {".png", ".exr"}, false);
    parse_size(arguments.picture_size);
  } else {
    if (arguments.output.empty()) throw UsageError("--to " + arguments.to + " needs --output FILE");
    if (!arguments.mesh.empty() || !arguments.picture.empty() || arguments.scene.uv_set)
      throw UsageError("--mesh, --picture and --uv-set belong to --lightmap");
    if (arguments.objects.size() > 1) throw UsageError("--to takes one --object");
    require_extension("--output", arguments.output, {".ply", ".npy"}, false);
  }
  for (const Output& output : arguments.outputs()) require_writable(output.path);
  const MethodInfo& method = method_named(arguments.visibility.method);
  if (method.needs_pixels) throw UsageError("method " + method.name + " takes pictures alone; use another");
}

void say_what_is_ignored(const BakeArguments& arguments, const CLI::App& command) {
  const bool map = arguments.is_lightmap();
  for (const CLI::Option* option : command.get_options())
    if (option->count() > 0 && option->get_group() == (map ? kFaceGroup : kLightmapGroup))
      say_ignored("--" + option->get_lnames().front(),
                  map ? "it belongs to --to, and a lightmap is baked" : "it belongs to --lightmap");
  if (!map) return;
  if (arguments.picture.empty())
    for (const char* option : {"--size", "--exposure"})
      if (command.count(option) > 0) say_ignored(option, "there is no --picture");
  if (command.count("--texels") > 0 && command.count("--texel") > 0)
    say_ignored("--texels", "the texture is as large as --texel makes it");
}

}  // namespace penumbra::apps
