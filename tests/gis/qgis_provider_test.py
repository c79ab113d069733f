#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The Processing provider inside QGIS, on the real program. Usage: qgis_provider_test.py PROGRAM PLUGIN_FOLDER"""
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

PROGRAM, PLUGIN = (pathlib.Path(p).resolve() for p in sys.argv[1:3])
del sys.argv[1:3]
HOME = tempfile.TemporaryDirectory()
os.environ.update(QT_QPA_PLATFORM="offscreen", HOME=HOME.name, QGIS_CUSTOM_CONFIG_PATH=HOME.name, OMP_WAIT_POLICY="passive",
                  XDG_RUNTIME_DIR=HOME.name, XDG_CACHE_HOME=HOME.name,
                  PATH=f"{PROGRAM.parent}{os.pathsep}{os.environ['PATH']}")
sys.path[:0] = [str(pathlib.Path(__file__).parent), str(PLUGIN.parent), "/usr/share/qgis/python/plugins"]

from qgis.core import NULL, QgsApplication, QgsProcessingContext, QgsProcessingFeedback, QgsProject  # noqa: E402

import made_scene  # noqa: E402

sys.dont_write_bytecode = True


class Heard(QgsProcessingFeedback):
    """Remembers what an algorithm tells, and cancels at a share of the bar where told to."""

    def __init__(self, cancel_at=None):
        super().__init__(False)
        self.warnings, self.infos, self.bar = [], [], []
        self.cancel_at = cancel_at
        self.progressChanged.connect(self.moved)

    def moved(self, share):
        self.bar.append(share)
        if self.cancel_at is not None and share >= self.cancel_at:
            self.cancel()

    def pushWarning(self, text):  # noqa: N802 (names of QGIS)
        self.warnings.append(text)

    def pushInfo(self, text):  # noqa: N802
        self.infos.append(text)


