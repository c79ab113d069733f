# SPDX-License-Identifier: Apache-2.0
"""Twelve houses below a slope, by the year, and what a dam changes. Every number is worked out a second time from the member files.

usage: risk_by_year.py STURZ DATA_FOLDER OUT_FOLDER [MEMBERS]
DATA_FOLDER is ../shared/data (Monte Marsicano, TINITALY, cells of 10 m). Houses and dam are made up. Two releases, one in 100 and one
in 1000 years; needs python3-netcdf4 and python3-gdal. Prints tables; leaves houses.geojson, both ensembles, years/ and dam/ in OUT_FOLDER.
"""
import csv
import json
import math
import pathlib
import subprocess
import sys

import netCDF4
import numpy as np
from osgeo import ogr

FREQUENCY = {"small": 0.01, "large": 0.001}
# Name, class, middle (UTM 33N), worth in thousand CHF; the last one stands beyond the terrain.
HOUSES = (("upper hut", "timber", 405840, 4627580, 150), ("ridge hut", "timber", 406120, 4627580, 120), ("saw mill", "timber", 406030, 4627180, 400),
          ("chapel", "stone", 406080, 4626980, 600), ("mill", "stone", 406060, 4626880, 500), ("farm", "stone", 406150, 4626580, 900),
          ("barn", "timber", 406020, 4626560, 80), ("school", "stone", 406060, 4626180, 2500), ("inn", "stone", 405960, 4626060, 1800),
          ("house 10", "stone", 406180, 4625980, 700), ("house 11", "stone", 406140, 4625760, 700), ("beyond", "stone", 406140, 4625400, 700))
CURVES = "timber: {pressure_kpa: [[3, 0], [30, 1]]}\nstone: {pressure_kpa: [[10, 0], [30, 0.4], [150, 1]]}\n"
SCENE = """
title: Slope above twelve houses, {name} release
terrain: {{raster: {data}/marsicano_10m.tif{dam}}}
release: {{polygon: {data}/release_250m.geojson, thickness_m: {thickness}}}
grains: {{density_kg_m3: 2600, solid_fraction: 0.6, friction_angle_deg: 32}}
basal:
  friction_coefficient: {{uniform: [0.40, 0.70]}}
  pore_pressure_ratio: {{uniform: [0.0, 0.3]}}
numerics: {{spacing_m: 10}}
ensemble: {{design: sobol, members: {members}, seed: 11}}
hazard: {{thickness_m: [0.5, 1, 2]}}
assets: {{features: {out}/houses.geojson, name_attribute: id, class_attribute: type, vulnerability: {out}/curves.yaml, value_attribute: worth, value_unit: kCHF}}
"""
DAM = ", dams: [{points_m: [[405960, 4626480], [406180, 4626330]], height_m: 12, crest_width_m: 4, side_slope: 1.5}]"
HIT = 1e-12


def sturz(program, *words):
    done = subprocess.run([program, *map(str, words)], capture_output=True, text=True, check=False)
    if done.returncode not in (0, 3):
        sys.exit(f"{' '.join(map(str, words))}\n{done.stdout[-2000:]}{done.stderr[-2000:]}")
    return done.stdout + done.stderr


