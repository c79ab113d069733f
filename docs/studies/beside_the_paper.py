# SPDX-License-Identifier: Apache-2.0
"""The Zhangjiawan-like slide beside the paper's figures, all lengths from the crown, with the error of resolution.

usage: beside_the_paper.py STURZ OUT [--fine]   (needs python3-numpy, python3-netcdf4, python3-gdal; --fine adds 2.6 m: five minutes of CPU more)
OUT takes the runs. The ground is drawn from published heights and lengths, not measured: a comparison of sizes, not a validation.
Gao et al. (2024) figures are those of their text, figures 7-9 and table 6. Every figure of full stress is that of its finest run; what
stands behind +- is its change from the run before, which has 2 to 3 times fewer particles.
"""
import csv
import pathlib
import sys

import numpy as np
from netCDF4 import Dataset
from osgeo import gdal
from runs import run as scalars_of

gdal.UseExceptions()
EAST, NORTH = 500000, 2900000  # of the crown
TIMES = (5, 10, 20, 30)  # [s]
PROBES = (190, 340, 685)       # along the section, from the crown [m]
BEHIND_HILL = ((400, 485), (-60, 60))  # the hollow upslope of the small hill, along and across [m]
SCENE = """
title: Zhangjiawan-like, the paper's values
terrain: {synthetic: {zhangjiawan: {cell_size_m: 5}}}
release: {volume_m3: 491000}
grains: {density_kg_m3: 2400, diameter_m: 3, solid_fraction: 0.70, friction_angle_deg: 24, cohesion_pa: 5000%s}
basal: {friction_coefficient: %s}
formulation: %s
numerics: {spacing_m: %s, accept_unresolved: true}
hazard: {cell_size_m: 5}
gauges: {interval_s: 0.5, points: [%s]}
"""
STATES = ", states: {dilute: {}, ultradilute: {contacts: hertz_mindlin}}"


def raster(path, name):
    data = gdal.Open(f'NETCDF:"{path}":{name}')
    west, cell, _, north, _, _ = data.GetGeoTransform()
    z = np.where((z := data.ReadAsArray().astype(float)) > 1e30, 0, z)
    rows, columns = z.shape
    s = west + cell * (np.arange(columns) + 0.5) - EAST
    n = north - cell * (np.arange(rows) + 0.5) - NORTH
    return np.nan_to_num(z), s, n


def probes(path):
    """Largest speed at each gauge and when it came, from gauge_series.csv."""
    found = {}
    with open(path, newline="", encoding="utf-8") as file:
        for row in csv.DictReader(line for line in file if not line.startswith("#")):
            if row["quantity"] != "speed" or not row["value"]:
                continue
            speed = float(row["value"])
            if speed > found.get(row["gauge"], (0, 0))[0]:
                found[row["gauge"]] = (speed, float(row["time_s"]))
    return found


def run(sturz, folder, formulation, spacing, friction, states=""):
    points = ", ".join(f"{{name: p{s}, at_m: [{EAST + s}, {NORTH}]}}" for s in PROBES)
    s = scalars_of(sturz, folder, SCENE % (states, friction, formulation, spacing, points))
    deposit, along, across = raster(folder / "out/peaks.nc", "deposit_thickness")
    reached, _, _ = raster(folder / "out/peaks.nc", "peak_thickness")
    (west, east), (south, north) = BEHIND_HILL
    hollow = deposit[np.ix_((across > south) & (across < north), (along > west) & (along < east))]
    mass = deposit.sum()
    s["front_m"] = float(along[(deposit > 0.5).any(axis=0)].max())
    s["reached_m"] = float(along[(reached > 0.05).any(axis=0)].max())
    s["centre_m"] = float((deposit.sum(axis=0) * along).sum() / mass)
    s["behind_hill_m"] = float(hollow.max())
    s["mean_m"] = float(mass / (deposit > 0.5).sum())
    with Dataset(folder / "out/peaks.nc") as file:
        s["tail_speed"], s["tail_travel"] = (float(np.max(file[f"tail_{what}"][:])) for what in ("speed", "travel"))
        s["front_speeds"] = [float(np.interp(t, file["time"][:], file["front_speed"][:])) for t in TIMES]
    s["probes"] = probes(folder / "out/gauge_series.csv")
    return s


