# SPDX-License-Identifier: Apache-2.0
"""S-1000 with and without erosion of its bed, beside the measured DEM of difference.

usage: erosion_s1000.py STURZ DATA_FOLDER OUT_FOLDER [SPACING_M]   (needs gdal_translate)
DATA_FOLDER holds pre_runout_DEM.asc, landslide_depth.asc and DEM_of_Difference.asc, OUT_FOLDER takes the
runs. Prints a table; distances are horizontal, from the centre of mass of the source.
"""
import math
import pathlib
import subprocess
import sys

SCENE = """
title: S-1000
terrain: {{raster: {data}/pre_runout_DEM.asc, crs: "EPSG:32149"}}
release: {{thickness_raster: {data}/landslide_depth.asc, thickness_factor: -1, surface: pre_failure}}
grains: {{density_kg_m3: 2650, solid_fraction: 0.6, friction_angle_deg: 32}}
basal: {{friction_coefficient: {friction}}}
formulation: depth_averaged
numerics: {{spacing_m: {spacing}}}
"""
GROWTH = 2.67e-4  # ln((22,481 + 5,126)/22,481)/770 m
EROSION = {
    "none": "",
    "E_s": f"erosion: {{law: exponential, growth_rate_per_m: {GROWTH}, supply: unlimited}}\n",
    "stress": "erosion: {law: shear_stress, supply: unlimited}\n",
}


def read_grid(path):
    head, rows = {}, []
    for line in pathlib.Path(path).read_text().splitlines():
        words = line.split()
        if words and words[0][0].isalpha() and words[0].lower() != "nan":
            head[words[0].lower()] = float(words[1])
        elif words:
            rows.append([float(w) for w in words])
    cell = head.get("cellsize", head.get("dx"))
    north = head["yllcorner"] + cell * len(rows)
    cells = {}
    for r, row in enumerate(rows):
        for c, value in enumerate(row):
            if value != head.get("nodata_value", -9999.0) and not math.isnan(value) and abs(value) < 1e30:
                cells[head["xllcorner"] + (c + 0.5) * cell, north - (r + 0.5) * cell] = value
    return cells, cell


def centre(cells):
    mass = sum(cells.values())
    return (sum(x * v for (x, _), v in cells.items()) / mass, sum(y * v for (_, y), v in cells.items()) / mass)


def measures(deposit, eroded_m3, source, cell, least):
    """Of what lies outside the source: farthest cell, centre of mass, volume."""
    from_ = centre(source)
    outside = {at: v for at, v in deposit.items() if at not in source and v > least}
    far = max(math.dist(at, from_) for at in outside)
    return far, math.dist(centre(outside), from_), sum(outside.values()) * cell * cell, eroded_m3


def layer(folder, name):
    out = folder / f"{name}.asc"
    subprocess.run(["gdal_translate", "-q", "-of", "AAIGrid", f'NETCDF:"{folder}/peaks.nc":{name}', out], check=True)
    return read_grid(out)


def run(sturz, folder, text):
    folder.mkdir(parents=True, exist_ok=True)
    scene = folder / "scene.yaml"
    scene.write_text(text)
    subprocess.run([sturz, "run", scene, "-o", folder / "out", "--replace"], check=True, capture_output=True)
    return folder / "out"


def main(sturz, data, out, spacing="3"):
    data, out = pathlib.Path(data).resolve(), pathlib.Path(out)
    depth, cell = read_grid(data / "landslide_depth.asc")
    source = {at: -v for at, v in depth.items() if v < 0}  # the file counts depths as negative
    difference, _ = read_grid(data / "DEM_of_Difference.asc")
    taken = sum(-v for at, v in difference.items() if v < 0 and at not in source) * cell * cell
    # Cells of the raster lie where its decimals put them: match them by rounding.
    print("| friction | erosion | farthest deposit cell m | centre of mass m | deposit outside m3 | eroded m3 | V_f/V_0 |")
    print("|---|---|---|---|---|---|---|")
    far, com, volume, _ = measures({at: v for at, v in difference.items() if v > 0}, taken, source, cell, 0.0)
    print(f"| measured | | {far:.0f} | {com:.0f} | {volume:,.0f} | {taken:,.0f} | {1 + taken / (sum(source.values()) * cell**2):.3f} |")
    near = {(round(x), round(y)): v for (x, y), v in source.items()}
    for friction in (0.265, 0.25, 0.235, 0.22):
        for name, block in EROSION.items():
            text = SCENE.format(data=data, friction=friction, spacing=spacing) + block
            folder = run(sturz, out / f"{friction}_{name}_{spacing}", text)
            deposit, size = layer(folder, "deposit_thickness")
            deposit = {(round(x), round(y)): v for (x, y), v in deposit.items()}
            eroded = 0.0
            if block:
                eroded = sum(layer(folder, "eroded_depth")[0].values()) * size * size
            far, com, volume, eroded = measures(deposit, eroded, near, size, 0.05)
            growth = 1 + eroded / (sum(source.values()) * cell**2)
            print(f"| {friction} | {name} | {far:.0f} | {com:.0f} | {volume:,.0f} | {eroded:,.0f} | {growth:.3f} |", flush=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
