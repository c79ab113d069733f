#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The shipped examples of scheduled batches work as they are. Usage: examples_test.py PROGRAM EXAMPLES"""
import configparser
import datetime
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

PROGRAM, EXAMPLES = sys.argv[1], pathlib.Path(sys.argv[2])
del sys.argv[1:]

SCENE = """terrain: {synthetic: {plane: {cell_size_m: 2, slope_deg: 30, length_m: 120, width_m: 50}}}
release: {box: {x_m: [-50, -40], y_m: [-5, 5]}, thickness_m: 3}
grains: {density_kg_m3: 2600, solid_fraction: 0.6, friction_angle_deg: 30}
basal: {friction_coefficient: {uniform: [0.3, 0.5]}}
numerics: {spacing_m: 1, end_time_s: 1}
ensemble: {design: sobol, members: 2, seed: 1}
formulation: depth_averaged
"""


def at_clock(hour):
    """A time zone in which it is `hour` o'clock now."""
    shift = hour - datetime.datetime.now(datetime.timezone.utc).hour
    if shift < -12:
        shift += 24
    return f"TST{-shift:+d}" if shift else "TST0"


class Examples(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.home = pathlib.Path(self.folder.name)
        (self.home / "bin").mkdir()
        (self.home / "bin/sturz").symlink_to(PROGRAM)
        slopes = self.home / "slopes"
        slopes.mkdir()
        list_text = (EXAMPLES / "slopes.yaml").read_text()
        self.assertIn("min_free_disk_gb: 20", list_text)
        (slopes / "slopes.yaml").write_text(list_text.replace("min_free_disk_gb: 20", "min_free_disk_gb: 0"))
        (slopes / "slope.yaml").write_text(SCENE)
        self.environment = dict(os.environ, HOME=str(self.home), TZ=at_clock(23),
                                PATH=f"{self.home}/bin:" + os.environ["PATH"],
                                XDG_CACHE_HOME=str(self.home / "cache"))

    def tearDown(self):
        self.folder.cleanup()

    def cron_command(self):
        lines = [l for l in (EXAMPLES / "sturz-batch.cron").read_text().splitlines() if l and not l.startswith("#")]
        self.assertEqual(len(lines), 1)
        self.assertNotIn("%", lines[0], "cron makes line ends of them")
        fields = lines[0].split(None, 5)
        self.assertEqual(fields[:5], ["0", "20", "*", "*", "*"])
        return fields[5]

    def run_cron(self):
        return subprocess.run(["sh", "-c", self.cron_command()], env=self.environment, cwd="/", text=True,
                              capture_output=True)

    def test_the_cron_line_computes_the_list_at_night(self):
        done = self.run_cron()
        log = (self.home / "slopes/batch.log").read_text()
        self.assertEqual(done.returncode, 0, log + done.stdout)
        self.assertIn("4 jobs: 4 computed", log)
        for name in ("summary.csv", "summary.html", "outlines.gpkg", "weak/report.html", "medians/peaks.nc"):
            self.assertTrue((self.home / "slopes/results" / name).is_file(), name)

    def test_by_day_it_says_nothing_and_leaves_the_work_for_the_night(self):
        self.environment["TZ"] = at_clock(12)
        done = self.run_cron()
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))
        self.assertIn("to come", (self.home / "slopes/batch.log").read_text())

    def test_a_list_with_a_slip_is_mailed(self):
        (self.home / "slopes/slopes.yaml").write_text("jobs: [{name: a}]\n")
        self.assertIn("slopes.yaml:1:8: jobs[0] (scenario is missing)", self.run_cron().stdout)

    def test_the_units_are_understood(self):
        units = {}
        for name in ("sturz-batch.service", "sturz-batch.timer"):
            text = (EXAMPLES / name).read_text()
            units[name] = configparser.ConfigParser(strict=False, interpolation=None)
            units[name].optionxform = str
            units[name].read_string(text)
            # The program need not be installed where this runs.
            (self.home / name).write_text(text.replace("/usr/bin/sturz", str(self.home / "bin/sturz")))
        service = units["sturz-batch.service"]["Service"]
        self.assertEqual(service["SuccessExitStatus"], "3")
        self.assertEqual(service["ExecStart"].split()[:2], ["/usr/bin/sturz", "batch"])
        self.assertEqual(units["sturz-batch.timer"]["Timer"]["OnCalendar"], "*-*-* 20:00:00")
        if not shutil.which("systemd-analyze"):
            return
        done = subprocess.run(["systemd-analyze", "--user", "--man=no", "verify", self.home / "sturz-batch.service",
                               self.home / "sturz-batch.timer"], text=True, capture_output=True,
                              env=dict(self.environment, XDG_RUNTIME_DIR=str(self.home)))
        ours = [l for l in done.stderr.splitlines() if "sturz-batch" in l]
        self.assertEqual(ours, [], done.stderr)
        self.assertNotIn("Failed", done.stderr)


if __name__ == "__main__":
    unittest.main()
