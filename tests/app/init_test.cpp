// SPDX-License-Identifier: Apache-2.0
// A scenario written around files that somebody has, and what is said where they do not fit.
#include "tests/app/app_fixture.hpp"

namespace sturz::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class Init : public App {
 protected:
  void SetUp() override {
    const Ended made = sturz({"terrain", "ramp", "-o", path("ground"), "--cell", "5", "--set",
                              "slope_deg=30", "--set", "slope_length_m=300"});
    ASSERT_EQ(made.exit_code, 0) << made.err;
    write("source.geojson", outline(""));
  }

  /// A square of 60 m on the slope of the ramp, with fields.
  static std::string outline(const std::string& fields) {
    return R"({"type": "FeatureCollection", "features": [{"type": "Feature", "properties": {)" +
           fields +
           R"(}, "geometry": {"type": "Polygon", "coordinates":
 [[[-160, -30], [-100, -30], [-100, 30], [-160, 30], [-160, -30]]]}}]})";
  }

  Ended init(const std::vector<std::string>& more) const {
    std::vector<std::string> words = {
        "init", path("ground/elevation.tif"), path("source.geojson"), "-o", path("mine"), "--crs",
        "local"};
    words.insert(words.end(), more.begin(), more.end());
    return sturz(words);
  }
};

