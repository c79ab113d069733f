// SPDX-License-Identifier: Apache-2.0
// What risk and compare say: no more than their numbers do.
#include "tests/app/app_fixture.hpp"

namespace sturz::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class RiskWords : public App {
 protected:
  RiskWords() {
    write("scene.yaml",
          replaced(tiny_scene(), "formulation: full_stress", "formulation: depth_averaged"));
  }
};

TEST_F(RiskWords, ComparisonsSpeakOfIntervalsAndOfNoCertainty) {
  ASSERT_EQ(sturz({"ensemble", path("scene.yaml"), "-o", path("a")}).exit_code, 0);
  const Ended ended = sturz({"compare", path("a"), path("a"), "-o", path("both")});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_THAT(ended.out, AllOf(HasSubstr("the 95 % interval, each cell for itself, lies below 0 in "
                                         "0 cells, above in 0"),
                               Not(HasSubstr("certain"))));
}

TEST_F(RiskWords, ATotalSaysWhichAssetsItLeavesOut) {
  write("assets.geojson", R"({"type": "FeatureCollection", "features": [
    {"type": "Feature", "properties": {"id": "source", "kind": "road", "worth": 1000},
     "geometry": {"type": "Point", "coordinates": [-45, 0]}},
    {"type": "Feature", "properties": {"id": "away", "kind": "road", "worth": 7},
     "geometry": {"type": "Point", "coordinates": [5000, 0]}}]})");
  write("curves.yaml", "road: {thickness_m: [[0, 0], [10, 1]]}\n");
  write("scene.yaml", read("scene.yaml") +
                          "assets: {features: assets.geojson, name_attribute: id, class_attribute: "
                          "kind, vulnerability: curves.yaml, value_attribute: worth, value_unit: "
                          "CHF}\n");
  write("risk.yaml", "scenarios: [{folder: a, frequency_per_year: 0.01}]\n");
  ASSERT_EQ(sturz({"ensemble", path("scene.yaml"), "-o", path("a")}).exit_code, 0);
  const Ended ended = sturz({"risk", path("risk.yaml"), "-o", path("years")});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_THAT(ended.out, AllOf(HasSubstr("2 assets: expected loss"),
                               HasSubstr("without 1 of them, whose loss is not known")));
}

}  // namespace
}  // namespace sturz::test
