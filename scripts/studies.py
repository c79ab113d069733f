#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Makes the studies of docs/studies again and puts their figures into their pages, with a record in made.json.

usage: scripts/make_studies.sh [--list | --table | --check] [--older] [--afresh] [--data FOLDER] [--only NAME ...] [NAME ...]
(all when no name is given: some eight hours of one core; the wrapper is this script with Debian's python). Needs a configured release build with tests
(cmake --preset release -DSTURZ_TESTS=ON; programs that are missing or old are built), python3-numpy, python3-netcdf4, python3-gdal, python3-matplotlib, and for some measured
ground: FOLDER holds s1000_sthelens (pre_runout_DEM.asc, landslide_depth.asc and DEM_of_Difference.asc from the tutorials
mass_wasting_runout of github.com/landlab/landlab, MIT) and marsicano_tinitaly (marsicano_10m.tif of TINITALY,
release_250m.geojson). A page keeps its words; what stands between <!-- made by NAME --> and <!-- end --> is replaced, with
the day and the machine. Read the words again: they may no longer fit. Which studies there are: scripts/studies_list.py; how old
they are: scripts/studies_made.py. Interrupted, the same command goes on after the last command that ended: what each printed is
kept in build/studies/steps, under a hash of command and code. --afresh forgets these.
"""
import argparse
import datetime
import hashlib
import json
import os
import pathlib
import platform
import shlex
import shutil
import subprocess
import sys

import studies_build
import studies_made
from studies_list import BESIDE, BUILD, DATA, MADE, OUT, ROOT, STUDIES, WHOLE


def processor():
    return next((line.split(":")[1].strip() for line in open("/proc/cpuinfo") if line.startswith("model name")), platform.machine())


def commit():
    return subprocess.run(["git", "-C", str(ROOT), "describe", "--always", "--dirty"], capture_output=True, text=True).stdout.strip()


def machine():
    return f"{datetime.date.today()}, {processor()}, release preset, commit {commit()}."


def put(page, name, text):
    """Replaces the block of a page. \\raises ValueError when the page has none."""
    path = STUDIES / page
    words, begin, end = path.read_text(), f"<!-- made by {name} -->", "<!-- end -->"
    if begin not in words:
        raise ValueError(f"{path}: no line {begin}")
    head, rest = words.split(begin, 1)
    studies_made.write_whole(path, f"{head}{begin}\n{text.strip()}\n\n{machine()}\n{end}{rest.split(end, 1)[1]}")


def in_words(command):
    """A command as somebody would type it in the root, without this machine's folders."""
    return shlex.join(word.replace(f"{ROOT}/", "") for word in command)


def step(command, code):
    """Runs a command, or takes what it printed when this code was measured before. \\return (its exit code, its words)"""
    kept = OUT / "steps" / hashlib.sha256(json.dumps([command, code]).encode()).hexdigest()[:16]
    if kept.is_file():
        return 0, kept.read_text()
    done = subprocess.run(command, capture_output=True, text=True, cwd=ROOT)
    if done.returncode != 0:
        print(f"{in_words(command)} ended with {done.returncode}\n{done.stdout[-2000:]}{done.stderr[-2000:]}", file=sys.stderr)
    else:
        kept.parent.mkdir(parents=True, exist_ok=True)
        part = kept.with_suffix(".part")
        part.write_text(done.stdout)
        part.rename(kept)
    return done.returncode, done.stdout


def write_page(name, study, printed):
    if study.page.startswith(WHOLE):
        studies_made.write_whole(STUDIES / study.page.removeprefix(WHOLE), printed[-1])
    elif study.page.startswith(BESIDE):
        parts = [f"# What {name} printed\n{machine()}"]
        parts += ["\n    {}\n\n{}".format(in_words(command), text.strip().replace(f"{ROOT}/", "")) for command, text in zip(study.commands, printed)]
        (STUDIES / "printed").mkdir(exist_ok=True)
        studies_made.write_whole(STUDIES / f"printed/{name}.md", "\n".join(parts) + "\n")
        print(f"{name}: carry the figures of docs/studies/printed/{name}.md over to its page")
    elif study.page:
        put(study.page, name, printed[-1])


def make(name, data):
    study = MADE[name]
    if study.by_hand:
        print(f"{name}: not made ({study.by_hand})")
        return True
    if not data and any(DATA in word for command in study.commands for word in command):
        print(f"{name}: not made (its ground is measured). Say with --data where that lies.")
        return False
    code = studies_made.hash_now(ROOT, study)
    commands = [[word.replace(DATA, data or "") for word in command] for command in study.commands]
    if old := studies_build.make_current(str(BUILD), commands):
        print(f"{name}: not made ({old}). cmake --preset release -DSTURZ_TESTS=ON, cmake --build build/release")
        return False
    programs = studies_build.identity(str(BUILD), commands)
    # Tests that fail and bounds that do not hold are written down, too: the rest of the commands runs all the same.
    ended = [step(command, code) for command in commands]
    well = all(status == 0 for status, _ in ended)
    if programs != studies_build.identity(str(BUILD), commands) or code != studies_made.hash_now(ROOT, study):
        shutil.rmtree(OUT / "steps", ignore_errors=True)  # nobody knows which of them are of which code
        print(f"{name}: not recorded (its program or its sources changed while it ran). Make it again.")
        return False
    if well or study.page.startswith(WHOLE):
        write_page(name, study, [text for _, text in ended])
        studies_made.keep(ROOT, name, {"command": " && ".join(in_words(command) for command in study.commands), "date": str(datetime.date.today()),
                                       "machine": processor(), "commit": commit(), "sources": code})
        studies_made.write_table(ROOT)
    print(f"{name}: {'made again' if well else 'look at what failed'}")
    return well


def show_list():
    old = studies_made.stale(ROOT)
    have = studies_made.records(ROOT)
    wide = max(map(len, MADE))
    for name, study in MADE.items():
        takes = "by hand" if study.by_hand else f"{study.minutes:g} min"
        needs = ", needs --data" if any(DATA in word for command in study.commands for word in command) else ""
        age = f"{have[name]['date']}, {studies_made.OLDER if name in old else studies_made.CURRENT}" if name in have else "never made"
        print(f"{name:{wide}}  {takes:>8}  {age}{needs}")


def main():
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("names", nargs="*")
    parser.add_argument("--only", action="append", default=[], metavar="NAME")
    for what in ("list", "table", "check", "older", "afresh"):
        parser.add_argument(f"--{what}", action="store_true")
    parser.add_argument("--data", type=os.path.abspath)
    given = parser.parse_intermixed_args()
    if given.list:
        show_list()
        return 0
    if given.table or given.check:
        return studies_made.main("table" if given.table else "check", ROOT)
    names = [*given.only, *given.names]
    unknown = [name for name in names if name not in MADE]
    if unknown:
        print(f"no study is called {', '.join(unknown)}; there are {', '.join(MADE)}", file=sys.stderr)
        return 2
    if given.afresh:
        shutil.rmtree(OUT / "steps", ignore_errors=True)
    OUT.mkdir(parents=True, exist_ok=True)
    chosen = names or (studies_made.stale(ROOT) if given.older else MADE)
    return 0 if all([make(name, given.data) for name in chosen]) else 1


if __name__ == "__main__":
    sys.exit(main())
