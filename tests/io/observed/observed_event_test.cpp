// SPDX-License-Identifier: Apache-2.0
// What was observed, from its files onto the cells of the maps.
#include "io/site/observed/event_reader.hpp"
#include "io/site/scene_inputs.hpp"
#include "tests/io/io_fixture.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace sturz::test {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

double sum(const Raster<double>& raster) {
  return std::accumulate(raster.values.begin(), raster.values.end(), 0.0,
                         [](double s, double v) { return s + (std::isfinite(v) ? v : 0); });
}

std::size_t measured_cells(const Raster<double>& raster) {
  return static_cast<std::size_t>(std::count_if(raster.values.begin(), raster.values.end(),
                                                [](double v) { return std::isfinite(v); }));
}

class ObservedEvents : public SceneOnAPlane {
 protected:
  ObservedEvents() { scene.observation.emplace(); }
  ObservationSpec& spec() { return *scene.observation; }
  void polygon(const std::string& name, const std::string& ring) {
    write(name, collection(feature("Polygon", "[" + ring + "]")));
  }
  /// n x n cells; the north-west corner lies x, y from 500000, 4600000.
  void raster(const std::string& name, double x, double y, double cell, int n,
              const std::vector<double>& values) {
    RasterFile file;
    file.n_cols = file.n_rows = n;
    file.affine = {500000 + x, cell, 0, 4600000 + y, 0, -cell};
    file.nodata = -9999;
    file.values = values;
    write_raster(path(name), file);
  }
  std::shared_ptr<const ObservedEvent> load() { return load_scene_inputs(scene).event; }
};

TEST_F(ObservedEvents, ASceneWithoutObservationHasNone) {
  scene.observation.reset();
  const SceneInputs in = load_scene_inputs(scene);
  EXPECT_EQ(in.event, nullptr);
  EXPECT_TRUE(in.observed.empty());
}

TEST_F(ObservedEvents, AnOutlineCoversCellsByTheirShareAndIsDrawn) {
  polygon("mapped.geojson", square(105, 100, 50));
  spec().outline = "mapped.geojson";
  spec().outline_sd_m = 7;
  const SceneInputs in = load_scene_inputs(scene);
  ASSERT_TRUE(in.event && in.event->outline);
  const ObservedArea& area = *in.event->outline;
  EXPECT_NEAR(100 * sum(area.cover), 2500, 1e-6);
  EXPECT_EQ(std::count(area.cover.values.begin(), area.cover.values.end(), 0.5), 10);
  ASSERT_EQ(area.outer.size(), 1U);
  EXPECT_EQ(area.outer[0].size(), 5U);
  EXPECT_EQ(area.sd_m, 7);
  EXPECT_EQ(in.observed.size(), 1U);
  EXPECT_EQ(in.identities.back().role, "observation.outline");
  EXPECT_THAT(in.notes, Contains("observation.outline = mapped.geojson: area 2500 m2"));
  EXPECT_NEAR(in.event->origin.x(), 500225, 1e-6);  // the centre of the box
  EXPECT_NEAR(in.event->origin.y(), 4600225, 1e-6);
}

TEST_F(ObservedEvents, FeaturesThatOverlapCountOnceAndHolesAreLeftOut) {
  write("mapped.geojson", collection(feature("Polygon", "[" + square(100, 100, 60) + "," +
                                                            square(120, 120, 20) + "]") +
                                     "," + feature("Polygon", "[" + square(140, 100, 60) + "]")));
  spec().outline = "mapped.geojson";
  spec().outline_sd_m = 5;
  const auto event = load();
  EXPECT_NEAR(100 * sum(event->outline->cover), 100 * 60 - 400, 1e-6);
  EXPECT_EQ(event->outline->outer.size(), 1U);
  EXPECT_LE(
      *std::max_element(event->outline->cover.values.begin(), event->outline->cover.values.end()),
      1 + 1e-12);
}

TEST_F(ObservedEvents, WhatLiesBeyondTheTerrainIsNotCompared) {
  polygon("mapped.geojson", square(-30, 100, 60));
  spec().outline = "mapped.geojson";
  spec().outline_sd_m = 5;
  const SceneInputs in = load_scene_inputs(scene);
  EXPECT_NEAR(100 * sum(in.event->outline->cover), 30 * 60, 1e-6);
  EXPECT_THAT(in.warnings, Contains(HasSubstr("1800 of 3600 m2 lie beyond the terrain")));
  EXPECT_EQ(in.observed[0].size(), 5U);
  EXPECT_TRUE(std::any_of(in.observed[0].begin(), in.observed[0].end(),
                          [](const Vec2& p) { return p.x() < 500000; }));
  polygon("mapped.geojson", square(9000, 100, 60));
  EXPECT_THAT(message_of([&] { load(); }), HasSubstr("lies beyond the terrain"));
}

