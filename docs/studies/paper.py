# SPDX-License-Identifier: Apache-2.0
"""The paper's flume experiments and its four conditions of Shuicheng beside ours.

usage: paper.py STURZ CASES OUT [--only TEXT] [--fine]   (needs python3-numpy; half an hour of CPU, --fine: 10 min more)
CASES is scenarios/cases, OUT takes the runs; a run that is there is not made again. --only makes just the runs whose name has
TEXT in it; the tables then have what is there. Published figures: Gao et al. (2024), tables 1 to 6 and text.
"""
import json
import math
import pathlib
import subprocess
import sys

import numpy as np
from frames import frame, frames

SLOPE, FLOOR = math.radians(20), 3.0
FOOT = FLOOR * math.cos(SLOPE)  # of the floor, on the map from the gate [m]
HOPPER = 0.46875                # length of the release on the map, whole spacings of which fit [m]
CROWN = (500000, 2900000)       # of the Shuicheng-like ground
END = 1650                      # where it ends, from there [m]
BED = {"basal.pore_pressure_ratio": 0, "basal.zones": []}  # the grains' own friction and no more
WET = {"coupling.scheme": "physical"}
PHYSICAL = {**WET, **BED}
TAN20 = {"basal.friction_coefficient": 0.364}
COLUMNS = {"formulation": "depth_averaged", "numerics.accept_unresolved": "true"}


def mixture(density, viscosity, diameter, solid, phases):
    """Block of the columns; permeability of Ergun's law for a_s, d [m2], so that drag is that of the particles."""
    k = diameter ** 2 * (1 - solid) ** 3 / (150 * solid ** 2)
    return {**COLUMNS, "fluid": None, "coupling": None, "mixture.fluid_density_kg_m3": density, "mixture.fluid_viscosity_pa_s": viscosity, "mixture.phases": phases,
            "mixture.permeability_m2": f"{k:.3g}", "mixture.permeability_fraction": solid}


WALLS = {"domain.walls": "[{point_m: [-0.4935, 0, 0], normal: [1, 0, 0]}, {point_m: [0.0235, 0, 0], normal: [-1, 0, 0], remove_at_s: 0.05}]"}
FLUME = [(f"{name}, {dx} mm", case, {**values, "numerics.spacing_m": HOPPER / round(1000 * HOPPER / dx), "numerics.end_time_s": 6, **(WALLS if dx == 39 else {})})
         for dx in (39, 31) for name, case, values in (
             ("I, as published", "flume_1", {}),
             ("II, as published", "flume_2", {}),
             ("III, as published", "flume_3", {}),
             ("II, physical, 0.8", "flume_2", PHYSICAL),
             ("III, physical, 0.8", "flume_3", PHYSICAL),
             ("I, 0.8, states of the grains", "flume_1", {"grains.states": "{dilute: {}, ultradilute: {contacts: hertz_mindlin}}"}),
             ("I, 0.5", "flume_1", {"basal.friction_coefficient": 0.5}),
             ("I, tan 20", "flume_1", TAN20),
             ("II, physical, tan 20", "flume_2", {**PHYSICAL, **TAN20}),
             ("III, physical, tan 20", "flume_3", {**PHYSICAL, **TAN20}))]
FLUME += [
    ("I, columns, 0.8", "flume_1", COLUMNS),
    ("I, columns, tan 20", "flume_1", {**COLUMNS, **TAN20}),
    ("III, columns, one velocity, 0.8", "flume_3", {**mixture(1570, 0.018, 0.02, 0.4168, "one"), **BED}),
    ("III, columns, two velocities, 0.8", "flume_3", {**mixture(1570, 0.018, 0.02, 0.4168, "two"), **BED}),
    ("III, columns, one velocity, tan 20", "flume_3", {**mixture(1570, 0.018, 0.02, 0.4168, "one"), **BED, **TAN20}),
    ("III, columns, two velocities, tan 20", "flume_3", {**mixture(1570, 0.018, 0.02, 0.4168, "two"), **BED, **TAN20}),
]
FLUME_FINE = [("III, physical, 0.8, 20 mm", "flume_3", {**PHYSICAL, "numerics.spacing_m": HOPPER / 23, "numerics.end_time_s": 6})]
FLUME_PAPER = {"I": (2.7, 2.3), "II": (3.7, 1.7), "III": (7.7, 3.7)}  # distance [m], largest speed [m/s]

