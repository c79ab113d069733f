#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Makes the studies of docs/studies again that rest on the three-dimensional solver, and puts their tables into their pages.

usage: scripts/studies.py [--list] [--data FOLDER] [NAME ...]    (all when no name is given: some four hours on two cores)
Needs a release build with tests (./test.sh, or cmake --build build/release), python3-numpy, python3-netcdf4, python3-gdal,
python3-matplotlib, and for some measured ground: FOLDER holds s1000_sthelens (pre_runout_DEM.asc, landslide_depth.asc and DEM_of_Difference.asc
from the tutorials mass_wasting_runout of github.com/landlab/landlab, MIT) and marsicano_tinitaly (marsicano_10m.tif of TINITALY,
release_250m.geojson). A page keeps its words; what stands between <!-- made by NAME --> and <!-- end --> is replaced, with
the day and the machine. Read the words again: they may no longer fit.
"""
import argparse
import datetime
import os
import pathlib
import platform
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
STUDIES, BUILD, OUT = ROOT / "docs/studies", ROOT / "build/release", ROOT / "build/studies"
STURZ, BENCH = str(BUILD / "ensemble/app/sturz"), str(BUILD / "tests/bench/sturz_bench")


def script(name, *arguments):
    return ["/usr/bin/python3", str(STUDIES / f"{name}.py"), *arguments]


def hard(states, page):
    return [BENCH, "hard", "--full", "--states", states, "--markdown", str(STUDIES / page)]


DATA = "folder of --data"
IMAGES = ROOT / "docs/images"
# Name: (page, commands; what the last one prints is put in). WHOLE: that is the page; no page: the commands write theirs.
WHOLE = "whole "
MADE = {
    "verification": (WHOLE + "verification_table.md",
                     [["ctest", "--test-dir", str(BUILD), "-L", "^physics$"],
                      ["python3", str(ROOT / "scripts/verification_table.py"), str(BUILD / "tests/physics/results.csv")]]),
    "stability": ("", [hard("dense", "stability.md"), hard("all", "stability_states.md")]),
    "error_against_seconds": ("error_against_seconds.md",
                              [script("error_against_seconds", "measure", STURZ, str(OUT / "ladder")),
                               script("error_against_seconds", "show", str(OUT / "ladder/figures.json"),
                                      str(STUDIES / "error_against_seconds_earlier.json"),
                                      str(IMAGES / "error_against_seconds.png"))]),
    "beside_the_paper": ("beside_the_paper.md", [script("beside_the_paper", STURZ, str(OUT / "paper"))]),
    "paper": ("paper.md", [script("paper", STURZ, str(ROOT / "scenarios/cases"), str(OUT / "paper_wet"))]),
    "usgs_flume_3d": ("usgs_flume_3d.md", [script("usgs_flume_3d", STURZ, str(ROOT / "scenarios/cases/usgs_flume"), str(OUT / "usgs_flume"))]),
    "who_is_right": ("who_is_right.md", [script("who_is_right", str(BUILD / "tests/tools/energy_of"), str(OUT / "who"))]),
    "formulations": ("formulations.md", [script("formulations", STURZ, DATA, str(OUT / "formulations"), str(IMAGES / "formulations.png"))]),
    "strength_inside": ("strength_inside.md", [script("strength_inside", STURZ, DATA, str(OUT / "strength"), "collapse", "pile", "slope", "s1000:4.5", "s1000:2.25")]),
    "multilevel": ("multilevel.md", [script("multilevel", "members", STURZ, str(ROOT / "scenarios/cases"), str(OUT / "multilevel")),
                                     script("multilevel", "repeats", str(BUILD / "tests/tools/multilevel_repeats"), str(OUT / "multilevel")),
                                     script("multilevel", "show", str(OUT / "multilevel"), str(IMAGES / "multilevel.png"))]),
    "performance": ("performance.md", [script("performance", BENCH, STURZ, str(OUT / "performance"), str(IMAGES / "performance.png"))]),
}


def machine():
    model = next((line.split(":")[1].strip() for line in open("/proc/cpuinfo") if line.startswith("model name")), platform.machine())
    commit = subprocess.run(["git", "-C", str(ROOT), "describe", "--always", "--dirty"], capture_output=True, text=True).stdout.strip()
    return f"{datetime.date.today()}, {model}, release preset, commit {commit}."


def put(page, name, text):
    """Replaces the block of a page. \\raises ValueError when the page has none."""
    path = STUDIES / page
    words, begin, end = path.read_text(), f"<!-- made by {name} -->", "<!-- end -->"
    if begin not in words:
        raise ValueError(f"{path}: no line {begin}")
    head, rest = words.split(begin, 1)
    path.write_text(f"{head}{begin}\n{text.strip()}\n\n{machine()}\n{end}{rest.split(end, 1)[1]}")


def make(name, data):
    page, commands = MADE[name]
    well = True
    if not data and any(DATA in command for command in commands):
        print(f"{name}: not made (its ground is measured). Say with --data where that lies.")
        return False
    commands = [[data if word == DATA else word for word in command] for command in commands]
    for command in commands:  # tests that fail and bounds that do not hold are written down, too
        done = subprocess.run(command, capture_output=True, text=True, cwd=ROOT)
        if done.returncode != 0:
            print(f"{name}: {' '.join(command)} ended with {done.returncode}\n{done.stdout[-2000:]}{done.stderr[-2000:]}", file=sys.stderr)
            well = False
    if well or page.startswith(WHOLE):
        if page.startswith(WHOLE):
            (STUDIES / page.removeprefix(WHOLE)).write_text(done.stdout)
        elif page:
            put(page, name, done.stdout)
    print(f"{name}: {'made again' if well else 'look at what failed'}")
    return well


def main():
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("names", nargs="*")
    parser.add_argument("--list", action="store_true")
    parser.add_argument("--data", type=os.path.abspath)
    given = parser.parse_intermixed_args()
    if given.list:
        print("\n".join(MADE))
        return 0
    unknown = [name for name in given.names if name not in MADE]
    if unknown:
        print(f"no study is called {', '.join(unknown)}; there are {', '.join(MADE)}", file=sys.stderr)
        return 2
    OUT.mkdir(parents=True, exist_ok=True)
    return 0 if all([make(name, given.data) for name in given.names or MADE]) else 1


if __name__ == "__main__":
    sys.exit(main())
