# SPDX-License-Identifier: Apache-2.0
"""The debris-flow flume (T11, V23): fronts and stops beside the measured ones, and the band of an ensemble.

usage: usgs_flume.py STURZ CASE OUT [MEMBERS]   (needs python3-numpy, python3-netcdf4; 5 min of CPU with 64 members)
CASE is scenarios/cases/usgs_flume/scenario.yaml, OUT takes the runs. Lengths s run along the bed, from the gate.
Single runs: the front is the farthest column, read from frames every 0.05 s. Members: the first cell of 0.5 m that is
5 cm deep or more. Prints two tables.
"""
import math
import pathlib
import subprocess
import sys

import numpy as np
from frames import frame as read
from netCDF4 import Dataset

CHUTE, PAD, STRAIGHT, RADIUS = math.radians(31), math.radians(2.5), 78.0, 10.0
GAUGES = (32, 53, 66)
# Inputs of the runs that George and Iverson (2014) show, and those of setrun.py in their repository.
THEIRS = {"mixture.permeability_m2": "5e-9", "mixture.permeability_fraction": "0.61",
          "basal.friction_coefficient": f"{math.tan(math.radians(40.7)):.5f}"}
SETRUN = {"mixture.permeability_m2": "1e-10", "mixture.permeability_fraction": "0.60",
          "basal.friction_coefficient": f"{math.tan(math.radians(40)):.5f}"}
MEASURED = {"mixture.permeability_m2": "1e-11", "mixture.permeability_fraction": "0.61",
            "basal.friction_coefficient": f"{math.tan(math.radians(40.7)):.5f}"}
AT_ONCE = {"domain": "null"}
RESOLVED = {"mixture.pressure_profile": "resolved"}


def newer_offset(depth, m=0.61, solid=2700, fluid=1100, a=0.05):
    """Later versions of the program take this for stress_offset, from the thickness of the place [Pa]."""
    rho = m * solid + (1 - m) * fluid
    return {"mixture.stress_offset_pa": f"{a * fluid * (solid - fluid) * 9.81 * math.cos(CHUTE) * depth / (2 * rho):.1f}"}


ROWS = [
    ("their runs: k 5e-9 m2 at 0.61, 40.7 degrees", 0.61, THEIRS),
    ("the same, mass free at once", 0.61, {**THEIRS, **AT_ONCE}),
    ("the same, free at once, 0.2 m", 0.61, {**THEIRS, **AT_ONCE, "numerics.spacing_m": "0.2"}),
    ("the same, free at once, 0.07 m", 0.61, {**THEIRS, **AT_ONCE, "numerics.spacing_m": "0.07"}),
    ("their runs", 0.64, THEIRS),
    ("their runs", 0.66, THEIRS),
    ("`setrun.py`: k 1e-10 m2 at 0.60, 40 degrees", 0.61, SETRUN),
    ("`setrun.py`", 0.66, SETRUN),
    ("measured k: 1e-11 m2, 40.7 degrees", 0.61, MEASURED),
    ("measured k", 0.66, MEASURED),
    ("their runs, newer stress offset at 0.15 m", 0.61, {**THEIRS, **newer_offset(0.15)}),
    ("their runs, newer stress offset at 0.15 m", 0.66, {**THEIRS, **newer_offset(0.15)}),
    ("`setrun.py`, newer stress offset at 0.15 m", 0.61, {**SETRUN, **newer_offset(0.15)}),
    ("their runs, newer stress offset at 1 m", 0.61, {**THEIRS, **newer_offset(1)}),
    ("their runs, profile resolved", 0.61, {**THEIRS, **RESOLVED}),
    ("the same, 0.2 m", 0.61, {**THEIRS, **RESOLVED, "numerics.spacing_m": "0.2"}),
    ("the same, 0.07 m", 0.61, {**THEIRS, **RESOLVED, "numerics.spacing_m": "0.07"}),
    ("their runs, profile resolved", 0.64, {**THEIRS, **RESOLVED}),
    ("their runs, profile resolved", 0.66, {**THEIRS, **RESOLVED}),
    ("the same, 5 nodes", 0.66, {**THEIRS, **RESOLVED, "mixture.pressure_nodes": "5"}),
    ("the same, 10 nodes", 0.66, {**THEIRS, **RESOLVED, "mixture.pressure_nodes": "10"}),
    ("the same, 8 nodes, 0.2 m", 0.66, {**THEIRS, **RESOLVED, "numerics.spacing_m": "0.2"}),
    ("the same, 8 nodes, 0.07 m", 0.66, {**THEIRS, **RESOLVED, "numerics.spacing_m": "0.07"}),
    ("`setrun.py`, profile resolved", 0.61, {**SETRUN, **RESOLVED}),
    ("`setrun.py`, profile resolved", 0.66, {**SETRUN, **RESOLVED}),
]


