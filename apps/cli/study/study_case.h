// study: what is seen. A case is a scene under one light at one size of picture.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "penumbra/render/scene/scene.h"

namespace penumbra::apps {

/// How the picture is taken.
struct StudyView {
  int width = 640, height = 480;
  /// Times the light's radius, half extents, or the tangent of half its angle.
  double light_scale = 1.0;
};

struct StudyCase {
  /// The file's name without folder and extension.
  std::string scene_name;
  /// Its light scaled as `view` says.
  Scene scene;
  StudyView view{};

  /// "bunny-medium 640x480", and " light x4".
  std::string id() const;
  /// A number that changes when the casters, the light or the camera do.
  std::string digest() const;
  nlohmann::json to_json() const;
};

/// Throws UsageError for a scene that has no light or several.
StudyCase make_case(const std::string& name, const Scene& scene, const StudyView& view);

}  // namespace penumbra::apps