TEST_F(ObservedEvents, ADepositOutsideTheOutlineIsDoubted) {
  polygon("mapped.geojson", square(100, 100, 60));
  polygon("deposit.geojson", square(140, 100, 40));
  spec().outline = "mapped.geojson";
  spec().outline_sd_m = spec().deposit_sd_m = 5;
  spec().deposit = "deposit.geojson";
  EXPECT_THAT(load_scene_inputs(scene).warnings,
              Contains(AllOf(HasSubstr("observation.deposit: 50 % of it lie outside"),
                             HasSubstr("the same event"))));
  polygon("deposit.geojson", square(110, 110, 40));
  EXPECT_THAT(load_scene_inputs(scene).warnings, Not(Contains(HasSubstr("observation.deposit"))));
}

TEST_F(ObservedEvents, ThicknessOfTheMapsOwnCellsIsTakenAsItIs) {
  raster("h.tif", 100, 200, 10, 3, {1, 2, 3, -9999, 5, 6, 7, 8, 0});
  spec().deposit_thickness = "h.tif";
  spec().thickness_sd_m = 0.4;
  const auto event = load();
  EXPECT_EQ(event->thickness->sd_m, 0.4);
  EXPECT_FALSE(event->thickness->net_change);
  EXPECT_EQ(measured_cells(event->thickness->value), 8U);
  EXPECT_NEAR(sum(event->thickness->value), 32, 1e-9);
  const Raster<double>& v = event->thickness->value;
  const int row = v.grid.row_of(4600195), col = v.grid.col_of(500125);
  EXPECT_DOUBLE_EQ(v.at(row, col), 3);
}

TEST_F(ObservedEvents, FinerAndShiftedCellsAreAveraged) {
  std::vector<double> ramp(400);
  std::iota(ramp.begin(), ramp.end(), 0.0);
  raster("h.tif", 105, 205, 1, 20, ramp);
  spec().deposit_thickness = "h.tif";
  spec().thickness_sd_m = 0.4;
  const auto event = load();
  // The one cell of the maps that lies wholly inside holds rows and columns 5 .. 14.
  const Raster<double>& v = event->thickness->value;
  EXPECT_NEAR(v.at(v.grid.row_of(4600195), v.grid.col_of(500115)), 9.5 * 20 + 9.5, 1e-9);
  // A corner of it is covered by a quarter: not measured. Beside it a half is.
  EXPECT_TRUE(std::isnan(v.at(v.grid.row_of(4600205), v.grid.col_of(500105))));
  EXPECT_TRUE(std::isfinite(v.at(v.grid.row_of(4600205), v.grid.col_of(500115))));
}

TEST_F(ObservedEvents, SignsOfADemOfDifference) {
  raster("dod.tif", 100, 200, 10, 2, {-3, 2, 1, -9999});
  spec().deposit_thickness = "dod.tif";
  spec().thickness_sd_m = 0.5;
  EXPECT_THAT(message_of([&] { load(); }),
              AllOf(HasSubstr("observation.deposit_thickness = dod.tif: holds -3"),
                    HasSubstr("rise_positive (after - before)")));
  spec().thickness_sign = ThicknessSign::rise_positive;
  auto event = load();
  EXPECT_TRUE(event->thickness->net_change);
  EXPECT_EQ(measured_cells(event->thickness->value), 2U);  // where it fell is masked
  EXPECT_NEAR(sum(event->thickness->value), 3, 1e-9);
  spec().thickness_sign = ThicknessSign::fall_positive;
  event = load();
  EXPECT_EQ(measured_cells(event->thickness->value), 1U);
  EXPECT_NEAR(sum(event->thickness->value), 3, 1e-9);
  spec().mask_erosion = false;
  event = load();
  EXPECT_EQ(measured_cells(event->thickness->value), 3U);
  EXPECT_NEAR(sum(event->thickness->value), 0, 1e-9);
}

