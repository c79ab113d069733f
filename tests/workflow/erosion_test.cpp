// SPDX-License-Identifier: Apache-2.0
// An ensemble of flows that take their bed along: maps, table, files, and going on after a stop.
#include "io/members/member_file.hpp"
#include "tests/workflow/workflow_fixture.hpp"

#include <algorithm>

namespace sturz::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class ErosionWorkflow : public Workflow {
 protected:
  workflow::EnsembleRequest eroding(const std::string& results) const {
    workflow::EnsembleRequest r = request(results);
    r.scene.overrides = {"formulation=depth_averaged",
                         "erosion.law=exponential",
                         "erosion.growth_rate_per_m={uniform: [0.005, 0.05]}",
                         "erosion.depth_m=0.2",
                         "erosion.bed_density_kg_m3=1800",
                         "hazard.eroded_depth_m=[0.01, 0.1]"};
    return r;
  }
};

TEST_F(ErosionWorkflow, MapsTableAndMembersHoldWhatWasEroded) {
  Recorder heard;
  const workflow::MapsMade made = whole(eroding("out"), heard);
  EXPECT_TRUE(exists("out/hazard/eroded_depth_mean_m.tif"));
  EXPECT_TRUE(exists("out/hazard/P_eroded_depth_gt_0.1m.tif"));
  EXPECT_TRUE(exists("out/hazard/eroded_depth_p50_m.tif"));
  const std::string table = read("out/members.csv");
  EXPECT_THAT(table, HasSubstr("eroded_volume_m3"));
  EXPECT_THAT(table, HasSubstr("volume_growth"));
  EXPECT_THAT(read("out/report.html"), HasSubstr("Eroded depth"));
  double most = 1;
  for (int k = 0; k < n_tiny; ++k) {
    const MemberResult m = read_member(path("out/members") / member_file_name(k));
    EXPECT_GE(m.scalars.volume_growth, 1) << k;
    most = std::max(most, m.scalars.volume_growth);
    EXPECT_LE(m.scalars.max_eroded_depth_m, 0.2F) << k;  // maps are floats
    double volume = 0;
    for (const float depth : m.layer(PeakLayer::eroded)) volume += 4.0 * depth;
    EXPECT_NEAR(volume, m.scalars.eroded_volume_m3, 1e-4 * volume + 1e-9) << k;
    EXPECT_NEAR(m.scalars.entrained_mass_kg, 1800 * m.scalars.eroded_volume_m3,
                1e-12 * m.scalars.released_mass_kg);
  }
  EXPECT_GT(most, 1.01) << "some of them slide";
}

TEST_F(ErosionWorkflow, ACancelledRunGoesOnToTheSameMaps) {
  Recorder quiet, first, second;
  const std::string hash = whole(eroding("whole"), quiet).hazard_hash;
  first.cancel_after = 2;
  EXPECT_TRUE(run(eroding("out"), first).interrupted);
  EXPECT_EQ(whole(eroding("out"), second).hazard_hash, hash);
}

TEST_F(ErosionWorkflow, OtherScenesHaveNoneOfIt) {
  Recorder heard;
  whole(request("out"), heard);
  EXPECT_FALSE(exists("out/hazard/eroded_depth_mean_m.tif"));
  EXPECT_THAT(read("out/report.html"), Not(HasSubstr("Eroded depth")));
  const MemberResult m = read_member(path("out/members") / member_file_name(0));
  EXPECT_TRUE(m.layer(PeakLayer::eroded).empty());
}

}  // namespace
}  // namespace sturz::test
