#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The project of an ensemble as QGIS opens and draws it. Usage: qgis_project_test.py PROGRAM [PICTURE]"""
import os
import pathlib
import sys
import tempfile
import unittest
import xml.etree.ElementTree

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
import numpy  # noqa: E402
from osgeo import gdal  # noqa: E402
from qgis.core import (QgsApplication, QgsMapRendererSequentialJob, QgsMapSettings, QgsProject,  # noqa: E402
                       QgsRasterLayer, QgsRectangle, QgsVectorLayer, QgsWkbTypes)
from qgis.PyQt.QtCore import QSize  # noqa: E402
from qgis.PyQt.QtGui import QColor, QImage  # noqa: E402

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import made_scene  # noqa: E402

PROGRAM = sys.argv.pop(1)
PICTURE = sys.argv.pop(1) if len(sys.argv) > 1 and sys.argv[1].endswith(".png") else None
OPACITY = 0.85
# First and last of the page's ramp of probabilities.
PALEST, DARKEST = (255, 238, 166), (52, 10, 70)


def drawn(layers, extent, size, crs=None):
    """Picture as numbers [row][column][red, green, blue]."""
    settings = QgsMapSettings()
    settings.setLayers(layers)
    settings.setBackgroundColor(QColor("white"))
    settings.setOutputSize(QSize(*size))
    settings.setExtent(extent)
    settings.setFlag(QgsMapSettings.Antialiasing, False)
    if crs is not None:
        settings.setDestinationCrs(crs)
    job = QgsMapRendererSequentialJob(settings)
    job.start()
    job.waitForFinished()
    image = job.renderedImage().convertToFormat(QImage.Format_RGBA8888)
    bits = image.constBits()
    bits.setsize(image.sizeInBytes())
    whole = numpy.frombuffer(bits, numpy.uint8).reshape(image.height(), image.bytesPerLine() // 4, 4)
    return whole[:, :image.width(), :3].copy()  # the memory is the image's


class OpenedProject(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = made_scene.made_results(PROGRAM, cls.temporary.name)
        # Moved since: paths are relative.
        cls.folder = cls.folder.rename(cls.folder.parent / "moved")
        cls.project = QgsProject()
        assert cls.project.read(str(cls.folder / "hazard.qgz")), cls.project.error()
        cls.by_name = {}
        for node in cls.project.layerTreeRoot().findLayers():
            cls.by_name.setdefault((node.parent().name(), node.name()), node)

    @classmethod
    def tearDownClass(cls):
        cls.project.clear()
        cls.temporary.cleanup()

    def raster(self, name):
        data = gdal.Open(str(self.folder / name))
        west, cell, _, north, _, _ = data.GetGeoTransform()
        values = data.ReadAsArray()
        rows, columns = values.shape
        return values, QgsRectangle(west, north - rows * cell, west + columns * cell, north)

    def visible(self):
        return [node.layer() for node in self.project.layerTreeRoot().findLayers() if node.isVisible()]

    def pixels_of_cells(self, layers, values, extent, per_cell=5):
        """The middle pixel of every cell."""
        rows, columns = values.shape
        crs = layers[0].crs()
        picture = drawn(layers, extent, (columns * per_cell, rows * per_cell), crs)
        middle = per_cell // 2
        return picture[middle::per_cell, middle::per_cell].astype(int)

    def test_everything_opens_where_it_lies(self):
        layers = self.project.mapLayers().values()
        self.assertGreater(len(layers), 50)
        self.assertEqual([layer.name() for layer in layers if not layer.isValid()], [])
        self.assertEqual({layer.crs().authid() for layer in layers}, {f"EPSG:{made_scene.EPSG}"})
        self.assertEqual(self.project.crs().authid(), f"EPSG:{made_scene.EPSG}")
        self.assertEqual(self.project.title(), made_scene.TITLE)

    def test_groups_and_names_can_be_read(self):
        groups = [g.name() for g in self.project.layerTreeRoot().children()]
        self.assertEqual((groups[0], groups[1], groups[-2:]),
                         ("Scene", "Probability", ["Bounds of the probabilities", "Ground"]))
        self.assertIn("Areas of classes", groups)
        for group, name in (("Scene", "Release"), ("Scene", "Observed outline"), ("Scene", "Gauges"),
                            ("Probability", "Probability that the flow arrives"), ("Ground", "Hillshade"),
                            ("Bounds of the probabilities", "Probability that the flow arrives, 95 % upper bound")):
            self.assertIn((group, name), self.by_name)
        shown = {node.name() for node in self.project.layerTreeRoot().findLayers() if node.isVisible()}
        self.assertEqual(shown, {"Release", "Observed outline", "Thalweg of the event", "Gauges",
                                 "Assets, by their probability to be hit", "Probability that the flow arrives", "Hillshade"})

    def test_a_probability_has_the_colours_of_its_classes_and_nothing_where_nothing_comes(self):
        values, extent = self.raster("hazard/P_reached.tif")
        style = xml.etree.ElementTree.parse(self.folder / "hazard/P_reached.qml")
        colours = [QColor(item.get("color")).getRgb()[:3] for item in style.iter("item")]
        self.assertEqual((colours[0], colours[-1]), (PALEST, DARKEST))
        layer = self.by_name["Probability", "Probability that the flow arrives"].layer()
        found = self.pixels_of_cells([layer], values, extent)
        edges = numpy.array([0.05, 0.1, 0.25, 0.5, 0.75, 0.9])
        classes = numpy.searchsorted(edges, values, side="right")
        self.assertGreater(len(set(classes[values > 0])), 3, "a test that sees several classes")
        expected = numpy.array(colours)[classes] * OPACITY + 255 * (1 - OPACITY)
        expected[values == 0] = 255
        self.assertLess(abs(found - expected).max(), 3)

    def test_the_areas_of_classes_have_the_same_colours(self):
        values, extent = self.raster("hazard/P_reached.tif")
        layer = self.by_name["Areas of classes", "Probability that the flow arrives"].layer()
        self.assertIsInstance(layer, QgsVectorLayer)
        found = self.pixels_of_cells([layer], values, extent)
        inside = abs(found[values >= 0.9] - (numpy.array(DARKEST) * 216 / 255 + 255 * (1 - 216 / 255))).max(axis=1)
        self.assertGreater((inside < 3).mean(), 0.7, "borders apart")
        self.assertTrue((found[values == 0] == 255).mean() > 0.9)

    def test_a_layer_of_the_package_has_its_style_without_the_project(self):
        layer = QgsVectorLayer(f"{self.folder / 'hazard.gpkg'}|layername=thickness_p95_m", "h", "ogr")
        self.assertTrue(layer.isValid())
        self.assertEqual(layer.geometryType(), QgsWkbTypes.PolygonGeometry)
        self.assertEqual((layer.renderer().type(), layer.renderer().classAttribute()), ("categorizedSymbol", "class"))
        raster = QgsRasterLayer(str(self.folder / "hazard/thickness_p95_m.tif"), "h")
        self.assertEqual(raster.renderer().type(), "singlebandpseudocolor")

    def test_assets_have_the_colour_of_their_probability(self):
        layer = self.by_name["Scene", "Assets, by their probability to be hit"].layer()
        assets = {f["name"]: f for f in layer.getFeatures()}
        self.assertGreaterEqual(assets["near"]["probability"], 0.9)
        for name, colour in (("near", DARKEST), ("away", PALEST)):
            box = assets[name].geometry().boundingBox()
            picture = drawn([layer], box.buffered(10), (80, 80), layer.crs()).reshape(-1, 3).astype(int)
            self.assertTrue((abs(picture - numpy.array(colour)).max(axis=1) < 3).any(), name)

    def test_the_whole_picture_is_pale_ground_with_readable_classes_and_nothing_black(self):
        values, extent = self.raster("hazard/P_reached.tif")
        rows, columns = values.shape
        picture = drawn(self.visible(), extent, (columns * 10, rows * 10), self.project.crs())
        if PICTURE:
            QImage(numpy.ascontiguousarray(picture).tobytes(), columns * 10, rows * 10, columns * 30,
                   QImage.Format_RGB888).save(PICTURE)
        cells = picture[5::10, 5::10].astype(int)
        outside = cells[values == 0]
        grey = outside.max(axis=1) - outside.min(axis=1) < 12
        self.assertGreater(grey.mean(), 0.8, "hillshade where nothing comes")
        self.assertGreater(numpy.median(outside[grey]), 140)
        self.assertLess((picture.max(axis=2) < 40).mean(), 0.002)
        likely, rare = cells[values >= 0.9].mean(axis=0), cells[(values > 0) & (values < 0.25)].mean(axis=0)
        self.assertGreater((rare - likely).sum(), 200)


if __name__ == "__main__":
    QgsApplication.setPrefixPath("/usr", True)
    application = QgsApplication([], False)
    application.initQgis()
    result = unittest.main(exit=False).result
    sys.stdout.flush()
    # Without leaving QGIS in order, which may crash among its own libraries after all is done.
    os._exit(0 if result.wasSuccessful() else 1)
