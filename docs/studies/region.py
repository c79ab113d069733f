#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Three hundred sources on one mountain: makes the scene, and checks a region's maps by hand.

usage: region.py make DATA OUT [N]     writes OUT/sources.geojson and OUT/scenario.yaml
       region.py check REGION          prints tables in Markdown: the maps against sums over member files

DATA holds marsicano_10m.tif (TINITALY, CC BY 4.0). Sources are octagons of 60 m on cells of 32 to 45 degrees, on a grid
whose distance is chosen so that there are N; volumes grow with slope. Needs numpy, netCDF4 and osgeo.
"""
import csv
import json
import math
import pathlib
import sys

import numpy as np

SCENE = """title: {n} sources on Monte Marsicano
terrain:
  raster: {raster}
release:
  polygon: sources.geojson
  each_feature: true
  feature_key: name
  volume_attribute: volume_m3
grains: {{density_kg_m3: 2650, solid_fraction: 0.6, friction_angle_deg: 34}}
basal:
  friction_coefficient: {{uniform: [0.35, 0.6]}}
  turbulent_coefficient_m_s2: {{uniform: [300, 1200]}}
formulation: depth_averaged
numerics: {{spacing_m: 5}}
ensemble: {{design: sobol, members: 8, seed: 11}}
hazard: {{quantiles: [0.5, 0.95]}}
"""


def slopes(elevation, cell):
    """Degrees; NaN along the edge."""
    south, east = np.gradient(elevation, cell)
    return np.degrees(np.arctan(np.hypot(south, east)))


def points(slope, step, margin):
    """Rows and columns of grid points on steep ground, away from the edge."""
    rows, cols = slope.shape
    return [(r, c) for r in range(margin, rows - margin, step) for c in range(margin, cols - margin, step)
            if 32 <= slope[r, c] <= 45]


def octagon(x, y, width):
    radius = width / 2 / math.cos(math.pi / 8)
    ring = [[round(x + radius * math.cos(math.pi / 8 + k * math.pi / 4), 2),
             round(y + radius * math.sin(math.pi / 8 + k * math.pi / 4), 2)] for k in range(8)]
    return [ring + ring[:1]]


def make(data, out, n):
    from osgeo import gdal
    gdal.UseExceptions()
    raster = pathlib.Path(data, "marsicano_10m.tif").resolve()
    dataset = gdal.Open(str(raster))
    west, cell, _, north, _, _ = dataset.GetGeoTransform()
    slope = slopes(dataset.ReadAsArray().astype(float), cell)
    step = next(s for s in range(40, 2, -1) if len(points(slope, s, 20)) >= n)
    found = points(slope, step, 20)
    found = [found[i * len(found) // n] for i in range(n)]
    features = []
    for k, (r, c) in enumerate(found):
        x, y = west + (c + 0.5) * cell, north - (r + 0.5) * cell
        volume = round(60 * 60 * 0.83 * (2 + 2 * (slope[r, c] - 32) / 13))
        features.append({"type": "Feature",
                         "properties": {"name": f"S{k + 1:03d}", "volume_m3": volume,
                                        "slope_deg": round(float(slope[r, c]), 1)},
                         "geometry": {"type": "Polygon", "coordinates": octagon(x, y, 60)}})
    out = pathlib.Path(out)
    out.mkdir(parents=True, exist_ok=True)
    crs = {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::32633"}}
    (out / "sources.geojson").write_text(json.dumps(
        {"type": "FeatureCollection", "name": "sources", "crs": crs, "features": features}))
    (out / "scenario.yaml").write_text(SCENE.format(n=n, raster=raster))
    print(f"{n} sources, one for {step} x {step} cells of steep ground")


class Region:
    """What the member files of a region say."""

    def __init__(self, folder):
        from netCDF4 import Dataset
        self.folder = pathlib.Path(folder)
        with open(self.folder / "sources.csv") as file:
            self.sources = list(csv.DictReader(file))
        self.maps = Dataset(self.folder / "hazard.nc")
        for name in self.maps.variables:
            self.maps[name].set_auto_mask(False)
        self.x, self.y = self.maps["x"][:], self.maps["y"][:]
        self.cell = float(self.x[1] - self.x[0])

    def members(self, source):
        from netCDF4 import Dataset
        for file in sorted((self.folder / source["folder"] / "members").glob("*.nc")):
            with Dataset(file) as data:
                data.set_auto_mask(False)
                yield data

    def came(self, source):
        """Of each member of a source: where its flow came, on the cells of the maps."""
        for data in self.members(source):
            cells = np.zeros((len(self.y), len(self.x)), bool)
            if "arrival_time" in data.variables:
                arrival = data["arrival_time"][:]
                r = int(round((self.y[0] - data["y"][0]) / self.cell))
                c = int(round((data["x"][0] - self.x[0]) / self.cell))
                cells[r:r + arrival.shape[0], c:c + arrival.shape[1]] = np.isfinite(arrival)
            yield cells

    def listed(self, row, col):
        """Sources and probabilities that hazard.nc gives of a cell."""
        cells = self.maps["reached_cell"][:]
        at = np.searchsorted(cells, row * len(self.x) + col)
        if at == len(cells) or cells[at] != row * len(self.x) + col:
            return {}
        begin = int(self.maps["sources_at_cell"][:at].sum())
        end = begin + int(self.maps["sources_at_cell"][at])
        return {int(s): float(p) for s, p in zip(self.maps["hit_source"][begin:end],
                                                self.maps["hit_probability"][begin:end])}


def three_cells(region):
    """Where most sources come, where one may come, where three to five may."""
    number = region.maps["number_of_sources"][:]
    highest = region.maps["highest_probability_of_a_hit"][:]
    wanted = [np.where(np.isfinite(number), number, -1), np.where((number == 1) & (highest < 1), highest, -1),
              np.where((number >= 3) & (number <= 5) & (highest < 0.7), highest, -1)]
    return [np.unravel_index(int(np.argmax(score)), score.shape) for score in wanted]


def print_cell(region, cell, shares, rows):
    row, col = cell
    listed = region.listed(row, col)
    same = listed.keys() == shares.keys() and all(abs(listed[k] - shares[k]) < 1e-7 for k in shares)
    none = math.prod(1 - p for p in shares.values())
    best = int(region.maps["most_likely_source"][row, col])
    names = {int(s["number"]): s["source"] for s in region.sources}
    some = sorted(shares.items(), key=lambda share: -share[1])
    text = ", ".join(f"{names[k]} {p:.3g}" for k, p in some[:5]) + (", ..." if len(some) > 5 else "")
    any_hit, any_rows = (float(region.maps[f"probability_of_any_hit{end}"][row, col]) for end in ("", "_shared_values"))
    print(f"| {region.x[col]:.0f}, {region.y[row]:.0f} | {len(shares)}: {text} | {'the same' if same else 'OTHERS'} | "
          f"{1 - none:.6f}, {any_hit:.6f} | {len(rows) / int(region.sources[0]['planned']):.4g}, {any_rows:.4g} | "
          f"{names.get(best)}, P {shares.get(best, 0):.3g} of {max(shares.values(), default=0):.3g} |")


def check(folder):
    """Three cells in words, then all cells, from plain sums over member files in the order of the sources."""
    region = Region(folder)
    cells = three_cells(region)
    shares, rows = [{} for _ in cells], [set() for _ in cells]
    shape = (len(region.y), len(region.x))
    none, expected, highest, number = np.ones(shape), np.zeros(shape), np.zeros(shape), np.zeros(shape)
    for source in region.sources:
        hits = np.zeros(shape)
        for k, came in enumerate(region.came(source)):
            hits += came
            for cell, hit_rows in zip(cells, rows):
                if came[cell]:
                    hit_rows.add(k)
        p = hits / max(int(source["valid"]), 1)
        none *= 1 - p
        expected += p
        highest = np.maximum(highest, p)
        number += p > 0
        for cell, share in zip(cells, shares):
            if p[cell] > 0:
                share[int(source["number"])] = float(p[cell])
    print("| cell: x, y | sources by hand: P | list in hazard.nc | any hit by hand, in hazard.nc | the same with one "
          "table of values | likeliest in hazard.nc: its P, of the largest |")
    print("|---|---|---|---|---|---|")
    for cell, share, hit_rows in zip(cells, shares, rows):
        print_cell(region, cell, share, hit_rows)
    print("\n| map | cells that some source reaches | largest difference from member files |")
    print("|---|---|---|")
    for name, values in (("highest_probability_of_a_hit", highest), ("probability_of_any_hit", 1 - none),
                         ("expected_number_of_sources", expected), ("number_of_sources", number)):
        stored = np.nan_to_num(region.maps[name][:])
        print(f"| `{name}` | {int((number > 0).sum()):,} | {np.abs(stored - values).max():.2g} |")


if __name__ == "__main__":
    command = sys.argv[1] if len(sys.argv) > 2 else ""
    if command == "make":
        make(sys.argv[2], sys.argv[3], int(sys.argv[4]) if len(sys.argv) > 4 else 300)
    elif command == "check":
        check(sys.argv[2])
    else:
        sys.exit(__doc__)
