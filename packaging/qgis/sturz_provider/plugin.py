# SPDX-License-Identifier: Apache-2.0
"""What QGIS starts: registers the provider, with or without windows."""
from qgis.core import QgsApplication

from .provider import SturzProvider


class SturzPlugin:
    def __init__(self, iface):
        self.iface = iface
        self.provider = None

    def initProcessing(self):  # noqa: N802 (QGIS calls these names)
        self.provider = SturzProvider()
        QgsApplication.processingRegistry().addProvider(self.provider)

    def initGui(self):  # noqa: N802
        self.initProcessing()

    def unload(self):
        if self.provider is not None:
            QgsApplication.processingRegistry().removeProvider(self.provider)
            self.provider = None
