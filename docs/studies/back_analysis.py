# SPDX-License-Identifier: Apache-2.0
"""Back-analysis tried where the answer is known, and where it was measured.

usage: back_analysis.py STURZ DATA_FOLDER OUT_FOLDER [twins|s1000|full:MEMBERS ...]
DATA_FOLDER holds marsicano_tinitaly (marsicano_10m.tif, release_250m.geojson) and s1000_sthelens (pre_runout_DEM.asc,
landslide_depth.asc, DEM_of_Difference.asc). `twins`: ten members of a slope play the event in turn; one ensemble of 200 others is calibrated
against each, with measurement errors added. `s1000`: the landslide of 2021 by its lengths alone, then held against its measured
thickness and outline: friction alone, friction with pore pressure, with an eroding bed. `full`: the same in full stress
with so many members, friction alone. Prints tables.
"""
import csv
import json
import pathlib
import random
import shutil
import subprocess
import sys

TWIN = """
title: Slope above the village
terrain: {{raster: {data}/marsicano_tinitaly/marsicano_10m.tif}}
release: {{polygon: {data}/marsicano_tinitaly/release_250m.geojson, thickness_m: 12}}
grains: {{density_kg_m3: 2600, solid_fraction: 0.6, friction_angle_deg: 32}}
basal:
  friction_coefficient: {{uniform: [0.40, 0.70]}}
  pore_pressure_ratio: {{uniform: [0.0, 0.3]}}
numerics: {{spacing_m: 10}}
ensemble: {{design: sobol, members: {members}, seed: {seed}}}
"""
# Quantity of the block, column of members.csv, standard deviation of its measurement as a share of the value.
MEASURED = (("runout_m", "crown_to_toe_length_m", 0.02), ("com_travel_m", "com_travel_m", 0.05), ("area_m2", "reached_area_m2", 0.05))

S1000 = """
title: S-1000
terrain: {{raster: {data}/pre_runout_DEM.asc, crs: "EPSG:32149"}}
release: {{thickness_raster: {data}/landslide_depth.asc, thickness_factor: -1, surface: pre_failure}}
grains: {{density_kg_m3: 2650, solid_fraction: 0.6, friction_angle_deg: 32}}
basal: {basal}
formulation: {formulation}
numerics: {{spacing_m: {spacing}}}
{erosion}ensemble: {{design: sobol, members: {members}, seed: 5}}
"""
# Crown to toe over the measured affected cells; way of the centre of mass between source and deposit.
LENGTHS = "observation:\n  runout_m: {value: 782, sd: 20}\n  com_travel_m: {value: 391, sd: 20}\n"
FIELDS = """observation:
  outline: {affected}
  outline_sd_m: 15
  deposit_thickness: {data}/DEM_of_Difference.asc
  thickness_sign: rise_positive
  thickness_sd_m: 0.7
"""
FRICTION = "{friction_coefficient: {uniform: [0.15, 0.40]}}"
WITH_PORES = "{friction_coefficient: {uniform: [0.20, 0.60]}, pore_pressure_ratio: {uniform: [0, 0.5]}}"
BED = "erosion: {law: exponential, growth_rate_per_m: {log_uniform: [5.0e-5, 2.0e-3]}, supply: unlimited}\n"


TITLES = {"twins": "Twins", "s1000": "S-1000, columns", "full": "S-1000, full stress"}


def sturz(program, *words):
    done = subprocess.run([program, *map(str, words)], capture_output=True, text=True, check=False)
    if done.returncode not in (0, 3):
        sys.exit(f"{' '.join(map(str, words))}\n{done.stdout[-2000:]}{done.stderr[-2000:]}")
    return done.stdout + done.stderr


