# SPDX-License-Identifier: Apache-2.0
"""Whether a mixture runs or sticks: columns beside the equations of one sheet (T4), three spacings.

usage: plot_wet_columns.py OUT.png STURZ   (needs python3-numpy, python3-matplotlib; 2 min of CPU)
prints all numbers, too
"""
import json
import math
import subprocess
import sys
import tempfile
from pathlib import Path

import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

SLOPE = math.radians(31)
FRACTIONS = [0.55, 0.58, 0.60, 0.61, 0.62, 0.625, 0.63, 0.635, 0.64, 0.645, 0.65, 0.66, 0.68]
MATERIAL = """
grains: {density_kg_m3: 2700, solid_fraction: %s}
mixture: {fluid_density_kg_m3: 1100, critical_solid_fraction: 0.64}
basal: {friction_coefficient: 0.83909963}
formulation: depth_averaged
"""
SHEET = """title: endless sheet, one metre along the normal
terrain: {synthetic: {plane: {cell_size_m: 1, slope_deg: 31, length_m: 12, width_m: 12}}}
release: {box: {x_m: [-6, 6], y_m: [-6, 6]}, thickness_m: 1, thickness: normal}
domain: {periodic: [x, y]}
numerics: {spacing_m: %s, end_time_s: 10, stop_at_rest: false}
"""
SLIDE = """title: 2,400 m3 on 31 degrees and level ground
terrain: {synthetic: {ramp: {cell_size_m: 2, slope_deg: 31, slope_length_m: 200, transition_m: 20,
  level_length_m: 1600, width_m: 300}}}
release: {box: {x_m: [-160, -130], y_m: [-20, 20]}, thickness_m: 2}
numerics: {spacing_m: %s, end_time_s: 300}
"""


def sheet_alone(m, dt=1e-3, end=10):
    """Path of one metre of the mixture on 31 degrees, from rest with hydrostatic pressure [m].

    The equations of physics.md F.7 with coefficients frozen over steps of 1 ms, for arrays of m."""
    mu, k_r, critical, solid, fluid, a, offset, grain = 0.005, 1e-10, 0.64, 2700, 1100, 0.05, 1e3, 1e-3
    g, along, phi = 9.80665 * math.cos(SLOPE), 9.80665 * math.sin(SLOPE), math.radians(40)
    m = np.array(m, float)
    load = m * solid + (1 - m) * fluid
    excess, speed, path = np.zeros_like(m), np.zeros_like(m), np.zeros_like(m)
    for _ in range(round(end / dt)):
        rho = m * solid + (1 - m) * fluid
        h = load / rho
        effective = np.maximum(load * g - fluid * g * h - excess, 0)
        shear = 2 * speed / h
        number = mu * shear / np.maximum(solid * (shear * grain) ** 2 + effective, 1e-300)
        psi = m - critical / (1 + np.sqrt(number))
        stiffness = m * (effective + offset) / a
        k = k_r * np.exp((0.6 - m) / 0.04)
        decay = k / (h * mu) * np.maximum(3 * stiffness / h - 1.5 * fluid * g * (rho - fluid) / rho, 0)
        steady = -3 * speed * stiffness / h * psi / np.maximum(decay, 1e-12)
        after = steady + (excess - steady) * np.exp(-decay * dt)
        m = m * np.exp(2 * k / (h * h * mu) * 0.5 * (excess + after) * dt)
        rho = m * solid + (1 - m) * fluid
        h = load / rho
        excess = np.clip(after, -fluid * g * h, load * g - fluid * g * h)
        effective = np.maximum(load * g - fluid * g * h - excess, 0)
        brake = effective * np.tan(phi + np.arctan(psi)) / load
        pulled = np.maximum(speed + dt * (along - brake), 0)
        pulled *= np.exp(-(1 - m) * 2 * mu * dt / (h * load))
        path += 0.5 * (speed + pulled) * dt
        speed = pulled
    return path


def run(sturz, scene, spacing, fraction):
    with tempfile.TemporaryDirectory() as folder:
        scenario = Path(folder) / "scene.yaml"
        scenario.write_text(scene % spacing + MATERIAL % fraction)
        out = subprocess.run([sturz, "run", str(scenario), "-o", f"{folder}/out", "--json"],
                             capture_output=True, text=True, check=True).stdout
    done = [json.loads(line) for line in out.splitlines() if '"done"' in line][-1]
    return done["scalars"]


def main():
    out, sturz = sys.argv[1:3]
    figure, (left, right) = plt.subplots(1, 2, figsize=(11, 3.8))
    fine = np.linspace(0.55, 0.68, 131)
    left.plot(fine, sheet_alone(fine), color="black", linewidth=1, label="one sheet, 1 ms")
    exact = sheet_alone(FRACTIONS)
    for spacing, marker in ((2, "s"), (1, "o"), (0.5, "x")):
        path = [run(sturz, SHEET, spacing, m)["com_travel_m"] / math.cos(SLOPE) for m in FRACTIONS]
        worst = np.max(np.abs(path - exact) / exact)
        print(f"sheet, {spacing} m: path after 10 s", " ".join(f"{p:.4g}" for p in path),
              f"| worst {100 * worst:.2f} %")
        left.plot(FRACTIONS, path, marker, markersize=5, fillstyle="none", label=f"columns, {spacing} m")
    print("one sheet:", " ".join(f"{p:.4g}" for p in exact))
    for spacing, marker in ((4, "s"), (2, "o"), (1, "x")):
        runs = [run(sturz, SLIDE, spacing, m) for m in FRACTIONS]
        print(f"slide, {spacing} m: runout", " ".join(f"{r['runout_m']:.4g}" for r in runs),
              "| centre of mass", " ".join(f"{r['com_travel_m']:.4g}" for r in runs))
        right.plot(FRACTIONS, [r["com_travel_m"] for r in runs], marker + "-", markersize=5,
                   linewidth=0.7, fillstyle="none", label=f"columns, {spacing} m")
    right.set_yscale("log")
    for axis, what in ((left, "path of an endless sheet after 10 s [m]"),
                       (right, "centre of mass of 2,400 m3 at rest, travelled [m]")):
        axis.axvline(0.64, linestyle="--", color="grey", linewidth=0.8)
        axis.text(0.641, 0.95, "critical", transform=axis.get_xaxis_transform(), fontsize=7, color="grey")
        axis.set_xlabel("solid fraction at release")
        axis.set_ylabel(what, fontsize=8)
        axis.legend(fontsize=7)
    figure.tight_layout()
    figure.savefig(out, dpi=130)


if __name__ == "__main__":
    main()
