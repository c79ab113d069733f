# SPDX-License-Identifier: Apache-2.0
"""Scenes from dictionaries, their errors, and what needs no package of anybody else."""
import io
import os
import pathlib
import subprocess
import sys
import time
import unittest
from unittest import mock

import sturz
from scenes import InFolder, slide
from sturz.errors import problem_of
from sturz.program import call
from sturz.progress import Bar
from sturz.scenario import as_file


class Scenes(InFolder):
    def test_a_dictionary_is_written_as_yaml_and_read_back(self):
        scene = sturz.Scenario(slide())
        file = scene.write("scene.yaml")
        self.assertIn("title: slide on a plane\n", file.read_text())
        again = sturz.Scenario.read(file)
        self.assertEqual((again.data, again.name), (scene.data, "scene"))
        self.assertEqual(again["numerics.spacing_m"], 4)

    def test_numbers_are_read_as_the_program_reads_them(self):
        """PyYAML alone has texts for 1e6 and 1.5e-3, 10 for 012, 90 for 1:30 and true for on."""
        pathlib.Path("scene.yaml").write_text(
            "a: 1e6\nb: 1.5e-3\nc: 012\nd: 1:30\ne: on\nf: 2026-01-01\ng: '1 m'\nh: true\ni: -.5\nj:\nk: +3\n"
            "l: [1., .inf]\n")
        scene = sturz.Scenario.read("scene.yaml")
        wanted = {"a": 1e6, "b": 0.0015, "c": 12, "d": "1:30", "e": "on", "f": "2026-01-01", "g": "1 m", "h": True,
                  "i": -0.5, "j": None, "k": 3, "l": [1.0, float("inf")]}
        self.assertEqual(scene.data, wanted)
        scene.write("again.yaml")
        self.assertEqual(sturz.Scenario.read("again.yaml").data, wanted)

    def test_numbers_of_numpy_and_paths_are_taken(self):
        code = ("import numpy, pathlib, sturz\n"
                "s = sturz.Scenario({'a': numpy.float64(0.5), 'b': numpy.arange(2), 'c': (1, 2),\n"
                "                    'd': pathlib.Path('x/y.tif'), 'e': {'f': numpy.int32(3)}})\n"
                "assert s.data == {'a': 0.5, 'b': [0, 1], 'c': [1, 2], 'd': 'x/y.tif', 'e': {'f': 3}}, s")
        subprocess.run([sys.executable, "-c", code], check=True)
        with self.assertRaisesRegex(sturz.SturzError, "set has no place"):
            sturz.Scenario({"a": {1, 2}})

    def test_a_changed_copy_leaves_the_scene_as_it_is(self):
        scene = sturz.Scenario(slide())
        finer = scene.with_values({"numerics.spacing_m": 2, "basal.turbulent_coefficient_m_s2": None},
                                  title="finer")
        self.assertEqual((finer["numerics.spacing_m"], finer["title"]), (2, "finer"))
        self.assertNotIn("turbulent_coefficient_m_s2", finer["basal"])
        self.assertEqual(scene.data, sturz.Scenario(slide()).data)
        with self.assertRaisesRegex(sturz.SturzError, "is a value, no block"):
            scene.with_values({"title.other": 1})

    def test_all_that_is_wrong_comes_as_one_exception_with_keys(self):
        wrong = slide(numerics={"spacing_m": -4, "end_time_s": 60},
                      basal={"friction_coeficient": 0.3})
        for ask in (sturz.check, sturz.describe, sturz.run, sturz.ensemble):
            with self.assertRaises(sturz.ScenarioError) as caught:
                ask(wrong)
            problems = {problem.key: problem for problem in caught.exception.problems}
            self.assertEqual(set(problems), {"numerics.spacing_m", "basal.friction_coeficient"})
            self.assertIn("-4", problems["numerics.spacing_m"].wrong)
            self.assertIn("must be > 0", problems["numerics.spacing_m"].wrong)
            self.assertIn("friction_coefficient", problems["basal.friction_coeficient"].right)
            self.assertGreater(problems["numerics.spacing_m"].line, 0)
        self.assertFalse(pathlib.Path("out").exists())
        self.assertEqual(os.listdir("."), [])  # the file of the dictionary is gone too

    def test_what_describe_says_is_a_dictionary(self):
        told = sturz.describe(slide(), values={"numerics.spacing_m": 8})
        self.assertEqual(told["formulation"], "depth_averaged")
        self.assertEqual(told["spacing_m"], 8)
        self.assertEqual(told["members"], 8)

    def test_relative_paths_start_at_the_scenes_folder(self):
        inputs = pathlib.Path("inputs")
        subprocess.run([sturz.program(), "terrain", "plane", "-o", str(inputs)], check=True,
                       capture_output=True)
        raster = next(inputs.glob("*.tif")).name
        scene = slide(terrain={"raster": raster, "crs": "local"},
                      release={"box": {"x_m": [-80, -60], "y_m": [-10, 10]}, "thickness_m": 3})
        with self.assertRaisesRegex(sturz.ScenarioError, "terrain.raster"):
            sturz.check(scene)
        sturz.check(sturz.Scenario(scene, folder=inputs))

    def test_keys_are_explained_by_the_programs_own_schema(self):
        told = sturz.explain("numerics.spacing_m")
        self.assertIn("description", told)
        with self.assertRaises(KeyError):
            sturz.explain("numerics.spacing")

    def test_a_shipped_case_is_copied(self):
        self.assertIn("template", sturz.cases())
        scene = sturz.copy_case("zhangjiawan", "mine")
        self.assertIn("basal", sturz.Scenario.read(scene).data)
        with self.assertRaisesRegex(sturz.SturzError, "Did you mean zhangjiawan"):
            sturz.copy_case("zangjiawan", "other")


