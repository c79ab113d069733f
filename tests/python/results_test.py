# SPDX-License-Identifier: Apache-2.0
"""Results as objects of xarray, pandas and geopandas; events while they are computed."""
import unittest

import numpy

import sturz
from scenes import InFolder, long_slide, slide


class Results(InFolder):
    def test_a_run(self):
        result = sturz.run(slide(), "one")
        self.assertEqual(result.outcome, "settled")
        with result.peaks as peaks:
            self.assertAlmostEqual(float(peaks.peak_thickness.max()), result.scalars["max_thickness_m"],
                                   places=5)
        self.assertTrue(result.page.is_file())
        again = sturz.open_results("one")
        self.assertIsInstance(again, sturz.RunResults)
        self.assertEqual(again.outcome, "settled")
        with self.assertRaisesRegex(sturz.ScenarioError, "another scene"):
            sturz.run(slide(title="other", numerics={"spacing_m": 8, "end_time_s": 60}), "one")

    def test_an_ensemble(self):
        events = []
        result = sturz.ensemble(slide(), "many", progress=events.append)
        kinds = [event["event"] for event in events if event["event"] != "warning"]
        self.assertEqual(kinds[0], "start")
        self.assertEqual(kinds.count("member"), 8)
        self.assertEqual(kinds[-1], "done")
        with result.hazard as hazard:
            reach = hazard.probability_of_reach
            self.assertEqual(float(reach.max()), 1)
            self.assertEqual(int(hazard.number_of_members.max()), 8)
        members = result.members
        self.assertEqual(list(members.member), list(range(8)))
        self.assertTrue(members["basal.friction_coefficient"].between(0.45, 0.65).all())
        self.assertEqual(sturz.open_results("many").hazard_hash, result.hazard_hash)

    def test_outlines_are_the_cells_of_the_map(self):
        result = sturz.ensemble(slide(), "many")
        table = result.outlines([0.1, 0.5, 1.0, 2.0])
        self.assertEqual(list(table.level), [0.1, 0.5, 1.0])  # nothing comes to 2
        with result.hazard as hazard:
            for level, area, shape in zip(table.level, table.area_m2, table.geometry):
                cells = int((hazard.probability_of_reach >= level).sum())
                self.assertEqual(area, 16 * cells)
                self.assertTrue(shape.is_valid)
        self.assertTrue(table.geometry[1].within(table.geometry[0]))

    def test_a_calibration(self):
        unknown = slide(basal={"friction_coefficient": {"uniform": [0.45, 0.65]}})
        truth = sturz.run(unknown, "truth", values={"basal.friction_coefficient": 0.5})
        scene = {**unknown, "observation": {"runout_m": {"value": truth.scalars["runout_m"], "sd": 5}}}
        events = []
        found = sturz.calibrate(scene, "fit", members=16, check_best=False, progress=events.append)
        self.assertEqual([e["members"] for e in events if e["event"] == "start"], [16])
        self.assertEqual(sum(e["event"] == "member" for e in events), 16)
        mean = found.posterior["basal.friction_coefficient"].mean()
        self.assertLess(abs(mean - 0.5), 0.02)
        self.assertIsInstance(sturz.open_results("fit"), sturz.CalibrationResults)
        self.assertTrue(found.found)

    def test_too_many_failed_members_are_an_exception_that_holds_the_results(self):
        # A wall clock that no member can keep.
        scene = long_slide()
        scene["numerics"]["max_wall_time_s"] = 0.1
        with self.assertRaises(sturz.MembersFailed) as caught:
            sturz.ensemble(scene, "none", members=2)
        self.assertEqual(set(caught.exception.results.members.outcome), {"failed"})

    def test_maps_equal_those_that_other_tools_read(self):
        result = sturz.ensemble(slide(), "many")
        with result.hazard as hazard:
            import netCDF4
            with netCDF4.Dataset("many/hazard.nc") as plain:
                plain.set_auto_mask(False)
                same = numpy.array_equal(plain["probability_of_reach"][:], hazard.probability_of_reach)
        self.assertTrue(same)


if __name__ == "__main__":
    unittest.main()
