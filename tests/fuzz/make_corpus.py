#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes the seeds of a fuzz target. Usage: make_corpus.py TARGET ROOT BUILD_FOLDER

Binary formats are made by the tools of GDAL, and by BUILD_FOLDER/fuzz_seeds."""
import json
import pathlib
import re
import subprocess
import sys
import tempfile

RELEASES = [
    "polygon: a.gpkg, layer: l, thickness_attribute: h, crs: 'EPSG:1'",
    "thickness_raster: h.tif, volume_m3: {discrete: {values: [1, 2], weights: [1, 3]}}",
    "box: {x_m: [0, 1], y_m: [0, 1]}, thickness_m: {table: [3, 1, 2]}",
    "paraboloid: {center_m: [0, 0], semi_axes_m: [5, 5]}, thickness_m: {uniform: {min: 1, max: 2}}",
    "cylinder: {center_m: [0, 0], radius_m: 5}, volume_m3: {log_uniform: [1, 100]}",
]
TERRAINS = [
    "raster: bed.tif, crs: EPSG:32648, cell_size_m: 5, nodata: wall",
    "synthetic: {ramp: {cell_size_m: 1, slope_deg: 30, azimuth_deg: 45}}",
    "synthetic: {flume: {cell_size_m: 0.05}}",
]
BASALS = [
    "friction_coefficient: {truncated_normal: {mean: 0.3, sd: 0.1, min: 0, max: 1}}, "
    "pore_pressure_ratio: {beta: {alpha: 4, beta: 3, min: 0.0, max: 0.6}}",
    "friction_coefficient: {lognormal: {median: 0.3, sigma_ln: 0.2, max: 2}}, restitution: 0.1",
    "turbulent_coefficient_m_s2: 500, viscosity_pa_s: 50, yield_stress_pa: {uniform: [10, 90]}, "
    "zones: [{polygon: a.gpkg, layer: l, friction_coefficient: 0.3}, {polygon: b.gpkg, "
    "pore_pressure_ratio: 0.85, cohesion_pa: 0}]",
]
TAIL = """numerics: {spacing_m: 5}
domain:
  periodic: [y]
  walls: [{point_m: [3, 0, 0], normal: [0, 1, 0], friction_coefficient: 0.3, remove_at_s: 0}]
