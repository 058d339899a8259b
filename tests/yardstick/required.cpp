#include "tests/yardstick/report.h"

namespace penumbra::yardstick {

const std::vector<std::string>& required() {
  static const std::vector<std::string> kRequired = {
      "cases/ground_*/silhouette",
      "cases/ground_*/reference",
      "cases/ground_*/rays",
      "cases/ground_*/hard",
      "cases/ground_*/dbuffer",
      "cases/ground_*/occlusion-textures",
      "cases/sheet_1e-[1-4]/silhouette",
      "cases/lamp_in_wall_plane_*/silhouette",
      "cases/lamp_in_wall_plane_*/reference",
      "cases/sun_*/silhouette",
      "cases/sun_1e*/reference",
      "cases/sun_1e*/hard",
      "lights/*/silhouette",
      "lights/*/reference",
      "lights/*/rays",
      "lights/*/hard",
      "lights/just_above_the_top_face*/occlusion-textures",
      "lights/sun_along_two_sides*/occlusion-textures",
      "suns/*/silhouette",
      "plates/*_floor_20/silhouette",
      "plates/*_floor_20_casts/silhouette",
      "plates/*_floor_200/silhouette",
      "plates/*_floor_2000/silhouette",
      "plates/*_floor_20000/silhouette",
      "plates/*_floor_1e+06/silhouette",
      "certificates/*",
      "cases/blinds/silhouette",
      "patterns/*/silhouette",
      "merging/*/silhouette",
  };
  return kRequired;
}

}  // namespace penumbra::yardstick
