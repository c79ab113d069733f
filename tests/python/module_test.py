# SPDX-License-Identifier: Apache-2.0
"""Members in this process: the bits of the command, arrays without copies, Python free meanwhile."""
import concurrent.futures
import gc
import multiprocessing
import os
import signal
import subprocess
import sys
import threading
import time
import unittest

import netCDF4
import numpy

import sturz
from scenes import InFolder, long_slide, slide

KEY = "basal.friction_coefficient"


SIMULATION = None  # what forked processes inherit


def hash_of_forked(friction):
    return SIMULATION.run({KEY: friction}).state_hash


def hash_of_new(friction):
    return sturz.Simulation(slide(), threads=2).run({KEY: friction}).state_hash


def error_of_forked():
    try:
        return SIMULATION.run().outcome
    except RuntimeError as refused:
        return str(refused)


class Bits(InFolder):
    def test_a_member_has_the_bits_of_the_command(self):
        full_stress = slide(formulation="full_stress", release={"box": {"x_m": [-130, -114], "y_m": [-8, 8]},
                                                                "thickness_m": 8},
                            basal={"friction_coefficient": {"uniform": [0.45, 0.65]}},
                            numerics={"spacing_m": 2, "end_time_s": 3})
        full_stress["grains"]["friction_angle_deg"] = 30
        for name, scene in (("columns", slide()), ("particles", full_stress)):
            values = {KEY: 0.52}
            member = sturz.Simulation(scene).run(values)
            command = sturz.run(scene, name, values=values)
            self.assertEqual(member.state_hash, command.state_hash, name)
            self.assertEqual(member.outcome, command.outcome)
            self.assert_same_scalars(member, command)
            self.assert_same_maps(member, f"{name}/members/000000.nc")

    def test_a_raster_of_which_only_a_part_is_read(self):
        whole = sturz.Scenario(slide()).write("whole.yaml")
        subprocess.run([sturz.program(), "terrain", whole, "-o", "ground"], check=True, capture_output=True)
        scene = slide(terrain={"raster": str(self.folder / "ground/elevation.tif"), "crs": "local"},
                      basal={"friction_coefficient": {"uniform": [0.6, 0.65]}})
        simulation = sturz.Simulation(scene)
        for friction in (0.61, 0.65, 0.5, 0.2):  # the last two lie beyond distribution and part
            values = {KEY: friction}
            command = sturz.run(scene, "out", values=values, replace=True)
            self.assertEqual(simulation.run(values).state_hash, command.state_hash, friction)

    def assert_same_scalars(self, member, command):
        self.assertEqual(set(member.scalars), set(command.scalars))
        for key, value in command.scalars.items():
            if key not in ("wall_s", "cpu_s"):
                numpy.testing.assert_equal(member.scalars[key], value, key)

    def assert_same_maps(self, member, file):
        """Every cell of every layer, as bits."""
        with netCDF4.Dataset(file) as stored:
            stored.set_auto_mask(False)
            self.assertGreaterEqual(len(member.peaks), 6)
            for layer, plane in member.peaks.items():
                kept = stored[layer][:].astype(numpy.float32)
                self.assertEqual(kept.shape, plane.shape, layer)
                numpy.testing.assert_array_equal(kept, plane, layer)

    def test_medians_are_the_scene_of_the_command_and_threads_change_nothing(self):
        command = sturz.run(slide(), "medians")
        for threads in (1, 2):
            simulation = sturz.Simulation(slide(), threads=threads)
            self.assertEqual(simulation.run().state_hash, command.state_hash)
            self.assertEqual(simulation.run(list(simulation.medians.values())).state_hash,
                             command.state_hash)

    def test_threads_of_python_compute_side_by_side_with_the_same_bits(self):
        simulation = sturz.Simulation(slide(), workers=4, threads=1)
        points = [{KEY: 0.45 + 0.02 * k} for k in range(8)]
        alone = [simulation.run(point).state_hash for point in points]
        with concurrent.futures.ThreadPoolExecutor(4) as pool:
            together = [member.state_hash for member in pool.map(simulation.run, points)]
        self.assertEqual(alone, together)
        self.assertEqual(len(set(alone)), 8)


