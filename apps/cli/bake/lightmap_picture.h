// bake: the scene lit by its lightmap, as its camera sees it.
#pragma once

#include "penumbra/render/bake/lightmap.h"
#include "penumbra/render/image/image.h"

namespace penumbra::apps {

/// Each pixel looks the map up, bilinearly, at the point that it shows. With the quantity visibility a pixel
/// is shaded as `penumbra render` does, with the visibility of each light from the map. With irradiance R G B
/// are albedo / π times what the map has, and nothing else counts. Objects that are not in the map, and the
/// sides of faces that are not, get no light. Throws as Renderer::render does.
Image picture_by_lightmap(const Scene& scene, const BakeSource& source, const TextureAtlas& atlas,
                          const Lightmap& map, int width, int height, int threads);

}  // namespace penumbra::apps