FIGURES = [("front of the deposit over 0.5 m", "front_m", 0), ("farthest reached", "reached_m", 0),
           ("centre of mass of the deposit", "centre_m", 0), ("fastest grain m/s", "max_speed_m_s", 1),
           ("mean speed at most m/s", "max_mean_speed_m_s", 1), ("thickest m", "max_deposit_m", 1),
           ("thickest behind the hill m", "behind_hill_m", 1), ("mean thickness m", "mean_m", 1),
           ("way of the centre of mass", "com_travel_m", 0), ("tail, what 95 % of the mass have passed: speed at most m/s", "tail_speed", 1),
           ("way of the tail", "tail_travel", 0)]
PAPER = {"front_m": "830 (840 seen)", "reached_m": "", "centre_m": "", "max_speed_m_s": "21 in the text, 44 in table 6 (31.6 seismic)",
         "max_mean_speed_m_s": "12", "max_deposit_m": "12.7 / 12.5", "behind_hill_m": "12.7", "mean_m": "4 (seen, with the bed's material)", "com_travel_m": "",
         "tail_speed": "7", "tail_travel": "230"}


def shown(runs, key, digits):
    """Value of the finest run, with its change from the one before."""
    value = runs[-1][key]
    change = f" ± {abs(value - runs[-2][key]):,.{digits}f}" if len(runs) > 1 else ""
    return f"{value:,.{digits}f}{change}"


def main(sturz, out, *flags):
    out = pathlib.Path(out)
    fine = [2.6] if "--fine" in flags else []
    series = [(f"columns, {mu}", "depth_averaged", (8, 4, 2.5), mu, "") for mu in (0.24, 0.30)]
    series += [(f"full stress, {mu}", "full_stress", [10.5, 6, 4.2, *fine], mu, "") for mu in (0.24, 0.30)]
    series += [("full stress with states, 0.24", "full_stress", (6, 4.2), 0.24, STATES)]
    results = {}
    for name, formulation, spacings, friction, states in series:
        folder = name.replace(" ", "_").replace(",", "")
        results[name] = [run(sturz, out / folder / f"{dx}", formulation, dx, friction, states) for dx in spacings]
        last = results[name][-1]
        print(f"{name}: {last['n_particles']:.0f} particles, spacing {spacings[-1]} m, {last['cpu_s']:.1f} s of CPU,"
              f" {last['n_steps']:.0f} steps", flush=True)
    names = list(results)
    print("\n| from the crown, m | paper | " + " | ".join(names) + " |\n|" + "---|" * (len(names) + 2))
    for title, key, digits in FIGURES:
        print(f"| {title} | {PAPER[key]} | " + " | ".join(shown(results[n], key, digits) for n in names) + " |")
    for s in PROBES:
        cells = ["{:.0f} m/s at {:.0f} s".format(*results[n][-1]["probes"][f"p{s}"]) if f"p{s}" in results[n][-1]["probes"] else "not reached"
                 for n in names]
        print(f"| fastest at {s} m | | " + " | ".join(cells) + " |")
    print(f"| front, m/s, after {', '.join(map(str, TIMES))} s | | " + " | ".join(", ".join(f"{v:.0f}" for v in results[n][-1]["front_speeds"]) for n in names) + " |")
    for title, key in (("transition, mass x time", "transition_fraction"), ("dilute", "dilute_fraction"), ("ultradilute", "ultradilute_fraction")):
        cells = [f"{100 * results[n][-1][key]:.1f} %" if "states" in n else "" for n in names]
        print(f"| {title} | {'seldom; none ultradilute' if key[0] == 'u' else ''} | " + " | ".join(cells) + " |")
    cells = [f"{results[n][-1]['max_granular_temperature_m2_s2']:.0f}" if "states" in n else "" for n in names]
    print("| granular temperature at most m²/s² | | " + " | ".join(cells) + " |")
    print("| processor seconds | 288 core-hours, 51,897 particles | " + " | ".join(f"{results[n][-1]['cpu_s']:,.1f}" for n in names) + " |")


if __name__ == "__main__":
    main(*sys.argv[1:])
