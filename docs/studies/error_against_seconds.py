# SPDX-License-Identifier: Apache-2.0
"""Error against seconds of full stress: the strip V18, the collapse V8b, the Zhangjiawan-like slide, from few layers to many.

usage: error_against_seconds.py measure STURZ OUT [CASE ...]    (strip, strip_30, collapse, zhangjiawan; all when absent)
       error_against_seconds.py show OUT/figures.json [EARLIER.json [PICTURE.png]]
needs python3-numpy, python3-gdal; python3-matplotlib for the picture. OUT takes runs and figures.json. One thread; seconds are
processor time of the member, without reading and writing. Ten minutes on one core. `show` prints the table, beside an earlier
program's figures where they are given; errors of both are taken from the same references.

strip        a periodic slice of a parabolic ridge, 160 m long and 4 m thick, slides down 35 degrees over a bed of tan 25 degrees
             and spreads for 10 s; 25 degrees inside, 30 in strip_30. Reference: Savage and Hutter (1989) with the thrust of this
             material, a closed form. It yields at sqrt(J2) = k p while the bed holds t of the normal stress, so
             t^2 + ((K - 1)/2)^2 = k^2 ((K + 1)/2)^2; and shear inside tilts the load on the bed by -t dh/dx, which
             takes t^2 off K (a term as large as the thrust itself that the shallow theory leaves out).
collapse     a column as high as long falls over rough ground (Lube et al. 2005), 31 degrees; the length behind which 99 % of the
             mass lies. Reference: the value that the two finest runs of OUT tend to in first order.
zhangjiawan  the shipped ground, 491,000 m3, friction 0.24; travel of the centre of mass. Reference: the finest run of OUT.
"""
import json
import math
import pathlib
import subprocess
import sys

import numpy as np
from osgeo import gdal
from usgs_flume import frame

gdal.UseExceptions()
SLOPE, BED = math.radians(35), math.tan(math.radians(25))
HALF, THICK, START, END = 80.0, 4.0, -120.0, 10.0

STRIP = """
title: Strip of a parabolic ridge
terrain: {{synthetic: {{plane: {{cell_size_m: {cell}, slope_deg: 35, length_m: 560, width_m: {width}}}}}}}
release: {{thickness_raster: ridge.tif}}
grains: {{friction_angle_deg: {inside}}}
basal: {{friction_coefficient: {bed}}}
domain: {{periodic: [y]}}
formulation: full_stress
numerics: {{spacing_m: {dx}, end_time_s: 10, stop_at_rest: false, accept_unresolved: true}}
"""
COLLAPSE = """
title: Collapse of a column as high as long
terrain: {{synthetic: {{plane: {{cell_size_m: {cell}, slope_deg: 0, length_m: {length}, width_m: {width}}}}}}}
release: {{box: {{x_m: [0, 1], y_m: [-{half_width}, {half_width}]}}, thickness_m: 1}}
grains: {{diameter_m: 0.01, friction_angle_deg: 31}}
basal: {{friction_coefficient: 0.6008606}}
domain: {{periodic: [y], walls: [{{point_m: [0, 0, 0], normal: [1, 0, 0], friction_coefficient: 0}}]}}
formulation: full_stress
numerics: {{spacing_m: {dx}, end_time_s: 2.5546, accept_unresolved: true}}
"""
ZHANGJIAWAN = """
title: Zhangjiawan-like, friction 0.24
terrain: {{synthetic: {{zhangjiawan: {{cell_size_m: 5}}}}}}
release: {{volume_m3: 491000}}
grains: {{density_kg_m3: 2400, diameter_m: 3, solid_fraction: 0.70, friction_angle_deg: 24, cohesion_pa: 5000}}
basal: {{friction_coefficient: 0.24}}
formulation: full_stress
numerics: {{spacing_m: {dx}, accept_unresolved: true}}
hazard: {{cell_size_m: 5}}
"""


def run(sturz, folder, text, particles):
    """Scalars of a run on one thread, and x and mass of its particles at the end."""
    folder.mkdir(parents=True, exist_ok=True)
    scene = folder / "scene.yaml"
    scene.write_text(text)
    out = folder / "out"
    extra = ["--particles", str(particles)] if particles else []
    done = subprocess.run([sturz, "run", scene, "-o", out, "--replace", "--threads", "1", "--json", *extra],
                          check=True, capture_output=True, text=True).stdout
    scalars = [json.loads(line) for line in done.splitlines() if '"done"' in line][-1]["scalars"]
    if not particles:
        return scalars, None, None
    _, x, mass = max((frame(path) for path in (out / "particles").glob("*.vtp")), key=lambda f: f[0])
    return scalars, x, mass


