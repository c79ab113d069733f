# SPDX-License-Identifier: Apache-2.0
"""The group `sturz` of the Processing toolbox, and its one setting: where the program lies."""
from processing.core.ProcessingConfig import ProcessingConfig, Setting
from qgis.core import QgsProcessingProvider

from .algorithms.calibrate import Calibrate
from .algorithms.describe import Describe
from .algorithms.ensemble import Ensemble
from .algorithms.open_results import OpenResults
from .algorithms.run import Run
from .program import SETTING


class SturzProvider(QgsProcessingProvider):
    def id(self):
        return "sturz"

    def name(self):
        return "sturz"

    def longName(self):  # noqa: N802
        return "sturz: landslide hazard from ensembles"

    def load(self):
        ProcessingConfig.addSetting(Setting(self.name(), SETTING,
                                            "Program sturz (empty: the one on PATH)", "",
                                            valuetype=Setting.FILE))
        ProcessingConfig.readSettings()
        self.refreshAlgorithms()
        return True

    def unload(self):
        ProcessingConfig.removeSetting(SETTING)

    def loadAlgorithms(self):  # noqa: N802
        for algorithm in (Describe, Run, Ensemble, Calibrate, OpenResults):
            self.addAlgorithm(algorithm())
