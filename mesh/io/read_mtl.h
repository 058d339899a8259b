// Material libraries of OBJ files: the diffuse color Kd of each material. All else is skipped.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "penumbra/mesh/io/polygon_soup.h"

namespace penumbra::detail {

struct MaterialLibrary {
  std::vector<Material> materials;
  /// Some material has a diffuse texture.
  bool has_textures = false;
};

/// `Kd r` stands for `Kd r r r`. A material whose Kd is missing, no number, a spectrum or in CIE XYZ has no
/// color. Components below 0 become 0, those above 1 become 1. Never fails. Cost O(bytes).
MaterialLibrary read_mtl(std::span<const std::byte> bytes);

}  // namespace penumbra::detail
