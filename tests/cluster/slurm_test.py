#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""`sturz submit` on a real Slurm of four made-up nodes: the bits of one machine whatever happens to
tasks, nodes and the call itself. Usage: slurm_test.py PROGRAM SOURCE_FOLDER

Two ensembles that take their time (a time limit, a lock that must first fall silent) run beside the
other tests: their last checks come at the end (tests run by name)."""
import json
import os
import pathlib
import random
import resource
import signal
import subprocess
import sys
import time
import unittest

from ensembles import PROGRAM, Ensembles, skip_all
from fake_cluster import FakeCluster, Unavailable

CLUSTER = None  # of all tests
# All of it, so that no member has to be tried.
ASKED = ("--memory", "500", "--maps-time", "5", "--maps-memory", "500")
SLOW_M = 0.15  # spacing at which a member takes about half a second


class OnSlurm(Ensembles):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.tiny = cls.scene("tiny", members=12)
        cls.slow = cls.scene("slow", members=24, spacing_m=SLOW_M)

    @classmethod
    def environment(cls):
        inherited = super().environment()
        return CLUSTER.environment(**{k: v for k, v in inherited.items()
                                      if k in ("XDG_CACHE_HOME", "OMP_WAIT_POLICY")})

    @classmethod
    def submit(cls, scene, out, *more, code=0, **environment):
        limit = () if "--time" in more else ("--time", "10")
        return cls.sturz("submit", "--slurm", scene, "-o", out, *ASKED, *limit, *more, code=code, **environment)

    @classmethod
    def submitted(cls, scene, out, *more, **environment):
        return json.loads(cls.submit(scene, out, *more, "--json", **environment).stdout.splitlines()[-1])

    @staticmethod
    def queue(name, form="%F_%K %T %r"):
        return CLUSTER.ask("squeue", "-h", "--array", f"--name={name},{name}-maps", "-o", form).splitlines()

    def wait_until(self, done, seconds=60, what=""):
        end = time.monotonic() + seconds
        while not done():
            if time.monotonic() > end:
                self.fail(f"waited {seconds} s: {what}\n{CLUSTER.ask('squeue', '--array')}")
            time.sleep(0.25)

    def wait_for_end(self, name, seconds=90):
        self.wait_until(lambda: not self.queue(name), seconds, f"the jobs of {name}")

    def wait_for_worker(self, out, shard):
        """The process that computes a shard, once a member of it is there."""
        found = []

        def computes():
            state = self.status(out)
            found[:] = [w for w in state["workers"] if w["shard"] == shard and w["workers"] > 0]
            return found and state["shards"][shard - 1]["valid"] > 0
        self.wait_until(computes, 60, f"shard {shard} of {out}")
        return found[0]

    @staticmethod
    def log(out, name):
        return (out / "cluster/log" / name).read_text()


class Submit(OnSlurm):
    """In this order; what a and b begin is checked by y and z."""
    begun = {}

    def test_a_a_time_limit_is_met(self):
        # Slurm's shortest limit is a minute, and it looks twice a minute: a good half of one to compute.
        four = self.scene("four", members=4, spacing_m=SLOW_M)
        before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
        self.sturz("ensemble", four, "-o", self.root / "four", "--shard", "1/1", "--workers", "1", OMP_THREAD_LIMIT="1")
        member_s = (resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before) / 4
        scene = self.scene("limit", members=max(8, int(45 / member_s)), spacing_m=SLOW_M)
        out = self.root / "limit"
        job = self.submitted(scene, out, "--shards", "1", "--time", "1", "--sbatch=--exclude=n2,n3,n4")
        self.begun["limit"] = (scene, out, job["name"])

    def test_b_a_killed_task_leaves_a_gap_that_is_named_and_only_that_is_submitted_again(self):
        out = self.root / "killed"
        job = self.submitted(self.slow, out, "--shards", "3", "--sbatch=--exclude=n1")
        self.assertEqual(job["submitted_shards"], [1, 2, 3])
        worker = self.wait_for_worker(out, 2)
        state = self.status(out)
        self.assertEqual(state["maps"], "none")
        self.assertGreater(state["remaining_s"], 0)
        self.assertEqual(worker["job"].split("/")[:2], ["slurm", "sturz"])
        if CLUSTER.own_names:
            self.assertIn(worker["host"], CLUSTER.names)
        os.kill(worker["pid"], signal.SIGKILL)
        self.wait_until(lambda: not [q for q in self.queue(job["name"], "%j %T") if q.split()[0] == job["name"]])
        again = self.submitted(self.slow, out)
        self.assertEqual((again["submitted_shards"], again["shards"]), ([2], 3))
        self.begun["killed"] = (self.slow, out, job["name"])

    def test_c_array_and_merge(self):
        out = self.root / "array"
        job = self.submitted(self.tiny, out, "--shards", "4")
        self.wait_for_end(job["name"])
        self.check_complete(out, self.tiny)
        self.assertTrue(self.submitted(self.tiny, out)["nothing_to_do"])
        more = self.submitted(self.tiny, out, "-n", "16")
        self.assertEqual(more["submitted_shards"], [1, 2, 3, 4])
        self.wait_for_end(job["name"])
        self.check_complete(out, self.scene("sixteen", members=16))

    def test_d_a_requeued_task_goes_on(self):
        out = self.root / "requeued"
        job = self.submitted(self.slow, out, "--shards", "2", "--sbatch=--exclude=n1,n2")
        self.wait_for_worker(out, 2)
        CLUSTER.ask("scontrol", "requeue", f"{job['array_jobs'][-1]}_2")
        self.wait_for_end(job["name"])
        self.assertIn("started 1 times before", self.log(out, "shard_2.txt"))
        self.check_complete(out, self.slow)

    def test_e_a_node_is_lost_while_its_task_goes_on_computing(self):
        out = self.root / "lost"
        job = self.submitted(self.slow, out, "--shards", "2", "--sbatch=--exclude=n1,n2")
        worker = self.wait_for_worker(out, 1)
        place = f"{job['array_jobs'][-1]}_1"
        node = CLUSTER.ask("squeue", "-h", "-j", place, "-o", "%N").strip()
        CLUSTER.children[node].send_signal(signal.SIGSTOP)  # the daemon hears nothing; the task computes
        try:
            CLUSTER.ask("scontrol", "update", f"nodename={node}", "state=down", "reason=test")
            self.wait_until(lambda: "started 1 times before" in self.log(out, "shard_1.txt"), 60, "a second start")
            self.wait_for_end(job["name"])
        finally:
            CLUSTER.children[node].send_signal(signal.SIGCONT)
            CLUSTER.ask("scontrol", "update", f"nodename={node}", "state=resume")
        self.wait_until(lambda: not pathlib.Path(f"/proc/{worker['pid']}").exists(), 60, "the first start's end")
        self.check_complete(out, self.slow)

    def test_f_a_disk_that_is_full_on_one_node(self):
        out = self.root / "full"
        limit = self.root / "limit.sh"
        limit.write_text('case ${SLURMD_NODENAME:-} in n4) ulimit -f 64 ;; esac\n')
        job = self.submitted(self.slow, out, "--shards", "4", "--sbatch=--exclude=n1,n2", BASH_ENV=str(limit))
        self.wait_for_end(job["name"])
        missing = self.status(out)["missing_shards"]
        self.assertTrue(0 < len(missing) < 4, missing)
        self.assertIn("A limit on the size of files is set", self.log(out, f"shard_{missing[0]}.txt"))
        self.assertRegex(self.log(out, "maps.txt"), rf"Shards? {missing[0]}[\d,-]* of 4 (is|are) not finished")
        again = self.submitted(self.slow, out)
        self.assertEqual(again["submitted_shards"], missing)
        self.wait_for_end(job["name"])
        self.check_complete(out, self.slow)

    def test_g_submit_killed_at_random_instants(self):
        instants = random.Random(20261130)
        begin = time.monotonic()
        done = self.submitted(self.tiny, self.root / "timed", "--shards", "2")
        whole_s = time.monotonic() - begin
        self.wait_for_end(done["name"])
        words = [PROGRAM, "submit", "--slurm", self.tiny, "--shards", "2", *ASKED, "--time", "10", "-o"]
        for i in range(6):
            out = self.root / f"cut-{i}"
            call = subprocess.Popen([*map(str, words), str(out)], cwd=self.root, env=self.environment(),
                                    stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            time.sleep(whole_s * instants.uniform(0.2, 1))
            call.kill()
            call.wait()
            record = out / "cluster/submission.json"
            if record.exists() and not json.loads(record.read_text())["complete"]:
                self.assertIn("stopped half-way", self.sturz("status", out).stderr)
            again = self.submitted(self.tiny, out, "--shards", "2")
            self.wait_for_end(again["name"])
            self.check_complete(out, self.tiny)

    def test_h_what_the_cluster_does_not_take_is_refused(self):
        out = self.root / "refused"
        said = self.submit(self.tiny, out, "--shards", "11", code=1).stderr
        self.assertIn("11 shards (this cluster takes arrays up to task 10, MaxArraySize)", said)
        said = self.submit(self.tiny, out, "--shards", "2", "--partition", "nowhere", code=1).stderr
        self.assertIn("invalid partition", said)
        self.assertEqual(self.status(out)["submission"]["array_jobs"], [])
        nothing = self.root / "empty"
        nothing.mkdir()
        said = self.submit(self.tiny, out, code=1, PATH=str(nothing)).stderr
        self.assertIn("sbatch is not here", said)
        done = self.sturz("submit", "--dry-run", self.tiny, "-o", self.root / "dry", *ASKED, PATH=str(nothing))
        self.assertIn("not submitted", done.stdout)
        self.assertEqual(sorted(p.name for p in (self.root / "dry/cluster").glob("*.sh")), ["merge.sh", "shard.sh"])
        self.assertEqual(CLUSTER.ask("squeue", "-h", "--name", again_name(self.root / "dry")).strip(), "")

    def test_y_the_gap_is_closed(self):
        scene, out, name = self.begun["killed"]
        self.wait_for_end(name, 120)
        self.check_complete(out, scene)

    def test_z_the_limited_ensemble_is_done(self):
        scene, out, name = self.begun["limit"]
        self.wait_for_end(name, 150)
        log = self.log(out, "shard_1.txt")
        self.assertIn("stopped at the time limit; goes on in another turn", log)
        self.assertIn("started 1 times before", log)
        self.check_complete(out, scene)


def again_name(out):
    return json.loads((out / "cluster/submission.json").read_text())["name"] \
        if (out / "cluster/submission.json").exists() else "none"


if __name__ == "__main__":
    signal.signal(signal.SIGTERM, signal.default_int_handler)  # the daemons are stopped on the way
    try:
        with FakeCluster(4, max_array=11) as CLUSTER:
            program = unittest.main(argv=[sys.argv[0], *sys.argv[3:]], exit=False, verbosity=2)
    except Unavailable as why:
        skip_all(f"no Slurm here ({why})")
    sys.exit(not program.result.wasSuccessful())
