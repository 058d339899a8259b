// The atlas that meshes bring along.
#include <algorithm>
#include <cstdint>
#include <numeric>
#include <span>

#include "penumbra/mesh/error.h"
#include "penumbra/render/bake/bake_receivers.h"
#include "penumbra/render/bake/texture_atlas.h"
#include "render/bake/uv_overlaps.h"

namespace penumbra {
namespace {

/// Texels²: what a texel gets of a face that lies on another one is then less than this share of it.
constexpr double kOverlap = 1.0 / 64.0;

struct PlacedFace {
  std::size_t object;
  std::uint32_t face;
};

std::string named(const std::vector<SceneObject>& objects, const PlacedFace& at) {
  return "face " + std::to_string(at.face) + " of object " + std::to_string(at.object) + " (" +
         objects[at.object].name + ")";
}

bool is_inside(const FaceUv& uv) {
  return std::ranges::all_of(
      uv, [](const glm::dvec2& p) { return p.x >= 0.0 && p.x <= 1.0 && p.y >= 0.0 && p.y <= 1.0; });
}

void require_apart(const std::vector<SceneObject>& objects, std::span<const FaceUv> uv,
                   std::span<const PlacedFace> faces) {
  const auto pairs = detail::find_overlaps(uv, kOverlap, 1);
  if (pairs.empty()) return;
  throw UsageError(
      named(objects, faces[pairs[0].first]) + " and " + named(objects, faces[pairs[0].second]) +
      " lie on each other in the texture; unwrap the mesh without overlap, or choose another set");
}

}  // namespace

TextureAtlas given_atlas(const std::vector<SceneObject>& objects, const AtlasOptions& options) {
  std::vector<std::size_t> chosen = options.objects;
  if (chosen.empty()) {
    chosen.resize(objects.size());
    std::iota(chosen.begin(), chosen.end(), std::size_t{0});
  }
  TextureAtlas atlas{
      .width = options.size, .height = options.size, .uv = std::vector<std::vector<FaceUv>>(objects.size())};
  std::vector<FaceUv> all;
  std::vector<PlacedFace> faces;
  for (const std::size_t i : chosen) {
    const SceneObject& object = objects[i];
    if (object.corner_uv.empty())
      throw UsageError("object " + std::to_string(i) + " (" + object.name +
                       ") has no texture coordinates of this set; those of glTF files are read");
    for (std::uint32_t f = 0; f < object.mesh.triangles().size(); ++f) {
      FaceUv uv = object.corner_uv[f];
      if (!is_inside(uv))
        throw UsageError(named(objects, {i, f}) +
                         " has no texture coordinates from 0 to 1; unwrap the mesh, or choose another set");
      for (glm::dvec2& p : uv) p *= static_cast<double>(options.size);
      if (face_normal(object.mesh, f) == Vec3(0.0)) uv = {};  // without area: no texel, as in charts
      atlas.uv[i].push_back(uv);
      all.push_back(uv);
      faces.push_back({i, f});
    }
  }
  require_apart(objects, all, faces);
  return atlas;
}

}  // namespace penumbra
