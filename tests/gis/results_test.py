#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What an ensemble leaves for other programs, opened with theirs: GeoPackage and GeoTIFF (GDAL), STAC item, stacked
members (xarray). Usage: results_test.py PROGRAM"""
import json
import pathlib
import sqlite3
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree
import zipfile

import numpy
import xarray
from osgeo import gdal, ogr

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import made_scene  # noqa: E402

PROGRAM = sys.argv.pop(1)
gdal.UseExceptions()
ogr.UseExceptions()
EDGES = [0, 0.05, 0.1, 0.25, 0.5, 0.75, 0.9, 1]  # of the classes of a probability


class Results(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = made_scene.made_results(PROGRAM, cls.temporary.name)

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def raster(self, name):
        data = gdal.Open(str(self.folder / name))
        return data, data.ReadAsArray()


class GeoTiffs(Results):
    def test_names_are_for_people_and_bounds_lie_apart(self):
        names = {p.name for p in (self.folder / "hazard").glob("*.tif")}
        for name in ("P_reached", "P_thickness_gt_0.5m", "P_speed_gt_5m_s", "P_energy_gt_100kJ_m2", "P_pressure_gt_30kPa",
                     "thickness_p95_m", "energy_mean_kJ_m2", "P_high_intensity"):
            self.assertIn(name + ".tif", names)
        self.assertFalse([name for name in names if "lower" in name or "upper" in name])
        self.assertTrue((self.folder / "hazard/bounds/P_pressure_gt_30kPa_upper.tif").is_file())

    def test_bounds_say_their_level(self):
        data, _ = self.raster("hazard/bounds/P_reached_upper.tif")
        metadata = data.GetRasterBand(1).GetMetadata()
        self.assertEqual(metadata["confidence_level"], "0.95")
        self.assertIn("upper end of the 95 % interval", metadata["long_name"])
        data, _ = self.raster("hazard/P_reached.tif")
        self.assertNotIn("confidence_level", data.GetRasterBand(1).GetMetadata())

    def test_unit_and_nodata_stand_in_the_band(self):
        for name, unit in (("P_reached", "1"), ("pressure_mean_kPa", "kPa"), ("energy_p50_kJ_m2", "kJ m-2"),
                           ("arrival_p50_s", "s")):
            data, values = self.raster(f"hazard/{name}.tif")
            band = data.GetRasterBand(1)
            self.assertEqual(band.GetUnitType(), unit, name)
            self.assertTrue(numpy.isnan(band.GetNoDataValue()))
            reached = self.raster("hazard/P_reached.tif")[1] > 0
            # 0, not nodata, where the ground is known and no member came; an arrival is missing there.
            self.assertTrue((numpy.isnan(values[~reached]) if name.startswith("arrival") else
                             values[~reached] >= 0).all(), name)

    def test_the_ground_is_the_terrain_under_the_maps(self):
        data, z = self.raster("ground.tif")
        west, cell, _, north, _, _ = data.GetGeoTransform()
        self.assertEqual(data.GetGeoTransform(), self.raster("hazard/P_reached.tif")[0].GetGeoTransform())
        self.assertEqual(data.GetRasterBand(1).GetUnitType(), "m")
        row, col = 3, 5
        x, y = west + (col + 0.5) * cell - made_scene.WEST, made_scene.NORTH - north + (row + 0.5) * cell
        across = y - made_scene.ROWS * made_scene.CELL / 2
        self.assertAlmostEqual(z[row, col], 500 + max(0, 500 - x) * 0.577 + 0.0005 * across ** 2, delta=1e-3)


class Package(Results):
    def table(self, name):
        # Both: a layer dies with its file.
        package = ogr.Open(str(self.folder / "hazard.gpkg"))
        self.assertIsNotNone(package.GetLayerByName(name), name)
        return package, package.GetLayerByName(name)

    def rows(self, name):
        """Attributes of every feature, and copies of their geometries under `shape`."""
        package, layer = self.table(name)
        return [dict(f.items(), shape=f.GetGeometryRef().Clone()) for f in layer]

    def test_each_class_has_the_area_of_its_cells(self):
        _, p = self.raster("hazard/P_reached.tif")
        package, layer = self.table("P_reached")
        self.assertEqual(layer.GetSpatialRef().GetAuthorityCode(None), str(made_scene.EPSG))
        self.assertEqual(layer.GetGeomType(), ogr.wkbMultiPolygon)
        self.assertEqual([layer.GetLayerDefn().GetFieldDefn(i).GetName() for i in range(5)],
                         ["class", "label", "probability_from", "probability_to", "area_m2"])
        seen = 0
        for feature in self.rows("P_reached"):
            k = feature["class"]
            low, high = feature["probability_from"], feature["probability_to"]
            self.assertEqual((low, high), (EDGES[k - 1], EDGES[k]))
            inside = (p > 0) & (p >= low) & ((p < high) if high < 1 else True)
            area = inside.sum() * made_scene.CELL ** 2
            self.assertGreater(area, 0)
            self.assertAlmostEqual(feature["area_m2"], area)
            self.assertAlmostEqual(feature["shape"].GetArea(), area)
            self.assertTrue(feature["shape"].IsValid())
            seen += area
        self.assertEqual(seen, (p > 0).sum() * made_scene.CELL ** 2)

    def test_flow_lines_begin_in_the_release_and_end_when_the_front_came(self):
        data, arrival = self.raster("hazard/arrival_p50_s.tif")
        _, p = self.raster("hazard/P_reached.tif")
        west, cell, _, north, _, _ = data.GetGeoTransform()
        release = self.rows("release")[0]["shape"]
        lines = self.rows("flow_lines")
        self.assertEqual([line["probability"] for line in lines], [0.9, 0.5, 0.05])
        for line in lines:
            shape = line["shape"]
            self.assertAlmostEqual(shape.Length(), line["length_m"])
            start = ogr.Geometry(ogr.wkbPoint)
            start.AddPoint_2D(*shape.GetPoint_2D(0))
            self.assertLess(start.Distance(release), 1e-6)
            places = [(int((north - y) / cell), int((x - west) / cell)) for x, y in shape.GetPoints()]
            self.assertTrue(all(p[place] > 0 for place in places))
            self.assertAlmostEqual(arrival[places[-1]], line["arrival_s"], delta=1e-4)
            self.assertGreaterEqual(p[places[-1]], line["probability"] - 1e-6)

    def test_thickness_has_its_unit_in_the_names_and_an_open_last_class(self):
        package, layer = self.table("thickness_p95_m")
        names = [layer.GetLayerDefn().GetFieldDefn(i).GetName() for i in range(5)]
        self.assertEqual(names, ["class", "label", "thickness_from_m", "thickness_to_m", "area_m2"])
        _, h = self.raster("hazard/thickness_p95_m.tif")
        rows = [(f["thickness_from_m"], f["thickness_to_m"], f["area_m2"], f["label"])
                for f in self.rows("thickness_p95_m")]
        self.assertGreater(len(rows), 2)
        self.assertIsNone(rows[-1][1])
        for low, high, area, label in rows:
            inside = (h > 0) & (h >= low * (1 - 1e-6)) & ((h < high * (1 - 1e-6)) if high is not None else True)
            self.assertAlmostEqual(area, inside.sum() * made_scene.CELL ** 2)
            self.assertTrue(label.endswith(" m"), label)

    def test_the_scenes_own_places_are_there(self):
        for name, kind, n in (("release", ogr.wkbMultiPolygon, 1), ("observed", ogr.wkbMultiPolygon, 1),
                              ("thalweg", ogr.wkbLineString, 1), ("gauge_points", ogr.wkbPoint, 1),
                              ("assets", ogr.wkbPolygon, 2), ("deposit_centres", ogr.wkbPoint, 8)):
            package, layer = self.table(name)
            self.assertEqual((layer.GetFeatureCount(), layer.GetGeomType()), (n, kind), name)
        self.assertAlmostEqual(self.rows("release")[0]["area_m2"], 100 * 100, delta=2500)
        self.assertAlmostEqual(self.rows("observed")[0]["shape"].GetArea(), 640 * 160, delta=1e-3)
        self.assertAlmostEqual(self.rows("thalweg")[0]["length_m"], 840)
        self.assertEqual({f["name"] for f in self.rows("assets")}, {"near", "away"})
        self.assertEqual(self.rows("gauge_points")[0]["name"], "bridge")

    def test_styles_are_where_qgis_looks(self):
        data = sqlite3.connect(f"file:{self.folder / 'hazard.gpkg'}?mode=ro", uri=True)
        layers = {name for name, in data.execute("SELECT table_name FROM gpkg_contents WHERE data_type = 'features'")}
        styles = {}
        for name, column, qml, default in data.execute(
                "SELECT f_table_name, f_geometry_column, styleQML, useAsDefault FROM layer_styles "
                "WHERE f_table_schema = ''"):
            self.assertEqual((column, default), ("geom", 1))
            styles[name] = xml.etree.ElementTree.fromstring(qml)
        self.assertEqual(set(styles), layers)
        data.close()
        values = [c.get("value") for c in styles["P_reached"].iter("category")]
        self.assertEqual(values, [str(k) for k in range(1, 8)])

    def test_the_same_scene_gives_the_same_bytes(self):
        before = {name: (self.folder / name).read_bytes() for name in ("hazard.gpkg", "hazard.qgz", "ground.tif")}
        made_scene.run(PROGRAM, "merge", self.folder)
        for name, content in before.items():
            self.assertEqual((self.folder / name).read_bytes() == content, True, name)


class Project(Results):
    def test_every_source_is_relative_and_there(self):
        with zipfile.ZipFile(self.folder / "hazard.qgz") as archive:
            self.assertEqual(archive.namelist(), ["hazard.qgs"])
            project = xml.etree.ElementTree.fromstring(archive.read("hazard.qgs"))
        self.assertEqual(project.findtext("title"), made_scene.TITLE)
        sources = [e.text for e in project.iter("datasource")]
        self.assertGreater(len(sources), 50)
        tables = {layer.GetName() for layer in ogr.Open(str(self.folder / "hazard.gpkg"))}
        for source in sources:
            self.assertTrue(source.startswith("./"), source)
            file, _, table = source.partition("|layername=")
            self.assertTrue((self.folder / file).is_file(), source)
            if table:
                self.assertIn(table, tables)
        tree = [e.get("id") for e in project.iter("layer-tree-layer")]
        self.assertEqual(len(tree), len(set(tree)))
        self.assertEqual(tree, [e.findtext("id") for e in project.iter("maplayer")])


class Stac(Results):
    """Required fields of an item, https://github.com/radiantearth/stac-spec, item-spec of v1.0.0."""

    def test_the_item_has_what_the_specification_demands(self):
        item = json.loads((self.folder / "stac_item.json").read_text())
        self.assertEqual((item["type"], item["stac_version"]), ("Feature", "1.0.0"))
        for key, kind in (("stac_extensions", list), ("id", str), ("geometry", dict), ("bbox", list),
                          ("properties", dict), ("links", list), ("assets", dict)):
            self.assertIsInstance(item[key], kind, key)
        self.assertRegex(item["properties"]["datetime"], r"^\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ$")
        self.assertTrue(item["id"])
        ring = item["geometry"]["coordinates"][0]
        self.assertEqual((item["geometry"]["type"], ring[0]), ("Polygon", ring[-1]))
        west, south, east, north = item["bbox"]
        self.assertEqual((west, south), (min(p[0] for p in ring), min(p[1] for p in ring)))
        # The scene lies on the central meridian of its zone, 15 degrees east.
        self.assertAlmostEqual(west, 15, delta=1e-3)
        self.assertTrue(41 < south < north < 42 and west < east, item["bbox"])
        area = sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(ring, ring[1:]))
        self.assertGreater(area, 0, "counterclockwise, RFC 7946")

    def test_the_projection_is_that_of_the_rasters(self):
        item = json.loads((self.folder / "stac_item.json").read_text())
        self.assertIn("https://stac-extensions.github.io/projection/v1.1.0/schema.json", item["stac_extensions"])
        data, values = self.raster("hazard/P_reached.tif")
        about = item["properties"]
        west, cell, _, north, _, down = data.GetGeoTransform()
        self.assertEqual(about["proj:epsg"], made_scene.EPSG)
        self.assertEqual(about["proj:shape"], list(values.shape))
        self.assertEqual(about["proj:transform"], [cell, 0, west, 0, down, north, 0, 0, 1])

    def test_every_asset_is_there_with_its_unit(self):
        item = json.loads((self.folder / "stac_item.json").read_text())
        for key, asset in item["assets"].items():
            self.assertTrue((self.folder / asset["href"]).is_file(), key)
            self.assertTrue(asset["title"] and asset["type"] and asset["roles"], key)
        bands = item["assets"]["hazard/pressure_mean_kPa.tif"]["raster:bands"]
        self.assertEqual(bands, [{"data_type": "float32", "nodata": "nan", "unit": "kPa"}])


