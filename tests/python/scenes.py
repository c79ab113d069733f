# SPDX-License-Identifier: Apache-2.0
"""Scenes small enough to be computed many times, and a folder of its own for each test."""
import os
import pathlib
import tempfile
import unittest
import warnings


def slide(**blocks):
    """Columns on a plane, a hundredth of a second a member."""
    scene = {
        "title": "slide on a plane",
        "terrain": {"synthetic": {"plane": {"cell_size_m": 4, "slope_deg": 25, "length_m": 300,
                                            "width_m": 80}}},
        "release": {"box": {"x_m": [-130, -110], "y_m": [-10, 10]}, "thickness_m": 3},
        "grains": {"density_kg_m3": 2600, "solid_fraction": 0.6},
        "basal": {"friction_coefficient": {"uniform": [0.45, 0.65]},
                  "turbulent_coefficient_m_s2": {"log_uniform": [200, 1500]}},
        "numerics": {"spacing_m": 4, "end_time_s": 60},
        "ensemble": {"design": "sobol", "members": 8, "seed": 1},
        "hazard": {"cell_size_m": 4, "thickness_m": [0.5], "speed_m_s": [2], "energy_kj_m2": [1],
                   "pressure_kpa": [1]},
        "formulation": "depth_averaged",
    }
    return {**scene, **blocks}


def long_slide(seconds=3600):
    """The same with members of many seconds: finer, and computed on when all is at rest."""
    return slide(numerics={"spacing_m": 0.5, "end_time_s": seconds, "stop_at_rest": False})


class InFolder(unittest.TestCase):
    """The working directory is an empty folder; warnings of scenes are no news."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(folder.name)
        self.folder = pathlib.Path(folder.name)
        warnings.simplefilter("ignore")
