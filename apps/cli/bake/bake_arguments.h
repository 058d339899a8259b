// What penumbra bake was asked for, and what of it can be refused before any file is read.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/common/options.h"
#include "apps/common/outputs.h"
#include "penumbra/render/bake/face_means.h"
#include "penumbra/render/bake/lightmap.h"

namespace CLI {
class App;
}

namespace penumbra::apps {

struct BakeArguments {
  CommonOptions common;
  SceneInput scene;
  std::vector<std::string> objects, lights, backs;
  std::string quantity = "visibility";
  VisibilityOptions visibility;
  /// Where values of parts are kept until all are there.
  std::filesystem::path parts;

  std::filesystem::path lightmap, mesh, picture;
  AtlasOptions atlas;
  LightmapOptions map;
  std::string picture_size = "640x480";
  double exposure_stops = 0.0;

  std::string to;
  std::filesystem::path output;
  FaceMeansOptions faces;

  bool is_lightmap() const { return !lightmap.empty(); }
  BakeQuantity bake_quantity() const {
    return quantity == "irradiance" ? BakeQuantity::kIrradiance : BakeQuantity::kVisibility;
  }
  std::vector<Output> outputs() const {
    return {{"--lightmap", lightmap}, {"--mesh", mesh}, {"--picture", picture}, {"--output", output}};
  }
  /// The folder of parts: given, or beside the result.
  std::filesystem::path parts_folder() const;
};

void add_bake_options(CLI::App& command, BakeArguments& arguments);

/// Throws UsageError and SystemError for all that can be refused without the scene.
void require_usable(const BakeArguments& arguments);

/// One line for each option that was given and has no effect.
void say_what_is_ignored(const BakeArguments& arguments, const CLI::App& command);

}  // namespace penumbra::apps
