#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Three hundred sources on one mountain: makes the scene, and checks a region's maps by hand.

usage: region.py make DATA OUT [N]     writes OUT/sources.geojson and OUT/scenario.yaml
       region.py check REGION          prints tables in Markdown, from member files alone
       region.py naive REGION          every cell of the maps against member files

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

    def hits(self, data, row, col):
        """Whether a member's flow came to a cell of the maps."""
        if "arrival_time" not in data.variables:
            return False
        x, y = data["x"][:], data["y"][:]
        c = int(round((self.x[col] - x[0]) / self.cell))
        r = int(round((y[0] - self.y[row]) / self.cell))
        return bool(0 <= r < len(y) and 0 <= c < len(x) and np.isfinite(data["arrival_time"][r, c]))

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


def check(folder):
    """Three cells: where most sources come, where one is likely, where a few may come."""
    region = Region(folder)
    number = region.maps["number_of_sources"][:]
    highest = region.maps["highest_probability_of_a_hit"][:]
    wanted = [np.where(np.isfinite(number), number, -1),
              np.where((number == 1) & (highest < 1), highest, -1),
              np.where((number >= 3) & (number <= 5) & (highest < 0.7), highest, -1)]
    print("| cell: x, y | sources by hand: P | in hazard.nc | any hit by hand, in hazard.nc | same values, in hazard.nc | likeliest |")
    print("|---|---|---|---|---|---|")
    for score in wanted:
        row, col = np.unravel_index(int(np.argmax(score)), score.shape)
        shares, rows = {}, set()
        for source in region.sources:
            came = [k for k, data in enumerate(region.members(source)) if region.hits(data, row, col)]
            rows.update(came)
            if came:
                shares[int(source["number"])] = len(came) / int(source["valid"])
        listed = region.listed(row, col)
        same = listed.keys() == shares.keys() and all(abs(listed[k] - shares[k]) < 1e-7 for k in shares)
        none = math.prod(1 - p for p in shares.values())
        n_rows = int(region.sources[0]["planned"])
        best = int(region.maps["most_likely_source"][row, col])
        at = lambda name: float(region.maps[name][row, col])
        names = {int(s["number"]): s["source"] for s in region.sources}
        some = sorted(shares.items(), key=lambda s: -s[1])
        text = ", ".join(f"{names[k]} {p:.3g}" for k, p in some[:5])
        print(f"| {region.x[col]:.0f}, {region.y[row]:.0f} | {len(shares)}: {text}{', ...' if len(some) > 5 else ''} | "
              f"{'the same' if same else 'OTHERS'} | {1 - none:.6f}, {at('probability_of_any_hit'):.6f} | "
              f"{len(rows) / n_rows:.4g}, {at('probability_of_any_hit_shared_values'):.4g} | "
              f"{names[best]}, P {shares[best]:.3g} (largest {max(shares.values()):.3g}) |")


def naive(folder):
    """All cells, with plain sums in the order of the sources."""
    region = Region(folder)
    shape = (len(region.y), len(region.x))
    none, expected, highest, number = np.ones(shape), np.zeros(shape), np.zeros(shape), np.zeros(shape)
    for source in region.sources:
        hits = np.zeros(shape)
        for data in region.members(source):
            if "arrival_time" not in data.variables:
                continue
            r = int(round((region.y[0] - data["y"][0]) / region.cell))
            c = int(round((data["x"][0] - region.x[0]) / region.cell))
            arrival = data["arrival_time"][:]
            hits[r:r + arrival.shape[0], c:c + arrival.shape[1]] += np.isfinite(arrival)
        p = hits / max(int(source["valid"]), 1)
        none *= 1 - p
        expected += p
        highest = np.maximum(highest, p)
        number += p > 0
    print("| map | cells that some source reaches | largest difference from member files |")
    print("|---|---|---|")
    for name, values in (("highest_probability_of_a_hit", highest), ("probability_of_any_hit", 1 - none),
                         ("expected_number_of_sources", expected), ("number_of_sources", number)):
        stored = np.nan_to_num(region.maps[name][:])
        print(f"| `{name}` | {int((number > 0).sum()):,} | {np.abs(stored - values).max():.2g} |")


if __name__ == "__main__":
    command = sys.argv[1] if len(sys.argv) > 2 else ""
    if command == "make":
        make(sys.argv[2], sys.argv[3], int(sys.argv[4]) if len(sys.argv) > 4 else 300)
    elif command in ("check", "naive"):
        {"check": check, "naive": naive}[command](sys.argv[2])
    else:
        sys.exit(__doc__)