class Arrays(InFolder):
    def test_forked_processes_compute_on_after_a_member_of_many_threads(self):
        """Where the threads of the parent's member are gone, a child's would wait for them for ever."""
        global SIMULATION
        SIMULATION = sturz.Simulation(slide(), threads=2)
        mine = SIMULATION.run({KEY: 0.5}).state_hash
        with multiprocessing.get_context("fork").Pool(2) as pool:
            known = pool.map_async(hash_of_forked, [0.5, 0.5]).get(60)
            anew = pool.apply_async(hash_of_new, [0.5]).get(60)
        self.assertEqual(known + [anew], [mine] * 3)
        SIMULATION = sturz.Simulation(long_slide())
        seen = []

        def fork_once(_):
            if not seen:
                with multiprocessing.get_context("fork").Pool(1) as pool:
                    seen.append(pool.apply_async(error_of_forked).get(60))
            return False

        SIMULATION.run(on_progress=fork_once)
        self.assertIn('"spawn"', seen[0])

    def test_maps_are_the_engines_own_arrays(self):
        member = sturz.Simulation(slide()).run()
        plane = member.peaks["peak_thickness"]
        again = member._result.peaks["peak_thickness"]
        self.assertEqual(plane.__array_interface__["data"][0], again.__array_interface__["data"][0])
        self.assertFalse(plane.flags.owndata)
        self.assertFalse(plane.flags.writeable)
        self.assertEqual((plane.dtype, plane.shape), (numpy.float32, member.window[2:]))
        self.assertAlmostEqual(float(plane.max()), member.scalars["max_thickness_m"], places=6)

    def test_a_map_keeps_its_owner_alive(self):
        simulation = sturz.Simulation(slide())
        plane = simulation.run().peaks["peak_speed"]  # the member is gone at once
        kept = plane.copy()
        del simulation
        for _ in range(5):
            gc.collect()
            other = sturz.Simulation(slide()).run({KEY: 0.55})  # would take the memory if it were free
        numpy.testing.assert_array_equal(plane, kept)
        self.assertIsNotNone(other)

    def test_a_member_that_nothing_holds_is_freed(self):
        simulation = sturz.Simulation(slide())
        member = simulation.run()
        plane = member.peaks["peak_speed"]
        before = sys.getrefcount(member._result)
        view = member._result.peaks["peak_speed"]
        self.assertGreater(sys.getrefcount(member._result), before)
        del view
        self.assertEqual(sys.getrefcount(member._result), before)
        self.assertIs(plane.base, member._result)

    def test_maps_with_coordinates(self):
        maps = sturz.Simulation(slide()).run().dataset()
        self.assertEqual(maps.peak_thickness.attrs["units"], "m")
        self.assertTrue((numpy.diff(maps.x) == 4).all() and (numpy.diff(maps.y) == -4).all())
        where = maps.peak_thickness.where(maps.peak_thickness > 2, drop=True)
        self.assertLess(float(where.x.min()), -110)  # the release


class Python(InFolder):
    def test_other_threads_of_python_go_on_meanwhile(self):
        simulation = sturz.Simulation(long_slide(60), threads=1)
        counted, over = [0], threading.Event()

        def count():
            while not over.is_set():
                counted[0] += 1
                time.sleep(0.001)

        thread = threading.Thread(target=count)
        thread.start()
        before = counted[0]
        begin = time.monotonic()
        simulation.run()
        seconds, during = time.monotonic() - begin, counted[0] - before
        over.set()
        thread.join()
        self.assertGreater(seconds, 0.05)
        # A thousand a second on a quiet machine; none under the lock.
        self.assertGreater(during, 100 * seconds)

    def test_errors_name_the_key(self):
        with self.assertRaises(sturz.ScenarioError) as caught:
            sturz.Simulation(slide(numerics={"spacing_m": -1, "end_time_s": 60}))
        self.assertEqual(caught.exception.keys, ["numerics.spacing_m"])
        simulation = sturz.Simulation(slide())
        with self.assertRaises(sturz.ScenarioError) as caught:
            simulation.run({KEY: -0.5})
        self.assertEqual(caught.exception.keys, [KEY])
        self.assertIn("must be", str(caught.exception))
        with self.assertRaisesRegex(sturz.ScenarioError, "not uncertain in this scene"):
            simulation.run({"numerics.spacing_m": 2})
        with self.assertRaisesRegex(sturz.ScenarioError, "3 values for 2 uncertain keys"):
            simulation.run([0.3, 500, 1])

    def test_a_listener_hears_cancels_and_raises(self):
        simulation = sturz.Simulation(long_slide())
        heard = []

        def hear(now):
            heard.append(now["time_s"])
            return len(heard) < 2

        member = simulation.run(on_progress=hear)
        self.assertEqual((member.outcome, member.valid), ("cancelled", False))
        self.assertEqual(len(heard), 2)
        self.assertLess(heard[0], heard[1])
        with self.assertRaises(ZeroDivisionError):
            simulation.run(on_progress=lambda now: 1 / 0)

    def test_ctrl_c_ends_a_member(self):
        simulation = sturz.Simulation(long_slide())
        threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT)).start()
        begin = time.monotonic()
        with self.assertRaises(KeyboardInterrupt):
            simulation.run()
        self.assertLess(time.monotonic() - begin, 3)


if __name__ == "__main__":
    unittest.main()
