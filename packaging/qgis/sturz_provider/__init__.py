# SPDX-License-Identifier: Apache-2.0
"""QGIS plugin: a Processing provider that calls the program sturz."""


def classFactory(iface):  # noqa: N802 (QGIS looks for this name)
    from .plugin import SturzPlugin
    return SturzPlugin(iface)
