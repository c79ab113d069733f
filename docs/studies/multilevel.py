# SPDX-License-Identifier: Apache-2.0
"""Multilevel estimates of the shipped Zhangjiawan-like case in full stress at 6 m, held against members that they did not use.

usage: multilevel.py members STURZ CASES OUT [N]     members of four levels, N (1,000) of full stress at 6 m; goes on where it was stopped
       multilevel.py repeats TOOL OUT [MEMBERS]      TOOL is tests/tools/multilevel_repeats; MEMBERS where the levels lie, OUT when absent
       multilevel.py show OUT [PICTURE.png]          prints the tables
needs python3-numpy, python3-netcdf4; python3-matplotlib for the picture. Draws are independent and the same at every level. Each repeat parts the members at
random: 64 draws of the dearest level and half of the cheaper ones' further draws are there to be used, the others are what the estimate
is held against, and share no draw with it. Means are held against a control-variate estimate from these others, the map against their
plain shares; the reference's own variance is taken off every mean square. Plain sampling: the variance of a member of the dearest
level over their number, at their mean CPU seconds: independent draws. Beside it Latin hypercubes of the dearest level, whose means scatter less,
against the same members. Error bars of measured gains: standard errors from the repeats.
"""
import csv
import json
import math
import pathlib
import subprocess
import sys

import netCDF4
import numpy

LEVELS = {"fs6": ("full_stress", 6, 1000), "fs12": ("full_stress", 12, 1400), "da9": ("depth_averaged", 9, 3000),
          "da18": ("depth_averaged", 18, 3000)}
REPEATS = "100,24"  # of means, and of maps (and of the whole procedure, which looks at maps)
# What is repeated: fixed members of levels by their place above, or the whole procedure with a target.
JOBS = {"columns 9 m, 16": "0=16,2=800", "full stress 12 m, columns 9 m, 16": "0=16,1=64,2=800", "chosen by the procedure": "error=0.03,map=0.04",
        "columns 9 m, 8": "0=8,2=400", "columns 9 m, 32": "0=32,2=860"}


CUBES, OF_CUBE = 6, 20  # Latin hypercubes of the dearest level, members of each: as many seconds as the first job takes


def ensemble(sturz, cases, level, n, out, *settings):
    formulation, spacing, _ = LEVELS[level]
    given = [f"formulation={formulation}", f"numerics.spacing_m={spacing}", "hazard.cell_size_m=10", *settings]
    subprocess.run([sturz, "ensemble", f"{cases}/zhangjiawan/scenario.yaml", *(word for key in given for word in ("--set", key)), "-n", str(n), "-o", str(out)],
                   check=True)


def members(sturz, cases, out, n):
    for name in ("da18", "da9", "fs12", "fs6"):
        ensemble(sturz, cases, name, n if name == "fs6" else LEVELS[name][2], f"{out}/{name}", "ensemble.design=monte_carlo")
    for k in range(CUBES):
        ensemble(sturz, cases, "fs6", OF_CUBE, f"{out}/cube_{k}", "ensemble.design=latin_hypercube", f"ensemble.seed={1000 + k}")


def repeats(tool, out, members_in):
    levels = [word for name, level in LEVELS.items() for word in (name, f"{members_in}/{name}", str(level[1]))]
    out.mkdir(parents=True, exist_ok=True)
    with open(out / "repeats.jsonl", "w") as file:
        subprocess.run([tool, REPEATS, "1", ";".join(JOBS.values()), *levels], check=True, stdout=file)


def read(out):
    """First line, and label -> repeats; a last line that was cut off is left out."""
    lines = []
    for line in (out / "repeats.jsonl").read_text().splitlines():
        try:
            lines.append(json.loads(line))
        except json.JSONDecodeError:
            break
    found = {}
    for row in lines[1:]:
        found.setdefault(list(JOBS)[row["job"]], []).append(row)
    return lines[0], found


def mean(values):
    values = list(values)
    return sum(values) / len(values)


def error_of_mean(values):
    m = mean(values)
    return math.sqrt(sum((v - m) ** 2 for v in values) / (len(values) - 1) / len(values)) if len(values) > 1 else math.nan