ensemble: {design: sobol, members: 16, correlation: {basal.friction_coefficient/release.thickness_m: -0.3}}
"""
BAD = ["", "a: *b", "&a [*a]", "? [x]: 1", "<<: {a: 1}", "--- 1\n--- 2", "a: !!binary x", "[" * 40,
       "a: {a: 1, a: 2}", "x: |\n  y\n", "x: >-\n  y\n", "\"\\x41\": 'b''c'", "# c\n...\n", "%YAML 1.2\n---\na: 1",
       "fluid: {}", "grains.friction: 1", "title: {", "- - - 1"]


def scenario_seeds(root, _build, _scratch):
    for case in sorted((root / "scenarios" / "cases").glob("*/scenario.yaml")):
        text = case.read_text()
        yield text
        yield re.sub(r" *#.*", "", text)
        yield text + "\0numerics.spacing_m=9"
        for block in re.split(r"\n\n", text):
            yield block
    for i, release in enumerate(RELEASES):
        terrain, basal = TERRAINS[i % len(TERRAINS)], BASALS[i % len(BASALS)]
        yield (f"title: t{i}\nterrain: {{{terrain}}}\nrelease: {{{release}}}\n"
               f"grains: {{friction: {{static: 0.3, dynamic: 0.6}}}}\nbasal: {{{basal}}}\n{TAIL}"
               "\0basal.restitution=0.5")
    yield from BAD


DESIGNS = [
    "release.thickness_m,basal.friction_coefficient\n1.5,0.3\n2,0.25\n",
    "basal.friction_coefficient,release.thickness_m\n0.3,1.5\n",
    "member,release.thickness_m,basal.friction_coefficient\r\n0,2.5,0.1\r\n1,3,0.2\r\n",
    "# design table: one row per member, drawn once\n# design: sobol\n# seed: 18446744073709551615\n"
    "# units: m,1\nmember,release.thickness_m,basal.friction_coefficient,"
    "unit_cube:release.thickness_m,unit_cube:basal.friction_coefficient\n"
    "0,1.5,0.29999999999999999,0.25,0.5\n1,2.5,0.40000000000000002,0.75,0.84\n",
    "# design: monte_carlo\n# seed: 1\n# units: \nmember\n0\n1\n",
    "\ufeff\"release.thickness_m\";\"x\"\n1;2\n", "\"a\",\"b\"\n\"1\",\"2\"\n", "a\n1e308\n-0\n", "a\nnan\n",
]


def design_seeds(_root, _build, _scratch):
    yield from DESIGNS


HYDROGRAPHS = [
    "time_s,discharge_m3_s\n0,0\n600,12.5\n3600,0\n",
    "# gauge\r\ndischarge_l_s,time_h,solid_fraction\r\n0,0,0.5\r\n2e3,1.5,0.6\r\n0,2,0.4\r\n",
    "\ufeff\"time_min\",\"discharge_m3_s\"\n0,1e-300\n1e-9,1e7\n5,0\n", "time_s;discharge_m3_s\n0;1\n",
    "time_s,discharge_m3_s\n0,0\n1,0\n2,3\n3,0\n4,0\n", "time_s,discharge_m3_s\n1,nan\n0,-1\n0,1,2\n",
]


def hydrograph_seeds(_root, _build, _scratch):
    yield from HYDROGRAPHS


RISKS = [
    "scenarios:\n  - {folder: a, frequency_per_year: 0.01}\n  - {folder: b, frequency_per_year: 1e-3}\n",
    "scenarios: [{folder: a, frequency_per_year: 100}]\nreturn_periods_years: [1, 2.5]\n"
    "probability_classes_years: [1, 2, 3]\nstrong_thickness_m: 2\nstrong_speed_m_s: .5\n",
    "timber: {pressure_kpa: [[5, 0], [30, 1]]}\nroad: {thickness_m: [[0, 0.1], [1e6, 0.1]]}\n",
    "a: {energy_kj_m2: [[1.5, 1]]}\nb: {speed_m_s: [[1, nan], [0, 2]]}\n", "scenarios: 3\n", "a: [1]\n",
]


def risk_seeds(_root, _build, _scratch):
    yield from RISKS


MANIFEST = {
    "kind": "ensemble",
    "program": {"name": "sturz", "version": "0.1.0", "git_commit": "0123abc", "compiler": "GNU 12",
                "build_type": "Release"},
    "started": "2026-01-31T12:00:00Z", "updated": "2026-01-31T12:00:00Z", "command": "sturz",
    "design": "sobol", "seed": 18446744073709551615, "members": 16, "spacing_m": 2.5,
    "inputs": [{"role": "terrain.raster", "file": "bed.tif", "shape": "3 x 3 cells", "parts": {"0/0": "01"}}], "description": ["a", "b"],
    "notes": [], "warnings": ["thin"], "compute_s": 1.5, "hazard_hash": "0123456789abcdef"}


def manifest_seeds(_root, _build, _scratch):
    yield json.dumps(MANIFEST)
    yield json.dumps(MANIFEST, indent=2)
    for key in MANIFEST:
        for value in (None, 1e300, -1, 0.5, "x", [], {}, [[1]]):
            yield json.dumps(MANIFEST | {key: value})
    yield from ("", "[]", "{", "[" * 200, "{\"kind\": \"\\ud800\"}", "1e999")


GRID = "ncols 4\nnrows 3\nxllcorner {x}\nyllcorner {y}\ncellsize {cell}\nNODATA_value -9999\n"
VALUES = "1 2 0.5 -9999\n0 1 1 0\n2 2 3 1\n"
# Where the cells lie: on the target's terrain, in degrees, in feet, far away.
PLACES = [(500000, 4600000, 10, "EPSG:32633"), (500003, 4600004, 7.5, "EPSG:32633"),
          (15.0001, 41.5505, 0.0002, "EPSG:4326"), (1640420, 15091863, 30, "EPSG:2229"),
          (0, 0, 1, None)]
ROTATED = "<GeoTransform>500010, 8, 3, 4600060, 3, -8</GeoTransform>"


def run(*words):
    subprocess.run([str(word) for word in words], check=True, stdout=subprocess.DEVNULL)


def raster_seeds(_root, _build, scratch):
    for i, (x, y, cell, crs) in enumerate(PLACES):
        text = GRID.format(x=x, y=y, cell=cell) + VALUES
        yield text
        grid = scratch / f"grid{i}.asc"
        grid.write_text(text)
        system = ["-a_srs", crs] if crs else []
        variants = {"plain": [], "scaled": ["-a_scale", "0.01", "-a_offset", "2", "-ot", "Int16"],
                    "wide": ["-ot", "Float64", "-outsize", "7", "3"], "bytes": ["-ot", "Byte"]}
        for name, words in variants.items():
            run("gdal_translate", "-q", *system, *words, grid, scratch / f"{name}{i}.tif")
            yield (scratch / f"{name}{i}.tif").read_bytes()
        run("gdal_translate", "-q", "-of", "VRT", *system, grid, scratch / "turned.vrt")
        turned = re.sub("<GeoTransform>.*</GeoTransform>", ROTATED,
                        (scratch / "turned.vrt").read_text())
        (scratch / "turned.vrt").write_text(turned)
        run("gdal_translate", "-q", scratch / "turned.vrt", scratch / "turned.tif")
        yield (scratch / "turned.tif").read_bytes()
        for driver, suffix in (("GSAG", "asag"), ("GSBG", "gsbg"), ("GS7BG", "gs7bg")):
            run("gdal_translate", "-q", "-of", driver, grid, scratch / f"surfer{i}.{suffix}")
            yield (scratch / f"surfer{i}.{suffix}").read_bytes()


def ring(x, y, edge):
    corners = ((0, 0), (edge, 0), (edge, edge), (0, edge), (0, 0))
    return [[x + dx, y + dy] for dx, dy in corners]


def features():
    x, y = 500000, 4600000
    yield "Polygon", [ring(x, y, 50)], {"h": 1.5}
    yield "Polygon", [ring(x, y, 50), ring(x + 10, y + 10, 20)], {"h": 2}
    yield "MultiPolygon", [[ring(x, y, 10)], [ring(x + 30, y, 10)]], {"h": 0.5}
    yield "Polygon", [[[x, y], [x + 40, y + 40], [x + 40, y], [x, y + 40], [x, y]]], {"h": 1}
    yield "Polygon", [ring(15.0001, 41.5505, 0.0003)], {"h": 1}
    yield "LineString", ring(x, y, 10), {"h": 1}


def polygon_seeds(_root, _build, scratch):
    drawn = [{"type": "Feature", "properties": values,
              "geometry": {"type": kind, "coordinates": places}}
             for kind, places, values in features()]
    drawn.append({"type": "Feature", "properties": {"h": None}, "geometry": {
        "type": "GeometryCollection", "geometries": [drawn[0]["geometry"], drawn[2]["geometry"]]}})
    for i, some in enumerate([[one] for one in drawn] + [drawn[0:2], drawn[0:1] + drawn[2:3]]):
        for code in (32633, 4326):
            system = {"type": "name", "properties": {"name": f"urn:ogc:def:crs:EPSG::{code}"}}
            text = json.dumps({"type": "FeatureCollection", "crs": system, "features": some})
            yield text
        source = scratch / f"{i}.geojson"
        source.write_text(text)
        for suffix, words in (("shp", ["-lco", "SHPT=POLYGON"]), ("gpkg", [
                "--config", "OGR_SQLITE_PRAGMA", "page_size=512", "-lco", "SPATIAL_INDEX=NO"])):
            target = scratch / f"{i}.{suffix}"
            done = subprocess.run(["ogr2ogr", "-a_srs", "EPSG:32633", *words, target, source],
                                  stderr=subprocess.DEVNULL, check=False)
            if done.returncode != 0:  # a line is no polygon
                continue
            if suffix == "gpkg":
                yield target.read_bytes()
            else:
                index, table = target.with_suffix(".shx"), target.with_suffix(".dbf")
                yield (target.read_bytes() + b"<<shx>>" + index.read_bytes() + b"<<dbf>>" +
                       table.read_bytes())
    yield json.dumps(drawn[0])
    yield json.dumps(drawn[0]["geometry"])


def netcdf_seeds(_root, build, _scratch):
    (build / "valid").mkdir(exist_ok=True)
    run(build / "fuzz_seeds", build / "valid")
    for which in range(3):  # which of the valid files; then what to change in it
        yield bytes([which])
        yield bytes(range(which, 200, 7))


def pack_seeds(_root, _build, _scratch):
    for n in (1, 30, 90, 250, 700):  # which of the three kinds, and numbers for it, from the end
        yield bytes((7 * k * k + n) % 256 for k in range(n))
        yield bytes(n)


SEEDS = {"scenario": scenario_seeds, "design": design_seeds, "hydrograph": hydrograph_seeds,
         "risk": risk_seeds,
         "manifest": manifest_seeds, "pack": pack_seeds,
         "rasters": raster_seeds, "polygons": polygon_seeds, "netcdf": netcdf_seeds}


def main(target, root, build):
    build = pathlib.Path(build).resolve()
    corpus = build / f"corpus_{target}"
    corpus.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as scratch:
        for n, seed in enumerate(SEEDS[target](pathlib.Path(root), build, pathlib.Path(scratch))):
            seed = seed.encode("utf-8", "surrogatepass") if isinstance(seed, str) else seed
            (corpus / f"seed_{n:03}").write_bytes(seed)


if __name__ == "__main__":
    main(*sys.argv[1:])
