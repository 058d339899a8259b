// study: what is seen. A case is a scene under one light at one size of picture.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

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
  /// What is varied, for how cost grows: "light", "size", "faces"; empty: a scene as it is.
  std::string sweep{};
  /// Cases of one name are shown together.
  std::string group{};

  /// "bunny-medium 640x480", and " light x4".
  std::string id() const;
  /// A number that changes when the casters, the light or the camera do.
  std::string digest() const;
  nlohmann::json to_json() const;
};

/// Throws UsageError for a scene that has no light or several.
StudyCase make_case(const std::string& name, const Scene& scene, const StudyView& view);

/// How cost grows: lights of 1/8 to 4 times the radius, and pictures of 1/16 to 4 times the pixels.
struct GrowthView {
  StudyView view;
  /// As StudyCase has it.
  std::string sweep;
};
std::vector<GrowthView> growth_views(const StudyView& view);

/// A sphere over a floor, of 1,280 to 1,310,720 faces, each under the same light. Made one after the other:
/// `level` is 0 to 3.
StudyCase sphere_case(int level, const StudyView& view);

}  // namespace penumbra::apps
