# SPDX-License-Identifier: Apache-2.0
"""The debris-flow flume in three dimensions (V23) and its mobilisation (V24), beside columns and what was published.

usage: usgs_flume_3d.py STURZ CASE OUT [--only TEXT]   (needs python3-numpy, python3-netcdf4; an hour of CPU)
CASE is the folder scenarios/cases/usgs_flume, OUT takes the runs; a run that is there is not made again. --only makes just the runs
whose name has TEXT in it; the tables have what is there. Lengths s run along the bed, from the gate. Front: the farthest grain or
column, from frames every 0.1 s. Thickness: volume of grains and liquid in a metre of the bed. Prints two tables.
"""
import json
import math
import pathlib
import subprocess
import sys

import numpy as np
from frames import frame, frames
from usgs_flume import GAUGES, RESOLVED, THEIRS, along_bed, settings, shown

SOLID, LIQUID = 2700, 1100                              # densities of V23 [kg/m3]
COLUMNS = {"grains.solid_fraction": "0.61", "mixture.fluid_viscosity_pa_s": "0.005"}


def slice_of(spacing, across):
    """The slice at another spacing, so many particles wide, and its share of the 10 m3."""
    width = spacing * across
    return {"numerics.spacing_m": f"{spacing:g}", "terrain.synthetic.debris_flume.pad_width_m": f"{width:g}",
            "terrain.synthetic.debris_flume.cell_size_m": f"{spacing:g}", "release.volume_m3": f"{5 * width:g}",
            "terrain.synthetic.debris_flume.volume_m3": f"{5 * width:g}"}


NO_DILATANCY = {"coupling.critical_solid_fraction": "null", "coupling.dilatancy_slope": "null"}
FLUME = [  # name, file, m0, settings
    ("columns, parabola", "scenario", 0.61, {**THEIRS, **COLUMNS}),
    ("columns, profile resolved", "scenario", 0.61, {**THEIRS, **COLUMNS, **RESOLVED}),
    ("columns, profile resolved", "scenario", 0.66, {**THEIRS, **COLUMNS, **RESOLVED, "grains.solid_fraction": "0.66"}),
    ("3-D, 0.125 m", "full_stress", 0.61, slice_of(0.125, 4)),
    ("3-D, 0.1 m", "full_stress", 0.61, {}),
    ("3-D, 0.0625 m", "full_stress", 0.61, slice_of(0.0625, 4)),
    ("3-D, 0.125 m, bed rougher than the grains", "full_stress", 0.61, {**slice_of(0.125, 4), "basal.friction_coefficient": "2"}),
    ("3-D, 0.125 m, without dilatancy", "full_stress", 0.61, {**slice_of(0.125, 4), **NO_DILATANCY}),
    ("3-D, 0.125 m", "full_stress", 0.66, {**slice_of(0.125, 4), "grains.solid_fraction": "0.66"}),
]

PRISM = """title: Six cubic metres of saturated sand on 31 degrees
terrain:
  synthetic: {{plane: {{cell_size_m: {dx}, slope_deg: 31, length_m: {length}, width_m: {width}}}}}
release:
  box: {{x_m: [{west}, {east}], y_m: [-{half}, {half}]}}
  thickness_m: {thick}
grains: {{density_kg_m3: 2700, diameter_m: 0.001, solid_fraction: {m0}{angle}}}
{wet}
basal: {{friction_coefficient: {friction}}}
formulation: {formulation}
domain: {{periodic: [{periodic}]}}
numerics: {{spacing_m: {dx}, end_time_s: {end}, stop_at_rest: false}}
ensemble: {{seed: {seed}, members: 1}}
hazard: {{cell_size_m: 0.5, thickness_m: [0.1], speed_m_s: [1], energy_kj_m2: [1], pressure_kpa: [3]}}
"""
IN_3D = """fluid: {density_kg_m3: 1000, viscosity_pa_s: 0.001, bed: film}
coupling: {drag_diameter_m: 0.000235, critical_solid_fraction: 0.56, dilatancy_slope: 1}"""
IN_COLUMNS = """mixture: {fluid_density_kg_m3: 1000, fluid_viscosity_pa_s: 0.001, critical_solid_fraction: 0.56, permeability_m2: 1.0e-10,
  permeability_fraction: 0.56, shear_grain_diameter_m: 0.001, compressibility: 0.05, stress_offset_pa: 1000, pressure_profile: resolved}"""


