# SPDX-License-Identifier: Apache-2.0
"""sturz run: one simulation with the medians of all distributions."""
import json

from qgis.core import QgsProcessingOutputNumber, QgsProcessingOutputString

from .base import SturzAlgorithm


class Run(SturzAlgorithm):
    word = "run"
    title = "Compute one simulation"
    help = ("Computes one simulation with the median of every uncertain value and writes report.html and peaks.nc "
            "(largest thickness, speed, energy and pressure, arrival, deposit) into the folder.")

    def initAlgorithm(self, configuration=None):  # noqa: N802
        self.add_scenario()
        self.add_folder()
        self.addOutput(QgsProcessingOutputString("OUTCOME", "How it ended"))
        self.addOutput(QgsProcessingOutputNumber("RUNOUT_M", "Runout [m]"))
        self.addOutput(QgsProcessingOutputNumber("REACHED_AREA_M2", "Reached area [m2]"))
        self.addOutput(QgsProcessingOutputString("SCALARS", "All numbers of the simulation, as JSON"))

    def processAlgorithm(self, parameters, context, feedback):  # noqa: N802
        done = self.call(parameters, context, feedback)
        found = {"OUT": self.folder}
        if done.get("event") == "done":
            scalars = done["scalars"]
            found.update(OUTCOME=done["outcome"], RUNOUT_M=scalars["runout_m"],
                         REACHED_AREA_M2=scalars["reached_area_m2"], SCALARS=json.dumps(scalars))
        return found
