# SPDX-License-Identifier: Apache-2.0
"""Draws deposits of the same scene in both formulations over hillshade.

usage: plot_formulations.py OUT.png TITLE=RUN_FOLDER ...   (needs python3-gdal, python3-matplotlib)
"""
import sys

import matplotlib
import numpy as np
from osgeo import gdal

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

gdal.UseExceptions()


def layer(folder, name):
    data = gdal.Open(f'NETCDF:"{folder}/peaks.nc":{name}')
    west, cell, _, north, _, _ = data.GetGeoTransform()
    z = data.ReadAsArray().astype(float)
    extent = [west, west + cell * z.shape[1], north - cell * z.shape[0], north]
    return np.where(z > 1e30, np.nan, z), extent


def draw(axis, title, folder):
    reached, extent = layer(folder, "peak_thickness")
    deposit, _ = layer(folder, "deposit_thickness")
    west, east, south, north = extent
    extent = [0, east - west, 0, north - south]
    axis.imshow(np.where(reached > 0.05, 0.3, np.nan), extent=extent, cmap="Greys", vmin=0, vmax=1)
    image = axis.imshow(np.where(deposit > 0.05, deposit, np.nan), extent=extent, cmap="YlOrBr",
                        vmin=0, vmax=12)
    rows, cols = np.where(reached > 0.05)
    cell = extent[1] / reached.shape[1]
    axis.set_xlim(cols.min() * cell - 60, cols.max() * cell + 60)
    axis.set_ylim(extent[3] - rows.max() * cell - 60, extent[3] - rows.min() * cell + 60)
    axis.set_title(title, fontsize=9)
    axis.set_aspect("equal")
    axis.tick_params(labelsize=6)
    return image


def main():
    out, runs = sys.argv[1], [text.split("=", 1) for text in sys.argv[2:]]
    columns = 2
    rows = (len(runs) + 1) // columns
    figure, axes = plt.subplots(rows, columns, figsize=(11, 2.6 * rows), squeeze=False)
    for axis in axes.flat[len(runs):]:
        axis.axis("off")
    for axis, (title, folder) in zip(axes.flat, runs):
        image = draw(axis, title, folder)
    figure.colorbar(image, ax=axes, shrink=0.6, label="deposit [m]; grey: reached at any time")
    figure.savefig(out, dpi=110, bbox_inches="tight")


if __name__ == "__main__":
    main()