SHUICHENG = [(f"{name}, as published, {dx} m", f"condition_{k + 1}", {"numerics.spacing_m": dx})
             for dx in (7.7, 5.45) for k, name in enumerate(("I", "II", "III", "IV"))]
SHUICHENG += [
    ("physical, 7.7 m", "condition_3", {**WET, "numerics.spacing_m": 7.7}),
    ("physical, friction 0.87, 7.7 m", "condition_3", {**WET, "basal.friction_coefficient": 0.87, "numerics.spacing_m": 7.7}),
    ("physical, 5.45 m", "condition_3", {**WET, "numerics.spacing_m": 5.45}),
    ("physical, drag of 10 mm, 7.7 m", "condition_3", {**WET, "coupling.drag_diameter_m": 0.01, "numerics.spacing_m": 7.7}),
    ("I, columns", "condition_1", COLUMNS),
    ("II, columns", "condition_2", {**COLUMNS, "basal.pore_pressure_ratio": 0.2}),
    ("columns, one velocity", "condition_3", mixture(1200, 0.2, 0.3, 0.5, "one")),
    ("columns, two velocities", "condition_3", mixture(1200, 0.2, 0.3, 0.5, "two")),
    ("columns, one velocity, friction 0.87", "condition_3", {**mixture(1200, 0.2, 0.3, 0.5, "one"), "basal.friction_coefficient": 0.87}),
    ("columns, two velocities, friction 0.87", "condition_3", {**mixture(1200, 0.2, 0.3, 0.5, "two"), "basal.friction_coefficient": 0.87}),
]
# Largest speed, area, centre of mass, distance, thickness of tables 5 and 6.
SHUICHENG_PAPER = {"I": (14, 0.11, 300, 600, 24), "II": (25.5, 0.21, 500, 850, 21), "III": (32, 0.26, 650, 1000, 23),
                   "IV": (38, 0.32, 760, 1360, 21), "the landslide": (35, 0.33, 770, "1,340 / 1,360", 20),
                   "MatDEM in table 6": (44, math.nan, math.nan, 1358, 50), "DAN3D in table 6": (40, math.nan, math.nan, 1250, 24)}

# Floor of scenarios/shapes/shuicheng.cpp: distance from the crown along the path, elevation [m].
PROFILE = np.array([(0, 1700), (60, 1655), (230, 1553), (330, 1500), (400, 1470), (480, 1447), (600, 1397), (750, 1348), (900, 1309),
                    (1050, 1279), (1200, 1256), (1340, 1240), (1450, 1228), (1700, 1205)], float)
# Friction that acts on a block of the whole mixture: friction on floor and plate of the flume; on the ground of Shuicheng.
FULL, SUNK = 1 - 1570 / 1999, 1 - 0.601 * 1570 / 1771  # flume III in full pores; II, slurry in the lower 60 %
FLUME_BLOCKS = [("I, 0.8", 0.8), ("II, physical, 0.8", 0.8 * SUNK), ("III, physical, 0.8", 0.8 * FULL), ("I, tan 20", 0.364),
                ("II, physical, tan 20", 0.364 * SUNK), ("III, physical, tan 20", 0.364 * FULL)]
SHUICHENG_BLOCKS = [("I", 0.5), ("II", 0.4), ("III, as published", 0.5 * 1400 / 2000), ("IV, as published", 0.4 * 1400 / 2000),
                    ("physical, 0.5", 0.5 * (1 - 1200 / 2000)), ("physical, 0.87", 0.87 * (1 - 1200 / 2000))]


def share(values, mass, part):
    """The value that so much of the mass [kg] lies below; infinite where there is less of it."""
    order = np.argsort(values)
    at = np.searchsorted(np.cumsum(mass[order]), part * (1 - 1e-9))
    return float(values[order][at]) if at < len(order) else math.inf


def along_flume(points):
    """Length along floor and plate from the gate [m]."""
    x = points[:, 0]
    return np.where(x < FOOT, x / math.cos(SLOPE), FLOOR + x - FOOT)


def from_crown(points):
    return np.hypot(points[:, 0] - CROWN[0], points[:, 1] - CROWN[1])


def thickness(points, mass, cell, bulk_density):
    """Largest bulk thickness of the grains on cells of the given side [m]."""
    low = points[:, :2].min(axis=0)
    cells = [np.arange(low[k], points[:, k].max() + cell, cell) for k in (0, 1)]
    if min(len(c) for c in cells) < 2:
        return math.nan
    return float(np.histogram2d(points[:, 0], points[:, 1], bins=cells, weights=mass)[0].max() / (bulk_density * cell ** 2))