def ridge(path, cell, width):
    """Vertical thickness of the parabola on the cells of the plane's own raster."""
    columns, rows = round(560 / cell), max(1, round(width / cell))
    x = -280 + cell * (np.arange(columns) + 0.5)
    u = (x - START) / (HALF * math.cos(SLOPE))
    thickness = np.tile(np.maximum(0, THICK / math.cos(SLOPE) * (1 - u * u)), (rows, 1))
    data = gdal.GetDriverByName("GTiff").Create(str(path), columns, rows, 1, gdal.GDT_Float64)
    data.SetGeoTransform([-280, cell, 0, rows * cell / 2, 0, -cell])
    data.GetRasterBand(1).WriteArray(thickness)


def strip(sturz, folder, layers, inside=25):
    dx = THICK / layers
    cell, width = 0.5 * dx, 6 * dx
    folder.mkdir(parents=True, exist_ok=True)
    ridge(folder / "ridge.tif", cell, width)
    s, x, mass = run(sturz, folder, STRIP.format(cell=cell, width=width, bed=BED, dx=dx, inside=inside), END)
    along = x / math.cos(SLOPE)
    centre = np.average(along, weights=mass)
    return s, math.sqrt(5 * np.average((along - centre) ** 2, weights=mass))


def strip_30(sturz, folder, layers):
    return strip(sturz, folder, layers, 30)


def thrust(inside):
    """What drives a mass apart that yields while it slides, over rho g h^2/2: 0.78 with 25 degrees inside, 0.48 with 30."""
    k2, t2 = math.tan(math.radians(inside)) ** 2, BED ** 2
    pressure = ((1 + k2) - math.sqrt(max(0, (1 + k2) ** 2 - (1 - k2) * (1 - k2 + 4 * t2)))) / (1 - k2)
    return pressure - t2


def strip_reference(inside):
    """a'' = 2 K g cos h_c / a with h_c = h_0 a_0 / a (Savage and Hutter 1989)."""
    a, rate, dt, pressure = HALF, 0.0, 1e-4, thrust(inside)
    for _ in range(round(END / dt)):
        rate += dt * 2 * pressure * 9.80665 * math.cos(SLOPE) * THICK * HALF / (a * a)
        a += dt * rate
    return a


def collapse(sturz, folder, layers):
    dx = 1 / layers
    length = 2 * 2 * dx * math.ceil(4.5 / (2 * dx))
    text = COLLAPSE.format(cell=2 * dx, length=length, width=4 * dx, half_width=2 * dx, dx=dx)
    s, x, mass = run(sturz, folder, text, 2.5546)
    order = np.argsort(x)
    share = np.cumsum(mass[order]) / mass.sum()
    return s, float(x[order][np.searchsorted(share, 0.99)]) - 1


def zhangjiawan(sturz, folder, spacing):
    s, _, _ = run(sturz, folder, ZHANGJIAWAN.format(dx=spacing), 0)
    return s, s["com_travel_m"]


# Layers of the strip and of the collapse, spacings of the slide [m].
CASES = {"strip": (strip, (2, 3, 4, 5, 6, 8, 12)), "strip_30": (strip_30, (2, 3, 4, 5, 6, 8)), "collapse": (collapse, (6, 8, 10, 14, 20, 28)),
         "zhangjiawan": (zhangjiawan, (10.5, 8, 6, 4.2))}
UNITS = {"strip": ("layers", "half-length m"), "strip_30": ("layers", "half-length m"), "collapse": ("layers", "run-out m"),
         "zhangjiawan": ("spacing m", "centre of mass m")}


def measure(sturz, out, *wanted):
    out = pathlib.Path(out)
    path = out / "figures.json"
    figures = json.loads(path.read_text()) if path.exists() else {}
    for case in wanted or CASES:
        compute, sizes = CASES[case]
        figures[case] = []
        for size in sizes:
            s, value = compute(sturz, out / case / str(size), size)
            row = {"size": size, "value": value, "cpu_s": s["cpu_s"], "particles": s["n_particles"], "steps": s["n_steps"],
                   "layers": s["release_layers"], "run_out_m": s["runout_m"], "deposit_m": s["max_deposit_m"],
                   "energy_residual": s["energy_residual"]}
            figures[case].append(row)
            print(case, json.dumps(row), flush=True)
            path.write_text(json.dumps(figures, indent=1))