class Provider(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        from processing.core.Processing import Processing
        from processing.core.ProcessingConfig import ProcessingConfig
        Processing.initialize()
        import sturz_provider
        cls.config = ProcessingConfig
        cls.plugin = sturz_provider.classFactory(None)
        cls.plugin.initProcessing()

    @classmethod
    def tearDownClass(cls):
        cls.plugin.unload()

    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.root = pathlib.Path(self.temporary.name)
        self.scene = str(made_scene.write_scene(self.root))
        self.out = str(self.root / "out")
        self.addCleanup(self.temporary.cleanup)
        self.addCleanup(QgsProject.instance().clear)

    def run_algorithm(self, name, parameters, heard=None):
        algorithm = QgsApplication.processingRegistry().createAlgorithmById(f"sturz:{name}")
        context = QgsProcessingContext()
        context.setProject(QgsProject.instance())
        heard = heard or Heard()
        good, why = algorithm.checkParameterValues(parameters, context)
        self.assertTrue(good, why)
        found, done = algorithm.run(parameters, context, heard)
        return found, done, heard

    def test_it_has_its_algorithms(self):
        provider = QgsApplication.processingRegistry().providerById("sturz")
        self.assertEqual({a.name() for a in provider.algorithms()},
                         {"describe", "run", "ensemble", "calibrate", "open_results"})

    def test_numbers_that_nobody_gave_are_not_handed_on(self):
        """Models and batches of QGIS give NULL, which is not None."""
        algorithm = QgsApplication.processingRegistry().createAlgorithmById("sturz:ensemble")
        algorithm.folder = self.out
        for given, words in (({}, []), ({"MEMBERS": None}, []), ({"MEMBERS": NULL, "WORKERS": 2}, ["--workers", 2])):
            said = algorithm.arguments({"SCENARIO": self.scene, **given}, QgsProcessingContext())
            self.assertEqual(said, ["ensemble", self.scene, "-o", self.out, *words])

    def test_describe_says_what_the_scene_is(self):
        found, done, heard = self.run_algorithm("describe", {"SCENARIO": self.scene})
        self.assertTrue(done)
        self.assertEqual(found["MEMBERS"], 8)
        self.assertAlmostEqual(found["RELEASE_VOLUME_M3"], 40000, delta=400)
        self.assertEqual(json.loads(found["DESCRIPTION"])["formulation"], "depth_averaged")
        self.assertTrue(any("basal.friction_coefficient" in text for text in heard.infos))

    def test_an_ensemble_moves_the_bar_and_shows_its_maps(self):
        found, done, heard = self.run_algorithm("ensemble", {"SCENARIO": self.scene, "OUT": self.out, "MEMBERS": 4,
                                                             "SET": "numerics.spacing_m=12\n\nensemble.seed=2"})
        self.assertTrue(done, heard.htmlLog())
        self.assertEqual(found["VALID"], 4)
        self.assertIn("spacing_m: 12", (self.root / "out/scenario.yaml").read_text())
        self.assertIn("seed: 2", (self.root / "out/scenario.yaml").read_text())
        self.assertEqual(heard.bar, sorted(heard.bar))
        self.assertEqual(heard.bar[-1], 100)
        self.assertGreaterEqual(len(heard.bar), 5)
        project = QgsProject.instance()
        self.assertEqual([g.name() for g in project.layerTreeRoot().children()], [made_scene.TITLE])
        self.assertTrue(all(layer.isValid() for layer in project.mapLayers().values()))
        reached = [n for n in project.layerTreeRoot().findLayers() if n.name() == "Probability that the flow arrives"
                   and n.parent().name() == "Probability"]
        self.assertTrue(reached[0].isVisible())
        self.assertEqual(reached[0].layer().renderer().type(), "singlebandpseudocolor")
        self.assertEqual(project.crs().authid(), f"EPSG:{made_scene.EPSG}")

    def test_cancelling_keeps_what_is_finished_and_the_same_call_goes_on(self):
        parameters = {"SCENARIO": self.scene, "OUT": self.out, "MEMBERS": 24, "WORKERS": 1, "LOAD": False}
        found, done, heard = self.run_algorithm("ensemble", parameters, Heard(cancel_at=6))
        kept = len(list((self.root / "out/members").glob("*.nc")))
        self.assertTrue(2 <= kept < 24, kept)
        self.assertFalse((self.root / "out/hazard.nc").exists())
        self.assertTrue(any("Stopped after" in text for text in heard.infos), heard.infos)
        self.assertEqual(list((self.root / "out").rglob("*.part")), [])
        found, done, heard = self.run_algorithm("ensemble", parameters)
        self.assertTrue(done, heard.htmlLog())
        self.assertIn(f"24 simulations, {24 - kept} to do", heard.infos)
        self.assertEqual(found["VALID"], 24)

    def test_results_of_another_day_open(self):
        made_scene.run(PROGRAM, "ensemble", self.scene, "-o", self.out, "-n", 2)
        found, done, heard = self.run_algorithm("open_results", {"FOLDER": self.out})
        self.assertTrue(done)
        self.assertEqual(found["LAYERS"], len(QgsProject.instance().mapLayers()))
        self.assertGreater(found["LAYERS"], 50)
        found, done, heard = self.run_algorithm("open_results", {"FOLDER": str(self.root)})
        self.assertFalse(done)
        self.assertIn("has no hazard.qgz", heard.htmlLog())

    def test_one_simulation_gives_its_numbers(self):
        found, done, heard = self.run_algorithm("run", {"SCENARIO": self.scene, "OUT": self.out})
        self.assertTrue(done)
        self.assertEqual(found["OUTCOME"], "settled")
        self.assertGreater(found["RUNOUT_M"], 100)
        self.assertTrue((self.root / "out/peaks.nc").is_file())
        found, done, heard = self.run_algorithm("open_results", {"FOLDER": self.out})
        self.assertTrue(done, heard.htmlLog())
        self.assertGreater(found["LAYERS"], 8)
        self.assertTrue(all(layer.isValid() for layer in QgsProject.instance().mapLayers().values()))

    def test_a_calibration_tells_what_it_found(self):
        found, done, heard = self.run_algorithm("calibrate", {"SCENARIO": self.scene, "OUT": self.out, "LOAD": False})
        self.assertTrue(done, heard.htmlLog())
        self.assertEqual(json.loads(found["POSTERIOR"])["event"], "done")
        self.assertTrue((self.root / "out/posterior.json").is_file())

    def test_the_programs_own_words_tell_what_is_wrong(self):
        scene = self.root / "scene.yaml"
        scene.write_text(scene.read_text().replace("thickness_m: 4", "thicknes_m: 4"))
        found, done, heard = self.run_algorithm("ensemble", {"SCENARIO": self.scene, "OUT": self.out})
        self.assertFalse(done)
        self.assertIn("thicknes_m", heard.htmlLog())

    def test_a_wrong_setting_says_where_to_correct_it(self):
        from sturz_provider.program import SETTING
        self.config.setSettingValue(SETTING, self.scene)  # a file, but no program
        try:
            found, done, heard = self.run_algorithm("describe", {"SCENARIO": self.scene})
        finally:
            self.config.setSettingValue(SETTING, "")
        self.assertFalse(done)
        self.assertIn("is no program that can be run", heard.htmlLog())
        self.assertIn("Settings > Options", heard.htmlLog().replace("&gt;", ">"))


class QgisProcess(unittest.TestCase):
    """The same from the command line, as a plugin that was installed."""

    def test_an_ensemble_end_to_end(self):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            shutil.copytree(PLUGIN, root / "plugins/sturz_provider")
            environment = dict(os.environ, QGIS_PLUGINPATH=str(root / "plugins"))
            # Debian 12's wrapper hands the program an option for windows, which it refuses.
            process = shutil.which("qgis_process.bin") or "qgis_process"

            def call(*words):
                done = subprocess.run([process, *words], text=True, capture_output=True, env=environment, check=False)
                self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
                return done.stdout

            call("plugins", "enable", "sturz_provider")
            scene = made_scene.write_scene(root)
            out = root / "out"
            text = call("--json", "run", "sturz:ensemble", "--", f"SCENARIO={scene}", "MEMBERS=3", f"OUT={out}", "LOAD=false")
            self.assertEqual(json.loads(text[text.index("{"):])["results"]["VALID"], 3)
            self.assertTrue((out / "hazard.qgz").is_file())


if __name__ == "__main__":
    QgsApplication.setPrefixPath("/usr", True)
    application = QgsApplication([], False)
    application.initQgis()
    result = unittest.main(exit=False).result
    sys.stdout.flush()
    sys.stderr.flush()
    HOME.cleanup()
    # Without leaving QGIS in order, which may crash among its own libraries after all is done.
    os._exit(0 if result.wasSuccessful() else 1)