def follow(folder, length, cell, bulk_density, liquid=False):
    """What the frames say of one material: fronts, speeds, what lies where at the end. Mass that left the ground counts as beyond it."""
    times, fronts, fastest, farthest = [], [], [], -math.inf
    for path in frames(folder, liquid):
        time, (points, velocity, mass) = frame(path, ("Points", "velocity", "mass"))
        s = length(points)
        if not times:
            released, start = mass.sum(), (s * mass).sum() / mass.sum()
        farthest = max(farthest, s.max(initial=-math.inf))
        times.append(time)
        fronts.append(share(s, mass, 0.98 * released))
        fastest.append(share(np.linalg.norm(velocity, axis=1), mass, 0.98 * mass.sum()))
    there = np.isfinite(fronts)
    speeds = np.diff(np.array(fronts)[there]) / np.maximum(np.diff(np.array(times)[there]), 1e-9)
    gone = mass.sum() < 0.98 * released
    return {"front_98": fronts[-1], "front_95": share(s, mass, 0.95 * released), "centre": math.nan if gone else float((s * mass).sum() / mass.sum()) - start, "median": share(s, mass, 0.5 * released), "farthest": float(farthest), "left": 1 - mass.sum() / released,
            "front_speed": float(speeds.max()), "fast_98": float(np.nanmax(fastest)), "thick": thickness(points, mass, cell, bulk_density),
            "on_plate": float(1 - mass[points[:, 0] < FOOT].sum() / released), "creeps": float(speeds[-5:].mean()), "until": times[-1]}


def run(sturz, case, folder, values, interval):
    words = [w for key, value in values.items() for w in ("--set", f"{key}={'null' if value is None else value}")]
    done = subprocess.run([sturz, "run", case, "-o", folder, "--replace", "--threads", "1", "--particles", str(interval), "--json", *words],
                          capture_output=True, text=True)
    lines = [json.loads(line) for line in done.stdout.splitlines() if '"done"' in line]
    if not lines:
        raise RuntimeError(f"{folder}: {done.stderr[-500:]}")
    return {"outcome": lines[-1]["outcome"], "reason": lines[-1].get("reason", ""), **lines[-1]["scalars"]}


def make(sturz, cases, out, scene, rows, only):
    flume = scene == "flume"
    found = {}
    for name, case, values in rows:
        folder = out / scene / name.replace(",", "").replace(" ", "_")
        done = folder.parent / f"{folder.name}.json"
        if values is None or (only not in f"{scene} {name}" and not done.exists()):
            continue
        if not done.exists():
            folder.parent.mkdir(parents=True, exist_ok=True)
            s = run(sturz, cases / scene / f"{case}.yaml", folder, values, 0.1 if flume else 2)
            done.write_text(json.dumps(s))
            print(f"{scene} {name}: {s['cpu_s']:.0f} s of CPU", file=sys.stderr, flush=True)
        how = (along_flume, 0.1, 1300) if flume else (from_crown, 20, 1400)
        found[name] = {**json.loads(done.read_text()), **follow(folder / "particles", *how)}
        if frames(folder / "particles", liquid=True):
            found[name]["liquid"] = follow(folder / "particles", *how, liquid=True)
    return found


def number(value, digits=0):
    if isinstance(value, str):
        return value
    return "" if value is None or math.isnan(value) else "beyond" if math.isinf(value) else f"{value:,.{digits}f}"


def ending(s):
    """How a run ended, in words."""
    if s["left"] > 0.02:
        return f"{100 * s['left']:.0f} % of the grains left the ground"
    return "at rest" if s["outcome"] == "settled" else f"creeps {100 * s['creeps']:.0f} cm/s" if s["creeps"] > 0.005 else "front at rest"


def table(head, rows):
    print("| " + " | ".join(head) + " |\n|" + "---|" * len(head))
    for row in rows:
        print("| " + " | ".join(row) + " |")
    print()