TEST_F(ObservedEvents, ADemOfDifferenceIsNotComparedWhereTheSourceWas) {
  raster("dod.tif", 180, 270, 10, 9, std::vector<double>(81, 1.5));
  spec().deposit_thickness = "dod.tif";
  spec().thickness_sd_m = 0.5;
  EXPECT_EQ(measured_cells(load()->thickness->value), 81U);  // a thickness is one everywhere
  spec().thickness_sign = ThicknessSign::rise_positive;
  const SceneInputs in = load_scene_inputs(scene);
  EXPECT_EQ(measured_cells(in.event->thickness->value), 81U - 25U);
  EXPECT_THAT(in.notes, Contains(HasSubstr("net change, not compared in 25 cells of the source "
                                           "and 0 where the ground fell")));
  EXPECT_THAT(in.warnings, Contains(AllOf(HasSubstr("the ground rises, by 1.5 m on the mean"),
                                          HasSubstr("thickness_sign the other way round?"))));
  std::vector<double> event(81, 1.5);  // as it is: a hollow where the source was
  std::fill(event.begin() + 18, event.begin() + 63, -4);
  raster("dod.tif", 180, 270, 10, 9, event);
  EXPECT_THAT(load_scene_inputs(scene).warnings, Not(Contains(HasSubstr("thickness_sign"))));
}

TEST_F(ObservedEvents, WithoutAnyDepositThereIsNothingToCompare) {
  raster("dod.tif", 100, 200, 10, 2, {-3, -2, -1, 0.05});
  spec().deposit_thickness = "dod.tif";
  spec().thickness_sd_m = 0.5;
  spec().thickness_sign = ThicknessSign::rise_positive;
  EXPECT_THAT(message_of([&] { load(); }),
              AllOf(HasSubstr("no cell that is compared holds more than 0.1 m"),
                    HasSubstr("Check observation.thickness_sign")));
  spec().threshold_m = 0.01;
  EXPECT_EQ(measured_cells(load()->thickness->value), 1U);
}

TEST_F(ObservedEvents, AnOutlineBesideTheReleaseIsDoubted) {
  spec().outline = "mapped.geojson";
  spec().outline_sd_m = 5;
  polygon("mapped.geojson", square(205, 205, 60));
  EXPECT_THAT(load_scene_inputs(scene).warnings, Not(Contains(HasSubstr("observation.outline"))));
  polygon("mapped.geojson", square(30, 30, 60));
  EXPECT_THAT(load_scene_inputs(scene).warnings,
              Contains(HasSubstr("observation.outline: does not touch the release")));
}

TEST_F(ObservedEvents, LinesAndPoints) {
  write("thalweg.geojson",
        collection(feature("LineString", "[[500225,4600225],[500300,4600200],[500400,4600100]]")));
  write("toe.geojson", collection(feature("Point", "[500400,4600100]")));
  spec().thalweg = "thalweg.geojson";
  spec().farthest_point = "toe.geojson";
  spec().farthest_point_sd_m = 12;
  const SceneInputs in = load_scene_inputs(scene);
  ASSERT_EQ(in.event->thalweg.size(), 3U);
  EXPECT_EQ(in.event->thalweg[2], Vec2(500400, 4600100));
  EXPECT_EQ(*in.event->farthest, Vec2(500400, 4600100));
  EXPECT_EQ(in.event->farthest_sd_m, 12);
  EXPECT_EQ(in.identities.back().role, "observation.farthest_point");
  EXPECT_THAT(in.warnings, Not(Contains(HasSubstr("observation.thalweg"))));
  write("thalweg.geojson",
        collection(feature("LineString", "[[500400,4600100],[500300,4600200],[500225,4600225]]")));
  EXPECT_THAT(load_scene_inputs(scene).warnings,
              Contains(HasSubstr("observation.thalweg: its start lies farther")));
}

TEST_F(ObservedEvents, WithoutAReleaseDistancesNeedAThalweg) {
  const Raster<double> nothing(plane(50, 40, 10, 500000, 4600400).grid, 0.0);
  spec().farthest_point_m = {500300, 4600200};
  spec().farthest_point_sd_m = 5;
  EXPECT_THAT(message_of([&] { read_observed_event(scene, nothing.grid, &nothing); }),
              HasSubstr("Add observation.thalweg."));
  write("thalweg.geojson",
        collection(feature("LineString", "[[500225,4600225],[500300,4600200]]")));
  spec().thalweg = "thalweg.geojson";
  const EventRead read = read_observed_event(scene, nothing.grid, &nothing);
  EXPECT_EQ(read.event.thalweg.size(), 2U);
  EXPECT_THAT(read.warnings, Not(Contains(HasSubstr("observation.thalweg"))));
}

