# SPDX-License-Identifier: Apache-2.0
"""Small ensembles for the tests of clusters: a scene, the program, and what results must be."""
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import netCDF4

PROGRAM, SOURCE = sys.argv[1], pathlib.Path(sys.argv[2])
SKIPPED = 77  # exit code that ctest knows

# Columns on a plane; `spacing_m` and `members` say how long it takes.
SCENE = """\
title: a slide in shards
formulation: depth_averaged
terrain:
  synthetic: {{plane: {{cell_size_m: 2, slope_deg: 30, length_m: 120, width_m: 50}}}}
release:
  box: {{x_m: [-50, -40], y_m: [-5, 5]}}
  thickness_m: 3
grains: {{density_kg_m3: 2600, solid_fraction: 0.6, friction_angle_deg: 30}}
basal:
  friction_coefficient: {{uniform: [0.3, 0.7]}}
  pore_pressure_ratio: {{uniform: [0.0, 0.3]}}
numerics: {{spacing_m: {spacing_m}, end_time_s: {end_s}}}
ensemble: {{design: sobol, members: {members}, seed: 1}}
hazard: {{cell_size_m: 2, thickness_m: [0.5, 1], speed_m_s: [1], energy_kj_m2: [1], pressure_kpa: [1]}}
"""


def skip_all(reason):
    print(f"SKIPPED: {reason}")
    sys.exit(SKIPPED)


def bits(folder):
    """Every value of hazard.nc, bit for bit, by the name of its variable."""
    with netCDF4.Dataset(folder / "hazard.nc") as data:
        data.set_auto_maskandscale(False)
        return {name: (v.dtype.str, v.shape, v[...].tobytes()) for name, v in data.variables.items()}


class Ensembles(unittest.TestCase):
    """A folder of its own for each class; the whole ensemble computed on one machine to compare with."""

    @classmethod
    def setUpClass(cls):
        cls.holder = tempfile.TemporaryDirectory(prefix="sturz-cluster-test-")
        cls.root = pathlib.Path(cls.holder.name)
        cls.root.chmod(0o755)
        cls.whole = {}

    @classmethod
    def tearDownClass(cls):
        cls.holder.cleanup()

    @classmethod
    def environment(cls):
        kept = {k: v for k, v in os.environ.items() if not k.startswith(("SLURM", "HQ_"))}
        return dict(kept, XDG_CACHE_HOME=str(cls.root / "cache"), OMP_WAIT_POLICY="passive")

    @classmethod
    def scene(cls, name, members, spacing_m=1, end_s=3):
        file = cls.root / f"{name}.yaml"
        file.write_text(SCENE.format(members=members, spacing_m=spacing_m, end_s=end_s))
        return file

    @classmethod
    def sturz(cls, *words, code=0, **environment):
        done = subprocess.run([PROGRAM, *map(str, words)], cwd=cls.root, text=True, capture_output=True,
                              env=dict(cls.environment(), **environment))
        if code is not None and done.returncode != code:
            raise AssertionError(f"sturz {words}: exit code {done.returncode}, not {code}\n{done.stdout}{done.stderr}")
        return done

    @classmethod
    def status(cls, folder):
        return json.loads(cls.sturz("status", folder, "--json").stdout)

    @classmethod
    def on_one_machine(cls, scene):
        """The bits that the scene's maps must have."""
        if scene not in cls.whole:
            folder = cls.root / f"{scene.stem}-whole"
            cls.sturz("ensemble", scene, "-o", folder)
            cls.whole[scene] = bits(folder)
        return cls.whole[scene]

    def check_complete(self, folder, scene):
        """All members, maps of all of them, the same bits as on one machine, nothing left behind."""
        state = self.status(folder)
        said = "".join(f"\n{log}:\n{log.read_text()[-1500:]}" for log in (folder / "cluster/log").glob("*"))
        self.assertEqual((state["missing"], state["maps"], state["workers"]), (0, "complete", []), said)
        self.assertEqual(bits(folder), self.on_one_machine(scene))
        self.assertEqual([p.name for p in folder.rglob("*.part")], [])
        self.assertEqual([p.name for p in folder.glob("lock*")], [])
