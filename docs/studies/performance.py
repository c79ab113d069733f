# SPDX-License-Identifier: Apache-2.0
"""Draws what sturz_bench measured: cost against size, and where a step's time goes.

usage: plot_performance.py OUT.png scaling.json throughput.json   (needs python3-matplotlib)
"""
import json
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402


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


def draw_passes(axis, throughput):
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


def main():
    out, scaling, throughput = sys.argv[1], *[json.load(open(p)) for p in sys.argv[2:4]]
    figure, axes = plt.subplots(1, 2, figsize=(13, 3.4), width_ratios=[1, 1.3])
    draw_growth(axes[0], scaling)
    draw_passes(axes[1], throughput)
    figure.tight_layout()
    figure.savefig(out, dpi=130)


if __name__ == "__main__":
    main()
