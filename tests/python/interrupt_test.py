# SPDX-License-Identifier: Apache-2.0
"""Ctrl-C, and what a listener raises, end the program in order; the same call goes on."""
import pathlib
import signal
import subprocess
import sys
import time
import unittest

import sturz
from scenes import InFolder, long_slide, slide


class Interrupts(InFolder):
    def test_what_a_listener_raises_stops_it_and_the_same_call_goes_on(self):
        class Enough(Exception):
            pass

        def third(event):
            if event["event"] == "member" and len(list(pathlib.Path("cut/members").glob("*.nc"))) >= 3:
                raise Enough

        with self.assertRaises(Enough):
            sturz.ensemble(slide(), "cut", members=32, workers=1, progress=third)
        done = len(list(pathlib.Path("cut/members").glob("*.nc")))
        self.assertTrue(3 <= done < 32, done)
        events = []
        resumed = sturz.ensemble(slide(), "cut", members=32, progress=events.append)
        start = next(event for event in events if event["event"] == "start")
        self.assertGreaterEqual(start["finished_before"], 3)
        self.assertEqual(sum(event["event"] == "member" for event in events),
                         32 - start["finished_before"])
        whole = sturz.ensemble(slide(), "whole", members=32)
        self.assertEqual(resumed.hazard_hash, whole.hazard_hash)

    def test_ctrl_c_of_a_script(self):
        code = (f"import sturz\nscene = {long_slide()!r}\n"
                "try:\n    sturz.ensemble(scene, 'out', progress=lambda e: print(e['event'], flush=True))\n"
                "except KeyboardInterrupt:\n    print('stopped')\n")
        script = subprocess.Popen([sys.executable, "-W", "ignore", "-c", code], stdout=subprocess.PIPE,
                                  text=True)
        self.addCleanup(script.kill)
        for line in script.stdout:
            if line.strip() == "start":
                break
        time.sleep(0.5)
        begin = time.monotonic()
        script.send_signal(signal.SIGINT)
        self.assertEqual(script.stdout.read().split()[-1], "stopped")
        self.assertEqual(script.wait(timeout=10), 0)
        script.stdout.close()
        self.assertLess(time.monotonic() - begin, 5)
        # The folder is free: nothing runs on in the background.
        with self.assertRaises(sturz.ScenarioError):
            sturz.ensemble(slide(), "out")
        self.assertIn("interrupted", pathlib.Path("out/log.txt").read_text())


if __name__ == "__main__":
    unittest.main()
