#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""scripts/build_quietly.sh with commands that only say what ninja would say. Usage: quiet_build_test.py
SCRIPT"""
import os
import pathlib
import pty
import subprocess
import sys
import tempfile
import time
import unittest

SCRIPT = sys.argv.pop(1)
STEPS = "echo '[1/4] Building a'; echo '[3/4] Building b'; sleep 3"


class QuietBuild(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.log = pathlib.Path(self.folder.name) / "build.log"

    def tearDown(self):
        self.folder.cleanup()

    def words(self, command, settings=""):
        text = f'set -euo pipefail; . "$1"; {settings} build_quietly "$2" bash -c "$3"'
        return ["bash", "-c", text, "-", SCRIPT, str(self.log), command]

    def run_plain(self, command, settings=""):
        return subprocess.run(self.words(command, settings), text=True, capture_output=True)

    def test_the_compilers_words_go_to_the_log_only(self):
        done = self.run_plain("echo '[1/1] warning: noise'")
        self.assertEqual(done.returncode, 0)
        self.assertNotIn("noise", done.stdout + done.stderr)
        self.assertIn("noise", self.log.read_text())
        self.assertIn(str(self.log), done.stdout)

    def test_without_a_terminal_a_line_comes_now_and_then(self):
        done = self.run_plain(STEPS, "build_tell_every=1;")
        self.assertIn("Building: 75 % (0:0", done.stdout)
        self.assertNotIn("\r", done.stdout)
        self.assertNotIn("Building: ", self.run_plain(STEPS).stdout)

    def test_on_a_terminal_one_line_is_written_over(self):
        shown = []

        def keep(descriptor):
            data = os.read(descriptor, 1024)
            shown.append(data)
            return data

        standard_output = os.dup(1)
        os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
        try:
            status = pty.spawn(self.words(STEPS), keep, lambda descriptor: b"")
        finally:
            os.dup2(standard_output, 1)
        text = b"".join(shown).decode()
        self.assertEqual(os.waitstatus_to_exitcode(status), 0)
        self.assertIn("\r\x1b[KBuilding: 75 % (0:0", text)
        self.assertEqual(text.count("\n"), 1, "only the closing line ends")

    def test_a_failure_shows_the_end_of_the_log_and_its_place(self):
        done = self.run_plain("seq 100; echo 'error: no'; exit 7")
        self.assertEqual(done.returncode, 7)
        self.assertIn("error: no", done.stderr)
        self.assertNotIn("\n50\n", done.stderr)
        self.assertIn(str(self.log), done.stderr)

    def test_an_interrupted_script_takes_its_compilers_along(self):
        mark = pathlib.Path(self.folder.name) / "lived on"
        script = subprocess.Popen(self.words(f"(sleep 4; touch '{mark}') & wait"),
                                  stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        time.sleep(1.5)
        script.terminate()
        self.assertNotEqual(script.wait(timeout=30), 0)
        time.sleep(4)
        self.assertFalse(mark.exists())

    def test_the_forecast_follows_the_cores(self):
        for cores, minutes in ((1, "8 to 13 minutes"), (2, "4 to 7 minutes"), (64, "a minute or two")):
            said = subprocess.run(
                ["bash", "-c", f'. "{SCRIPT}"; nproc() {{ echo {cores}; }}; build_core_seconds=600; build_forecast'],
                text=True, capture_output=True).stdout.strip()
            self.assertEqual(said, minutes)


if __name__ == "__main__":
    unittest.main()
