#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Holds what `sturz describe` says of an ensemble against what it uses: six scenes of both kinds.

usage: forecasts.py STURZ CASES FOLDER [NAME ...]
STURZ is the program, CASES the folder of shipped cases, FOLDER takes scenes and results (a new or empty one).
Prints a table in Markdown. Seconds are of computing (user and system, all threads), so that others may use the
machine meanwhile. Members are what the ensemble took more than the same command again, which starts and makes the maps.
"""
import json
import os
import pathlib
import subprocess
import sys

SLIDE = """title: slide made for this table
terrain:
  synthetic: {plane: {cell_size_m: 4, slope_deg: 22, length_m: 400, width_m: 160}}
release:
  box: {x_m: [-150, -110], y_m: [-20, 20]}
  thickness_m: {uniform: [4, 7]}
grains: {density_kg_m3: 2650, solid_fraction: 0.6, friction_angle_deg: 32}
basal:
  friction_coefficient: {uniform: [0.45, 0.65]}
numerics: {spacing_m: 2}
ensemble: {design: sobol, members: 8, seed: 3}
hazard: {cell_size_m: 4, thickness_m: [0.5, 2], speed_m_s: [1, 5]}
formulation: %s
"""
SCENES = {
    "columns, shipped": ("zhangjiawan", {"ensemble.members": 48}),
    "columns, large maps": ("zhangjiawan", {"ensemble.members": 120, "numerics.spacing_m": 8,
                                            "hazard.cell_size_m": 2.5}),
    "columns, tiny members": ("depth_averaged", {"ensemble.members": 300}),
    "full stress, shipped": ("zhangjiawan", {"ensemble.members": 6, "numerics.spacing_m": 10,
                                             "formulation": "full_stress"}),
    "full stress, other case": ("shuicheng_dry", {"ensemble.members": 6, "numerics.spacing_m": 10,
                                                  "formulation": "full_stress"}),
    "full stress, short slide": ("full_stress", {"ensemble.members": 8}),
}


def scene_file(which, cases, folder):
    if which not in ("depth_averaged", "full_stress"):
        return pathlib.Path(cases) / which / "scenario.yaml"
    file = folder / f"slide_{which}.yaml"
    file.write_text(SLIDE % which)
    return file


def used(command):
    """Seconds of computing, most memory [bytes], JSON lines of a command that has to succeed."""
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
    out = process.stdout.read()
    _, status, usage = os.wait4(process.pid, 0)
    if status != 0:
        sys.exit(f"failed: {' '.join(map(str, command))}\n{out}")
    lines = [json.loads(line) for line in out.splitlines()]
    return usage.ru_utime + usage.ru_stime, usage.ru_maxrss * 1024, lines


def size(path):
    if path.is_file():
        return path.stat().st_size
    return sum(f.stat().st_size for f in path.rglob("*") if f.is_file())


def compared(sturz, name, cases, folder):
    which, changes = SCENES[name]
    scene = [scene_file(which, cases, folder)]
    for key, value in changes.items():
        scene += ["--set", f"{key}={value}"]
    said = used([sturz, "describe", *scene, "--json"])[2][0]["forecast"]
    said["maps_cpu_s"] = {k: v + said["start_cpu_s"] for k, v in said["maps_cpu_s"].items()}
    out = folder / name.replace(",", "").replace(" ", "_")
    command = [sturz, "ensemble", *scene, "-o", out, "--json"]
    first_s, memory, lines = used(command)
    again_s = used(command)[0]
    start = next(line for line in lines if line.get("event") == "start")
    if start["forecast"]:
        first_s -= start["forecast"]["trial_cpu_s"]
    members_bytes = size(out / "members")
    return said, {"members_cpu_s": first_s - again_s, "maps_cpu_s": again_s, "total_cpu_s": first_s,
                  "memory_bytes": memory, "members_disk_bytes": members_bytes,
                  "maps_disk_bytes": size(out) - members_bytes}


def text(said, used_value, unit):
    factor = max(said["likely"] / used_value, used_value / said["likely"])
    outside = "" if said["low"] <= used_value <= said["high"] else " **outside**"
    return (f"{said['likely'] / unit:.3g} ({said['low'] / unit:.3g}-{said['high'] / unit:.3g}) / "
            f"{used_value / unit:.3g}{outside}, {factor:.2f}"), factor


def main():
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    sturz, cases, folder = sys.argv[1], sys.argv[2], pathlib.Path(sys.argv[3])
    folder.mkdir(parents=True, exist_ok=True)
    names = sys.argv[4:] or list(SCENES)
    columns = [("members_cpu_s", "members s", 1), ("maps_cpu_s", "start and maps s", 1), ("total_cpu_s", "total s", 1),
               ("members_disk_bytes", "members MB", 1e6), ("maps_disk_bytes", "maps MB", 1e6),
               ("memory_bytes", "memory MB", 1e6)]
    print("| scene | tried | " + " | ".join(c[1] for c in columns) + " |")
    print("|---|---|" + "---|" * len(columns), flush=True)
    worst = {key: 1.0 for key, _, _ in columns}
    for name in names:
        said, measured = compared(sturz, name, cases, folder)
        row = [name, f"{said['tried_members']} of {said['members']} at {said['tried_spacing_m']:.3g} m"]
        for key, _, unit in columns:
            cell, factor = text(said[key], measured[key], unit)
            worst[key] = max(worst[key], factor)
            row.append(cell)
        print("| " + " | ".join(row) + " |", flush=True)
    print("| largest factor | | " + " | ".join(f"{worst[key]:.2f}" for key, _, _ in columns) + " |")
    print(f"\nmean load in the last 15 minutes: {os.getloadavg()[2]:.1f} on "
          f"{len(os.sched_getaffinity(0))} cores")


if __name__ == "__main__":
    main()
