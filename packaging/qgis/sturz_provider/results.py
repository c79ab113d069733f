# SPDX-License-Identifier: Apache-2.0
"""Shows a folder of results: its project's layers, with their styles and groups, in the project at hand."""
import os

from qgis.core import QgsLayerTreeGroup, QgsProject

from .program import SturzError


def project_of(folder):
    """Of an ensemble or, where there is none, of a single run."""
    ensemble, run = (os.path.join(folder, name) for name in ("hazard.qgz", "peaks.qgz"))
    return run if os.path.isfile(run) and not os.path.isfile(ensemble) else ensemble


def _copy(group, target, layers, project):
    """A group with its layers into another tree, the upper ones first."""
    n = 0
    for child in group.children():
        if isinstance(child, QgsLayerTreeGroup):
            made = target.addGroup(child.name())
            made.setExpanded(child.isExpanded())
            made.setItemVisibilityChecked(child.itemVisibilityChecked())
            n += _copy(child, made, layers, project)
        else:
            layer = layers[child.layerId()].clone()
            project.addMapLayer(layer, False)
            node = target.addLayer(layer)
            node.setItemVisibilityChecked(child.itemVisibilityChecked())
            node.setExpanded(child.isExpanded())
            n += 1
    return n


def show_results(folder, context, feedback):
    """Adds one group with everything that hazard.qgz (peaks.qgz of a run) shows. Returns the number of layers."""
    file = project_of(folder)
    if not os.path.isfile(file):
        raise SturzError(f"{folder} has no hazard.qgz. Name a folder that `sturz ensemble` or `sturz run` wrote (without `hazard.gis_files: false`); `sturz merge` makes "
                         "the file for one of an older version.")
    stored = QgsProject()
    if not stored.read(file):
        raise SturzError(f"{file} cannot be read ({stored.error()}). `sturz merge {folder}` makes it anew.")
    broken = [layer.name() for layer in stored.mapLayers().values() if not layer.isValid()]
    if broken:
        feedback.pushWarning("Files are missing for: " + ", ".join(broken))
    project = context.project() or QgsProject.instance()
    group = project.layerTreeRoot().insertGroup(0, stored.title() or os.path.basename(folder))
    if not project.mapLayers():
        project.setCrs(stored.crs())
    n = _copy(stored.layerTreeRoot(), group, stored.mapLayers(), project)
    feedback.pushInfo(f"{n} layers of {folder}")
    return n
