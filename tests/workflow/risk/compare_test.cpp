// SPDX-License-Identifier: Apache-2.0
// Two finished ensembles compared: with and without a dam, with and without pairs.
#include "ensemble/workflow/comparison/compare.hpp"

#include "io/netcdf/netcdf_layers.hpp"
#include "tests/workflow/workflow_fixture.hpp"

#include <cmath>

namespace sturz::test {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

class CompareWorkflow : public Workflow {
 protected:
  static std::string columns() {
    return replaced(tiny_scene(), "formulation: full_stress", "formulation: depth_averaged");
  }
  void ensemble(const std::string& folder, const std::string& text) {
    write("scene.yaml", text);
    Recorder silent;
    whole(request(folder), silent);
  }
  workflow::Compared compare(bool paired = true) {
    return workflow::compare({path("a"), path("b"), path("both"), paired}, heard);
  }
  Recorder heard;
};

/// On a gentle slope every member comes to 20 m below its middle without the dam. Across it, the
/// dam's crest rises 7 m above its upper foot, and the members have fallen 9 m there with two
/// thirds of that lost to friction: none comes over it.
TEST_F(CompareWorkflow, WithAndWithoutADam) {
  std::string gentle = replaced(columns(), "slope_deg: 30", "slope_deg: 15");
  gentle = replaced(gentle, "uniform: [0.3, 0.7]", "uniform: [0.18, 0.185]");
  gentle = replaced(gentle, "uniform: [0.0, 0.3]", "uniform: [0.0, 0.02]");
  gentle = replaced(gentle, "end_time_s: 3", "end_time_s: 13");
  ensemble("a", gentle);
  ensemble("b", replaced(gentle, "terrain:\n",
                         "terrain:\n  dams: [{points_m: [[0, -24], [0, 24]], height_m: 10, "
                         "crest_width_m: 4, side_slope: 1}]\n"));
  const workflow::Compared made = compare();
  EXPECT_EQ(made.n_pairs, 6U);
  EXPECT_THAT(made.differences, Contains(HasSubstr("terrain.dams: absent ->")));
  EXPECT_EQ(made.summary.least, -1);
  EXPECT_GT(made.summary.n_less, 0U);
  for (const char* file : {"both/comparison.nc", "both/comparison/index.csv"})
    EXPECT_TRUE(exists(file)) << file;
  EXPECT_FALSE(exists("both/asset_differences.csv"));
  ASSERT_TRUE(made.has_page);
  EXPECT_THAT(read("both/report.html"), HasSubstr("A: 6, B: 6 valid simulations"));
  EXPECT_THAT(read("both/report.html"), HasSubstr("\"beside\":{"));
  const LayerStack maps = read_layers(path("both/comparison.nc"));
  ASSERT_NE(maps.find("probability_difference"), nullptr);
  EXPECT_EQ(maps.find("thickness_exceedance_difference")->axis.values,
            (std::vector<double>{0.5, 1}));
}

TEST_F(CompareWorkflow, MembersThatDrewOtherValuesAreNoPairs) {
  ensemble("a", columns());
  ensemble("b", replaced(columns(), "seed: 1", "seed: 2"));
  EXPECT_THAT([&] { compare(); },
              ThrowsMessage<SetupError>(HasSubstr("their members are no pairs (ensemble.seed is 1 "
                                                  "and 2)")));
  EXPECT_FALSE(exists("both/comparison.nc"));
  const workflow::Compared made = compare(false);
  EXPECT_EQ(made.n_pairs, 0U);
  EXPECT_TRUE(std::isnan(made.summary.median_gain));
  EXPECT_TRUE(exists("both/comparison.nc"));
}

TEST_F(CompareWorkflow, AnEnsembleDoesNotDifferFromItself) {
  ensemble("a", columns());
  ensemble("b", columns());
  const workflow::Compared made = compare();
  EXPECT_TRUE(made.differences.empty());
  EXPECT_EQ(made.summary.least, 0);
  EXPECT_EQ(made.summary.most, 0);
}

}  // namespace
}  // namespace sturz::test
