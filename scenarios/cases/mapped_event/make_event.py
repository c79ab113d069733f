# SPDX-License-Identifier: Apache-2.0
"""Makes the files of this case: a gully that bends and opens on a fan (elevation.tif), and a source above it (source.geojson).

usage: make_event.py FOLDER [REACHED_MEMBER]
With the member file of a run of `truth.yaml` it also draws mapped.geojson: the outline of what was passed over by 0.3 m and more,
straightened to 6 m, its corners shifted at random by 5 m. Needs python3-gdal and python3-netcdf4.
"""
import json
import pathlib
import random
import sys

import netCDF4
import numpy as np
from osgeo import gdal, ogr

WEST, CELL, COLUMNS, ROWS = -150.0, 5.0, 300, 110


def ground():
    """Elevation [m] by row from the north: falls by 32 to 5 degrees to the east; the gully bends and fades on the fan."""
    x = WEST + (np.arange(COLUMNS) + 0.5) * CELL
    y = 0.5 * ROWS * CELL - (np.arange(ROWS) + 0.5) * CELL
    along = 1000 - np.tan(np.radians(5)) * x - 350 * np.tan(np.radians(29)) * (1 - np.exp(-x / 350))
    middle = 45 * np.sin(x / 170) * np.exp(-x / 900)
    depth = 34 / (1 + np.exp((x - 620) / 70))
    across = y[:, None] - middle[None, :]
    bumps = 0.4 * np.sin(x / 23)[None, :] * np.sin(y / 19)[:, None]
    return along[None, :] + depth[None, :] * (np.sqrt(1 + (across / 45) ** 2) - 1) + bumps


def write_ground(folder):
    z = ground().astype(np.float32)
    data = gdal.GetDriverByName("GTiff").Create(str(folder / "elevation.tif"), COLUMNS, ROWS, 1, gdal.GDT_Float32, ["COMPRESS=DEFLATE", "PREDICTOR=3"])
    data.SetGeoTransform((WEST, CELL, 0, 0.5 * ROWS * CELL, 0, -CELL))
    data.GetRasterBand(1).WriteArray(np.round(z, 2))


def write_polygon(file, points, note):
    ring = [list(p) for p in points]
    feature = {"type": "Feature", "properties": {"note": note}, "geometry": {"type": "Polygon", "coordinates": [ring]}}
    file.write_text(json.dumps({"type": "FeatureCollection", "name": file.stem, "features": [feature]}) + "\n")


def outline(member):
    """Corners of the largest ring around cells that 0.3 m passed over."""
    with netCDF4.Dataset(member) as data:
        covered = np.isfinite(data["arrival_time"][:].filled(np.nan)) & (data["peak_thickness"][:].filled(0) > 0.3)
        west, north, cell = data.grid_west_m + data.window_col0 * data.grid_cell_m, data.grid_north_m - data.window_row0 * data.grid_cell_m, data.grid_cell_m
    raster = gdal.GetDriverByName("MEM").Create("", covered.shape[1], covered.shape[0], 1, gdal.GDT_Byte)
    raster.SetGeoTransform((west, cell, 0, north, 0, -cell))
    raster.GetRasterBand(1).WriteArray(covered.astype(np.uint8))
    source = ogr.GetDriverByName("Memory").CreateDataSource("shapes")
    layer = source.CreateLayer("shapes")
    gdal.Polygonize(raster.GetRasterBand(1), raster.GetRasterBand(1), layer, -1)
    largest = max((f.GetGeometryRef().Clone() for f in layer), key=lambda g: g.GetArea())
    whole = ogr.Geometry(ogr.wkbPolygon)
    whole.AddGeometry(largest.GetGeometryRef(0))
    drawn = whole.Buffer(6).Buffer(-6).Simplify(6)
    draw = random.Random(2)
    corners = [(round(p[0] + draw.gauss(0, 5)), round(p[1] + draw.gauss(0, 5))) for p in drawn.GetGeometryRef(0).GetPoints()]
    return corners[:-1] + corners[:1]


def main(folder, member=None):
    folder = pathlib.Path(folder)
    write_ground(folder)
    write_polygon(folder / "source.geojson", [(40, -20), (55, 35), (110, 45), (130, 15), (115, -25), (70, -40), (40, -20)], "made up")
    if member:
        write_polygon(folder / "mapped.geojson", outline(member), "a computed event, corners shifted by 5 m at random")


if __name__ == "__main__":
    main(*sys.argv[1:])
