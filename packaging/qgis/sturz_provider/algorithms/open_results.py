# SPDX-License-Identifier: Apache-2.0
"""The layers of a finished folder in the project at hand."""
from qgis.core import (QgsProcessingAlgorithm, QgsProcessingException, QgsProcessingOutputNumber,
                       QgsProcessingParameterFile)

from ..program import SturzError
from ..results import show_results
from .base import SturzAlgorithm


class OpenResults(SturzAlgorithm):
    word = "open_results"
    title = "Open results"
    help = ("Adds the maps of a finished folder to the project: styled, grouped, with the release, the assets and the "
            "hillshade of the ground. Nothing is computed, and the program sturz is not needed.")

    def flags(self):
        # Layers belong to the main thread.
        return super().flags() | QgsProcessingAlgorithm.FlagNoThreading

    def initAlgorithm(self, configuration=None):  # noqa: N802
        self.addParameter(QgsProcessingParameterFile("FOLDER", "Folder of the results",
                                                     behavior=QgsProcessingParameterFile.Folder))
        self.addOutput(QgsProcessingOutputNumber("LAYERS", "Layers that were added"))

    def processAlgorithm(self, parameters, context, feedback):  # noqa: N802
        try:
            return {"LAYERS": show_results(self.parameterAsFile(parameters, "FOLDER", context), context, feedback)}
        except SturzError as error:
            raise QgsProcessingException(str(error)) from error
