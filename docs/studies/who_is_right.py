# SPDX-License-Identifier: Apache-2.0
"""The same slide in columns, in full stress from 3 layers up, and grain by grain; and the same of the paper's dry flume.

usage: who_is_right.py ENERGY_OF OUT [--case zhangjiawan|flume] [ROW ...]   (all cases and rows when none is named; an hour of CPU)
ENERGY_OF is the target `energy_of` (build/release/tests/tools). OUT takes the runs; one that is there is not made again.
A row is columns, full_LAYERS or grains_METRES, and then, each after a colon, what differs: seed=2, overlap=0.05,
bed=0.8 or a key of grains.discrete, as bed_rolling_friction=0. Prints one line of a table per row. Nothing is fitted.
"""
import argparse
import json
import pathlib

from runs import kept, output

# All rows: the friction of the paper (0.24 on the bed, 24 degrees inside; no pore pressure).
ZHANGJIAWAN = """
title: Zhangjiawan-like, {row}
terrain: {{synthetic: {{zhangjiawan: {{cell_size_m: 5}}}}}}
release: {{volume_m3: 491000}}
grains: {{density_kg_m3: 2400, diameter_m: 3, solid_fraction: 0.70{inside}}}
basal: {{friction_coefficient: {bed}}}
formulation: {formulation}
numerics: {{spacing_m: {spacing}, end_time_s: 120, accept_unresolved: true}}
ensemble: {{seed: {seed}}}
hazard: {{cell_size_m: 10}}
"""
# Experiment I of the paper: 100 kg of gravel as spheres of 20 mm, on 0.5 m of floor behind a gate that is gone at once. Side walls are glass,
# here smooth, and go on over the plate; 20 degrees inside.
FLUME = """
title: Dry flume, {row}
terrain: {{synthetic: {{flume: {{cell_size_m: 0.02, slope_deg: 20, hopper_length_m: 0.6}}}}}}
release: {{box: {{x_m: [-0.4438, 0], y_m: [-0.24, 0.24]}}, thickness_m: 0.3009}}
grains: {{density_kg_m3: 2600, diameter_m: 0.02, solid_fraction: 0.60{inside}}}
basal: {{friction_coefficient: {bed}}}
formulation: {formulation}
domain:
  walls:
    - {{point_m: [-0.4698, 0, 0], normal: [1, 0, 0], friction_coefficient: 0}}
    - {{point_m: [0, -0.25, 0], normal: [0, 1, 0], friction_coefficient: 0}}
    - {{point_m: [0, 0.25, 0], normal: [0, -1, 0], friction_coefficient: 0}}
numerics: {{spacing_m: {spacing}, end_time_s: 10, accept_unresolved: true}}
ensemble: {{seed: {seed}}}
hazard: {{cell_size_m: 0.04}}
"""
# What a layer of full stress is counted on (the release: its median, the box's height) [m].
CASES = {
    "zhangjiawan": {"text": ZHANGJIAWAN, "angle": 24, "bed": 0.24, "thick": 42, "columns": 4, "digits": 0, "area": (1e4, "ha"),
                    "rows": "columns full_3 full_6 full_10 full_12 full_12:seed=2 full_12:seed=3 full_20 grains_8 grains_8:seed=2 grains_8:seed=3 grains_5 grains_5:seed=2 grains_5:seed=3"
                            " grains_5:overlap=0.05 grains_5:overlap=0.2 grains_5:bed_rolling_friction=0 grains_5:bed_rolling_friction=0.1 grains_3"},
    "flume": {"text": FLUME, "angle": 20, "bed": 0.5, "thick": 0.3009, "columns": 0.02, "digits": 2, "area": (1, "m²"),
              "rows": " ".join(f"{row}:bed={bed}" for bed in (0.364, 0.5, 0.8) for row in ("columns", "full_12", "grains_0.03", "grains_0.02"))},
}


def scene(case, row):
    """The scene of a row, as YAML."""
    name, *changes = row.split(":")
    given = dict(change.split("=") for change in changes)
    seed, bed, overlap = given.pop("seed", 1), given.pop("bed", case["bed"]), given.pop("overlap", 0.1)
    kind, _, size = name.partition("_")
    inside = f", friction_angle_deg: {case['angle']}"
    formulation, spacing = "depth_averaged", case["columns"]
    if kind == "full":
        formulation, spacing = "full_stress", case["thick"] / float(size)
    if kind == "grains":
        more = "".join(f", {key}: {value}" for key, value in given.items())
        formulation, inside = "discrete", f", discrete: {{greatest_overlap: {overlap}, diameter_m: {size}{more}}}"
    return case["text"].format(row=row.replace(":", " "), inside=inside, formulation=formulation, spacing=spacing, seed=seed, bed=bed)


def run(tool, folder, text):
    return kept(folder, tool, text, lambda scene: json.loads(output([tool, scene], scene)))


def line(row, case, d):
    def share(*parts):
        return f"{100 * sum(d[part] for part in parts) / d['released_j']:.1f}"
    n, (unit, _) = case["digits"], case["area"]
    cells = [row, f"{d['n_particles']:,.0f}", f"{d['layers']:.1f}", f"{d['front_m']:.{n}f}", f"{d['runout_m']:.{n}f}",
             f"{d['com_m']:.{n}f}", f"{d['com_drop_m']:.{n + 1}f}", f"{d['com_ratio']:.3f}", share("bed_j"),
             share("inside_j"), share("impacts_j"), share("numerical_j"), f"{d['speed_m_s']:.{1 + n // 2}f}",
             f"{d['deposit_m2'] / unit:.2f}", f"{d['max_deposit_m']:.{n + 1}f}", f"{d['end_s']:.{n // 2}f} {d['outcome']}",
             f"{d['n_steps']:,.0f}", f"{d['cpu_s']:.1f}"]
    return "| " + " | ".join(cells) + " |"


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("tool")
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("rows", nargs="*")
    parser.add_argument("--case", choices=CASES)
    given = parser.parse_intermixed_args()
    for number, (name, case) in enumerate(CASES.items()):
        if given.case not in (None, name):
            continue
        print(("\n" if number else "") + "| row | particles | layers | front m | run-out m | centre of mass m | its fall m | fall / way |"
              f" bed % | inside % | impacts % | numerical % | speed m/s | deposit {case['area'][1]} | largest deposit m | end s | steps | CPU s |")
        print("|" + "---|" * 18, flush=True)
        for row in given.rows or case["rows"].split():
            text = scene(case, row)
            folder = given.out / name / row.replace(":", "_")
            print(line(row.replace(":", ", ").replace("_", " "), case, run(given.tool, folder, text)), flush=True)


if __name__ == "__main__":
    main()
