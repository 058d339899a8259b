// Heights on a regular grid of posts, and where they are read from.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <vector>

namespace penumbra::detail {

struct HeightGrid {
  std::size_t columns = 0, rows = 0;
  /// Row after row. NaN: no data.
  std::vector<double> heights;
  /// The first post, and the ways to the next one in its row and to the next row: east, north.
  std::array<double, 2> origin{0.0, 0.0}, across{1.0, 0.0}, down{0.0, -1.0};

  double height(std::size_t row, std::size_t column) const { return heights[row * columns + column]; }
};

/// 11,585² posts: more triangles than twice this would not fit.
inline constexpr std::size_t kMostPosts = std::size_t{1} << 27;

/// A raster that GDAL reads as GeoTIFF, ESRI ASCII grid (.asc) or ESRI .bil: posts are the centers of its
/// pixels, heights its one band. Or a NumPy array (.npy, rows × columns): posts are 1 apart, the first row is
/// the northern one. Throws MeshError for other files, for degrees in place of lengths, and for fewer than 2
/// × 2 posts; SystemError where GDAL is needed and not there.
HeightGrid read_heights(const std::filesystem::path& path);

}  // namespace penumbra::detail
