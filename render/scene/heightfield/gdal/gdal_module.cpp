#include "render/scene/heightfield/gdal/gdal_module.h"

#include <cpl_error.h>
#include <gdal.h>
#include <ogr_srs_api.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

namespace penumbra::detail {
namespace {

struct Close {
  void operator()(void* dataset) const { GDALClose(dataset); }
};
using Dataset = std::unique_ptr<void, Close>;

/// Those that hold heights in lengths. Others, which may look into a network, are not asked.
constexpr const char* kDrivers[] = {"GTiff", "AAIGrid", "EHdr", nullptr};
constexpr const char* kOthers = "write it as GeoTIFF: gdal_translate FILE heights.tif";

std::string first_line_of_error() {
  std::string text = CPLGetLastErrorMsg();
  std::ranges::replace(text, '\n', ' ');
  return text.empty() ? "is no GeoTIFF, .asc or .bil" : text;
}

std::string complaint_of(GDALDatasetH dataset) {
  if (const int bands = GDALGetRasterCount(dataset); bands != 1)
    return "has " + std::to_string(bands) +
           " bands, heights are one; choose it: gdal_translate -b 1 FILE heights.tif";
  if (GDALDataTypeIsComplex(GDALGetRasterDataType(GDALGetRasterBand(dataset, 1))))
    return "has complex numbers; write heights as real ones";
  const OGRSpatialReferenceH system = GDALGetSpatialRef(dataset);
  if (system != nullptr && OSRIsGeographic(system))
    return "has its places in degrees; give lengths: gdalwarp -t_srs EPSG:CODE FILE heights.tif, CODE being "
           "that of a projection";
  const auto columns = static_cast<std::size_t>(GDALGetRasterXSize(dataset));
  const auto rows = static_cast<std::size_t>(GDALGetRasterYSize(dataset));
  if (columns == 0 || rows > kMostPosts / columns)
    return "has " + std::to_string(columns) + " x " + std::to_string(rows) +
           " posts, more than 134 million; cut it, or take a coarser one: gdal_translate -outsize 50% 50% "
           "FILE heights.tif";
  return {};
}

/// The file's coordinates of pixels, the corner of the first at 0, to places.
void set_places(GDALDatasetH dataset, HeightGrid& out) {
  double g[6] = {0.0, 1.0, 0.0, 0.0, 0.0, -1.0};
  if (GDALGetGeoTransform(dataset, g) != CE_None) {  // none: as an array
    g[0] = g[2] = g[3] = g[4] = 0.0;
    g[1] = 1.0;
    g[5] = -1.0;
  }
  out.across = {g[1], g[4]};
  out.down = {g[2], g[5]};
  out.origin = {g[0] + 0.5 * (g[1] + g[2]), g[3] + 0.5 * (g[4] + g[5])};
}

/// Gaps become NaN; the rest gets the band's scale and offset.
void finish_heights(GDALRasterBandH band, HeightGrid& out) {
  int has_gaps = 0;
  const double gap = GDALGetRasterNoDataValue(band, &has_gaps);
  const bool single = GDALGetRasterDataType(band) == GDT_Float32;
  const auto is_gap = [&](double value) {
    return has_gaps && (value == gap || (single && static_cast<float>(value) == static_cast<float>(gap)));
  };
  const double scale = GDALGetRasterScale(band, nullptr), offset = GDALGetRasterOffset(band, nullptr);
  for (double& height : out.heights)
    height = std::isfinite(height) && !is_gap(height) ? height * scale + offset
                                                      : std::numeric_limits<double>::quiet_NaN();
}

std::string read(const std::string& path, HeightGrid& out) {
  GDALAllRegister();
  CPLErrorReset();
  const Dataset dataset(
      GDALOpenEx(path.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY, kDrivers, nullptr, nullptr));
  if (!dataset) return first_line_of_error() + "; " + kOthers;
  if (const std::string complaint = complaint_of(dataset.get()); !complaint.empty()) return complaint;
  const int columns = GDALGetRasterXSize(dataset.get()), rows = GDALGetRasterYSize(dataset.get());
  out.columns = static_cast<std::size_t>(columns);
  out.rows = static_cast<std::size_t>(rows);
  out.heights.resize(out.columns * out.rows);
  set_places(dataset.get(), out);
  const GDALRasterBandH band = GDALGetRasterBand(dataset.get(), 1);
  if (GDALRasterIO(band, GF_Read, 0, 0, columns, rows, out.heights.data(), columns, rows, GDT_Float64, 0,
                   0) != CE_None)
    return first_line_of_error() + "; it is truncated or corrupt; copy it again";
  finish_heights(band, out);
  return {};
}

}  // namespace
}  // namespace penumbra::detail

std::string penumbra_read_heights(const std::string& path, penumbra::detail::HeightGrid& out) {
  CPLPushErrorHandler(CPLQuietErrorHandler);
  std::string complaint;
  try {
    complaint = penumbra::detail::read(path, out);
  } catch (...) {
    CPLPopErrorHandler();
    throw;
  }
  CPLPopErrorHandler();
  return complaint;
}