def scene(m0, dx, seed=1, sheet=False, columns=False, end=3):
    """V24: 0.75 m of sand (vertical), 4 m long on the map, in a slice of four particles; a sheet is as thick and has no ends."""
    width = 4 * dx
    length, west, east = (6 * dx, -3 * dx, 3 * dx) if sheet else (60, -26, -22)
    return PRISM.format(dx=dx, length=length, width=width, west=west, east=east, half=width / 2, m0=m0, seed=seed, end=end, thick=0.75,
                        angle="" if columns else ", friction_angle_deg: 40.7", wet=IN_COLUMNS if columns else IN_3D,
                        friction=0.86 if columns else 2, formulation="depth_averaged" if columns else "full_stress",
                        periodic="x, y" if sheet else "y")


MOBILISE = [  # name, m0, scene
    *(("prism, columns, 0.1 m", m, scene(m, 0.1, columns=True)) for m in (0.48, 0.59)),
    *((f"prism, 0.1 m, seed {seed}", m, scene(m, 0.1, seed)) for m in (0.48, 0.59) for seed in (1, 2, 3)),
    *((f"prism, 0.075 m", m, scene(m, 0.075)) for m in (0.48, 0.59)),
    *((f"sheet, {dx} m", m, scene(m, dx, sheet=True)) for dx in (0.1, 0.075) for m in (0.48, 0.59)),
]


def make(sturz, folder, scene_file, values, interval):
    """Runs a scene unless it was; \\return its scalars, its outcome among them."""
    done = folder.parent / f"{folder.name}.json"
    if not done.exists():
        run = subprocess.run([sturz, "run", scene_file, "-o", folder, "--replace", "--threads", "1", "--particles", str(interval), "--json",
                              *settings(values)], capture_output=True, text=True)
        lines = [json.loads(line) for line in run.stdout.splitlines() if '"done"' in line]
        if not lines:
            raise SystemExit(f"{folder}: {run.stdout[-500:]}{run.stderr[-500:]}")
        done.write_text(json.dumps({"outcome": lines[-1]["outcome"], **lines[-1]["scalars"]}))
        print(f"{folder.name}: {lines[-1]['scalars']['cpu_s']:.0f} s of CPU", file=sys.stderr, flush=True)
    return json.loads(done.read_text())


def volumes(points, mass, density, edges):
    return np.histogram(along_bed(points[:, 0]), bins=edges, weights=mass / density)[0]


def follow_flume(folder, width):
    """Times of the front at the gauges, last fronts, peak thickness at the gauges and how far the liquid was ahead."""
    gauges, times, fronts, most, ahead, thick = (32, 66), [], [], [], 0.0, {32: 0.0, 66: 0.0}
    wet = frames(folder, liquid=True)
    for number, path in enumerate(frames(folder)):
        time, (points, mass, density) = frame(path, ("Points", "mass", "density"))
        s = along_bed(points[:, 0])
        liquid = frame(wet[number], ("Points", "mass"))[1] if wet else None
        for gauge in gauges:
            edges = [gauge - 0.5, gauge + 0.5]
            volume = volumes(points, mass, SOLID if wet else density, edges)[0]
            if wet:
                volume += volumes(*liquid, LIQUID, edges)[0]
            thick[gauge] = max(thick[gauge], volume / width)
        times.append(time)
        fronts.append(s.max())
        order = np.argsort(s)
        most.append(s[order][np.searchsorted(np.cumsum(mass[order]) / mass.sum(), 0.98)])
        if wet:
            ahead = max(ahead, float(liquid[1][along_bed(liquid[0][:, 0]) > s.max() + 1].sum() / liquid[1].sum()))
    fronts = np.maximum.accumulate(fronts)
    return {"passes": [float(np.interp(g, fronts, times)) if fronts[-1] >= g else math.inf for g in GAUGES],
            "stop": float(fronts[-1]), "most": float(most[-1]), "speed": float((most[-1] - most[-6]) / (times[-1] - times[-6])),
            "thick": thick, "ahead": ahead, "until": times[-1]}


