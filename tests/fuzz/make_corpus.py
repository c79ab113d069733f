#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes the seeds of the scenario fuzzer. Usage: make_corpus.py ROOT CORPUS_FOLDER"""
import pathlib
import re
import sys

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


def seeds(root):
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


def main(root, corpus):
    corpus = pathlib.Path(corpus)
    corpus.mkdir(parents=True, exist_ok=True)
    for n, text in enumerate(seeds(pathlib.Path(root))):
        (corpus / f"seed_{n:03}.yaml").write_text(text)


if __name__ == "__main__":
    main(*sys.argv[1:])
