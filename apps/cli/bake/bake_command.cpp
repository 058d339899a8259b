// penumbra bake: light of surfaces, as a texture or over faces and around vertices.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>

#include "apps/cli/bake/bake_arguments.h"
#include "apps/cli/bake/bake_parts.h"
#include "apps/cli/bake/bake_source.h"
#include "apps/cli/bake/face_values.h"
#include "apps/cli/bake/lightmap_picture.h"
#include "apps/cli/commands.h"
#include "apps/cli/made_by.h"
#include "apps/cli/ranks/shared_work.h"
#include "apps/common/messages.h"
#include "penumbra/mesh/error.h"
#include "penumbra/render/bake/atlas_mesh.h"

namespace penumbra::apps {
namespace {

constexpr const char* kFooter = R"(Examples:
  penumbra bake room.json --lightmap room.exr --mesh room.glb --picture lit.png
  penumbra bake room.json --lightmap room.exr --quantity irradiance --texel 0.05
  penumbra bake level.glb --uv-set 1 --lightmap level.exr --texels 2048
  penumbra bake scene.json --object 1 --to vertices --output lit.ply
  mpirun -n 4 penumbra bake room.json --lightmap room.exr --texels 4096
A visibility is the fraction of a light's area that is seen, 0 to 1. Lightmaps have the channels visibility.NAME of each light, or R G B of irradiance, and
coverage, the share of each texel that faces cover. A bake that was ended goes on where it was when it is called again.)";

/// What all parts of one bake share.
struct Bake {
  const BakeArguments& arguments;
  const Scene& scene;
  const BakeSource& source;
  /// Null where this process is alone.
  Ranks* ranks;

  bool is_helper() const { return ranks && ranks->rank() > 0; }

