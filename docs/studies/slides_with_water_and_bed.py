# SPDX-License-Identifier: Apache-2.0
"""Two slides of the shipped cases with what the cases leave out: Zhangjiawan's bed, Shuicheng's water and bed.

usage: slides_with_water_and_bed.py STURZ OUT [zhangjiawan|shuicheng]   (5 min of CPU each at most)
OUT takes the runs. Prints a table beside published figures. Nothing is fitted: friction is that of the paper or of the case,
growth follows from the published volumes, water from published densities and viscosity.
"""
import json
import math
import pathlib
import subprocess
import sys

EAST, NORTH = 500000, 2900000  # false origin of both grounds
APRON = (230, 640)  # of Zhangjiawan, from the crown along the path [m]: foot of the cliff and 400 m below it
ZHANGJIAWAN = """
title: Zhangjiawan-like, with a bed
terrain: {synthetic: {zhangjiawan: {cell_size_m: 5}}}
release: {volume_m3: 491000}
grains: {density_kg_m3: 2400, solid_fraction: 0.70, friction_angle_deg: 24}
basal: {friction_coefficient: %s}
formulation: depth_averaged
numerics: {spacing_m: 4, end_time_s: 180}
hazard: {cell_size_m: 5}
"""
BED = """
erosion: {law: exponential, growth_rate_per_m: %s, supply: unlimited, polygon: %s, crs: "EPSG:32648"}
"""
SHUICHENG = """
title: Shuicheng-like, wet
terrain: {synthetic: {shuicheng: {cell_size_m: 5}}}
release: {volume_m3: 700000}
grains: {density_kg_m3: 2800, solid_fraction: %s}
mixture: {fluid_density_kg_m3: 1200, fluid_viscosity_pa_s: 0.2, permeability_m2: %s, critical_solid_fraction: 0.64%s}
basal: {friction_coefficient: 0.5}
formulation: depth_averaged
numerics: {spacing_m: 4, end_time_s: 180}
hazard: {cell_size_m: 5}
"""
DRY = """
title: Shuicheng-like, a fixed share of pore pressure
terrain: {synthetic: {shuicheng: {cell_size_m: 5}}}
release: {volume_m3: 700000}
grains: {density_kg_m3: 2800, solid_fraction: 0.6, friction: {static: 0.38, dynamic: 0.64, inertial_number_scale: 0.3}}
basal: {friction_coefficient: 0.5, pore_pressure_ratio: %s}
formulation: depth_averaged
numerics: {spacing_m: 4, end_time_s: 180}
hazard: {cell_size_m: 5}
"""


def run(sturz, folder, text):
    folder.mkdir(parents=True, exist_ok=True)
    scene = folder / "scene.yaml"
    scene.write_text(text)
    done = subprocess.run([sturz, "run", scene, "-o", folder / "out", "--replace", "--threads", "1", "--json"],
                          check=True, capture_output=True, text=True).stdout
    return [json.loads(line) for line in done.splitlines() if '"done"' in line][-1]


def apron(folder):
    (west, east), (south, north) = (EAST + APRON[0], EAST + APRON[1]), (NORTH - 300, NORTH + 300)
    ring = [[west, south], [east, south], [east, north], [west, north], [west, south]]
    path = folder / "apron.geojson"
    folder.mkdir(parents=True, exist_ok=True)
    path.write_text(json.dumps({"type": "FeatureCollection", "features": [
        {"type": "Feature", "properties": {}, "geometry": {"type": "Polygon", "coordinates": [ring]}}]}))
    return path.resolve()


def number(value, digits=0):
    return "-" if value is None or math.isnan(value) else f"{value:,.{digits}f}"


def line(name, done):
    s = done["scalars"]
    end = {"settled": "rest", "out_of_time": "moves", "left_terrain": "the rest at rest"}.get(done.get("outcome", ""), done.get("outcome", ""))
    left = (s["lost_fraction"] or 0) > 0.001
    volume = math.nan if left else s["release_volume_m3"] + (s["eroded_volume_m3"] or 0)
    gone = f", {100 * s['lost_fraction']:.0f} % left" if left else ""
    mean = volume / s["deposit_area_m2"] if s["deposit_area_m2"] else math.nan
    return (f"| {name} | {number(s['max_speed_m_s'])} | {number(s['com_travel_m'])} | {number(s['crown_to_toe_length_m'])} |"
            f" {number(s['reached_area_m2'] / 1e4, 1)} / {number(s['deposit_area_m2'] / 1e4, 1)} | {number(s['max_deposit_m'], 1)} |"
            f" {number(mean, 1)} | {number(volume / 1e4, 1)} | {s['end_time_s']:.0f} s, {end}{gone} |")


