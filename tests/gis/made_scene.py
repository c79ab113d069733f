# SPDX-License-Identifier: Apache-2.0
"""A small scene on the map with everything that a GIS shows, and the program on it."""
import json
import os
import pathlib
import subprocess

EPSG, WEST, NORTH, CELL = 32633, 500000.0, 4600000.0, 10.0
COLUMNS, ROWS = 110, 60
TITLE = "Hang <Süd> & Co"

SCENE = """\
title: "Hang <Süd> & Co"
terrain: {raster: ground.asc, crs: "EPSG:32633"}
release: {polygon: source.geojson, thickness_m: 4}
grains: {density_kg_m3: 2600, solid_fraction: 0.6}
basal:
  friction_coefficient: {uniform: [0.2, 0.45]}
numerics: {spacing_m: 8, end_time_s: 60}
ensemble: {design: sobol, members: 8, seed: 1}
hazard: {thickness_m: [0.5, 1], speed_m_s: [5], energy_kj_m2: [100], pressure_kpa: [30]}
observation: {outline: event.geojson, outline_sd_m: 20, thalweg: thalweg.geojson}
assets: {features: houses.geojson, name_attribute: name}
gauges:
  points: [{name: bridge, at_m: [500500, 4599700]}]
formulation: depth_averaged
"""


def layer(kind, shapes):
    """GeoJSON text of named shapes in the scene's system."""
    return json.dumps({
        "type": "FeatureCollection", "crs": {"type": "name", "properties": {"name": f"urn:ogc:def:crs:EPSG::{EPSG}"}},
        "features": [{"type": "Feature", "properties": {"name": name}, "geometry": {"type": kind, "coordinates": at}}
                     for name, at in shapes.items()]})


def square(west, south, east, north):
    x, y = WEST, NORTH
    return [[[x + west, y + south], [x + east, y + south], [x + east, y + north], [x + west, y + north],
             [x + west, y + south]]]


def write_scene(folder):
    """Slope of 30 degrees to the east, level ground from 500 m on, in a shallow valley along its middle."""
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    lines = [f"ncols {COLUMNS}", f"nrows {ROWS}", f"xllcorner {WEST}", f"yllcorner {NORTH - ROWS * CELL}",
             f"cellsize {CELL}", "NODATA_value -9999"]
    for row in range(ROWS):
        across = (row + 0.5) * CELL - ROWS * CELL / 2
        lines.append(" ".join(
            f"{500 + max(0.0, 500 - (col + 0.5) * CELL) * 0.577 + 0.0005 * across * across:.4f}" for col in range(COLUMNS)))
    (folder / "ground.asc").write_text("\n".join(lines) + "\n")
    (folder / "source.geojson").write_text(layer("Polygon", {"source": square(60, -350, 160, -250)}))
    (folder / "event.geojson").write_text(layer("Polygon", {"event": square(60, -380, 700, -220)}))
    (folder / "thalweg.geojson").write_text(layer("LineString", {"path": [[WEST + 60, NORTH - 300], [WEST + 900, NORTH - 300]]}))
    (folder / "houses.geojson").write_text(layer("Polygon", {"near": square(400, -310, 420, -290),
                                                             "away": square(1000, -60, 1020, -40)}))
    (folder / "scene.yaml").write_text(SCENE)
    return folder / "scene.yaml"


def run(program, *arguments, code=0):
    environment = dict(os.environ, OMP_WAIT_POLICY="passive")
    done = subprocess.run([program, *map(str, arguments)], text=True, capture_output=True, env=environment, check=False)
    if done.returncode != code:
        raise AssertionError(f"{arguments}: code {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout


def made_results(program, folder):
    """The folder of an ensemble of the scene."""
    results = pathlib.Path(folder) / "out"
    run(program, "ensemble", write_scene(folder), "-o", results)
    return results