TEST_F(Init, WritesASceneThatDescribesAndRuns) {
  const Ended ended = init({"--thickness", "4"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_THAT(ended.out, AllOf(HasSubstr("14 400 m3 on 3 600 m2"), HasSubstr("sturz describe")));
  EXPECT_THAT(read("mine/scenario.yaml"),
              AllOf(HasSubstr("raster: \"../ground/elevation.tif\""), HasSubstr("thickness_m: 4 "),
                    HasSubstr("turbulent_coefficient_m_s2: {triangular: [100, 500, 1000]}"),
                    HasSubstr("# Hungr and Evans 1996 (not yet checked)")));
  const Ended described = sturz({"describe", path("mine/scenario.yaml")});
  EXPECT_EQ(described.exit_code, 0) << described.err;
  EXPECT_THAT(described.err, Not(HasSubstr("unresolved release")));
  const Ended run = sturz({"run", path("mine/scenario.yaml"), "-o", path("once")});
  EXPECT_EQ(run.exit_code, 0) << run.err;
}

TEST_F(Init, TakesFilesOfAnyName) {
  write("the \"upper\" mass.geojson", outline(""));
  const Ended ended =
      sturz({"init", path("ground/elevation.tif"), path("the \"upper\" mass.geojson"), "-o",
             path("mine"), "--crs", "local", "--thickness", "4"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_EQ(sturz({"describe", path("mine/scenario.yaml")}).exit_code, 0);
}

TEST_F(Init, WhatIsInTheWrongPlaceIsSaid) {
  EXPECT_THAT(sturz({"init", path("source.geojson"), path("ground/elevation.tif"), "-o",
                     path("mine"), "--crs", "local", "--thickness", "4"})
                  .err,
              HasSubstr("they seem to be swapped"));
  EXPECT_THAT(sturz({"describe", path("ground/elevation.tif")}).err,
              HasSubstr("no scenario. `sturz init RASTER RELEASE"));
  EXPECT_THAT(sturz({"describe", path("ground")}).err,
              HasSubstr("ground is a folder. Name a file"));
  ASSERT_EQ(init({"--thickness", "4"}).exit_code, 0);
  EXPECT_THAT(sturz({"describe", path("mine")}).err,
              HasSubstr("Did you mean " + path("mine/scenario.yaml") + "?"));
}

TEST_F(Init, PicksASpacingThatResolvesTheNarrowSide) {
  ASSERT_EQ(init({"--thickness", "20"}).exit_code, 0);
  // Cells of 5 m and 20 m of thickness would allow 5 m; ten across 60 m allow 6.
  EXPECT_THAT(read("mine/scenario.yaml"), HasSubstr("spacing_m: 5 "));
  write("source.geojson",
        replaced(replaced(outline(""), "-30], [-100, -30", "-10], [-100, -10"),
                 "[-100, 30], [-160, 30], [-160, -30]", "[-100, 10], [-160, 10], [-160, -10]"));
  ASSERT_EQ(init({"--thickness", "20", "-o", path("narrow")}).exit_code, 1) << "-o twice";
  const Ended narrow = sturz({"init", path("ground/elevation.tif"), path("source.geojson"), "-o",
                              path("narrow"), "--crs", "local", "--thickness", "20"});
  ASSERT_EQ(narrow.exit_code, 0) << narrow.err;
  EXPECT_THAT(read("narrow/scenario.yaml"), HasSubstr("spacing_m: 2 "));
}

TEST_F(Init, PicksARoundSpacingWhereTheSourceIsTooLargeForAFinerOne) {
  // 24 300 m2 in some 4,000 columns are 2.46 m apart.
  write("source.geojson",
        replaced(outline(""), "[[[-160, -30], [-100, -30], [-100, 30], [-160, 30], [-160, -30]]]",
                 "[[[-290, -45], [-20, -45], [-20, 45], [-290, 45], [-290, -45]]]"));
  const Ended ended = init({"--thickness", "1"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_THAT(read("mine/scenario.yaml"), HasSubstr("spacing_m: 2.5 "));
}

TEST_F(Init, TakesThicknessFromAFieldOrGuessesItAndSaysSo) {
  const Ended guessed = init({});
  ASSERT_EQ(guessed.exit_code, 0) << guessed.err;
  EXPECT_THAT(guessed.out, HasSubstr("a guess from the area alone"));
  EXPECT_THAT(read("mine/scenario.yaml"), HasSubstr("log_uniform: [1.47, 5.9]"));
  write("source.geojson", outline("\"Thickness\": 3"));
  const Ended ended = sturz({"init", path("ground/elevation.tif"), path("source.geojson"), "-o",
                             path("of_field.yaml"), "--crs", "local"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_THAT(read("of_field.yaml"), HasSubstr("thickness_attribute: \"Thickness\""));
  EXPECT_THAT(ended.out, HasSubstr("10 800 m3"));
}

TEST_F(Init, SnowIsMeasuredAtRightAnglesToTheSlope) {
  const Ended ended = init({"--process", "snow_dense", "--thickness", "1"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_THAT(read("mine/scenario.yaml"),
              AllOf(HasSubstr("thickness: normal"), HasSubstr("cohesion_pa: {uniform: [0, 100]}")));
}

TEST_F(Init, NeverReplacesAFile) {
  ASSERT_EQ(init({"--thickness", "4"}).exit_code, 0);
  const Ended again = init({"--thickness", "5"});
  EXPECT_EQ(again.exit_code, 1);
  EXPECT_THAT(again.err, HasSubstr("is there already"));
  EXPECT_THAT(read("mine/scenario.yaml"), HasSubstr("thickness_m: 4 "));
}

TEST_F(Init, SaysWhatDoesNotFitBeforeItWrites) {
  EXPECT_THAT(init({"--process", "rock_avalanch"}).err, HasSubstr("Did you mean rock_avalanche?"));
  EXPECT_THAT(init({"--process", "lahar"}).err, HasSubstr("no publication stands behind"));
  EXPECT_THAT(init({"--process", "snow_dense"}).err, HasSubstr("Say --thickness METRES"));
  EXPECT_THAT(init({"--thickness", "4", "--volume", "5"}).err, HasSubstr("excludes"));
  const Ended nowhere = sturz({"init", path("ground/elevation.tif"), path("source.geojson"), "-o",
                               path("mine"), "--thickness", "4"});
  EXPECT_THAT(nowhere.err, HasSubstr("Here: sturz init ... --crs EPSG:CODE."));
  EXPECT_THAT(sturz({"init", path("ground/elevation.tif"), path("sorce.geojson"), "-o",
                     path("mine"), "--crs", "local"})
                  .err,
              HasSubstr("source.geojson"));
  std::string far = outline("");
  for (std::size_t at = 0; (at = far.find("[-1", at)) != std::string::npos; at += 4)
    far.replace(at, 3, "[-91");
  write("source.geojson", far);
  EXPECT_THAT(init({"--thickness", "4"}).err, HasSubstr("outside"));
  EXPECT_FALSE(exists("mine/scenario.yaml"));
}

TEST_F(Init, ARasterOfThicknessesIsAReleaseToo) {
  const Ended shape = sturz({"terrain", "zhangjiawan", "-o", path("hill"), "--cell", "10"});
  ASSERT_EQ(shape.exit_code, 0) << shape.err;
  const Ended ended = sturz({"init", path("hill/elevation.tif"), path("hill/release.tif"), "-o",
                             path("hill"), "--crs", "local"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_THAT(read("hill/scenario.yaml"), HasSubstr("thickness_raster: \"release.tif\""));
}

}  // namespace
}  // namespace sturz::test
