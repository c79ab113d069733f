# SPDX-License-Identifier: Apache-2.0
"""Multilevel estimates of the shipped Zhangjiawan-like case in full stress at 6 m, held against members that they did not use.

usage: multilevel.py members STURZ CASES OUT [N]     members of four levels, N (400) of full stress at 6 m; goes on where it was stopped
       multilevel.py repeats TOOL OUT                TOOL is tests/tools/multilevel_repeats; minutes
       multilevel.py show OUT [PICTURE.png]          prints the tables
needs python3-numpy; python3-matplotlib for the picture. Draws are independent and the same at every level. Each repeat takes some members
of each level at random; cheaper levels take theirs beyond the draws of the dearest. The reference are the members of the dearest level
that the repeat has not taken, and its own variance is taken off every mean square. Plain sampling: the variance of the members of the
dearest level over their number, at their mean CPU seconds.
"""
import json
import math
import pathlib
import subprocess
import sys

LEVELS = {"fs6": ("full_stress", 6, 400), "fs12": ("full_stress", 12, 800), "da9": ("depth_averaged", 9, 2000),
          "da18": ("depth_averaged", 18, 2000)}
REPEATS = 40
# Levels, and draws of each for 8 members of the dearest.
SETS = {"columns 9 m": (["fs6", "da9"], [8, 400]), "columns 9 and 18 m": (["fs6", "da9", "da18"], [8, 120, 400]),
        "full stress 12 m, columns 9 m": (["fs6", "fs12", "da9"], [8, 40, 400])}
MEMBERS = [8, 12, 16, 24, 32]


def members(sturz, cases, out, n):
    for name in ("da18", "da9", "fs12", "fs6"):
        formulation, spacing, count = LEVELS[name]
        subprocess.run([sturz, "ensemble", f"{cases}/zhangjiawan/scenario.yaml", "--set", "ensemble.design=monte_carlo", "--set",
                        f"formulation={formulation}", "--set", f"numerics.spacing_m={spacing}", "--set", "hazard.cell_size_m=10", "-n",
                        str(n if name == "fs6" else count), "-o", f"{out}/{name}"], check=True)


def repeats(tool, out):
    for label, (levels, counts) in SETS.items():
        for n in MEMBERS:
            scaled = ",".join(str(max(1, round(c * n / counts[0]))) for c in counts)
            folders = [word for level in levels for word in (f"{out}/{level}", str(LEVELS[level][1]))]
            text = subprocess.run([tool, str(REPEATS), "1", scaled, *folders], check=True, capture_output=True, text=True).stdout
            (out / f"{label.replace(' ', '_').replace(',', '')}_{n}.jsonl").write_text(text)


def read(out):
    """label -> n -> (first line, repeats)."""
    found = {}
    for label in SETS:
        for n in MEMBERS:
            file = out / f"{label.replace(' ', '_').replace(',', '')}_{n}.jsonl"
            if file.exists():
                lines = [json.loads(line) for line in file.read_text().splitlines()]
                found.setdefault(label, {})[n] = (lines[0], lines[1:])
    return found


def mean(values):
    values = list(values)
    return sum(values) / len(values)


def row(head, rows):
    """Seconds, and by name: root mean square error, gain over plain sampling, coverage."""
    counts, cost = head["counts"], head["cpu_s"]
    seconds = sum(n * c for n, c in zip(counts, cost))
    found = {}
    for i, name in enumerate(m["name"] for m in rows[0]["means"]):
        own = mean(r["means"][i]["reference_variance"] for r in rows)
        size = mean(r["map"]["reference_members"] for r in rows)
        square = mean((r["means"][i]["mean"] - r["means"][i]["reference"]) ** 2 for r in rows) - own
        plain = own * (size - 0) * cost[0] / seconds
        covered = mean(abs(r["means"][i]["mean"] - r["means"][i]["reference"]) <=
                       math.hypot(r["means"][i]["high"] - r["means"][i]["mean"], 1.645 * math.sqrt(own)) for r in rows)
        told = mean(r["means"][i]["se"] ** 2 for r in rows)
        found[name] = (square, plain, covered, told, own)
    own = mean(r["map"]["reference_variance"] for r in rows)
    square = mean(r["map"]["mse"] for r in rows) - own
    plain = mean(r["map"]["spread"] for r in rows) * cost[0] / seconds
    found["map"] = (square, plain, mean(r["map"]["covered"] for r in rows), mean(r["map"]["told"] ** 2 for r in rows), own)
    return seconds, found