HEAD = ("| inputs | fastest m/s | centre of mass m | crown to toe m | reached / deposit 1e4 m2 | thickest m | mean m |"
        " volume at the end 1e4 m3 | until |\n|---|---|---|---|---|---|---|---|---|")


def zhangjiawan(sturz, out):
    growth = math.log(82.3 / 49.1) / (APRON[1] - APRON[0])
    print(f"Zhangjiawan, E_s = {growth:.2e} 1/m over {APRON[0]} to {APRON[1]} m\n{HEAD}")
    print("| published | 21-44, 31.6 seismic | | 840 | / 20.6 | 12.5-12.7 computed, 4 at most seen | 4 | 82.3 | 78 s |")
    polygon = apron(out / "zhangjiawan")
    for friction in (0.24, 0.30, 0.363):
        for name, rate in (("none", 0), ("E_s", growth), ("2 E_s", 2 * growth)):
            text = ZHANGJIAWAN % friction + (BED % (f"{rate:.4e}", polygon) if rate else "")
            done = run(sturz, out / "zhangjiawan" / f"{friction}_{name.replace(' ', '')}", text)
            print(line(f"friction {friction}, bed {name}", done), flush=True)


def shuicheng(sturz, out):
    print(f"\nShuicheng, grains' friction 0.5, fluid 1200 kg/m3 and 0.2 Pa s\n{HEAD}")
    for row in ("I dry, computed | 14 | 300 | 600 | 11 / | 24 | | 70-200 | |", "II r_u 0.2, computed | 25.5 | 500 | 850 | 21 / | 21 | | | |",
                "III drag of a slurry, computed | 32 | 650 | 1,000 | 26 / | 23 | | | |", "IV both, computed | 38 | 760 | 1,360 | 32 / | 21 | | | |",
                "the landslide | 25-45 | 770 | 1,295-1,360 | 33 / | 20 | 6 | 116-200 | 60 s |"):
        print(f"| {row}")
    for ratio in (0, 0.2):
        done = run(sturz, out / "shuicheng" / f"r_u_{ratio}", DRY % ratio)
        print(line(f"here: no mixture, r_u {ratio}", done), flush=True)
    growth = math.log(116 / 70) / 1000
    bed = f"erosion: {{law: exponential, growth_rate_per_m: {growth:.3e}, supply: unlimited}}\n"
    rows = [(m, k, "", "") for k in ("1e-10", "1e-8") for m in (0.50, 0.60, 0.62, 0.63, 0.64, 0.66)]
    rows += [(0.50, "3e-4", "", ""), (0.60, "3e-4", "", ""), (0.60, "1e-10", ", pressure_profile: resolved", ""),
             (0.64, "1e-10", ", pressure_profile: resolved", ""), (0.64, "1e-8", ", pressure_profile: resolved", ""),
             (0.60, "1e-10", ", pressure_profile: resolved, drainage: both", ""), (0.60, "1e-10", "", bed),
             (0.64, "1e-10", "", bed), (0.64, "1e-8", "", bed)]
    for index, (m, k, extra, erosion) in enumerate(rows):
        done = run(sturz, out / "shuicheng" / f"row{index}", SHUICHENG % (m, k, extra) + erosion)
        name = f"here: m0 {m}, k {k} m2{extra}" + (f", bed E_s {growth:.1e} 1/m" if erosion else "")
        print(line(name, done), flush=True)


def main(sturz, out, which=""):
    out = pathlib.Path(out).resolve()
    if which != "shuicheng":
        zhangjiawan(sturz, out)
    if which != "zhangjiawan":
        shuicheng(sturz, out)


if __name__ == "__main__":
    main(*sys.argv[1:])
