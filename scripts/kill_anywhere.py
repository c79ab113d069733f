#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""kill_anywhere.py PROGRAM [--instants N] [--kinds KIND ...] [--seed S] [--state FILE]

Kills the program with SIGKILL at random instants of its life, runs the same command again, and compares
the bytes of hazard.nc with those of a run that was left alone. Kinds, each N instants:

  runner  members in files of their own      maps    from members that are there to the page
  pack    members in packs                   batch   a list of two scenarios, all of it
  merge   maps of what shards left           submit  to a real Slurm on this machine (root; else left out)

An instant is a fraction of the time that the command takes, drawn from seed, kind and number; it is drawn
again when the program had ended before. With --state what is done is kept, and a call that was stopped goes
on there. The last line tells the sum; the exit code is zero when all bits were the same.
"""
import argparse
import hashlib
import json
import os
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "tests/cluster"))
from fake_cluster import FakeCluster, Unavailable  # noqa: E402

KINDS = ("runner", "pack", "merge", "maps", "batch", "submit")
SCENE = """\
title: under fire
terrain:
  synthetic: {plane: {cell_size_m: 2, slope_deg: 30, length_m: 120, width_m: 50}}
release:
  box: {x_m: [-50, -40], y_m: [-5, 5]}
  thickness_m: 3
grains: {density_kg_m3: 2600, solid_fraction: 0.6, friction_angle_deg: 30}
basal:
  friction_coefficient: {uniform: [0.3, 0.7]}
  pore_pressure_ratio: {uniform: [0.0, 0.3]}
numerics: {spacing_m: 1, end_time_s: 1.5}
ensemble: {design: sobol, members: 24, seed: 1}
hazard: {cell_size_m: 2, thickness_m: [0.5, 1], speed_m_s: [1]}
formulation: depth_averaged
"""
LIST = """\
jobs:
  - {name: dry, scenario: scene.yaml}
  - {name: wet, scenario: scene.yaml, set: {basal.pore_pressure_ratio: 0.4}, members: 12}
