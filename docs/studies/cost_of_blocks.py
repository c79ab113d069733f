# SPDX-License-Identifier: Apache-2.0
"""What a block costs: user CPU a column and step of a scene with it and without it, in alternating runs on one thread.

usage: cost_of_blocks.py STURZ OUT [PAIRS]   (needs python3-netcdf4; 3 min of CPU with 5 pairs)
4,032 columns of 4 m, 5 m thick, on 25 degrees above level ground, 40 s. Prints medians and the range of the ratios.
"""
import os
import pathlib
import statistics
import subprocess
import sys

from netCDF4 import Dataset

SCENE = """
title: cost of a block
terrain: {synthetic: {ramp: {cell_size_m: 4, slope_deg: 25, slope_length_m: 500, transition_m: 40, level_length_m: 1400, width_m: 700}}}
release: {box: {x_m: [-350, -100], y_m: [-125, 125]}, thickness_m: 5}
grains: {density_kg_m3: 2700, solid_fraction: 0.64}
basal: {friction_coefficient: %s}
formulation: depth_averaged
numerics: {spacing_m: 4, end_time_s: 40}
"""
WATER = "mixture: {fluid_density_kg_m3: 1100, permeability_m2: 1.0e-9%s}\n"
BED = "erosion: {%s, supply: unlimited}\n"
SCENES = {
    "dry": SCENE % 0.25,
    "dry, bed: exponential, 1e-5 1/m": SCENE % 0.25 + BED % "law: exponential, growth_rate_per_m: 1.0e-5",
    "dry, bed: exponential, 1e-3 1/m": SCENE % 0.25 + BED % "law: exponential, growth_rate_per_m: 1.0e-3",
    "dry, bed: shear stress": SCENE % 0.25 + BED % "law: shear_stress",
    "wet": SCENE % 0.75 + WATER % "",
    "wet, profile resolved, 8 nodes": SCENE % 0.75 + WATER % ", pressure_profile: resolved",
    "wet, profile resolved, 8 nodes, two drains": SCENE % 0.75 + WATER % ", pressure_profile: resolved, drainage: both",
    "wet, bed: exponential, 1e-3 1/m": SCENE % 0.75 + WATER % "" + BED % "law: exponential, growth_rate_per_m: 1.0e-3",
}


def run(sturz, folder, text):
    """User CPU of the whole process a column and step [ns], and steps."""
    folder.mkdir(parents=True, exist_ok=True)
    scene = folder / "scene.yaml"
    scene.write_text(text)
    before = os.times().children_user
    subprocess.run([sturz, "run", scene, "-o", folder / "out", "--replace", "--threads", "1"], check=True, capture_output=True)
    with Dataset(folder / "out" / "members" / "000000.nc") as file:
        column_steps = float(file["n_steps"][...]) * float(file["n_particles"][...])
        member = float(file["cpu_s"][...])
    return 1e9 * member / column_steps, 1e9 * (os.times().children_user - before) / column_steps, float(column_steps)


def main(sturz, out, pairs="5"):
    out = pathlib.Path(out)
    found = {name: [] for name in SCENES}
    for _ in range(int(pairs)):
        for number, (name, text) in enumerate(SCENES.items()):
            found[name].append(run(sturz, out / str(number), text))
    print("| scene | member: ns a column and step | over its twin without | whole process | column steps |\n|---|---|---|---|---|")
    for name, runs in found.items():
        twin = found["dry" if name.startswith("dry") else "wet"]
        ratios = sorted(a[0] / b[0] for a, b in zip(runs, twin))
        print(f"| {name} | {statistics.median(r[0] for r in runs):.0f} | {statistics.median(ratios):.2f}"
              f" ({ratios[0]:.2f}-{ratios[-1]:.2f}) | {statistics.median(r[1] for r in runs):.0f} | {runs[0][2]:.3g} |")


if __name__ == "__main__":
    main(*sys.argv[1:])
