# SPDX-License-Identifier: Apache-2.0
"""sturz ensemble: many simulations, hazard maps, and their layers in the project at hand."""
from qgis.core import QgsProcessingOutputFile, QgsProcessingOutputNumber

from ..results import project_of
from .base import SturzAlgorithm


class Ensemble(SturzAlgorithm):
    word = "ensemble"
    title = "Compute an ensemble and its hazard maps"
    help = ("Computes many simulations, one for each draw of the uncertain values, and maps of how likely a place is "
            "reached, how thick, how fast and when. Cancelling keeps what is finished: the same call into the same "
            "folder goes on.")

    def initAlgorithm(self, configuration=None):  # noqa: N802
        self.add_scenario()
        self.add_members()
        self.add_load()
        self.add_folder()
        self.addOutput(QgsProcessingOutputNumber("VALID", "Valid simulations"))
        self.addOutput(QgsProcessingOutputFile("PROJECT", "QGIS project of the results"))

    def processAlgorithm(self, parameters, context, feedback):  # noqa: N802
        done = self.call(parameters, context, feedback)
        self.remember(parameters, context, feedback)
        return {"OUT": self.folder, "VALID": done.get("valid", 0), "PROJECT": project_of(self.folder)}
