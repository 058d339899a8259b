// Colors of a soup's materials, from the files of materials that it names.
#pragma once

#include <filesystem>
#include <string>

#include "penumbra/mesh/io/polygon_soup.h"

namespace penumbra::detail {

/// Reads a file that stands in `folder`, or several whose names blanks separate. The first color found for a
/// material counts. Files that cannot be read, and textures, are added to soup.ignored.
void add_colors(PolygonSoup& soup, const std::filesystem::path& folder, const std::string& file);

}  // namespace penumbra::detail