def houses_file(out):
    features = []
    for name, kind, x, y, worth in HOUSES:
        ring = [[x - 6, y - 9], [x + 6, y - 9], [x + 6, y + 9], [x - 6, y + 9], [x - 6, y - 9]]
        features.append({"type": "Feature", "properties": {"id": name, "type": kind, "worth": worth}, "geometry": {"type": "Polygon", "coordinates": [ring]}})
    layer = {"type": "FeatureCollection", "name": "houses", "crs": {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::32633"}}, "features": features}
    (out / "houses.geojson").write_text(json.dumps(layer))
    (out / "curves.yaml").write_text(CURVES)


def peaks(folder):
    """Reached, peak thickness, speed and pressure of each member on the whole grid, as arrays [member, row, column]."""
    layers = {"arrival_time": [], "peak_thickness": [], "peak_speed": [], "peak_pressure": []}
    for file in sorted((folder / "members").glob("*.nc")):
        with netCDF4.Dataset(file) as data:
            r, c, n, m = data.window_row0, data.window_col0, data.window_n_rows, data.window_n_cols
            for name, planes in layers.items():
                whole = np.full((data.grid_n_rows, data.grid_n_cols), np.nan)
                whole[r:r + n, c:c + m] = data[name][:].filled(np.nan)
                planes.append(whole)
            grid = (data.grid_west_m, data.grid_north_m, data.grid_cell_m)
    planes = {name: np.array(p) for name, p in layers.items()}
    reached = np.isfinite(planes["arrival_time"])
    return grid, reached, *(np.where(reached, planes[k], 0) for k in ("peak_thickness", "peak_speed", "peak_pressure"))


def cells_of(x, y, grid):
    """Rows and columns of the cells that a house of 12 m by 18 m covers some area of."""
    west, north, cell = grid
    columns = range(math.floor((x - 6 - west) / cell), math.ceil((x + 6 - west) / cell))
    rows = range(math.floor((north - y - 9) / cell), math.ceil((north - y + 9) / cell))
    return [(r, c) for r in rows for c in columns]


def house_by_hand(cells, reached, pressure, kind):
    """Share of members that hit, and mean damage, from the members' own maps."""
    rows, columns = zip(*cells)
    hit = reached[:, rows, columns].any(axis=1)
    largest = pressure[:, rows, columns].max(axis=1) / 1000
    curve = ([3, 30], [0, 1]) if kind == "timber" else ([10, 30, 150], [0, 0.4, 1])
    return hit.mean(), np.where(hit, np.interp(largest, *curve, left=0), 0).mean()


def houses(out, sets):
    worst, by_year = 0.0, {}
    print("| house | P(hit) small | P(hit) large | large, 95 % | pressure q95 kPa | expected damage | loss a year kCHF | once in 300 years m |\n|---|---|---|---|---|---|---|---|")
    tables = {k: {r["name"]: r for r in csv.DictReader((out / k / "assets.csv").open(encoding="utf-8"))} for k in sets}
    years = {r["name"]: r for r in csv.DictReader((out / "years" / "assets_by_year.csv").open(encoding="utf-8"))}
    for name, kind, x, y, worth in HOUSES:
        rows = {k: tables[k][name] for k in sets}
        large, year = rows["large"], years[name]
        if large["place"] == "inside":
            loss = 0.0
            for k, (grid, reached, _, _, pressure) in sets.items():
                share, damage = house_by_hand(cells_of(x, y, grid), reached, pressure, kind)
                loss += FREQUENCY[k] * damage * worth
                worst = max(worst, abs(share - float(rows[k]["probability"])), abs(damage - float(rows[k]["expected_damage"])))
            by_year[name] = abs(loss - float(year["expected_loss_kCHF_per_year"]))
        shown = [rows["small"]["probability"], large["probability"], f"{large['probability_lower_95'][:5]} to {large['probability_upper_95'][:5]}",
                 large["pressure_q95_kpa"], large["expected_damage"], year["expected_loss_kCHF_per_year"], year["thickness_300_years_m"]]
        print(f"| {name}, {kind}, {large['place']} | " + " | ".join(s if " to " in s else s[:6] for s in shown) + " |")
    print(f"\nlargest difference from the hand's: P and damage {worst:.1e}, loss a year {max(by_year.values()):.1e} kCHF")


def return_level(levels, rates, period):
    """Largest value v with rate(X >= v) >= 1/period; 0 where there is none."""
    order = np.argsort(-levels)
    enough = np.cumsum(rates[order]) >= 1 / period - HIT
    return levels[order][np.argmax(enough)] if enough.any() else 0.0


def cell_by_hand(sets, r, c):
    """Level of 300 years, intensity and matrix field of one cell."""
    thick, rates, reached_rate, strong_rate = [], [], 0.0, 0.0
    for k, (_, reached, thickness, speed, _) in sets.items():
        each = FREQUENCY[k] / len(reached)
        hit, strong = reached[:, r, c], (thickness[:, r, c] > 1) & (speed[:, r, c] > 1)
        thick += list(thickness[hit, r, c])
        rates += [each] * int(hit.sum())
        reached_rate += each * hit.sum()
        strong_rate += each * (hit & strong).sum()
    level = return_level(np.array(thick), np.array(rates), 300) if thick else 0.0
    classes = []
    for probability, period in ((3, 30), (2, 100), (1, 300)):
        intensity = 3 if strong_rate >= 1 / period - HIT else 2 if reached_rate >= 1 / period - HIT else 0
        classes.append(3 * (intensity - 1) + probability if intensity else 0)
    return level, reached_rate, strong_rate, max(classes)


def years(out, sets):
    with netCDF4.Dataset(out / "years" / "risk.nc") as data:
        level = data["thickness_return_level"][list(data["return_period"][:]).index(300)].filled(0)
        field = data["highest_matrix_field"][:].filled(0)
        rate = data["annual_rate"][:].filled(0)
        west, north = float(data["x"][0]), float(data["y"][0])
    grid = sets["large"][0]
    row0, column0 = round((grid[1] - north) / grid[2] - 0.5), round((west - grid[0]) / grid[2] - 0.5)
    differ, largest = 0, 0.0
    for r in range(field.shape[0]):
        for c in range(field.shape[1]):
            by_hand = cell_by_hand(sets, r + row0, c + column0)
            differ += by_hand[3] != field[r, c]
            largest = max(largest, abs(by_hand[0] - level[r, c]), abs(by_hand[1] - rate[r, c]))
    print("\n| cell, row and column | rate reached a year | rate strong a year | level of 300 years m | highest field by hand | in risk.nc |\n|---|---|---|---|---|---|")
    for value in np.unique(field[field > 0]):
        cells = np.argwhere(field == value)
        r, c = cells[len(cells) // 2]
        by_hand = cell_by_hand(sets, r + row0, c + column0)
        print(f"| {r}, {c} | {by_hand[1]:.5f} | {by_hand[2]:.5f} | {by_hand[0]:.2f} | {by_hand[3]} | {int(value)} |")
    print(f"\nof {field.size} cells {differ} differ in their field; largest difference of level and rate {largest:.1e}")


def dam(program, out):
    told = sturz(program, "compare", out / "large", out / "with_dam", "-o", out / "dam")
    print("\n" + "\n".join(line for line in told.splitlines() if line and "warning" not in line))
    print("\n| house | P without | P with the dam | difference, 95 % of pairs | 95 % without pairs | loss kCHF |\n|---|---|---|---|---|---|")
    for row in csv.DictReader((out / "dam" / "asset_differences.csv").open(encoding="utf-8")):
        if row["place"] == "inside":
            value = {k: f"{float(v):.3f}" for k, v in row.items() if v and ("differ" in k or "prob" in k)}
            print(f"| {row['name']} | {value['probability_a']} | {value['probability_b']} | {value['difference_paired_lower_95']} to {value['difference_paired_upper_95']} | "
                  f"{value['difference_unpaired_lower_95']} to {value['difference_unpaired_upper_95']} | {value['loss_difference_kCHF']} |")



def main(program, data, out, members="200"):
    out = pathlib.Path(out).resolve()
    out.mkdir(parents=True, exist_ok=True)
    data = (pathlib.Path(data) / "marsicano_tinitaly").resolve()
    houses_file(out)
    for name, thickness, wall in (("small", 4, ""), ("large", 12, ""), ("with_dam", 12, DAM)):
        (out / f"{name}.yaml").write_text(SCENE.format(name=name, data=data, dam=wall, thickness=thickness, members=members, out=out))
        sturz(program, "ensemble", out / f"{name}.yaml", "-o", out / name)
    scenarios = "\n".join(f"  - {{folder: {k}, frequency_per_year: {f}}}" for k, f in FREQUENCY.items())
    (out / "risk.yaml").write_text(f"scenarios:\n{scenarios}\n")
    print(sturz(program, "risk", out / "risk.yaml", "-o", out / "years"))
    sets = {k: peaks(out / k) for k in FREQUENCY}
    houses(out, sets)
    years(out, sets)
    dam(program, out)
    data_set = ogr.Open(str(out / "large" / "assets.gpkg"))  # lives as long as its layer is read
    layer = data_set.GetLayer(0)
    print(f"\nassets.gpkg: {layer.GetFeatureCount()} features, {layer.GetLayerDefn().GetFieldCount()} fields, {layer.GetSpatialRef().GetName()}")


if __name__ == "__main__":
    main(*sys.argv[1:])
