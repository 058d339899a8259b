#!/usr/bin/env python3
"""Writes the rasters of this folder by GDAL's Python module (python3-gdal)."""
import pathlib

import numpy as np
from osgeo import gdal, osr

gdal.UseExceptions()
HERE = pathlib.Path(__file__).resolve().parent


def write(name, heights, code, kind=gdal.GDT_Float32, bands=1, gap=None, scale=None, options=()):
    rows, columns = heights.shape
    file = gdal.GetDriverByName("GTiff").Create(str(HERE / name), columns, rows, bands, kind, options=list(options))
    file.SetGeoTransform((440720.0, 30.0, 0.0, 5100000.0, 0.0, -20.0))
    system = osr.SpatialReference()
    system.ImportFromEPSG(code)
    file.SetProjection(system.ExportToWkt())
    for k in range(bands):
        band = file.GetRasterBand(k + 1)
        band.WriteArray(heights)
        if gap is not None:
            band.SetNoDataValue(gap)
        if scale:
            band.SetScale(scale[0])
            band.SetOffset(scale[1])


r, c = np.mgrid[0:3, 0:4]
steps = (10 * r + c).astype(np.int16)
steps[1, 2] = -9999
# Decimetres above 100 m, one gap.
write("steps.tif", steps, 32633, gdal.GDT_Int16, gap=-9999, scale=(0.1, 100.0))
write("tiled.tif", (10.0 * r + c).astype(np.float32), 32633, gap=-3.4028234663852886e38,
      options=["TILED=YES", "BLOCKXSIZE=16", "BLOCKYSIZE=16", "COMPRESS=DEFLATE"])
write("degrees.tif", steps, 4326)
write("bands.tif", steps, 32633, gdal.GDT_Int16, bands=3)
