#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Makes the pictures of README, tutorial and guide again from the shipped cases, into docs/images.

usage: scripts/make_pictures.py [--list] [NAME ...]    (all when no name is given: a minute of one core)
Needs build/release/ensemble/app/sturz, python3-numpy, python3-netcdf4, python3-gdal, python3-matplotlib. Runs lie in build/pictures and go on
where they were. Pictures of docs/studies are made by their studies (scripts/make_studies.sh).
"""
import pathlib
import subprocess
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.colors import BoundaryNorm, LightSource, ListedColormap
from matplotlib.patches import Patch
from netCDF4 import Dataset
from osgeo import gdal, ogr, osr

gdal.UseExceptions()
ROOT = pathlib.Path(__file__).resolve().parent.parent
STURZ, RUNS, IMAGES, CASES = ROOT / "build/release/ensemble/app/sturz", ROOT / "build/pictures", ROOT / "docs/images", ROOT / "scenarios/cases"
# Classes of the maps: lower ends, colours (Okabe and Ito's order from light to dark, told apart by all eyes), words.
REACHED = ((0.005, 0.05, 0.2, 0.5, 0.8, 1.0001), ("#ffffb2", "#fecc5c", "#fd8d3c", "#f03b20", "#bd0026"), "probability that the flow arrives")
PRESSURE = ((1, 3, 10, 30, 100, 1e9), ("#edf8fb", "#b3cde3", "#8c96c6", "#8856a7", "#810f7c"), "pressure that 5 % of the members exceed [kPa]")


def sturz(*words):
    done = subprocess.run([str(STURZ), *map(str, words)], capture_output=True, text=True)
    if done.returncode not in (0, 2):
        raise SystemExit(f"sturz {' '.join(map(str, words))}\n{done.stdout[-1000:]}{done.stderr[-1000:]}")
    return done.stdout


def results_of(name, members, command="ensemble", *more):
    """Folder of the results of a shipped case with so many members."""
    out = RUNS / f"{name}_{members}"
    sturz(command, CASES / name / "scenario.yaml", "-o", out, "-n", members, *more)
    return out


def layer(out, name, **at):
    """A plane of hazard.nc as (values, west, east, south, north); at: index by dimension."""
    with Dataset(out / "hazard.nc") as file:
        variable = file[name]
        values = variable[tuple(at.get(d, slice(None)) for d in variable.dimensions)]
        x, y = np.asarray(file["x"][:], float), np.asarray(file["y"][:], float)
    values = np.ma.filled(np.ma.asarray(values, float), np.nan)
    half = abs(x[1] - x[0]) / 2
    if y[0] < y[-1]:
        values = values[::-1]
    return values, x.min() - half, x.max() + half, y.min() - half, y.max() + half


def nearest(out, dimension, wanted):
    with Dataset(out / "hazard.nc") as file:
        return int(np.argmin(abs(np.asarray(file[dimension][:], float) - wanted)))


def ground_of(name):
    """Elevation on the working grid: (heights, affine, coordinate system)."""
    folder = RUNS / f"{name}_ground"
    sturz("terrain", CASES / name / "scenario.yaml", "-o", folder)
    file = gdal.Open(str(folder / "elevation.tif"))
    heights = file.ReadAsArray().astype(float)
    nodata = file.GetRasterBand(1).GetNoDataValue()
    if nodata is not None:
        heights[heights == nodata] = np.nan
    return heights, file.GetGeoTransform(), file.GetProjection()


def rings_of(path, projection):
    """Rings of a polygon file in a coordinate system, or as they are where that is empty."""
    source = ogr.Open(str(path))
    rings = []
    for feature in source.GetLayer(0):
        shape = feature.GetGeometryRef().Clone()
        own = shape.GetSpatialReference()
        if projection and own is not None and "LOCAL_CS" not in projection and "ENGCRS" not in projection:
            wanted = osr.SpatialReference(projection)
            for system in (own, wanted):
                system.SetAxisMappingStrategy(osr.OAMS_TRADITIONAL_GIS_ORDER)
            shape.Transform(osr.CoordinateTransformation(own, wanted))
        parts = [shape.GetGeometryRef(k) for k in range(shape.GetGeometryCount())]
        for part in parts:
            ring = part.GetGeometryRef(0) if part.GetGeometryCount() else part
            rings.append(np.array(ring.GetPoints())[:, :2])
    return rings


def draw_ground(axes, heights, affine):
    shade = LightSource(315, 45).hillshade(np.nan_to_num(heights, nan=np.nanmin(heights)), vert_exag=1.5, dx=affine[1], dy=affine[1])
    rows, columns = heights.shape
    extent = (affine[0], affine[0] + columns * affine[1], affine[3] + rows * affine[5], affine[3])
    axes.imshow(shade, cmap="gray", extent=extent, vmin=-0.4, vmax=1.1, interpolation="bilinear")
    x = affine[0] + (np.arange(columns) + 0.5) * affine[1]
    y = affine[3] + (np.arange(rows) + 0.5) * affine[5]
    span = np.nanmax(heights) - np.nanmin(heights)
    step = next(s for s in (5, 10, 20, 50, 100, 200, 500) if span / s < 14)
    axes.contour(x, y, heights, np.arange(np.floor(np.nanmin(heights) / step) * step, np.nanmax(heights), step), colors="k", linewidths=0.25, alpha=0.5)


def draw_classes(axes, plane, classes):
    ends, colours, words = classes
    values, west, east, south, north = plane
    shown = np.ma.masked_where(~(values >= ends[0]), values)
    axes.imshow(shown, cmap=ListedColormap(colours), norm=BoundaryNorm(ends, len(colours)), extent=(west, east, south, north), alpha=0.75, interpolation="nearest")
    percent = ends[-1] < 2
    labels = [f"{100 * a:g} to {100 * min(b, 1):g} %" if percent else f"{a:g} to {b:g}" if b < 1e6 else f"{a:g} and more" for a, b in zip(ends, ends[1:])]
    labels[0] = labels[0].replace("0.5 to", "up to") if percent else labels[0]
    return [Patch(facecolor=c, label=text) for c, text in zip(colours, labels)], words


def draw_scale(axes, extent):
    width = extent[1] - extent[0]
    length = next(s for s in (2000, 1000, 500, 200, 100, 50) if s < width / 4)
    x, y = extent[0] + 0.04 * width, extent[2] + 0.06 * (extent[3] - extent[2])
    axes.plot([x, x + length], [y, y], color="k", lw=3, solid_capstyle="butt")
    axes.text(x + length / 2, y + 0.015 * (extent[3] - extent[2]), f"{length} m", ha="center", va="bottom", fontsize=8)
    axes.annotate("N", xy=(0.96, 0.97), xytext=(0.96, 0.85), xycoords="axes fraction", ha="center", va="center", fontsize=9,
                  arrowprops={"arrowstyle": "->", "lw": 1.2})


def part_shown(plane, least, extent):
    """The rectangle around what is drawn, with a margin of a third and at least eight cells, inside the ground's."""
    values, west, east, south, north = plane
    rows, columns = np.where(values >= least)
    cell = (east - west) / values.shape[1]
    x = west + cell * np.array([columns.min(), columns.max() + 1])
    y = north - cell * np.array([rows.max() + 1, rows.min()])
    margin = max(max(np.ptp(x), np.ptp(y)) / 3, 8 * cell)
    return (max(x[0] - margin, extent[0]), min(x[1] + 1.6 * margin, extent[1]), max(y[0] - margin, extent[2]), min(y[1] + margin, extent[3]))