def show_flume(found):
    head = ("run", "98 / 95 % of the grains within m", "half within m", "farthest grain m", "fastest front m/s", "98 % slower than m/s",
            "on the plate %", "thickest m", "liquid's front m", "at the end", "particles", "CPU s")
    rows = [(f"paper, {name}", number(d, 1), "", "", number(v, 1), *[""] * 7) for name, (d, v) in FLUME_PAPER.items()]
    for name, s in found.items():
        rows.append((name, f"{number(s['front_98'], 1)} / {number(s['front_95'], 1)}", number(s["median"], 1), number(s["farthest"], 1), number(s["front_speed"], 1),
                     number(s["fast_98"], 1), number(100 * s["on_plate"]), number(s["thick"], 2),
                     number(s["liquid"]["front_98"], 1) if "liquid" in s else "", f"{ending(s)}, {s['until']:.1f} s",
                     number(s["n_particles"]), number(s["cpu_s"])))
    table(head, rows)


def show_shuicheng(found):
    head = ("run", "fastest m/s", "98 % slower than m/s", "reached / deposit km²", "centre of the grains m", "98 / 95 % of the grains within m",
            "farthest grain m", "thickest m", "liquid's front m", "at the end", "particles", "CPU s")
    rows = [(f"paper, {name}", number(v), "", number(area, 2), number(c), number(d), "", number(h), *[""] * 4)
            for name, (v, area, c, d, h) in SHUICHENG_PAPER.items()]
    for name, s in found.items():
        rows.append((name, number(s["max_speed_m_s"]), number(s["fast_98"]), f"{s['reached_area_m2'] / 1e6:.2f} / {s['deposit_area_m2'] / 1e6:.2f}",
                     number(s["centre"]), f"{number(s['front_98'])} / {number(s['front_95'])}", number(s["farthest"]), number(s["thick"], 1),
                     number(s["liquid"]["front_98"]) if "liquid" in s else "", f"{ending(s)}, {s['until']:.0f} s",
                     number(s["n_particles"]), number(s["cpu_s"])))
    table(head, rows)


def show_ratios(found):
    """Distance over that of condition I, and whether it lies within 25 % of the paper's."""
    rows = []
    for dx in ("7.7 m", "5.45 m"):
        runs = {k: found.get(f"{k}, as published, {dx}") for k in ("I", "II", "III", "IV")}
        if not all(runs.values()):
            continue
        for key in ("front_98", "front_95"):
            cells = []
            for k in ("II", "III", "IV"):
                gone, paper = math.isinf(runs[k][key]), SHUICHENG_PAPER[k][3] / 600
                ours = (END if gone else runs[k][key]) / runs["I"][key]
                within = "within" if abs(ours / paper - 1) <= 0.25 else "missed"
                cells.append(f"{'over ' if gone else ''}{ours:.2f} of {paper:.2f}: {'not known' if gone and ours < 1.25 * paper else within}")
            rows.append((f"{dx}, {key[-2:]} % of the grains", *cells))
    table(("spacing", "II / I", "III / I", "IV / I"), rows)


def block_stops(friction, start):
    """Where a block comes to rest that starts so far from the crown; infinite beyond the ground [m]."""
    x = np.arange(start + 1, 1650.0)
    floor = np.interp(x, *PROFILE.T)
    below = np.nonzero(np.interp(start, *PROFILE.T) - friction * (x - start) < floor)[0]
    return float(x[below[0]]) if len(below) else math.inf


def show_blocks():
    table(("flume", "mu_eff", "on 20 degrees m/s²", "on the plate m/s²"),
          [(name, number(mu, 2), number(9.81 * (math.sin(SLOPE) - mu * math.cos(SLOPE)), 1), number(-9.81 * mu, 1)) for name, mu in FLUME_BLOCKS])
    table(("Shuicheng", "mu_eff", "a block from 20 m below the crown stops at m", "from the mass's centre, 140 m"),
          [(name, number(mu, 2), number(block_stops(mu, 20)), number(block_stops(mu, 140))) for name, mu in SHUICHENG_BLOCKS])


def main(sturz, cases, out, *flags):
    cases, out = pathlib.Path(cases).resolve(), pathlib.Path(out).resolve()
    only = flags[flags.index("--only") + 1] if "--only" in flags else ""
    flume = make(sturz, cases, out, "flume", FLUME + (FLUME_FINE if "--fine" in flags else []), only)
    shuicheng = make(sturz, cases, out, "shuicheng", SHUICHENG, only)
    print("### Flume\n")
    show_flume(flume)
    print("### Shuicheng\n")
    show_shuicheng(shuicheng)
    print("### Distances over that of condition I\n")
    show_ratios(shuicheng)
    print("### Blocks\n")
    show_blocks()


if __name__ == "__main__":
    main(*sys.argv[1:])
