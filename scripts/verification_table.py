#!/usr/bin/env python3
"""Writes docs/studies/verification_table.md from the lines that the physics tests left.

    ctest --test-dir build/release -L physics
    scripts/verification_table.py build/release/tests/physics/results.csv > docs/studies/verification_table.md
"""
import csv
import datetime
import math
import os
import re
import sys


def number(text, digits=4):
    if not text:  # hard cases have no spacing or step
        return "-"
    value = float(text)
    return "-" if math.isnan(value) else f"{value:.{digits}g}"


def is_relative(row):
    """Others are in the quantity's own unit."""
    measured, reference, error = (float(row[k]) for k in ("measured", "reference", "error"))
    return reference != 0 and abs(abs(measured / reference - 1) - abs(error)) < 1e-3 * abs(error) + 1e-9


def per_cent(row, column, sign=""):
    value = float(row[column])
    if math.isnan(value):
        return "-"
    return f"{100 * value:{sign}.3g} %" if is_relative(row) else number(row[column], 3)


def natural(text):
    return [float(t) if re.fullmatch(r"\d+(\.\d+)?", t) else t
            for t in re.split(r"(\d+(?:\.\d+)?)", text)]


def main(path):
    with open(path, newline="", encoding="utf-8") as file:
        rows = sorted(csv.DictReader(file), key=lambda r: natural(r["case"]))
    made = datetime.date.fromtimestamp(os.path.getmtime(path))
    missed = sum(r["verdict"] == "missed" for r in rows)
    met = sum(r["verdict"] == "met" for r in rows)
    print("# Verification: every line\n"
          "What the lines mean, why some are missed and what was not measured: `verification.md`. "
          "Written by `scripts/verification_table.py`; do not edit. Every line with a tolerance is asserted; one that "
          "is missed fails its test unless `tests/physics/results/known_misses.csv` says why.\n\n"
          f"{made}: {met} lines met, {missed} missed, {len(rows) - met - missed} reported without "
          "a tolerance. Seconds are those of one run, other work on the machine.\n\n"
          "| case | quantity | measured | reference | error | tolerance | verdict | dx m | particles "
          "| mean dt s | s |\n|---|---|---|---|---|---|---|---|---|---|---|")
    for r in rows:
        cells = [r["case"], r["quantity"], number(r["measured"]), number(r["reference"]), per_cent(r, "error", "+"),
                 per_cent(r, "tolerance"), f"**{r['verdict']}**" if r["verdict"] == "missed" else r["verdict"],
                 number(r["dx_m"], 3), r["particles"] or "-", number(r["dt_s"], 3), number(r["wall_s"], 2)]
        print("| " + " | ".join(cells) + " |")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit("usage: verification_table.py tests/physics/results.csv")
    main(sys.argv[1])
