// Heightfields that GDAL reads: tests/data/terrain/make.py wrote the rasters by GDAL's Python module. Built
// where GDAL is.
#include <algorithm>
#include <cmath>

#include "render/scene/heightfield/height_grid.h"
#include "tests/render/scene/heightfield/height_support.h"

namespace penumbra {
namespace {

using Raster = testing::HeightFiles;
const std::filesystem::path kFolder = std::filesystem::path(PENUMBRA_SOURCE) / "tests/data/terrain";

TEST_F(Raster, GeoTiffHasPlacesScaleAndGaps) {
  const detail::HeightGrid grid = detail::read_heights(kFolder / "steps.tif");
  ASSERT_EQ(grid.columns, 4u);
  ASSERT_EQ(grid.rows, 3u);
  // Pixels of 30 by 20, whose corner is at 440,720 east, 5,100,000 north: posts are their centers.
  EXPECT_EQ(grid.origin, (std::array<double, 2>{440735.0, 5099990.0}));
  EXPECT_EQ(grid.across, (std::array<double, 2>{30.0, 0.0}));
  EXPECT_EQ(grid.down, (std::array<double, 2>{0.0, -20.0}));
  EXPECT_TRUE(std::isnan(grid.height(1, 2)));
  EXPECT_NEAR(grid.height(2, 3), 102.3, 1e-9);
  EXPECT_EQ(std::ranges::count_if(grid.heights, [](double h) { return std::isnan(h); }), 1);

  const Scene scene = scene_of(R"("heightfield": ")" + (kFolder / "steps.tif").string() +
                               R"(", "translation": [-440735, -100, 5099990])");
  const Bounds bounds = scene.bounds();
  EXPECT_EQ(bounds.low, Vec3(0, 0, 0));
  EXPECT_EQ(bounds.high.x, 90.0);
  EXPECT_NEAR(bounds.high.y, 2.3, 1e-9);
  EXPECT_EQ(bounds.high.z, 40.0);
}

TEST_F(Raster, TiledAndCompressedIsTheSame) {
  const detail::HeightGrid grid = detail::read_heights(kFolder / "tiled.tif");
  EXPECT_EQ(grid.heights, (std::vector<double>{0, 1, 2, 3, 10, 11, 12, 13, 20, 21, 22, 23}));
}

TEST_F(Raster, AsciiGridIsReadFromNorthToSouth) {
  write_text("h.asc",
             "ncols 3\nnrows 2\nxllcorner 10\nyllcorner 100\ncellsize 2\nNODATA_value -1\n5 6 7\n8 -1 9\n");
  const detail::HeightGrid grid = detail::read_heights(path("h.asc"));
  EXPECT_EQ(grid.origin, (std::array<double, 2>{11.0, 103.0}));
  EXPECT_EQ(grid.down, (std::array<double, 2>{0.0, -2.0}));
  EXPECT_EQ(grid.height(0, 2), 7.0);
  EXPECT_TRUE(std::isnan(grid.height(1, 1)));
  EXPECT_EQ(grid.height(1, 2), 9.0);
}

TEST_F(Raster, RefusalsSayWhatToDo) {
  const auto said = [this](const std::filesystem::path& file) {
    return complaint_of(R"("heightfield": ")" + file.string() + "\"");
  };
  EXPECT_NE(said(kFolder / "degrees.tif").find("gdalwarp"), std::string::npos)
      << said(kFolder / "degrees.tif");
  EXPECT_NE(said(kFolder / "bands.tif").find("3 bands"), std::string::npos);
  EXPECT_NE(said(kFolder / "make.py").find("; "), std::string::npos);
  write_text("cut.tif", std::string("II*\0\x08\0\0\0\x05", 9));
  EXPECT_NE(said(path("cut.tif")).find("cut.tif"), std::string::npos);
  EXPECT_NE(said("/vsicurl/http://localhost/x.tif").find("no such file"), std::string::npos);
  EXPECT_EQ(std::ranges::count(said(path("cut.tif")), '\n'), 0);
}

}  // namespace
}  // namespace penumbra
