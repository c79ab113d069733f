#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""`cmake --install` into a prefix, moved elsewhere, must work there and know nothing of where it was
made. Usage: install_test.py CMAKE BUILD_FOLDER SOURCE_FOLDER"""
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

CMAKE, BUILD, SOURCE = sys.argv[1:4]
del sys.argv[1:]

LAYOUT = ("bin/sturz", "share/sturz/cases/zhangjiawan/scenario.yaml", "share/sturz/cases/zhangjiawan/README.md",
          "share/sturz/cases/template/scenario.yaml", "share/sturz/qgis/sturz_provider/__init__.py",
          "share/sturz/qgis/sturz_provider/algorithms/ensemble.py", "share/man/man1/sturz.1.gz",
          "share/bash-completion/completions/sturz", "share/doc/sturz/README.md",
          "share/doc/sturz/LICENSE", "share/doc/sturz/copyright", "share/doc/sturz/CITATION.cff",
          "share/doc/sturz/docs/user_guide.md", "share/doc/sturz/examples/slopes.yaml",
          "share/doc/sturz/examples/sturz-batch.service", "share/doc/sturz/examples/sturz-batch.cron",
          "share/doc/sturz/docs/examples/cluster/Snakefile")


class Install(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        root = pathlib.Path(cls.folder.name)
        subprocess.run([CMAKE, "--install", BUILD, "--prefix", root / "first"], check=True,
                       stdout=subprocess.DEVNULL)
        cls.prefix = root / "moved there, with a blank"
        (root / "first").rename(cls.prefix)
        cls.work = root / "work"
        cls.work.mkdir()

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def sturz(self, *arguments, code=0):
        environment = dict(os.environ, XDG_CACHE_HOME=str(self.work / "cache"), OMP_WAIT_POLICY="passive")
        done = subprocess.run([self.prefix / "bin/sturz", *arguments], cwd=self.work, text=True,
                              capture_output=True, env=environment)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done

    def test_everything_is_where_people_look_for_it(self):
        for name in LAYOUT:
            self.assertTrue((self.prefix / name).is_file(), name)

    def test_the_version_is_the_projects(self):
        lists = (pathlib.Path(SOURCE) / "CMakeLists.txt").read_text()
        version = re.search(r"project\(sturz VERSION ([\d.]+)", lists).group(1)
        self.assertTrue(self.sturz("--version").stdout.startswith(f"sturz {version} ("))

    def test_the_plugin_has_the_version_of_the_project(self):
        metadata = (self.prefix / "share/sturz/qgis/sturz_provider/metadata.txt").read_text()
        version = re.search(r"^version=(.*)$", metadata, re.M).group(1)
        self.assertTrue(self.sturz("--version").stdout.startswith(f"sturz {version} ("))

    def test_a_shipped_case_is_listed_copied_and_computed(self):
        listed = self.sturz("cases").stdout
        for name in ("zhangjiawan", "shuicheng_dry", "usgs_flume", "template"):
            self.assertIn(f"  {name} ", listed)
        self.sturz("cases", "zhangjiawan", "-o", "mine")
        self.sturz("ensemble", "mine/scenario.yaml", "-n", "2", "-o", "out", "--set", "numerics.end_time_s=2",
                   "--set", "numerics.spacing_m=16")
        for name in ("hazard.nc", "report.html", "members.csv"):
            self.assertGreater((self.work / "out" / name).stat().st_size, 0)

    def test_python_finds_package_module_and_program_where_they_were_moved(self):
        folder = self.prefix / "lib/python3/dist-packages"
        environment = {k: v for k, v in os.environ.items() if k != "STURZ"}
        environment |= {"PYTHONPATH": str(folder), "PATH": "/usr/bin:/bin"}
        code = ("import sturz; print(sturz.program()); print(sturz.__file__); print('template' in sturz.cases())\n"
                "import sturz.simulation as s; print(s._module().__file__)")
        done = subprocess.run(["/usr/bin/python3", "-c", code], cwd=self.work, text=True, capture_output=True,
                              env=environment)
        lines = done.stdout.splitlines()
        self.assertEqual(lines[:3], [str(self.prefix / "bin/sturz"), str(folder / "sturz/__init__.py"), "True"])
        if list((pathlib.Path(BUILD) / "python").glob("_sturz*.so")):
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(pathlib.Path(lines[3]).parent, folder)

    def test_the_interpreter_has_the_module_built_in(self):
        if not (pathlib.Path(BUILD) / "python/sturz-python").exists():
            self.skipTest("built without Python")
        done = subprocess.run([self.prefix / "bin/sturz-python", "-c", "import _sturz, sturz; print(_sturz.version)"],
                              cwd=self.work, text=True, capture_output=True)
        self.assertEqual(done.stdout, self.sturz("--version").stdout.split()[1] + "\n", done.stderr)

    def test_a_copy_never_overwrites(self):
        self.sturz("cases", "template", "-o", "changed")
        (self.work / "changed/scenario.yaml").write_text("mine")
        message = self.sturz("cases", "template", "-o", "changed", code=1).stderr
        self.assertIn("is there already", message)
        self.assertEqual((self.work / "changed/scenario.yaml").read_text(), "mine")

    def test_an_unknown_case_has_a_neighbour(self):
        self.assertIn("Did you mean zhangjiawan?", self.sturz("cases", "zangjiawan", code=1).stderr)

    def test_without_its_data_the_program_says_what_is_missing(self):
        alone = self.work / "alone"
        alone.mkdir()
        (alone / "sturz").write_bytes((self.prefix / "bin/sturz").read_bytes())
        (alone / "sturz").chmod(0o755)
        done = subprocess.run([alone / "sturz", "cases"], text=True, capture_output=True)
        self.assertEqual(done.returncode, 1)
        self.assertIn("share/sturz/cases (no such folder", done.stderr)

    def test_no_path_of_the_build_is_compiled_in(self):
        program = (self.prefix / "bin/sturz").read_bytes()
        for path in (SOURCE, BUILD, self.folder.name):
            self.assertNotIn(path.encode(), program)

    def test_the_completion_offers_cases_of_the_program_that_is_typed(self):
        script = self.prefix / "share/bash-completion/completions/sturz"
        program = self.prefix / "bin/sturz"
        words = subprocess.run(
            ["bash", "-c", 'source "$1"; COMP_WORDS=("$2" cases zh); COMP_CWORD=2; _sturz; '
             'printf "%s\\n" "${COMPREPLY[@]}"', "-", script, program],
            text=True, capture_output=True, check=True).stdout.split()
        self.assertEqual(words, ["zhangjiawan"])


if __name__ == "__main__":
    unittest.main()