def show(out, picture):
    found = read(out)
    head, rows = next(iter(next(iter(found.values())).values()))
    size = mean(r["map"]["reference_members"] for r in rows)
    print(f"Dearest level: {size + head['counts'][0]:.0f} members, {head['cpu_s'][0]:.2f} CPU s each; {len(rows)} repeats a row.\n")
    print("| levels | members | CPU s | result | error | by its bounds | plain, same seconds | 1/gain measured | 1/gain told | 90 % bounds cover |")
    print("|---|---|---|---|---|---|---|---|---|---|")
    for label, by_n in found.items():
        for n, (head, rows) in by_n.items():
            seconds, values = row(head, rows)
            for name, (square, plain, covered, told, own) in values.items():
                error = f"{math.sqrt(square):.3g}" if square > 0 else f"under {math.sqrt(own):.2g}"
                gain = f"1/{plain / square:.1f}" if square > 0 else "not told"
                print(f"| {label} | {', '.join(map(str, head['counts']))} | {seconds:.0f} | {name} | {error} | {math.sqrt(told):.3g} | "
                      f"{math.sqrt(plain):.3g} | {gain} | 1/{plain / told:.1f} | {100 * covered:.0f} % |")
    if picture:
        draw(found, picture)


def draw(found, picture):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    names = {"runout_m": "run-out [m]", "reached_area_m2": "area reached [m2]", "com_travel_m": "way of the centre of mass [m]",
             "map": "P(reached), doubtful cells"}
    figure, axes = plt.subplots(1, 4, figsize=(17, 4.4))
    cheap = {}
    for label, by_n in found.items():
        for head, rows in by_n.values():
            for name, c in zip(SETS[label][0][1:], head["cheap"]):
                cheap[name] = (c, head["cpu_s"][SETS[label][0].index(name)])
    for axis, (name, title) in zip(axes, names.items()):
        plain_x, plain_y = [], []
        for label, by_n in found.items():
            points = [row(head, rows) for head, rows in by_n.values()]
            x = [s for s, _ in points]
            axis.plot(x, [math.sqrt(max(v[name][0], 0)) or math.nan for _, v in points], "o-", label=label)
            plain_x += x
            plain_y += [v[name][1] * s for s, v in points]
        variance = plain_y[0]
        x = [min(plain_x) / 2, max(plain_x) * 30]
        axis.plot(x, [math.sqrt(variance / s) for s in x], "k-", label="full stress 6 m alone")
        for level, (c, cost) in sorted(cheap.items()):
            bias = abs(c["map_rms" if name == "map" else name])
            base = head_cost(found)
            curve = [x[0] * (x[1] / x[0]) ** (k / 30) for k in range(31)]
            axis.plot(curve, [math.hypot(bias, math.sqrt(variance * cost / base / s)) for s in curve], "--", label=f"{level} alone")
        axis.set_xscale("log")
        axis.set_yscale("log")
        axis.set_xlabel("CPU seconds")
        axis.set_title(title)
        axis.grid(alpha=0.3)
    axes[0].set_ylabel("root mean square error")
    axes[3].legend(fontsize=8)
    figure.tight_layout()
    figure.savefig(picture, dpi=110)


def head_cost(found):
    return next(iter(next(iter(found.values())).values()))[0]["cpu_s"][0]


if __name__ == "__main__":
    if sys.argv[1:2] == ["members"] and len(sys.argv) in (5, 6):
        members(sys.argv[2], sys.argv[3], pathlib.Path(sys.argv[4]), int(sys.argv[5]) if len(sys.argv) == 6 else 400)
    elif sys.argv[1:2] == ["repeats"] and len(sys.argv) == 4:
        repeats(sys.argv[2], pathlib.Path(sys.argv[3]))
    elif sys.argv[1:2] == ["show"] and len(sys.argv) in (3, 4):
        show(pathlib.Path(sys.argv[2]), sys.argv[3] if len(sys.argv) == 4 else None)
    else:
        sys.exit(__doc__)