"""


def fail(text):
    sys.exit(f"kill_anywhere: {text}")


class Case:
    """One kind of work in folders of its own; the same relative names everywhere, so that the same is written."""

    def __init__(self, kind, program, root, cluster):
        self.kind, self.program, self.root, self.cluster = kind, program, root, cluster
        self.words = {
            "runner": ["ensemble", "scene.yaml", "-o", "out", "--workers", "2"],
            "pack": ["ensemble", "scene.yaml", "-o", "out", "--workers", "2", "--packs"],
            "maps": ["ensemble", "scene.yaml", "-o", "out", "--workers", "2"],
            "merge": ["merge", "out"],
            "batch": ["batch", "list.yaml", "-o", "out"],
            "submit": ["submit", "--slurm", "scene.yaml", "-o", "out", "--shards", "2", "--time", "10",
                       "--memory", "500", "--maps-time", "5", "--maps-memory", "500"],
        }[kind]
        self.start = root / f"{kind}-start"  # what is there before the command
        self.prepare()
        whole = self.copied("whole")
        begin = time.monotonic()
        self.run(whole)
        self.life_s = time.monotonic() - begin
        self.settle(whole)
        self.expected = self.bytes_of(whole)
        if not self.expected:
            fail(f"{kind}: no hazard.nc")

    def environment(self):
        kept = {k: v for k, v in os.environ.items() if not k.startswith(("SLURM", "HQ_"))}
        base = self.cluster.environment() if self.cluster else {}
        return dict(base, **{k: v for k, v in kept.items() if k not in base},
                    XDG_CACHE_HOME=str(self.root / "cache"), OMP_WAIT_POLICY="passive")

    def sturz(self, folder, *words):
        done = subprocess.run([self.program, *words], cwd=folder, text=True, capture_output=True,
                              env=self.environment())
        if done.returncode != 0:
            fail(f"{self.kind}: sturz {' '.join(words)} ended with {done.returncode}\n{done.stdout}{done.stderr}")

    def run(self, folder):
        self.sturz(folder, *self.words)

    def prepare(self):
        self.start.mkdir()
        (self.start / "scene.yaml").write_text(SCENE)
        (self.start / "list.yaml").write_text(LIST)
        if self.kind == "merge":
            for k in (1, 2, 3):
                self.sturz(self.start, "ensemble", "scene.yaml", "-o", "out", "--shard", f"{k}/3",
                           *(["--packs"] if k < 3 else []))
        elif self.kind == "maps":  # all members, and a manifest that knows of no maps
            self.sturz(self.start, "ensemble", "scene.yaml", "-o", "out", "--shard", "1/1", "--workers", "2")
            for name in ("hazard", "hazard.nc", "report.html", "members.csv"):
                path = self.start / "out" / name
                shutil.rmtree(path) if path.is_dir() else path.unlink(missing_ok=True)

    def copied(self, name):
        folder = self.root / f"{self.kind}-{name}"
        shutil.rmtree(folder, ignore_errors=True)
        shutil.copytree(self.start, folder, symlinks=True)
        return folder

    def settle(self, folder):
        """Of a submitted ensemble: until the cluster has made its maps."""
        if self.kind != "submit":
            return
        name = json.loads((folder / "out/cluster/submission.json").read_text())["name"]
        end = time.monotonic() + 300
        while any(name in line for line in self.cluster.ask("squeue", "-h", "-o", "%j").splitlines()):
            if time.monotonic() > end:
                fail(f"submit: jobs of {name} do not end")
            time.sleep(0.3)

    def bytes_of(self, folder):
        """SHA-256 of each hazard.nc; of a batch by the name of its job."""
        files = sorted(f for f in (folder / "out").rglob("hazard.nc") if not f.parent.is_symlink())
        return [hashlib.sha256(f.read_bytes()).hexdigest() for f in files]

    def strike(self, instants):
        """Kills one process. \\return what is left, and after how many ms it was killed"""
        while True:
            folder = self.copied("struck")
            after_s = instants.random() * self.life_s
            process = subprocess.Popen([self.program, *self.words], cwd=folder, env=self.environment(),
                                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            time.sleep(after_s)
            process.send_signal(signal.SIGKILL)
            if process.wait() == -signal.SIGKILL:
                return folder, int(1000 * after_s)

    def instant(self, seed, number):
        folder, ms = self.strike(random.Random(f"{seed}/{self.kind}/{number}"))
        held = sum(1 for f in folder.rglob("*") if f.is_file())
        self.run(folder)
        self.settle(folder)
        same = self.bytes_of(folder) == self.expected
        left = [str(f.relative_to(folder)) for f in folder.rglob("*")
                if f.suffix == ".part" or f.name.startswith("lock")]
        return {"ms": ms, "files": held, "same": same and not left, "left": left}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("--instants", type=int, default=7)
    parser.add_argument("--kinds", nargs="+", choices=KINDS, default=KINDS)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--state", type=pathlib.Path)
    asked = parser.parse_args()
    done = json.loads(asked.state.read_text()) if asked.state and asked.state.exists() else {}
    print(f"seed {asked.seed}, {asked.instants} instants of each of: {' '.join(asked.kinds)}")
    with tempfile.TemporaryDirectory(prefix="sturz-kills-") as name:
        root = pathlib.Path(name)
        root.chmod(0o755)
        for kind in asked.kinds:
            wanted = [f"{asked.seed}/{kind}/{i}" for i in range(asked.instants)]
            if any(w not in done for w in wanted):
                try:
                    strike_all(kind, asked, root, done)
                except Unavailable as why:
                    print(f"{kind}: left out ({why})")
            of_kind = [done[w] for w in wanted if w in done]
            print(f"{kind}: {sum(d['same'] for d in of_kind)} of {len(of_kind)} the same", flush=True)
    mine = {k: v for k, v in done.items() if k.startswith(f"{asked.seed}/")}
    same = sum(d["same"] for d in mine.values())
    print(f"{same} of {len(mine)} instants gave the same bytes of hazard.nc")
    sys.exit(same != len(mine) or not mine)  # nothing that was killed shows nothing


def strike_all(kind, asked, root, done):
    program = asked.program.resolve()
    cluster = FakeCluster(2) if kind == "submit" else None
    if cluster:
        cluster.__enter__()
    try:
        case = Case(kind, str(program), root, cluster)
        print(f"{kind}: left alone {case.life_s:.2f} s, hazard.nc {' '.join(e[:12] for e in case.expected)}")
        for i in range(asked.instants):
            key = f"{asked.seed}/{kind}/{i}"
            if key in done:
                continue
            done[key] = case.instant(asked.seed, i)
            d = done[key]
            print(f"  {key}: killed after {d['ms']} ms with {d['files']} files there: "
                  f"{'the same' if d['same'] else 'OTHER ' + ' '.join(d['left'])}", flush=True)
            if asked.state:
                asked.state.write_text(json.dumps(done, indent=1))
    finally:
        if cluster:
            cluster.__exit__()


if __name__ == "__main__":
    main()