def map_picture(file, name, plane, classes, outlines, title):
    heights, affine, projection = ground_of(name)
    rows, columns = heights.shape
    whole = (affine[0], affine[0] + columns * affine[1], affine[3] + rows * affine[5], affine[3])
    extent = part_shown(plane, classes[0][0], whole)
    figure, axes = plt.subplots(figsize=(7.5, min(7.5, 0.9 + 7.3 * (extent[3] - extent[2]) / (extent[1] - extent[0]))), layout="constrained")
    draw_ground(axes, heights, affine)
    handles, words = draw_classes(axes, plane, classes)
    for path, colour, text in outlines:
        for k, ring in enumerate(rings_of(path, projection)):
            handles += axes.plot(ring[:, 0], ring[:, 1], color=colour, lw=1.6, label=text if k == 0 else None)[: k == 0]
    draw_scale(axes, extent)
    axes.set(xlim=extent[:2], ylim=extent[2:], xticks=[], yticks=[])
    axes.set_title(title, fontsize=10, loc="left")
    wide = extent[1] - extent[0] > 2 * (extent[3] - extent[2])
    place = {"loc": "upper center", "bbox_to_anchor": (0.5, -0.02), "ncol": 4} if wide else {"loc": "lower right"}
    axes.legend(handles=handles, title=words, fontsize=7.5, title_fontsize=7.5, framealpha=0.9, **place)
    figure.savefig(IMAGES / file, dpi=130)
    plt.close(figure)