def row(head, rows):
    """Seconds, and by result: mean square error with its standard error, that of plain sampling of so many seconds, coverage, what the bounds tell."""
    seconds = mean(sum(n * c for n, c in zip(r["counts"], head["cpu_s"])) for r in rows)
    found = {}
    for i, name in enumerate(m["name"] for m in rows[0]["means"]):
        squares = [(r["means"][i]["mean"] - r["means"][i]["known"]) ** 2 - r["means"][i]["known_variance"] for r in rows]
        others = head["members"][0] - head["pool"]
        plain = mean(r["means"][i]["reference_variance"] for r in rows) * others * head["cpu_s"][0] / seconds

        def covers(m):
            half = m["high"] - m["mean"] if m["known"] > m["mean"] else m["mean"] - m["low"]
            return abs(m["mean"] - m["known"]) <= math.hypot(half, 1.645 * math.sqrt(m["known_variance"]))
        found[name] = (mean(squares), error_of_mean(squares), plain, mean(covers(r["means"][i]) for r in rows),
                       mean(r["means"][i]["se"] ** 2 for r in rows), mean(r["means"][i]["known_variance"] for r in rows))
    maps = [r["map"] for r in rows if r["map"]]
    if maps:
        squares = [m["mse"] - m["reference_variance"] for m in maps]
        found["map"] = (mean(squares), error_of_mean(squares), mean(m["spread"] for m in maps) * head["cpu_s"][0] / seconds,
                        mean(m["covered"] for m in maps), mean(m["told"] ** 2 for m in maps), mean(m["reference_variance"] for m in maps))
    return seconds, found


def decided(rows):
    """Mean rounds, - where the numbers were fixed, and in how many repeats members ran out."""
    capped = sum(bool(r["capped"]) for r in rows)
    rounds = mean(r["rounds"] for r in rows)
    return f"{rounds:.1f}" if rounds > 0 else "-", f"{capped} of {len(rows)}" if capped else "0"


def results_of(folder, name):
    """member -> a result of it, of members that settled and whose end was seen."""
    lines = (line for line in open(folder / "members.csv") if not line.startswith("#"))
    return {int(row["member"]): float(row[name]) for row in csv.DictReader(lines) if row["outcome"] == "settled" and row["censored"] == "none"}


def reference(out, name):
    """Mean of the dearest level's members, corrected by the columns that have more of them, and its variance."""
    dear, cheap = results_of(out / "fs6", name), results_of(out / "da9", name)
    y, x = (numpy.array([level[k] for k in sorted(dear.keys() & cheap.keys())]) for level in (dear, cheap))
    slope = numpy.cov(x, y)[0, 1] / x.var(ddof=1)
    many = numpy.array(list(cheap.values()))
    left = y - slope * x
    return left.mean() + slope * many.mean(), left.var(ddof=1) / len(y) + slope ** 2 * many.var(ddof=1) / len(many), y.var(ddof=1)


def reach(folder):
    """P(reached) by the corner of the cell, and the number of members."""
    with netCDF4.Dataset(folder / "hazard.nc") as data:
        p = data["probability_of_reach"][:].filled(0)
        n = len(results_of(folder, "runout_m"))
        return {(x, y): p[r, c] for r, y in enumerate(data["y"][:].tolist()) for c, x in enumerate(data["x"][:].tolist()) if p[r, c] > 0}, n


def cubes(out):
    """Mean square errors of the Latin hypercubes: result -> (square, its standard error, that of as many independent draws)."""
    folders = sorted(out.glob("cube_*"))
    found = {}
    for name in ("runout_m", "reached_area_m2", "com_travel_m"):
        known, own, spread = reference(out, name)
        of = [list(results_of(folder, name).values()) for folder in folders]
        squares = [(mean(values) - known) ** 2 - own for values in of]
        found[name] = mean(squares), error_of_mean(squares), mean(spread / len(values) for values in of)
    known, n = reach(out / "fs6")
    doubtful = {cell: p for cell, p in known.items() if 0.05 < p < 0.95}
    plain = mean(p * (1 - p) for p in doubtful.values()) * n / (n - 1)
    squares = []
    for folder in folders:
        p, _ = reach(folder)
        squares.append(mean((p.get(cell, 0) - q) ** 2 for cell, q in doubtful.items()) - plain / n)
    found["map"] = mean(squares), error_of_mean(squares), mean(plain / reach(folder)[1] for folder in folders)
    return found


def show_cubes(out):
    print(f"\n{CUBES} Latin hypercubes of {OF_CUBE} members of full stress 6 m, against the same members:\n")
    print("| result | error | independent draws, as many | 1/gain measured |\n|---|---|---|---|")
    for name, (square, doubt, plain) in cubes(out).items():
        low, high = square - doubt, square + doubt
        error = f"{math.sqrt(square):.3g}" if square > 0 else f"under {math.sqrt(high):.2g}"
        gain = (f"1/{plain / square:.1f} (1/{plain / high:.1f} to " + (f"1/{plain / low:.0f})" if low > 0 else "more)")) if square > 0 else f"over 1/{plain / high:.0f}"
        print(f"| {name} | {error} | {math.sqrt(plain):.3g} | {gain} |")


