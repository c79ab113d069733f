// SPDX-License-Identifier: Apache-2.0
// Two finished ensembles with frequencies: maps and assets by year.
#include "ensemble/workflow/risk/risk.hpp"

#include "io/netcdf/netcdf_layers.hpp"
#include "tests/workflow/workflow_fixture.hpp"

#include <cmath>

namespace sturz::test {
namespace {

using ::testing::HasSubstr;

class RiskWorkflow : public Workflow {
 protected:
  RiskWorkflow() {
    write("assets.geojson", R"({"type": "FeatureCollection", "features": [
      {"type": "Feature", "properties": {"id": "field", "kind": "road", "worth": 1000},
       "geometry": {"type": "Polygon",
         "coordinates": [[[-48, -4], [-40, -4], [-40, 4], [-48, 4], [-48, -4]]]}}]})");
    write("curves.yaml", "road: {thickness_m: [[0, 0], [10, 1]]}\n");
    write("risk.yaml",
          "scenarios:\n"
          "  - {folder: small, frequency_per_year: 0.01}\n"
          "  - {folder: large, frequency_per_year: 0.001}\n"
          "return_periods_years: [30, 100, 300]\n");
  }
  void ensemble(const std::string& folder, const std::string& thickness, const std::string& more) {
    std::string text =
        replaced(tiny_scene(), "formulation: full_stress", "formulation: depth_averaged");
    write("scene.yaml", replaced(text, "thickness_m: 3", "thickness_m: " + thickness) + more);
    Recorder silent;
    whole(request(folder), silent);
  }
  workflow::RiskMade risk(const std::string& out) {
    return workflow::make_risk({path("risk.yaml"), path(out)}, heard);
  }
  Recorder heard;
  static constexpr const char* block =
      "assets: {features: assets.geojson, name_attribute: id, "
      "class_attribute: kind, vulnerability: curves.yaml, "
      "value_attribute: worth, value_unit: CHF}\n";
};

TEST_F(RiskWorkflow, MapsAndAssetsByYear) {
  ensemble("small", "1", block);
  ensemble("large", "3", block);
  const workflow::RiskMade made = risk("years");
  // The release is reached by every member of both.
  EXPECT_NEAR(made.highest_rate, 0.011, 1e-8);
  EXPECT_EQ(made.n_assets, 1U);
  EXPECT_GT(made.total_loss.mean, 0);
  EXPECT_LT(made.total_loss.mean, 0.011 * 1000);
  for (const char* file : {"years/risk.nc", "years/risk/index.csv", "years/assets_by_year.gpkg",
                           "years/risk/thickness_return_level_300_year.tif"})
    EXPECT_TRUE(exists(file)) << file;
  EXPECT_THAT(read("years/assets_by_year.csv"), HasSubstr("\nfield,inside,road,1000,0.011,"));
  const LayerStack maps = read_layers(path("years/risk.nc"));
  ASSERT_NE(maps.find("matrix_field"), nullptr);
  EXPECT_EQ(maps.find("thickness_return_level")->axis.values, (std::vector<double>{30, 100, 300}));
  const std::string once = read("years/risk.nc");
  risk("again");
  EXPECT_EQ(read("again/risk.nc"), once);
}

TEST_F(RiskWorkflow, RefusesWhatDoesNotBelongTogether) {
  ensemble("small", "1", block);
  ensemble("large", "3", "");
  EXPECT_THAT([&] { risk("years"); },
              ::testing::ThrowsMessage<SetupError>(
                  HasSubstr("their assets differ (only one of their scenes has `assets`)")));
  EXPECT_FALSE(exists("years/risk.nc"));
  EXPECT_THAT([&] { risk("small"); },
              ::testing::ThrowsMessage<SetupError>(HasSubstr("holds results of `sturz ensemble`")));
  write("risk.yaml", "scenarios: [{folder: nowhere, frequency_per_year: 1}]\n");
  EXPECT_THAT([&] { risk("years"); },
              ::testing::ThrowsMessage<SetupError>(HasSubstr("holds no results of sturz")));
}

TEST_F(RiskWorkflow, RefusesMembersThatAreNoSampleAndTellsOfSets) {
  ensemble("small", "1", "");
  const auto of_design = [&](const char* design, const char* members, const char* folder) {
    const std::string columns =
        replaced(tiny_scene(), "formulation: full_stress", "formulation: depth_averaged");
    write("scene.yaml", replaced(columns, "design: sobol, members: 6",
                                 std::string("design: ") + design + ", members: " + members));
    Recorder silent;
    whole(request(folder), silent);
  };
  of_design("morris", "6", "large");
  EXPECT_THAT([&] { risk("years"); },
              ::testing::ThrowsMessage<SetupError>(HasSubstr("ensemble.design = morris")));
  EXPECT_FALSE(exists("years"));
  of_design("saltelli", "8", "sets");
  write("risk.yaml", "scenarios: [{folder: sets, frequency_per_year: 0.1}]\n");
  risk("years");
  EXPECT_THAT(heard.warnings, ::testing::Contains(HasSubstr("ensemble.design = saltelli")));
}

TEST_F(RiskWorkflow, RefusesOneFolderUnderTwoNames) {
  ensemble("small", "1", "");
  write("risk.yaml",
        "scenarios:\n"
        "  - {folder: small, frequency_per_year: 0.01}\n"
        "  - {folder: ../" +
            path("").parent_path().filename().string() + "/small/, frequency_per_year: 0.001}\n");
  EXPECT_THAT([&] { risk("years"); },
              ::testing::ThrowsMessage<SetupError>(HasSubstr("are one folder")));
  EXPECT_FALSE(exists("years"));
}

TEST_F(RiskWorkflow, TablesOfEarlierAssetsGoBeforeTheMapsChange) {
  ensemble("small", "1", block);
  write("risk.yaml", "scenarios: [{folder: small, frequency_per_year: 0.1}]\n");
  risk("years");
  ASSERT_TRUE(exists("years/assets_by_year.csv"));
  std::filesystem::remove(path("years/risk.nc"));
  std::filesystem::create_directories(path("years/risk.nc/in_the_way"));
  EXPECT_ANY_THROW(risk("years"));
  EXPECT_FALSE(exists("years/assets_by_year.csv"));
  EXPECT_FALSE(exists("years/assets_by_year.gpkg"));
}

TEST_F(RiskWorkflow, RefusesOtherCells) {
  ensemble("small", "1", "");
  const std::string coarse =
      replaced(replaced(tiny_scene(), "formulation: full_stress", "formulation: depth_averaged"),
               "hazard: {cell_size_m: 2", "hazard: {cell_size_m: 4");
  write("scene.yaml", coarse);
  Recorder silent;
  whole(request("large"), silent);
  EXPECT_THAT([&] { risk("years"); },
              ::testing::ThrowsMessage<SetupError>(HasSubstr("do not lie on the same cells")));
}

}  // namespace
}  // namespace sturz::test
