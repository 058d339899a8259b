#include "render/scene/heightfield/height_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "mesh/io/cursor.h"
#include "mesh/io/formats.h"
#include "mesh/io/npy.h"
#include "penumbra/mesh/error.h"
#include "render/scene/heightfield/gdal/gdal_module.h"
#include "render/support/run_time_module.h"

namespace penumbra::detail {
namespace {

HeightGrid read_npy_heights(const std::filesystem::path& path) {
  NpyRows array = read_npy_rows(
      path, "save heights by numpy.save as an array of float32 or float64 of shape (rows, columns)");
  HeightGrid grid{.columns = array.columns, .rows = array.rows, .heights = std::move(array.values)};
  for (double& height : grid.heights)
    if (!std::isfinite(height)) height = std::numeric_limits<double>::quiet_NaN();
  return grid;
}

HeightGrid read_raster(const std::filesystem::path& path) {
  static void* const opened =
      symbol_of_module(PENUMBRA_GDAL_MODULE, kReadHeightsSymbol,
                       "heightfields of GeoTIFF and .asc need GDAL: install the Debian package libgdal-dev",
                       "or give heights as .npy");
  HeightGrid grid;
  const std::string complaint = (*reinterpret_cast<ReadHeights*>(opened))(path.string(), grid);
  if (!complaint.empty()) throw MeshError(path.string() + ": " + complaint);
  return grid;
}

void require_usable(const HeightGrid& grid, const std::string& name) {
  const auto size = std::to_string(grid.columns) + " x " + std::to_string(grid.rows);
  if (grid.columns < 2 || grid.rows < 2)
    fail_reading(name, "", "has " + size + " posts", "a heightfield has at least 2 x 2");
  if (grid.rows > kMostPosts / grid.columns)
    fail_reading(name, "", "has " + size + " posts, more than 134 million", "cut it, or take a coarser one");
  const double area = grid.across[0] * grid.down[1] - grid.across[1] * grid.down[0];
  if (!(std::abs(area) > 0.0 && std::isfinite(area + grid.origin[0] + grid.origin[1])))
    fail_reading(name, "", "has posts on one line", "its transform is wrong; write it again");
  if (std::ranges::all_of(grid.heights, [](double h) { return std::isnan(h); }))
    fail_reading(name, "", "has no heights, only gaps", "check its value for no data");
}

}  // namespace

HeightGrid read_heights(const std::filesystem::path& path) {
  // A name beginning with /vsi would let GDAL look elsewhere than in files.
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored))
    fail_reading(path.string(), "", "no such file", "check the path of the heightfield");
  HeightGrid grid = lower_extension(path) == ".npy" ? read_npy_heights(path) : read_raster(path);
  require_usable(grid, path.string());
  return grid;
}

}  // namespace penumbra::detail