STAND_IN = """#!{python}
import signal, sys
told = []
signal.signal(signal.SIGINT, lambda *_: told.append(1))
for k in range(20000):  # far more than a pipe holds
    print('{{"event": "member", "number": %d}}' % k, flush=True)
open("put_away", "w").write(str(len(told)))
sys.exit(3)
"""


class Stopped(InFolder):
    """A program that has much to say when it is told to stop puts its things away all the same."""

    def test_a_full_pipe_does_not_get_it_killed(self):
        stand_in = pathlib.Path("stand_in")
        stand_in.write_text(STAND_IN.format(python=sys.executable))
        stand_in.chmod(0o755)

        def enough(_):
            time.sleep(0.5)  # the pipe is full now
            raise ZeroDivisionError

        with mock.patch.dict(os.environ, STURZ=str(stand_in.resolve())):
            begin = time.monotonic()
            with self.assertRaises(ZeroDivisionError):
                call(["ensemble"], enough)
        self.assertEqual(pathlib.Path("put_away").read_text(), "1")
        self.assertLess(time.monotonic() - begin, 8)

    def test_a_server_that_nobody_stopped_ends_with_the_script(self):
        stand_in = pathlib.Path("stand_in")
        stand_in.write_text(f"#!{sys.executable}\nimport pathlib, signal\n"
                        "signal.signal(signal.SIGINT, signal.default_int_handler)\n"
                        "try:\n    print('{\"event\": \"serving\", \"url\": \"\", \"inputs\": [], \"outputs\": []}', flush=True)\n"
                        "    signal.pause()\n"
                        "except KeyboardInterrupt:\n    pathlib.Path('ended').touch()\n")
        stand_in.chmod(0o755)
        subprocess.run([sys.executable, "-c", "import sturz\nserver = sturz.serve({})"], check=True, timeout=30,
                       env={**os.environ, "STURZ": str(stand_in.resolve())})
        self.assertTrue(pathlib.Path("ended").exists())

    def test_names_that_begin_with_a_dash_are_no_options(self):
        for scene in ("-x.yaml", pathlib.Path("-x.yaml")):
            with as_file(scene) as file:
                self.assertEqual(file, "./-x.yaml")
        with as_file(sturz.Scenario({"title": "a"}, name="../-a/b")) as file:
            self.assertEqual(os.path.dirname(os.path.abspath(file)), os.getcwd())