  /// All parts, into the store that this returns; nothing for a rank that has helped.
  std::optional<PartStore> run(const BakeParts& parts, const TextureAtlas* atlas) const {
    if (is_helper()) {
      help(parts, *ranks);
      return std::nullopt;
    }
    std::optional<PartStore> store;
    const auto work = [&] {
      store.emplace(arguments.parts_folder(), settings_of(arguments, scene, atlas));
      ProgressLine line("baking");
      const std::size_t had = bake_all(parts, *store, ranks, line.callback());
      if (had > 0 && arguments.common.verbose)
        complain(std::to_string(had) + " of " + std::to_string(parts.count) + " parts were there already");
    };
    if (ranks)
      or_abort(*ranks, work);
    else
      work();
    return store;
  }
};

void write_map(const Bake& bake, const Lightmap& map, const TextureAtlas& atlas) {
  Image image{.width = map.width, .height = map.height, .channels = {}, .metadata = metadata_of(bake.scene)};
  const std::vector<std::string> names = channel_names(bake.scene, bake.source.quantity);
  for (std::size_t c = 0; c < names.size(); ++c) image.channels[names[c]] = map.channels[c];
  image.channels["coverage"] = map.coverage;
  image.metadata["penumbraBake"] = settings_of(bake.arguments, bake.scene, &atlas).dump();
  write_exr(bake.arguments.lightmap, image);
}

void write_picture(const Bake& bake, const Lightmap& map, const TextureAtlas& atlas) {
  const BakeArguments& arguments = bake.arguments;
  const PixelPair size = parse_size(arguments.picture_size);
  Image image =
      picture_by_lightmap(bake.scene, bake.source, atlas, map, size.x, size.y, arguments.common.threads);
  if (extension_of(arguments.picture) == ".exr") {
    image.metadata = metadata_of(bake.scene);
    return write_exr(arguments.picture, image);
  }
  write_png(arguments.picture, image,
            {.exposure_stops = arguments.exposure_stops, .background = bake.scene.picture.background});
}

std::string text_of(const TextureAtlas& atlas, const Lightmap& map) {
  const auto touched = std::ranges::count_if(map.coverage, [](float c) { return c > 0.0f; });
  const double covered = 100.0 * static_cast<double>(touched) / static_cast<double>(map.coverage.size());
  char text[200];
  if (atlas.texel > 0.0)
    std::snprintf(text, sizeof text,
                  "%zu charts in %dx%d texels of %.4g scene units; %.0f%% of them are covered\n",
                  atlas.charts, atlas.width, atlas.height, atlas.texel, covered);
  else
    std::snprintf(text, sizeof text,
                  "The file's texture coordinates in %dx%d texels; %.0f%% of them are covered\n", atlas.width,
                  atlas.height, covered);
  return text;
}

void bake_map(const Bake& bake) {
  const BakeArguments& arguments = bake.arguments;
  AtlasOptions options = arguments.atlas;
  options.objects = object_numbers(bake.scene, arguments.objects);
  const TextureAtlas atlas = arguments.scene.uv_set ? given_atlas(bake.scene.objects, options)
                                                    : make_atlas(bake.scene.objects, options);
  const LightmapBaker baker(bake.source, atlas, arguments.map);
  const BakeParts parts{
      .count = baker.tiles(),
      .values = [&](std::size_t tile) { return baker.values(tile); },
      .cost = [&](std::size_t tile) { return static_cast<double>(baker.touched(tile)); },
      .bake = [&](std::size_t tile, const Progress& progress) { return baker.bake(tile, progress); }};
  const std::optional<PartStore> store = bake.run(parts, &atlas);
  if (!store) return;
  const Lightmap map = baker.finish([&](std::size_t tile) { return store->read(tile); });
  write_map(bake, map, atlas);
  if (!arguments.mesh.empty()) write_atlas_mesh(arguments.mesh, bake.scene.objects, atlas, bake.source.backs);
  if (!arguments.picture.empty()) write_picture(bake, map, atlas);
  store->remove(parts.count);
  print(text_of(atlas, map));
}

void bake_object(const Bake& bake) {
  const BakeArguments& arguments = bake.arguments;
  const std::vector<std::size_t> objects = object_numbers(bake.scene, arguments.objects);
  if (objects.size() > 1)
    throw UsageError("--to takes one object, and \"" + arguments.objects[0] + "\" has " +
                     std::to_string(objects.size()) + " tiles; give the number of one");
  const std::size_t object = objects.empty() ? 0 : objects[0];
  FaceMeansOptions options = arguments.faces;
  options.place = arguments.to == "vertices" ? BakePlace::kVertices : BakePlace::kFaces;
  const FaceMeans means(bake.source, object, options);
  const BakeParts parts{
      .count = means.parts(),
      .values = [&](std::size_t part) { return means.values(part); },
      .cost = [&](std::size_t part) { return static_cast<double>(means.faces(part)); },
      .bake = [&](std::size_t part, const Progress& progress) { return means.bake(part, progress); }};
  const std::optional<PartStore> store = bake.run(parts, nullptr);
  if (!store) return;
  write_values(arguments.output, bake.scene.objects[object].mesh, options.place == BakePlace::kVertices,
               channel_names(bake.scene, bake.source.quantity),
               means.finish([&](std::size_t part) { return store->read(part); }));
  store->remove(parts.count);
}

void run(const BakeArguments& arguments, const CLI::App& command) {
  require_usable(arguments);
  say_what_is_ignored(arguments, command);
  const ThreadLimit limit(arguments.common.threads);
  const Scene scene = chosen_scene(arguments, load(arguments.scene));
  require_apart(arguments.outputs(), scene.files);
  const Casters casters(scene.objects, arguments.common.threads);
  const BakeSource source{.casters = casters,
                          .lights = scene.lights,
                          .quantity = arguments.bake_quantity(),
                          .visibility = arguments.visibility,
                          .backs = object_numbers(scene, arguments.backs)};
  object_numbers(scene, arguments.objects);  // said before other processes are met
  const std::unique_ptr<Ranks> ranks = Ranks::of_this_run();
  const Bake bake{arguments, scene, source, ranks.get()};
  or_abort_where_lost(ranks.get(), [&] {
    arguments.is_lightmap() ? bake_map(bake) : bake_object(bake);
    if (bake.is_helper()) return;
    for (const Output& output : arguments.outputs())
      if (!output.path.empty()) say_written(arguments.common.verbose, output.path);
  });
}

}  // namespace

void add_bake_command(CLI::App& app) {
  CLI::App& command = *app.add_subcommand("bake", "Light of surfaces, as a texture or of faces and vertices");
  auto arguments = std::make_shared<BakeArguments>();
  add_bake_options(command, *arguments);
  command.footer(kFooter);
  command.callback([arguments, &command] { run(*arguments, command); });
}

}  // namespace penumbra::apps
