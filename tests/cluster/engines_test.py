#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Shards by hand, by GNU parallel and by Snakemake: the bits of one machine, and clear words where
something is missing. Usage: engines_test.py PROGRAM SOURCE_FOLDER"""
import os
import shutil
import signal
import subprocess
import sys
import time
import unittest

from ensembles import Ensembles, PROGRAM, SOURCE

EXAMPLES = SOURCE / "docs/examples/cluster"


class Engines(Ensembles):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.tiny = cls.scene("tiny", members=12)

    def test_shards_of_any_number_that_start_together(self):
        for n in (1, 3, 7):
            out = self.root / f"by-{n}"
            words = [PROGRAM, "ensemble", self.tiny, "-o", out, "--workers", "1", "--shard"]
            started = [subprocess.Popen([*map(str, words), f"{k}/{n}"], cwd=self.root, env=self.environment(),
                                        stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
                       for k in range(1, n + 1)]
            for shard in started:
                _, said = shard.communicate(timeout=120)
                self.assertEqual(shard.returncode, 0, said)
            self.sturz("merge", out)
            self.check_complete(out, self.tiny)

    def test_the_task_of_a_scheduler_is_a_shard(self):
        out = self.root / "auto"
        ensemble = ("ensemble", self.tiny, "-o", out, "--shard", "auto/3")
        self.sturz(*ensemble, SLURM_ARRAY_TASK_ID="1")
        self.sturz(*ensemble, SLURM_ARRAY_TASK_ID="1", HQ_TASK_ID="3")
        self.assertEqual(self.status(out)["missing_shards"], [2])
        self.sturz(*ensemble, "--first-task", "0", HQ_TASK_ID="1")
        self.assertEqual(self.status(out)["missing_shards"], [])
        said = self.sturz(*ensemble, code=1).stderr
        self.assertIn("neither SLURM_ARRAY_TASK_ID nor HQ_TASK_ID is set", said)
        said = self.sturz(*ensemble, code=1, SLURM_ARRAY_TASK_ID="0").stderr
        self.assertIn("SLURM_ARRAY_TASK_ID is 0 (tasks 1 to 3 compute shards 1 to 3)", said)

    def test_merge_names_missing_shards_and_a_command_that_works(self):
        out = self.root / "gaps"
        for k in (1, 4):
            self.sturz("ensemble", self.tiny, "-o", out, "--shard", f"{k}/5")
        said = self.sturz("merge", out, code=1).stderr
        self.assertIn("7 of 12 members are missing (1, 2, 4, 6, 7, 9, 11)", said)
        self.assertIn("Shards 2,3,5 of 5 are not finished", said)
        self.assertIn("--shard K/5 with K = 3,5", said)
        command = said.split("computed them: ")[1].split(", and --shard")[0]
        self.assertTrue(command.startswith("sturz ensemble "), command)
        for k in (2, 3, 5):
            words = command.replace("sturz", PROGRAM, 1).replace("--shard 2/5", f"--shard {k}/5")
            subprocess.run(words, shell=True, check=True, cwd=self.root, env=self.environment(),
                           stdout=subprocess.DEVNULL)
        self.sturz("merge", out)
        self.check_complete(out, self.tiny)

    def test_terminated_shards_end_within_ten_seconds_with_three(self):
        scene = self.scene("long", members=40, spacing_m=0.4)
        out = self.root / "stopped"
        words = [PROGRAM, "ensemble", str(scene), "-o", str(out), "--workers", "1", "--shard", "1/2"]
        for which in (signal.SIGUSR1, signal.SIGTERM):
            shard = subprocess.Popen(words, cwd=self.root, env=self.environment(), stdout=subprocess.DEVNULL,
                                     stderr=subprocess.DEVNULL)
            while not list(out.glob("lock_1_of_2.json")) and shard.poll() is None:
                time.sleep(0.02)
            sent = time.monotonic()
            shard.send_signal(which)
            self.assertEqual(shard.wait(60), 3)
            self.assertLess(time.monotonic() - sent, 10)
        self.assertEqual([p.name for p in out.glob("lock*")], [])

    def test_gnu_parallel(self):
        line = next(l for l in (EXAMPLES / "gnu_parallel.sh").read_text().splitlines() if l.startswith("parallel "))
        if not shutil.which("parallel"):
            self.skipTest("parallel is not installed")
        out = self.root / "parallel"
        variables = {"STURZ": PROGRAM, "SCENE": str(self.tiny), "OUT": str(out), "SHARDS": "3"}
        done = subprocess.run(["bash", EXAMPLES / "gnu_parallel.sh"], cwd=self.root, text=True, capture_output=True,
                              env=dict(self.environment(), PARALLEL_HOME=str(self.root), **variables))
        self.assertEqual(done.returncode, 0, line + done.stdout + done.stderr)
        self.check_complete(out, self.tiny)

    def test_snakemake(self):
        if not shutil.which("snakemake"):
            self.skipTest("snakemake is not installed")
        out = self.root / "snake"
        words = ["snakemake", "--snakefile", EXAMPLES / "Snakefile", "--directory", self.root, "--cores", "2",
                 "--quiet", "--config", f"sturz={PROGRAM}", f"scene={self.tiny}", f"out={out}", "shards=3"]
        environment = dict(self.environment(), HOME=str(self.root))
        done = subprocess.run(list(map(str, words)), text=True, capture_output=True, env=environment)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.check_complete(out, self.tiny)

    def test_a_full_disk_stops_a_shard_and_the_rerun_completes_it(self):
        out = self.root / "full"
        out.mkdir()
        made = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=160k", "tmpfs", str(out)], capture_output=True)
        if made.returncode != 0:
            self.skipTest("no small disk can be made here (mount of a tmpfs is not allowed)")
        try:
            said = self.sturz("ensemble", self.tiny, "-o", out, "--shard", "1/1", code=1).stderr
            self.assertIn("No space left on device", said)
            self.assertIn("MB free in", said)
            subprocess.run(["mount", "-o", "remount,size=64m", str(out)], check=True)
            self.assertLess(self.status(out)["finished"], 12)
            self.sturz("ensemble", self.tiny, "-o", out, "--shard", "1/1")
            self.sturz("merge", out)
            self.check_complete(out, self.tiny)
        finally:
            subprocess.run(["umount", str(out)], check=True)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