class Tables(InFolder):
    def test_a_hash_in_a_name_does_not_cut_its_row(self):
        pathlib.Path("assets.csv").write_text("# of the event\nname,probability\nHaus #3,0.25\nHaus 4,0.5\n")
        table = sturz.EnsembleResults(".").table("assets.csv")
        self.assertEqual(list(table.name), ["Haus #3", "Haus 4"])
        self.assertEqual(list(table.probability), [0.25, 0.5])

    def test_cells_of_just_the_level_belong_to_its_outline(self):
        import numpy
        from sturz.outlines import cells_at_least
        import xarray
        plane = xarray.DataArray(numpy.array([[0.95, 0.9]], dtype="float32"), dims=("y", "x"),
                                 coords={"y": [0.0], "x": [0.0, 10.0]})
        self.assertEqual(cells_at_least(plane, 0.95).area, 100)


class Words(unittest.TestCase):
    def test_the_parts_of_an_error(self):
        p = problem_of("a b/x.yaml:3:14: basal.zones[2].friction_coefficient = -1 (must be >= 0). Say 0.")
        self.assertEqual((p.key, p.line, p.column), ("basal.zones[2].friction_coefficient", 3, 14))
        self.assertEqual(p.wrong, "basal.zones[2].friction_coefficient = -1 (must be >= 0).")
        self.assertEqual(p.right, "Say 0.")
        self.assertEqual(problem_of("numerics.spacing_m = -5 (must be > 0).").right, "must be > 0")
        self.assertEqual(problem_of("--workers: Value abc could not be read").key, "")

    def test_the_bar_counts_what_was_finished_before(self):
        stream = io.StringIO()
        bar = Bar(stream)
        bar({"event": "start", "members": 4, "finished_before": 1})
        bar({"event": "member", "outcome": "settled"})
        bar({"event": "member", "outcome": "failed"})
        self.assertTrue(bar.line(200).startswith("[###############.....] 3/4 members, 1 failed | about"))
        self.assertEqual(len(bar.line(10)), 10)
        bar({"event": "done"})
        self.assertTrue(stream.getvalue().endswith("\n"))


class Alone(InFolder):
    """With nothing but Python: what others need is named when it is asked for."""

    def python(self, code):
        others = ("xarray", "pandas", "geopandas", "yaml", "numpy", "netCDF4", "_sturz")
        masked = f"import sys\nfor name in {others}:\n    sys.modules[name] = None\nimport sturz\n"
        scene = f"scene = {slide()!r}\n"
        done = subprocess.run([sys.executable, "-W", "ignore", "-c", masked + scene + code], text=True,
                              capture_output=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def test_a_scene_is_computed_and_its_numbers_are_there(self):
        said = self.python("r = sturz.run(scene, 'one')\nprint(r.outcome, r.scalars['runout_m'] > 1)\n"
                           "e = sturz.ensemble(scene, 'many', members=2)\n"
                           "print(len(e.rows()), e.rows()[1]['member'], e.page.name)")
        self.assertEqual(said.split(), ["settled", "True", "2", "1", "report.html"])

    def test_what_is_missing_is_named_with_its_package(self):
        said = self.python("""
e = sturz.ensemble(scene, 'many', members=2)
for ask in (lambda: e.hazard, lambda: e.members, lambda: e.outlines(), lambda: sturz.Scenario.read('x.yaml'),
            lambda: sturz.Simulation(scene)):
    try:
        ask()
    except sturz.Missing as missing:
        print(missing)
""")
        for package in ("python3-xarray", "python3-pandas", "python3-geopandas", "python3-yaml",
                        "pybind11-dev"):
            self.assertIn(package, said)

    def test_a_program_that_is_not_there_is_said(self):
        done = subprocess.run([sys.executable, "-c", "import sturz; sturz.program()"], text=True,
                              env={**os.environ, "STURZ": "/nowhere/sturz"}, capture_output=True, check=False)
        self.assertIn("STURZ=/nowhere/sturz is no program", done.stderr)


if __name__ == "__main__":
    unittest.main()
