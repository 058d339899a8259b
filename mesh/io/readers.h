// One reader for each format. Bytes in, soup out, MeshError otherwise; indices are checked by
// parse_polygon_soup.
#pragma once

#include <span>
#include <string>

#include "penumbra/mesh/io/polygon_soup.h"

namespace penumbra::detail {

PolygonSoup read_obj(std::span<const std::byte> bytes, const std::string& name);
PolygonSoup read_off(std::span<const std::byte> bytes, const std::string& name);
PolygonSoup read_ply(std::span<const std::byte> bytes, const std::string& name);
PolygonSoup read_stl(std::span<const std::byte> bytes, const std::string& name);

/// OFF, COFF, NOFF, STOFF and their combinations; also the variants that read_off refuses by name (4OFF,
/// nOFF).
bool is_off_keyword(std::string_view token);
/// Whether the size is exactly that of a binary STL file with the count it states.
bool has_binary_stl_size(std::span<const std::byte> bytes);

}  // namespace penumbra::detail