class Stack(Results):
    def stack(self, *more):
        file = self.folder / "stack.nc"
        made_scene.run(PROGRAM, "members", self.folder, "--stack", file, *more)
        return file

    def test_xarray_has_the_members_on_one_grid(self):
        with xarray.open_dataset(self.stack("--quantity", "pressure")) as data:
            intensity = data["intensity"]
            self.assertEqual(intensity.dims, ("member", "y", "x"))
            self.assertEqual(intensity.attrs["units"], "kPa")
            self.assertEqual(list(data["member"].values), list(range(8)))
            for number in range(8):
                with xarray.open_dataset(self.folder / f"members/{number:06d}.nc") as member:
                    own = member["peak_pressure"] / 1000
                    same = intensity.sel(member=number).reindex_like(own)
                    numpy.testing.assert_allclose(same.values, own.values, rtol=1e-6)
                    # Nothing beyond the member's own window; both are floats of 24 bits, summed as doubles.
                    total = intensity.sel(member=number).values.sum(dtype=float)
                    numpy.testing.assert_allclose(total, own.values.sum(dtype=float), rtol=1e-6)

    def test_the_maps_follow_from_the_stack(self):
        with xarray.open_dataset(self.stack()) as data, xarray.open_dataset(self.folder / "hazard.nc") as maps:
            share = (data["intensity"] > 0.5).mean("member")
            stored = maps["thickness_exceedance"].sel(thickness_threshold=0.5)
            numpy.testing.assert_allclose(share.values, stored.reindex_like(share).values, atol=1e-6)
            self.assertEqual(stored.values.sum(dtype=float), stored.reindex_like(share).values.sum(dtype=float),
                             "all of it")

    def test_the_file_keeps_the_conventions(self):
        lint = pathlib.Path(__file__).parent.parent / "support/cf_lint.py"
        found = subprocess.run([sys.executable, lint, self.stack("--quantity", "arrival")], capture_output=True, text=True,
                               check=False)
        self.assertEqual(found.returncode, 0, found.stdout + found.stderr)

    def test_climada_finds_its_coordinates_unaided(self):
        """As Hazard.from_xarray_raster reads: default names, stacked to events by places."""
        data = xarray.open_dataset(self.stack("--frequency", "0.02"))
        dims = {name: data[name].dims for name in ("time", "latitude", "longitude")}
        flat = data.stack(event=dims["time"], lat_lon=dict.fromkeys(dims["latitude"] + dims["longitude"]))
        self.assertEqual(set(flat["intensity"].dims), {"event", "lat_lon"})
        latitude, longitude = flat["latitude"].values, flat["longitude"].values
        self.assertEqual(latitude.shape, (data.sizes["y"] * data.sizes["x"],))
        self.assertTrue((latitude > 41).all() and (latitude < 42).all())
        self.assertTrue((abs(longitude - 15) < 0.02).all())
        for name in ("time", "event_id"):  # read as ordinals, which must be positive whole numbers
            self.assertTrue(numpy.issubdtype(flat[name].dtype, numpy.integer) and (flat[name] > 0).all(), name)
        self.assertAlmostEqual(float(flat["frequency"].sum()), 0.02)
        self.assertEqual(flat["frequency"].dims, ("event",))
        data.close()

    def test_bad_requests_have_one_clear_error(self):
        for words, text in ((("--quantity", "mass"), "--quantity mass (is none that members have). One of: thickness"),
                            (("--quantity", "liquid"), "no member has a map of")):
            with self.assertRaisesRegex(AssertionError, "code 1"):
                self.stack(*words)
            try:
                self.stack(*words)
            except AssertionError as error:
                self.assertIn(text, str(error))


del Results  # has no tests of its own

if __name__ == "__main__":
    unittest.main()