def flume(sturz, case, out, only):
    print("| | m0 | 32 m s | 53 m s | 66 m s | front at the end m | 98 % of the grains m | thickness at 32 m cm | at 66 m cm |"
          " liquid ahead of the grains % | core seconds | particles |")
    print("|---|---|---|---|---|---|---|---|---|---|---|---|")
    print("| measured; D-Claw | 0.61 | 3.2-4.0 | 5.3 | 6.6-7.0 | 112 | 78-110 | 13-22 | 10-18 | | | |")
    for name, file, m0, values in FLUME:
        folder = out / "flume" / f"{name} {m0}".replace(",", "").replace(" ", "_")
        if only not in f"flume {name} {m0}" and not (folder.parent / f"{folder.name}.json").exists():
            continue
        folder.parent.mkdir(parents=True, exist_ok=True)
        s = make(sturz, folder, case / f"{file}.yaml", values, 0.1)
        width = 2 if file == "scenario" else float(values.get("terrain.synthetic.debris_flume.pad_width_m", 0.4))
        f = follow_flume(folder / "particles", width)
        moving = "" if f["speed"] < 0.05 else f", {f['speed']:.1f} m/s still after {f['until']:.0f} s"
        print(f"| {name} | {m0} | {' | '.join(shown(p) for p in f['passes'])} | {f['stop']:.1f} | {f['most']:.1f}{moving} |"
              f" {100 * f['thick'][32]:.0f} | {100 * f['thick'][66]:.0f} | {'' if file == 'scenario' else format(100 * f['ahead'], '.1f')} |"
              f" {s['cpu_s']:.0f} | {s['n_particles']:.0f} |", flush=True)


def follow_sand(folder, columns):
    """Path and speed of the centre of the grains along the slope after 1 and 3 s; excess of the liquid's pressure at the bed over still water."""
    slope, liquid, speed, excess = math.radians(31), frames(folder, liquid=True), [], []
    for number, name in enumerate(frames(folder)):
        time, (points, velocity) = frame(name, ("Points", "velocity"))
        speed.append((time, float((velocity[:, 0] * math.cos(slope) - velocity[:, 2] * math.sin(slope)).mean())))
        if columns or time == 0 or time > 1:
            continue
        middle = points[:, 0].mean()
        _, (where, pressure) = frame(liquid[number], ("Points", "pressure"))
        height = (where[:, 2] + where[:, 0] * math.tan(slope)) * math.cos(slope)
        low = (height < 0.15) & (np.abs(where[:, 0] - middle) < 1)
        excess.append(float((pressure[low] - 1000 * 9.81 * math.cos(slope) * (0.75 * math.cos(slope) - height[low])).mean()))
    times, speeds = np.array(speed).T
    path = np.concatenate([[0], np.cumsum(np.diff(times) * 0.5 * (speeds[1:] + speeds[:-1]))])  # a sheet's places repeat themselves
    return [np.interp((1, 3), times, series) for series in (path, speeds)] + [np.mean(excess) if excess else math.nan]


def mobilise(sturz, out, only):
    print("\n| | m0 | path of the centre after 1 s m | after 3 s m | speed after 1 s m/s | after 3 s m/s | excess pore pressure at the bed,"
          " mean of the first second kPa | core seconds |")
    print("|---|---|---|---|---|---|---|---|")
    print("| measured (Iverson et al. 2000) | loose, 0.5 | | | > 1 | | | |\n| | dense, 0.6 | | | 0.002 | | | |")
    for name, m0, text in MOBILISE:
        folder = out / "mobilise" / f"{name} {m0}".replace(",", "").replace(" ", "_")
        if only not in f"mobilise {name} {m0}" and not (folder.parent / f"{folder.name}.json").exists():
            continue
        folder.parent.mkdir(parents=True, exist_ok=True)
        file = folder.parent / f"{folder.name}.yaml"
        file.write_text(text)
        s = make(sturz, folder, file, {}, 0.1)
        path, speed, excess = follow_sand(folder / "particles", "columns" in name)
        print(f"| {name} | {m0} | {path[0]:.3f} | {path[1]:.3f} | {speed[0]:.3f} | {speed[1]:.3f} |"
              f" {'' if math.isnan(excess) else format(excess / 1000, '+.2f')} | {s['cpu_s']:.0f} |", flush=True)


def main(sturz, case, out, *words):
    only = words[1] if words and words[0] == "--only" else ""
    flume(sturz, pathlib.Path(case), pathlib.Path(out), only)
    mobilise(sturz, pathlib.Path(out), only)


if __name__ == "__main__":
    main(*sys.argv[1:])
