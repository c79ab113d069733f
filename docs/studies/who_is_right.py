# SPDX-License-Identifier: Apache-2.0
"""The same slide in columns, in full stress at 3, 6 and 12 layers, and grain by grain.

usage: who_is_right.py ENERGY_OF OUT [--case zhangjiawan|flume] [--rows columns,full_3,full_6,full_12,discrete]
                       [--seed N] [--overlap X] [--diameter D]
                       [--more "bed_rolling_friction: 0"]
ENERGY_OF is the target `energy_of` (build/release/tests/tools). OUT takes the runs; one that is there is not made
again. Prints one line of a table per row. Nothing is fitted: all rows
have the friction of the paper (0.24 on the bed, 24 degrees inside; no pore pressure).
"""
import argparse
import json
import pathlib
import subprocess

THICKNESS = 42  # of the release, median: layers of full stress are counted on it [m]
ZHANGJIAWAN = """
title: Zhangjiawan-like, {row}
terrain: {{synthetic: {{zhangjiawan: {{cell_size_m: 5}}}}}}
release: {{volume_m3: 491000}}
grains: {{density_kg_m3: 2400, diameter_m: 3, solid_fraction: 0.70{inside}}}
basal: {{friction_coefficient: 0.24}}
formulation: {formulation}
numerics: {{spacing_m: {spacing}, end_time_s: 120, accept_unresolved: true}}
ensemble: {{seed: {seed}}}
hazard: {{cell_size_m: 10}}
"""
# The dry tenth of the flume of the U.S. Geological Survey: its mass as stones of 10 cm, without water.
FLUME = """
title: Debris-flow flume, dry, {row}
terrain: {{synthetic: {{debris_flume: {{cell_size_m: 0.1}}}}}}
release: {{volume_m3: 10}}
grains: {{density_kg_m3: 2700, diameter_m: 0.1, solid_fraction: 0.61{inside}}}
basal: {{friction_coefficient: 0.45}}
formulation: {formulation}
numerics: {{spacing_m: {spacing}, end_time_s: 30, accept_unresolved: true}}
ensemble: {{seed: {seed}}}
hazard: {{cell_size_m: 0.5}}
"""
ANGLE = {"zhangjiawan": 24, "flume": 32}
GRAIN = {"zhangjiawan": 3, "flume": 0.1}
TEXT = {"zhangjiawan": ZHANGJIAWAN, "flume": FLUME}
DEPTH = {"zhangjiawan": THICKNESS, "flume": 1.2}
COLUMN_SPACING = {"zhangjiawan": 4, "flume": 0.1}


def scene(case, row, seed, overlap, diameter, more):
    inside = f", friction_angle_deg: {ANGLE[case]}"
    formulation, spacing = "depth_averaged", COLUMN_SPACING[case]
    if row.startswith("full_"):
        formulation, spacing = "full_stress", DEPTH[case] / int(row.removeprefix("full_"))
    if row == "discrete":
        formulation, inside = "discrete", f", discrete: {{greatest_overlap: {overlap}, diameter_m: {diameter:g}{more}}}"
    return TEXT[case].format(row=row, inside=inside, formulation=formulation, spacing=spacing, seed=seed)


def run(tool, folder, text):
    folder.mkdir(parents=True, exist_ok=True)
    kept = folder / "done.json"
    if kept.exists() and (folder / "scene.yaml").read_text() == text:
        return json.loads(kept.read_text())
    (folder / "scene.yaml").write_text(text)
    done = json.loads(subprocess.run([tool, folder / "scene.yaml"], check=True, capture_output=True,
                                     text=True).stdout)
    kept.write_text(json.dumps(done))
    return done


def line(row, d):
    def share(*parts):
        return f"{100 * sum(d[part] for part in parts) / d['released_j']:.1f}"
    cells = [row, f"{d['n_particles']:,.0f}", f"{d['layers']:.1f}", f"{d['front_m']:.0f}", f"{d['runout_m']:.0f}",
             f"{d['com_m']:.0f}", f"{d['com_drop_m']:.1f}", f"{d['com_ratio']:.3f}", share("bed_j"),
             share("inside_j"), share("impacts_j"), share("numerical_j"), f"{d['speed_m_s']:.1f}",
             f"{d['deposit_m2'] / 1e4:.2f}", f"{d['max_deposit_m']:.1f}", f"{d['end_s']:.0f} {d['outcome']}",
             f"{d['n_steps']:,.0f}", f"{d['cpu_s']:.1f}"]
    return "| " + " | ".join(cells) + " |"


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("tool")
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--case", choices=TEXT, default="zhangjiawan")
    parser.add_argument("--rows", default="columns,full_3,full_6,full_12,discrete")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--overlap", type=float, default=0.1)
    parser.add_argument("--diameter", type=float, help="of the grains [m]; 3, in the flume 0.1")
    parser.add_argument("--more", default="", help="further keys of grains.discrete")
    given = parser.parse_args()
    more = f", {given.more}" if given.more else ""
    diameter = given.diameter or GRAIN[given.case]
    print("| row | particles | layers | front m | run-out m | centre of mass m | its fall m | fall / way | bed % |"
          " inside % | impacts % | numerical % | speed m/s | deposit ha | largest deposit m | end s | steps | CPU s |")
    print("|" + "---|" * 18, flush=True)
    for row in given.rows.split(","):
        name = row if row != "discrete" else f"discrete_{diameter:g}_{given.overlap:g}_{given.seed}{more}"
        text = scene(given.case, row, given.seed, given.overlap, diameter, more)
        folder = given.out / given.case / name.replace(" ", "").replace(":", "=")
        print(line(name, run(given.tool, folder, text)), flush=True)


if __name__ == "__main__":
    main()
