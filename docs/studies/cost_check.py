# SPDX-License-Identifier: Apache-2.0
"""Is what `sturz cost` says true? Three scenes in columns, two of them in full stress, each checked by a spacing that no estimate sees.

usage: cost_check.py STURZ CASES DATA OUT [SCENE ...]    (names of SPACINGS below; when absent the three in columns)
DATA holds marsicano_tinitaly (marsicano_10m.tif of TINITALY, CC BY 4.0, and release_250m.geojson). 16 draws of each scene at 2,
1.5 and 1 times its own spacing (6 m where Zhangjiawan is full stress), and at half of it, which `--check` keeps from the estimates. Prints tables in Markdown: what was
said, what was found. Six core minutes, full stress another forty; begun folders go on.
"""
import json
import math
import pathlib
import subprocess
import sys

MARSICANO = """title: A made-up source on Monte Marsicano
terrain: {{raster: {data}/marsicano_tinitaly/marsicano_10m.tif}}
release: {{polygon: {data}/marsicano_tinitaly/release_250m.geojson, volume_m3: {{lognormal: {{median: 1200000, sigma_ln: 0.15, min: 700000, max: 1900000}}}}, surface: pre_failure, floor: tapered}}
grains: {{density_kg_m3: 2650, solid_fraction: 0.6, friction_angle_deg: 34}}
basal: {{friction_coefficient: {{uniform: [0.32, 0.5]}}}}
formulation: depth_averaged
numerics: {{spacing_m: 10}}
ensemble: {{design: sobol, members: 256, seed: 1}}
hazard: {{thickness_m: [0.5, 1, 2, 5]}}
"""
FULL_STRESS = "_full_stress"
SPACINGS = {"zhangjiawan": (8, 6, 4, 2), "marsicano": (20, 15, 10, 5), "usgs_flume": (0.2, 0.15, 0.1, 0.05),
            "zhangjiawan" + FULL_STRESS: (12, 9, 6, 3), "marsicano" + FULL_STRESS: (20, 15, 10, 5)}
TOLERATED = 2  # said over found, or the other way


def scene_of(name, cases, data, out):
    if not name.startswith("marsicano"):
        return cases / name.removesuffix(FULL_STRESS) / "scenario.yaml"
    path = out / "marsicano.yaml"
    path.write_text(MARSICANO.format(data=data))
    return path


def study(sturz, scene, folder, spacings):
    *rungs, held_out = spacings
    formulation = "full_stress" if folder.name.endswith(FULL_STRESS) else "depth_averaged"
    subprocess.run([sturz, "cost", scene, "--set", f"formulation={formulation}", "-n", "16", "--workers", "1", "--spacings", ",".join(map(str, rungs)),
                    "--check", str(held_out), "-o", folder], check=True, stdout=subprocess.DEVNULL)
    return json.loads((folder / "cost.json").read_text())["ladders"][0]


def percent(share):
    return "" if share is None else f"{100 * share:.2g} %"


def recommended(ladder):
    """The coarsest computed spacing that is no coarser than the chosen one; the finest where none was enough."""
    chosen = ladder["cheapest"]["spacing_m"]
    return next((d for d in ladder["spacings_m"] if chosen is not None and d <= chosen * (1 + 1e-9)), ladder["spacings_m"][-1])


def means_met(rows):
    return sum(0.5 <= r["said_mean"] / r["found_mean"] <= 2 for r in rows if r["said_mean"] and r["found_mean"]), sum(r["said_mean"] is not None for r in rows)


def show(name, ladder, held_out):
    where = recommended(ladder)
    rows = [r for r in ladder["checked"] if r["said"] is not None and r["found"] is not None]  # a threshold that nothing reaches tells none
    here = [r for r in rows if r["spacing_m"] == where]
    means, of = means_met(here)
    known = min(r["members"] for r in ladder["results"])
    print(f"\n**{name}**, beside {held_out:g} m ({ladder['members_used']} of 16 members valid throughout, {known} known): at {where:g} m "
          f"**{sum(r['met'] for r in here)} of {len(here)}** within a factor of {TOLERATED}, at all three spacings {sum(r['met'] for r in rows)} of {len(rows)}; "
          f"of the means {means} of {of}.\n")
    print("| | spacing m | said | found | factor | noise | met | mean: said | found |\n|---|---|---|---|---|---|---|---|---|")
    for r in sorted(rows, key=lambda row: row["spacing_m"]):
        ratio = r["said"] / r["found"] if r["found"] else math.inf
        print(f"| {r['name']} | {r['spacing_m']:g} | {percent(r['said'])} | {percent(r['found'])} | {ratio:.2f} | {percent(r['noise'])} | {'yes' if r['met'] else 'no'} "
              f"| {percent(r['said_mean'])} | {percent(r['found_mean'])} |")


def main(sturz, cases, data, out, *names):
    cases, out = pathlib.Path(cases), pathlib.Path(out)
    out.mkdir(parents=True, exist_ok=True)
    for name in names or (name for name in SPACINGS if not name.endswith(FULL_STRESS)):
        show(name, study(sturz, scene_of(name, cases, data, out), out / name, SPACINGS[name]), SPACINGS[name][-1])


if __name__ == "__main__":
    main(*sys.argv[1:])