def along_bed(x):
    """Length along the bed of map positions."""
    x = np.asarray(x, float)
    arc_x = STRAIGHT * math.cos(CHUTE)
    centre, pad_x = arc_x + RADIUS * math.sin(CHUTE), arc_x + RADIUS * (math.sin(CHUTE) - math.sin(PAD))
    on_arc = STRAIGHT + RADIUS * (CHUTE - np.arcsin(np.clip((centre - x) / RADIUS, -1, 1)))
    on_pad = STRAIGHT + RADIUS * (CHUTE - PAD) + (x - pad_x) / math.cos(PAD)
    return np.where(x <= arc_x, x / math.cos(CHUTE), np.where(x < pad_x, on_arc, on_pad))


def frame(path):
    """Time, map x and mass of the columns of a ParaView frame."""
    time, (points, mass) = read(path, ("Points", "mass"))
    return time, points[:, 0], mass


def settings(values):
    return [word for key, value in values.items() for word in ("--set", f"{key}={value}")]


def single(sturz, case, folder, m, values):
    values = {"grains.solid_fraction": m, "mixture.fluid_viscosity_pa_s": 0.005, **values}
    subprocess.run([sturz, "run", case, "-o", folder, "--replace", "--threads", "1", "--particles", "0.05",
                    *settings(values)], check=True, capture_output=True)
    frames = sorted((frame(path) for path in (folder / "particles").glob("*.vtp")), key=lambda f: f[0])
    times = np.array([f[0] for f in frames])
    fronts = np.maximum.accumulate([along_bed(f[1]).max() for f in frames])
    passes = [float(np.interp(s, fronts, times)) if fronts[-1] >= s else math.inf for s in GAUGES]
    s = along_bed(frames[-1][1])
    order = np.argsort(s)
    share = np.cumsum(frames[-1][2][order]) / frames[-1][2].sum()
    most = float(s[order][np.searchsorted(share, 0.98)])
    released = frames[0][2].sum()
    return passes, float(fronts[-1]), most, 1 - frames[-1][2].sum() / released


def ensemble(sturz, case, folder, members):
    subprocess.run([sturz, "ensemble", case, "-o", folder, "-n", str(members), "--workers", "1", "--set",
                    "numerics.spacing_m=0.2"], check=True, capture_output=True)
    passes = []
    for path in sorted((folder / "members").glob("*.nc")):
        with Dataset(path) as file:
            first = np.nanmin(np.ma.filled(file["arrival_time"][:], np.nan), axis=0, initial=np.inf)
            where = along_bed(file["x"][:])
        passes.append([float(np.min(first[where >= s], initial=np.inf)) for s in GAUGES])
    return np.array(passes)


def shown(value, digits=2):
    return "-" if math.isinf(value) else f"{value:.{digits}f}"


def main(sturz, case, out, members="64"):
    out = pathlib.Path(out)
    print("| inputs | m0 | 32 m s | 53 m s | 66 m s | stop m | 98 % of the mass to m | left the pad |")
    print("|---|---|---|---|---|---|---|---|")
    print("| measured; D-Claw | 0.61 | 3.2-4.0 | 5.3 | 6.6-7.0 | 112 | | |")
    for number, (name, m, values) in enumerate(ROWS):
        passes, stop, most, gone = single(sturz, case, out / f"row{number}", m, values)
        print(f"| {name} | {m} | {' | '.join(shown(p) for p in passes)} | {stop:.1f} | {most:.1f} |"
              f" {'' if gone < 1e-9 else f'{100 * gone:.0f} %'} |", flush=True)
    if int(members) < 1:
        return
    passes = ensemble(sturz, case, out / "ensemble", int(members))
    print(f"\n{len(passes)} members\n\n| front at | 5 % | 25 % | median | 75 % | 95 % | never | measured |")
    print("|---|---|---|---|---|---|---|---|")
    for k, (s, seen) in enumerate(zip(GAUGES, ("3.2-4.0", "5.3", "6.6-7.0"))):
        quantiles = [np.quantile(passes[:, k], q, method="lower") for q in (0.05, 0.25, 0.5, 0.75, 0.95)]
        print(f"| {s} m | {' | '.join(shown(float(q)) for q in quantiles)} | {np.isinf(passes[:, k]).sum()} | {seen} |")


if __name__ == "__main__":
    main(*sys.argv[1:])