def members(folder):
    with open(folder / "members.csv", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def posterior(folder):
    return json.loads((folder / "posterior.json").read_text())


def twin_block(truth, draw):
    lines = ["observation:"]
    for key, column, share in MEASURED:
        sd = share * float(truth[column])
        lines.append(f"  {key}: {{value: {max(float(truth[column]) + draw.gauss(0, sd), sd):.6g}, sd: {sd:.4g}}}")
    return "\n".join(lines) + "\n"


def twins(program, data, out):
    (out / "truths.yaml").write_text(TWIN.format(data=data, members=16, seed=77))
    (out / "prior.yaml").write_text(TWIN.format(data=data, members=200, seed=3))
    for name in ("truths", "prior"):
        sturz(program, "ensemble", out / f"{name}.yaml", "-o", out / name)
    truths = [m for m in members(out / "truths") if m["censored"] == "none"][:10]
    keys = ("basal.friction_coefficient", "basal.pore_pressure_ratio")
    draw, inside = random.Random(4), {}
    print("| truth: friction, pore pressure | runout m | discrepancy | friction 5 to 95 % | pore pressure 5 to 95 % | inside | smallest Q2 | correlation |")
    print("|---|---|---|---|---|---|---|---|")
    for number, truth in enumerate(truths):
        block = twin_block(truth, draw)
        for discrepancy in ("0", "0.1"):
            folder = out / f"twin_{number}_{discrepancy}"
            shutil.rmtree(folder, ignore_errors=True)
            shutil.copytree(out / "prior", folder)
            scene = out / f"twin_{number}.yaml"
            scene.write_text((out / "prior.yaml").read_text() + block)
            sturz(program, "calibrate", scene, "-o", folder, "--method", "emulator", "--discrepancy", discrepancy, "--no-check")
            found = posterior(folder)
            bands = {k["key"]: k["posterior"] for k in found["keys"]}
            hit = [bands[k]["p5"] <= float(truth[k]) <= bands[k]["p95"] for k in keys]
            inside.setdefault(discrepancy, []).append(hit)
            q2 = min(e["q2"] for e in found["emulators"])
            print(f"| {float(truth[keys[0]]):.3f}, {float(truth[keys[1]]):.3f} | {float(truth['crown_to_toe_length_m']):.0f} | {discrepancy} | "
                  + " | ".join(f"{bands[k]['p5']:.3f} to {bands[k]['p95']:.3f}" for k in keys)
                  + f" | {'yes' if hit[0] else 'NO'}, {'yes' if hit[1] else 'NO'} | {q2:.3f} | {found['identifiability']['correlation'][0][1]:+.2f} |", flush=True)
    for discrepancy, hits in inside.items():
        print(f"discrepancy {discrepancy}: friction inside its 90 % interval in {sum(h[0] for h in hits)} of {len(hits)}, pore pressure in {sum(h[1] for h in hits)}")


def mean(rows, column):
    values = [float(r[column]) for r in rows if r.get(column)]
    return sum(values) / len(values) if values else float("nan")


def s1000_model(program, data, out, name, full, with_bed, basal, n):
    scene = S1000.format(data=data, basal=basal, formulation="full_stress" if full else "depth_averaged", spacing=2.5 if full else 3,
                         erosion=BED if with_bed else "", members=n)
    lengths, fields = out / f"{name}_lengths.yaml", out / f"{name}_fields.yaml"
    lengths.write_text(scene + LENGTHS)
    fields.write_text(scene + FIELDS.format(data=data, affected=data / "affected_one.gpkg"))
    sturz(program, "calibrate", lengths, "-o", out / f"{name}_prior")
    found = posterior(out / f"{name}_prior")
    for key in found["keys"]:
        p = key["posterior"]
        print(f"| {name} | {key['key']} | {p['p5']:.4g} / {p['median']:.4g} / {p['p95']:.4g} | {key['variance_removed']:.2f} | "
              f"{found['sample']['method']} | {', '.join('{:.3f}'.format(e['q2']) for e in found['emulators'])} | {found['identifiability']['correlation'][0][-1]:+.2f} |", flush=True)
    rows = {}
    sturz(program, "ensemble", fields, "-o", out / f"{name}_prior_fields")
    rows["prior"] = members(out / f"{name}_prior_fields")
    sturz(program, "ensemble", fields, "--posterior", out / f"{name}_prior", "-n", n, "-o", out / f"{name}_posterior")
    rows["posterior"] = members(out / f"{name}_posterior")
    return rows


def s1000(program, data, out, full_members):
    data = data / "s1000_sthelens"
    data = prepared(data, out)
    models = {"columns": (False, False, FRICTION, 64), "columns, pore pressure": (False, False, WITH_PORES, 128), "columns, bed": (False, True, FRICTION, 128)}
    if full_members:
        models = {"full stress": (True, False, FRICTION, full_members)}
    print("| model | value | 5 % / median / 95 % | variance removed | method | Q2 | correlation with the last value |\n|---|---|---|---|---|---|---|")
    scored = {name: s1000_model(program, data, out, name, *model) for name, model in models.items()}
    columns = ("score_outline_iou", "score_outline_distance_m", "score_thickness_rmse_m", "score_thickness_volume_ratio", "score_thickness_band_overlap", "eroded_volume_m3")
    print("\n| model | members | " + " | ".join(columns) + " |\n|---|---|" + "---|" * len(columns))
    for name, sets in scored.items():
        for which, rows in sets.items():
            print(f"| {name} | {which} | " + " | ".join(f"{mean(rows, c):.3g}" for c in columns) + " |")


def prepared(data, out):
    """The affected cells as one polygon, and the files beside it."""
    folder = out / "data"
    folder.mkdir(exist_ok=True)
    for name in ("pre_runout_DEM.asc", "landslide_depth.asc", "DEM_of_Difference.asc"):
        shutil.copy(data / name, folder / name)
    if not (folder / "affected_one.gpkg").exists():
        calc = folder / "affected.tif"
        subprocess.run(["gdal_calc.py", "--quiet", "-A", folder / "DEM_of_Difference.asc", f"--outfile={calc}", "--calc=(abs(A)>0.01)*1", "--NoDataValue=0",
                        "--overwrite", "--type=Byte"], check=True)
        subprocess.run(["gdal_polygonize.py", "-q", "-8", calc, folder / "affected.gpkg", "affected"], check=True)
        subprocess.run(["ogr2ogr", "-a_srs", "EPSG:32149", folder / "affected_one.gpkg", folder / "affected.gpkg", "-dialect", "SQLite", "-sql",
                        "SELECT ST_Buffer(geom, 0) AS geom FROM affected ORDER BY ST_Area(geom) DESC LIMIT 1"], check=True)
    return folder.resolve()


def main(program, data, out, *parts):
    out = pathlib.Path(out)
    out.mkdir(parents=True, exist_ok=True)
    data = pathlib.Path(data).resolve()
    for part in parts or ("twins", "s1000", "full:32"):
        name, _, number = part.partition(":")
        print(f"\n### {TITLES[name]}")
        twins(program, data, out) if name == "twins" else s1000(program, data, out, int(number or 0))


if __name__ == "__main__":
    main(*sys.argv[1:])