def references(figures):
    found = {"strip": strip_reference(25), "strip_30": strip_reference(30)}
    if "collapse" in figures:  # first order: the error goes with 1/layers
        a, b = figures["collapse"][-2:]
        found["collapse"] = b["value"] + (b["value"] - a["value"]) / (b["size"] / a["size"] - 1)
    if "zhangjiawan" in figures:
        found["zhangjiawan"] = figures["zhangjiawan"][-1]["value"]
    return found


def seconds_for(rows, reference, error):
    """Processor time at which the error falls below `error` for good, between runs in logarithms; None: it does not."""
    points = [(r["cpu_s"], abs(r["value"] / reference - 1)) for r in rows]
    for k in range(len(points) - 1, -1, -1):
        if points[k][1] > error:
            if k + 1 == len(points):
                return None
            (t0, e0), (t1, e1) = points[k], points[k + 1]
            u = math.log(e0 / error) / math.log(e0 / max(e1, 1e-9))
            return t0 * (t1 / t0) ** u
    return points[0][0]


def show(now, earlier=None, picture=None):
    sets = {"now": json.loads(pathlib.Path(now).read_text())}
    if earlier:
        sets["earlier"] = json.loads(pathlib.Path(earlier).read_text())
    reference = references(sets["now"])
    for case, rows in sets["now"].items():
        size, value = UNITS[case]
        print(f"\n{case}, reference {reference[case]:.4g}\n")
        print(f"| program | {size} | particles | {value} | error | steps | CPU s |\n|---|---|---|---|---|---|---|")
        for name, figures in sets.items():
            for r in figures.get(case, []):
                print(f"| {name} | {r['size']:g} | {r['particles']:,.0f} | {r['value']:.4g} | {100 * (r['value'] / reference[case] - 1):+.1f} % |"
                      f" {r['steps']:,.0f} | {r['cpu_s']:.2f} |")
        if earlier and case in sets["earlier"]:
            for error in (0.10, 0.05, 0.03):
                pair = [seconds_for(sets[name][case], reference[case], error) for name in ("earlier", "now")]
                text = ["not reached" if t is None else f"{t:.2f} s" for t in pair]
                ratio = f": 1/{pair[0] / pair[1]:.1f} of the time" if None not in pair and pair[0] > 1.2 * pair[1] else ""
                print(f"\nerror of {100 * error:.0f} %: earlier {text[0]}, now {text[1]}{ratio}")
    if picture:
        draw(sets, reference, picture)


def draw(sets, reference, path):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    figure, axes = plt.subplots(1, 3, figsize=(11, 3.4), sharey=True)
    titles = {"strip": "Strip on a slope (closed form)", "collapse": "Collapse of a column", "zhangjiawan": "Zhangjiawan-like slide"}
    for axis, case in zip(axes, titles):
        for name, style in (("earlier", "o--"), ("now", "s-")):
            rows = sets.get(name, {}).get(case, [])
            points = [(r["cpu_s"], 100 * abs(r["value"] / reference[case] - 1), r) for r in rows]
            points = [p for p in points if p[1] > 1e-6]  # the reference itself
            if not points:
                continue
            axis.loglog([p[0] for p in points], [p[1] for p in points], style, ms=4, lw=1.2,
                        color={"earlier": "#b0602a", "now": "#1f5f8b"}[name],
                        label={"earlier": "particle alone mirrored in the ground", "now": "neighbours mirrored"}[name])
            for t, e, r in (points[0], points[-1]):
                axis.annotate(f"{r['size']:g}", (t, e), textcoords="offset points", xytext=(4, 4), fontsize=7)
        axis.set_title(titles[case], fontsize=9)
        axis.set_xlabel("processor seconds", fontsize=8)
        axis.set_ylim(0.3, 60)  # under that a curve crosses its reference
        axis.grid(True, which="both", lw=0.3)
        axis.tick_params(labelsize=7)
    axes[0].set_ylabel("error [%]", fontsize=8)
    axes[0].legend(fontsize=7)
    figure.text(0.99, 0.01, "numbers: layers at the start; spacing in m on the right", ha="right", fontsize=7)
    figure.tight_layout(rect=(0, 0.03, 1, 1))
    figure.savefig(path, dpi=110)


if __name__ == "__main__":
    {"measure": measure, "show": show}[sys.argv[1]](*sys.argv[2:])
