// A texture that a method keeps, as a picture to look at.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace penumbra {

struct TexturePicture {
  std::string name;                  ///< what it holds
  int size = 0;                      ///< texels a side
  std::vector<std::uint8_t> values;  ///< size², row 0 at the low end of the light's second axis; 0: nothing
};

}  // namespace penumbra