def show(out, picture):
    head, found = read(out)
    print(f"Members that settled: {head['members']}, left out: {head['left_out']}, CPU s a member: {[round(c, 4) for c in head['cpu_s']]}.\n")
    print("| levels, members of full stress 6 m | repeats (with maps) | rounds (mean) | capped | members (mean) | CPU s | result | error | told by its bounds | plain, same seconds | 1/gain measured | told | 90 % bounds cover |")
    print("|---|---|---|---|---|---|---|---|---|---|---|---|---|")
    for label, rows in found.items():
        seconds, values = row(head, rows)
        rounds, capped = decided(rows)
        counts = ", ".join(f"{mean(r['counts'][p] for r in rows):.0f}" for p in range(len(head["members"])))
        for name, (square, doubt, plain, covered, told, own) in values.items():
            low, high = square - doubt, square + doubt
            error = f"{math.sqrt(square):.3g}" if square > 0 else f"under {math.sqrt(high):.2g}"
            gain = (f"1/{plain / square:.1f} (1/{plain / high:.1f} to " + (f"1/{plain / low:.0f})" if low > 0 else "more)")) if square > 0 else f"over 1/{plain / high:.0f}"
            print(f"| {label} | {len(rows)} ({sum(r['map'] is not None for r in rows)}) | {rounds} | {capped} | {counts} | {seconds:.0f} | {name} | {error} | {math.sqrt(told):.3g} | "
                  f"{math.sqrt(plain):.3g} | {gain} | 1/{plain / told:.1f} | {100 * covered:.0f} % |")
    print("\nCapped: repeats that asked for more members than are stored, got those that are, and decided no further.")
    print("\nWhat a cheaper level alone is off by, however many members it has:")
    for c in head["cheap"]:
        print(list(LEVELS)[c["level"]], {k: round(v, 3) for k, v in c.items() if k != "level"})
    show_cubes(out)
    if picture:
        draw(head, found, cubes(out), picture)


def draw(head, found, spread, picture):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    names = {"runout_m": "run-out [m]", "reached_area_m2": "area reached [m2]", "com_travel_m": "way of the centre of mass [m]",
             "map": "P(reached), doubtful cells"}
    figure, axes = plt.subplots(1, 4, figsize=(17, 4.4))
    all_rows = {label: row(head, rows) for label, rows in found.items()}
    # Fixed numbers of one set of levels are joined, the others stand alone.
    sets = {}
    for label, value in all_rows.items():
        sets.setdefault(label.rsplit(", ", 1)[0], []).append(value)
    for axis, (name, title) in zip(axes, names.items()):
        for label, points in sets.items():
            points = sorted(((s, v[name]) for s, v in points if name in v), key=lambda p: p[0])
            axis.plot([s for s, _ in points], [math.sqrt(v[0]) if v[0] > 0 else math.nan for _, v in points], "o-", label=label)
        seconds, values = next(iter(all_rows.values()))
        variance = values[name][2] * seconds
        x = [10, 10000]
        axis.plot(x, [math.sqrt(variance / s) for s in x], "k-", label="full stress 6 m, independent draws")
        square = spread[name][0]
        axis.plot([OF_CUBE * head["cpu_s"][0]], [math.sqrt(square) if square > 0 else math.nan], "k*", markersize=11, label="full stress 6 m, Latin hypercubes")
        curve = [x[0] * (x[1] / x[0]) ** (k / 30) for k in range(31)]
        for c in head["cheap"]:
            bias = abs(c["map_rms" if name == "map" else name])
            cost = head["cpu_s"][c["level"]] / head["cpu_s"][0]
            axis.plot(curve, [math.hypot(bias, math.sqrt(variance * cost / s)) for s in curve], "--", label=f"{list(LEVELS)[c['level']]} alone")
        axis.set_xscale("log")
        axis.set_yscale("log")
        axis.set_xlabel("CPU seconds")
        axis.set_title(title)
        axis.grid(alpha=0.3)
    axes[0].set_ylabel("root mean square error")
    axes[3].legend(fontsize=7)
    figure.tight_layout()
    figure.savefig(picture, dpi=110)


if __name__ == "__main__":
    if sys.argv[1:2] == ["members"] and len(sys.argv) in (5, 6):
        members(sys.argv[2], sys.argv[3], pathlib.Path(sys.argv[4]), int(sys.argv[5]) if len(sys.argv) == 6 else LEVELS["fs6"][2])
    elif sys.argv[1:2] == ["repeats"] and len(sys.argv) in (4, 5):
        repeats(sys.argv[2], pathlib.Path(sys.argv[3]), sys.argv[-1])
    elif sys.argv[1:2] == ["show"] and len(sys.argv) in (3, 4):
        show(pathlib.Path(sys.argv[2]), sys.argv[3] if len(sys.argv) == 4 else None)
    else:
        sys.exit(__doc__)
