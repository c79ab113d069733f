# SPDX-License-Identifier: Apache-2.0
"""What a step costs and where its time goes: the tables of sturz_bench, what a stiffer mass costs in accuracy, the paper's size; and a picture.

usage: performance.py BENCH STURZ OUT [PICTURE.png] [--quick]   (needs python3-numpy, python3-gdal; python3-matplotlib for the picture; half an hour, on a quiet machine)
BENCH is the target `sturz_bench`. OUT takes figures as JSON and the runs. Prints Markdown. --quick, for a busy machine:
the bench's short form, without what goes by the wall clock, and no runs.
"""
import json
import pathlib
import subprocess
import sys

from error_against_seconds import ZHANGJIAWAN
from runs import run

MEASURES = {"throughput": [], "scaling": ["--most", "1e6"], "threads": [], "ensemble": [], "absent-effects": []}
BY_THE_WALL_CLOCK = ("threads", "ensemble")


def markdown(text, quick):
    """The bench's tables with their headings set apart, as Markdown wants them; without those of wall times where it is quick."""
    blocks = text.split("\n\n")
    for block in blocks:
        heading, _, table = block.partition("\n")
        if quick and "wall time" in heading:
            continue
        yield f"**{heading}**\n\n{table}" if table.startswith("|") else block


def measure(bench, out, quick):
    for name, flags in MEASURES.items():
        if quick and name in BY_THE_WALL_CLOCK:
            continue
        print(f"\n### {name}\n")
        done = subprocess.run([bench, *quick, *([] if quick else flags), "--json", out / f"{name}.json", name], capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise SystemExit(f"{name}: {done.stdout[-500:]}{done.stderr[-500:]}")
        print("\n\n".join(markdown(done.stdout, quick)), flush=True)


def stiffness(sturz, out):
    print("\n### Stiffness: what 1/c0 costs in accuracy\nZhangjiawan-like, friction 0.24, full stress at 6 m.\n\n"
          "| factor | steps | centre of mass m | run-out m | Mach | density error | s |\n|" + "---|" * 7)
    for title, numerics in (("5", "sound_speed_factor: 5"), ("10", "sound_speed_factor: 10"), ("20", "sound_speed_factor: 20"),
                            ("10, fixed c0", "sound_speed_factor: 10, adaptive_sound_speed: false")):
        s = run(sturz, out / f"stiff_{title.replace(', ', '_').replace(' ', '_')}", ZHANGJIAWAN.format(dx=f"6, {numerics}"))
        print(f"| {title} | {s['n_steps']:,.0f} | {s['com_travel_m']:.0f} | {s['runout_m']:,.0f} | {s['max_mach']:.3f} | {100 * s['max_density_error']:.1f} % | {s['cpu_s']:.1f} |", flush=True)


def size_of_the_paper(sturz, out):
    print("\n### The paper's size\nZhangjiawan-like, friction 0.24, full stress at 2.1 m, one thread. The paper: 51,897 particles, 288 core-hours.\n\n"
          "| particles | steps | flow s | processor s | 10^6 updates/s | centre of mass m | run-out m | largest speed m/s | largest deposit m | energy residual |\n|" + "---|" * 10)
    s = run(sturz, out / "size", ZHANGJIAWAN.format(dx=2.1))
    print(f"| {s['n_particles']:,.0f} | {s['n_steps']:,.0f} | {s['end_time_s']:.0f} | {s['cpu_s']:.0f} | {s['n_particles'] * s['n_steps'] / s['cpu_s'] / 1e6:.1f} | {s['com_travel_m']:.0f} | "
          f"{s['runout_m']:,.0f} | {s['max_speed_m_s']:.0f} | {s['max_deposit_m']:.1f} | {s['energy_residual']:.1g} |", flush=True)


def draw_growth(axis, scaling):
    rows = scaling["scaling"]
    n = [row["particles"] for row in rows]
    cost = [row["ns_per_update"]["median"] for row in rows]
    low = [c - row["ns_per_update"]["least"] for c, row in zip(cost, rows)]
    high = [row["ns_per_update"]["most"] - c for c, row in zip(cost, rows)]
    axis.errorbar(n, cost, yerr=[low, high], marker="o", capsize=3)
    two_k = cost[1]
    axis.axhline(1.6 * two_k, linestyle="--", color="grey")
    axis.text(n[0], 1.62 * two_k, "target: 1.6 x the cost at 2,000", fontsize=7, color="grey")
    axis.set_xscale("log")
    axis.set_ylim(0, 1.9 * two_k)
    axis.set_xlabel("particles")
    axis.set_ylabel("ns a particle-update, one core")
    axis.set_title("Growth with size (median, range)", fontsize=9)


def draw_passes(axis, throughput, plt):
    scenes = [("dense slide, 51k", "passes_dense_slide_51k"), ("thin slide, 3k", "passes_thin_slide"),
              ("columns, 10k", "passes_columns_10_0k")]
    colours = plt.get_cmap("tab20").colors
    names = {}
    for y, (_, key) in enumerate(scenes):
        left = 0
        for row in throughput[key]:
            name = row["pass"].split(":")[0]
            if name == "all":
                continue
            colour = names.setdefault(name, colours[len(names) % len(colours)])
            width = row["ns_per_update"]
            axis.barh(y, width, left=left, color=colour)
            left += width
    axis.set_yticks(range(len(scenes)), [name for name, _ in scenes], fontsize=8)
    axis.set_xlabel("ns a particle-update, one core")
    axis.set_title("Where a step's time goes", fontsize=9)
    handles = [plt.Rectangle((0, 0), 1, 1, color=colour) for colour in names.values()]
    axis.legend(handles, list(names), fontsize=6, ncol=2, loc="center left", bbox_to_anchor=(1, 0.5))


def picture(out, path):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    scaling, throughput = (json.loads((out / f"{name}.json").read_text()) for name in ("scaling", "throughput"))
    figure, axes = plt.subplots(1, 2, figsize=(13, 3.4), width_ratios=[1, 1.3])
    draw_growth(axes[0], scaling)
    draw_passes(axes[1], throughput, plt)
    figure.tight_layout()
    figure.savefig(path, dpi=130)


def main(bench, sturz, out, *more):
    out, quick = pathlib.Path(out), [word for word in more if word == "--quick"]
    out.mkdir(parents=True, exist_ok=True)
    measure(bench, out, quick)
    if not quick:
        stiffness(sturz, out)
        size_of_the_paper(sturz, out)
        for path in more[:1]:
            picture(out, path)


if __name__ == "__main__":
    main(*sys.argv[1:])
