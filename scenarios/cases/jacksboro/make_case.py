#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes elevation.tif and source.geojson of this case from Matplotlib's sample data (python-matplotlib-data).

usage: make_case.py [jacksboro_fault_dem.npz]     (needs python3-numpy, python3-gdal)
A window of 170 x 142 cells of 3 arc seconds, kept as it is: degrees, whole metres. The source is an octagon of our own.
"""
import json
import math
import pathlib
import sys

import numpy as np
from osgeo import gdal, osr

gdal.UseExceptions()
HERE = pathlib.Path(__file__).resolve().parent
SAMPLE = "/usr/share/matplotlib/mpl-data/sample_data/jacksboro_fault_dem.npz"
ROWS, COLUMNS = slice(176, 318), slice(96, 266)
MIDDLE, HALF_M = (-84.2625, 36.5267), (170, 150)  # of the source: degrees, semi-axes east and north [m]


def main(sample=SAMPLE):
    with np.load(sample) as dem:
        heights, step, west, north = dem["elevation"], float(dem["dx"]), float(dem["xmin"]), float(dem["ymin"])
    part = heights[ROWS, COLUMNS]
    file = gdal.GetDriverByName("GTiff").Create(str(HERE / "elevation.tif"), part.shape[1], part.shape[0], 1, gdal.GDT_Int16,
                                                ["COMPRESS=DEFLATE", "PREDICTOR=2"])
    file.SetGeoTransform((west + COLUMNS.start * step, step, 0, north - ROWS.start * step, 0, -step))
    system = osr.SpatialReference()
    system.ImportFromEPSG(4326)
    file.SetProjection(system.ExportToWkt())
    file.GetRasterBand(1).WriteArray(part)
    file.GetRasterBand(1).SetUnitType("m")
    file = None
    metres = 111_320.0
    ring = [[round(MIDDLE[0] + HALF_M[0] * math.cos(k * math.pi / 4) / (metres * math.cos(math.radians(MIDDLE[1]))), 6),
             round(MIDDLE[1] + HALF_M[1] * math.sin(k * math.pi / 4) / metres, 6)] for k in range(9)]
    feature = {"type": "Feature", "properties": {"note": "made up"}, "geometry": {"type": "Polygon", "coordinates": [ring]}}
    (HERE / "source.geojson").write_text(json.dumps({"type": "FeatureCollection", "name": "source", "features": [feature]}) + "\n")


if __name__ == "__main__":
    main(*sys.argv[1:])
