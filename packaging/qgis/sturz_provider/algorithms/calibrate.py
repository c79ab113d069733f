# SPDX-License-Identifier: Apache-2.0
"""sturz calibrate: which values explain what was observed."""
import json

from qgis.core import QgsProcessingOutputString

from .base import SturzAlgorithm


class Calibrate(SturzAlgorithm):
    word = "calibrate"
    title = "Calibrate against an observed event"
    help = ("Computes an ensemble of a scenario that has a block `observation`, and finds which values explain it. "
            "The folder gets the ensemble's maps and posterior.json, weights.csv and the page with both.")

    def initAlgorithm(self, configuration=None):  # noqa: N802
        self.add_scenario()
        self.add_members()
        self.add_load()
        self.add_folder()
        self.addOutput(QgsProcessingOutputString("POSTERIOR", "What was found, as JSON"))

    def processAlgorithm(self, parameters, context, feedback):  # noqa: N802
        done = self.call(parameters, context, feedback)
        self.remember(parameters, context, feedback)
        return {"OUT": self.folder, "POSTERIOR": json.dumps(done)}