TEST_F(ObservedEvents, NumbersAreTakenOver) {
  spec().runout_m = MeasuredSpec{200, 10};
  spec().farthest_point_m = {500300, 4600200};
  spec().farthest_point_sd_m = 5;
  spec().threshold_m = 0.3;
  spec().fronts = {{{"time_s", {10}}, {"point_m", {500300, 4600210}}, {"sd_s", {2}}}};
  spec().speeds = {{{"point_m", {500310, 4600210}}, {"speed_m_s", {11}}, {"sd_m_s", {3}}}};
  const auto event = load();
  EXPECT_EQ(event->runout_m->value, 200);
  EXPECT_EQ(event->runout_m->sd, 10);
  EXPECT_EQ(*event->farthest, Vec2(500300, 4600200));
  EXPECT_EQ(event->threshold_m, 0.3);
  EXPECT_TRUE(event->threshold_given);
  ASSERT_EQ(event->fronts.size(), 1U);
  EXPECT_FALSE(event->fronts[0].distance_m);
  EXPECT_EQ(event->fronts[0].point, Vec2(500300, 4600210));
  EXPECT_EQ(*event->fronts[0].sd_s, 2);
  ASSERT_EQ(event->speeds.size(), 1U);
  EXPECT_EQ(event->speeds[0].speed_m_s.value, 11);
}

TEST_F(ObservedEvents, AllThatIsWrongIsToldInOneRound) {
  write("line.geojson", collection(feature("LineString", "[[500225,4600225],[500300,4600200]]")));
  spec().outline = "line.geojson";
  spec().deposit = "missing.gpkg";
  spec().thalweg = "point.geojson";
  write("point.geojson", collection(feature("Point", "[500400,4600100]")));
  spec().farthest_point = "two.geojson";
  write("two.geojson", collection(feature("Point", "[500400,4600100]") + "," +
                                  feature("Point", "[500410,4600100]")));
  spec().speeds = {{{"point_m", {15, 46}}, {"speed_m_s", {11}}, {"sd_m_s", {3}}}};
  scene.basal.zones.push_back({"nowhere.gpkg", "", 0.3, {}, {}});
  EXPECT_THAT(
      message_of([&] { load(); }),
      AllOf(HasSubstr("Draw the observed outline as polygons"),
            HasSubstr("observation.deposit = missing.gpkg"),
            HasSubstr("observation.thalweg = point.geojson: holds a Point, not a line"),
            HasSubstr("observation.farthest_point = two.geojson: must hold one feature, a point"),
            HasSubstr("observation.speeds[0].point_m = [15, 46]: lies beyond the terrain"),
            HasSubstr("basal.zones[0].polygon = nowhere.gpkg")));
  scene.terrain.raster = "none.tif";  // what can be checked without it is
  EXPECT_THAT(message_of([&] { load(); }),
              AllOf(HasSubstr("terrain.raster = none.tif"), HasSubstr("missing.gpkg"),
                    HasSubstr("holds a Point, not a line")));
}

TEST_F(ObservedEvents, LengthsBeyondTheTerrainAreRefusedAndWideOnesDoubted) {
  spec().runout_m = MeasuredSpec{70000.0, 10.0};
  spec().com_travel_m = MeasuredSpec{60000.0, 10.0};
  spec().area_m2 = MeasuredSpec{1e9, 1e6};
  spec().fronts = {{{"time_s", {3}}, {"distance_m", {50000}}, {"sd_m", {5}}}};
  const std::string message = message_of([&] { load(); });
  EXPECT_THAT(message,
              AllOf(HasSubstr("observation.runout_m.value = 70000 m: is longer than the terrain"),
                    HasSubstr("observation.com_travel_m.value = 60000 m"),
                    HasSubstr("observation.area_m2.value = 1e+09 m2: is more than"),
                    HasSubstr("observation.fronts[0].distance_m = 50000 m")));
  spec().com_travel_m.reset(), spec().area_m2.reset(), spec().fronts.clear();
  spec().runout_m = MeasuredSpec{70.0, 90.0};
  EXPECT_THAT(load_scene_inputs(scene).warnings,
              Contains(HasSubstr("observation.runout_m: its standard deviation of 90 is larger")));
  spec().runout_m = MeasuredSpec{70.0, 10.0};
  EXPECT_THAT(load_scene_inputs(scene).warnings, Not(Contains(HasSubstr("standard deviation"))));
}

TEST_F(ObservedEvents, OtherSystemsAreReprojected) {
  // The same place in degrees, as elsewhere; without a system GeoJSON is WGS84.
  write("mapped.geojson",
        collection(feature("Polygon",
                           "[[[15.001,41.5525],[15.003,41.5525],[15.003,41.5535],[15.001,41.5535],"
                           "[15.001,41.5525]]]"),
                   ""));
  spec().outline = "mapped.geojson";
  spec().outline_sd_m = 5;
  const SceneInputs in = load_scene_inputs(scene);
  EXPECT_NEAR(100 * sum(in.event->outline->cover), 166.8 * 111.1, 200);
  EXPECT_THAT(in.notes, Contains(AllOf(HasSubstr("observation.outline"),
                                       HasSubstr("reprojected from WGS 84"))));
}

}  // namespace
}  // namespace sturz::test