def jacksboro():
    out = results_of("jacksboro", 64)
    source = [(CASES / "jacksboro/source.geojson", "#0072b2", "source (made up)")]
    map_picture("jacksboro_map.png", "jacksboro", layer(out, "probability_of_reach"), REACHED, source,
                "A made-up source on real ground, 64 members")
    plane = layer(out, "pressure_quantile", quantile=nearest(out, "quantile", 0.95))
    map_picture("jacksboro_pressure.png", "jacksboro", plane, PRESSURE, source, "The same: pressure")


def mapped_event():
    out = RUNS / "mapped_event"
    sturz("calibrate", CASES / "mapped_event/scenario.yaml", "-o", out)
    outlines = [(CASES / "mapped_event/source.geojson", "#0072b2", "source"), (CASES / "mapped_event/mapped.geojson", "#009e73", "mapped")]
    map_picture("mapped_event_map.png", "mapped_event", layer(out, "probability_of_reach"), REACHED, outlines,
                "What the prior can reach, and what was mapped")
    posterior(out)


def posterior(out):
    """Histograms of what the outline told, over the priors."""
    with open(out / "posterior.csv") as file:
        heads = [head.strip().strip('"') for head in next(line for line in file if not line.startswith("#")).split(",")]
        rows = np.loadtxt(file, delimiter=",", ndmin=2)
    priors = {"basal.friction_coefficient": (0.25, 0.5, 0.31, "friction"), "release.thickness_m": (4, 10, 6.5, "thickness [m]")}
    figure, axes = plt.subplots(1, 2, figsize=(7.5, 2.6), layout="constrained")
    for ax, (key, (low, high, truth, words)) in zip(axes, priors.items()):
        column = next(k for k, head in enumerate(heads) if head.startswith(key))
        ax.hist(rows[:, column], bins=np.linspace(low, high, 26), density=True, color="#56b4e9", label="after the outline")
        ax.plot([low, low, high, high], [0, 1 / (high - low), 1 / (high - low), 0], color="k", lw=1.2, label="before")
        ax.axvline(truth, color="#d55e00", lw=1.5, ls="--", label="truth")
        ax.set(xlabel=words, yticks=[])
    axes[0].legend(fontsize=7.5, frameon=False)
    figure.savefig(IMAGES / "mapped_event_posterior.png", dpi=130)
    plt.close(figure)


PICTURES = {"jacksboro": jacksboro, "mapped_event": mapped_event}


def main(words):
    if "--list" in words:
        print("\n".join(PICTURES))
        return 0
    if unknown := [word for word in words if word not in PICTURES]:
        print(f"no picture is called {', '.join(unknown)}; there are {', '.join(PICTURES)}\n{__doc__}", file=sys.stderr)
        return 2
    RUNS.mkdir(parents=True, exist_ok=True)
    for name in words or PICTURES:
        PICTURES[name]()
        print(f"{name}: made")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
