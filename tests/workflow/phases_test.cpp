// SPDX-License-Identifier: Apache-2.0
// An ensemble of grains and liquid at two velocities: maps, table, files, and going on after a
// stop.
#include "io/members/member_file.hpp"
#include "tests/workflow/workflow_fixture.hpp"

namespace sturz::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class PhasesWorkflow : public Workflow {
 protected:
  workflow::EnsembleRequest parting(const std::string& results) const {
    workflow::EnsembleRequest r = request(results);
    r.scene.overrides = {"formulation=depth_averaged", "mixture.phases=two",
                         "basal.pore_pressure_ratio=0",
                         "mixture.permeability_m2={log_uniform: [1.0e-9, 1.0e-5]}",
                         "hazard.thickness_m=[0.05, 0.2]"};
    return r;
  }
};

TEST_F(PhasesWorkflow, MapsTableAndMembersTellThePhasesApart) {
  Recorder heard;
  whole(parting("out"), heard);
  EXPECT_TRUE(exists("out/hazard/solid_thickness_mean_m.tif"));
  EXPECT_TRUE(exists("out/hazard/P_liquid_thickness_gt_0.05m.tif"));
  for (const char* map :
       {"P_solid_reached.tif", "P_liquid_reached.tif", "bounds/P_solid_reached_lower.tif",
        "solid_pressure_mean_kPa.tif", "liquid_fraction_p50.tif"})
    EXPECT_TRUE(exists(std::string("out/hazard/") + map)) << map;
  const std::string table = read("out/members.csv");
  for (const char* column :
       {"solid_runout_m", "liquid_runout_m", "drag_loss_fraction", "drag_raised_fraction",
        "solid_lost_fraction", "liquid_reached_area_m2"})
    EXPECT_THAT(table, HasSubstr(column));
  EXPECT_THAT(read("out/report.html"), HasSubstr("Thickness of liquid alone"));
  for (int k = 0; k < n_tiny; ++k) {
    const MemberResult m = read_member(path("out/members") / member_file_name(k));
    EXPECT_EQ(m.layer(PeakLayer::solid).size(), m.window.n_cells());
    EXPECT_GT(m.scalars.max_liquid_thickness_m, 0);
    EXPECT_LE(std::abs(m.scalars.solids_error), 1e-13);
    EXPECT_LE(std::abs(m.scalars.water_error), 1e-13);
    EXPECT_GE(m.scalars.runout_m, m.scalars.solid_runout_m);
    EXPECT_GT(m.scalars.max_solid_pressure_pa, 0);
    EXPECT_LE(m.scalars.max_solid_energy_j_m2, m.scalars.max_energy_j_m2);
    EXPECT_GE(m.scalars.reached_area_m2, m.scalars.solid_reached_area_m2);
    EXPECT_GT(m.scalars.liquid_reached_area_m2, 0);
  }
}

TEST_F(PhasesWorkflow, ACancelledRunGoesOnToTheSameMaps) {
  Recorder quiet, first, second;
  const std::string hash = whole(parting("whole"), quiet).hazard_hash;
  first.cancel_after = 2;
  EXPECT_TRUE(run(parting("out"), first).interrupted);
  EXPECT_EQ(whole(parting("out"), second).hazard_hash, hash);
}

TEST_F(PhasesWorkflow, OtherScenesHaveNoneOfIt) {
  Recorder heard;
  whole(request("out"), heard);
  EXPECT_FALSE(exists("out/hazard/solid_thickness_mean_m.tif"));
  EXPECT_FALSE(exists("out/hazard/P_solid_reached.tif"));
  EXPECT_THAT(read("out/members.csv"), Not(HasSubstr("liquid_lost_fraction")));
  EXPECT_THAT(read("out/report.html"), Not(HasSubstr("Grains and liquid")));
  EXPECT_THAT(read("out/report.html"), Not(HasSubstr("Thickness of liquid alone")));
}

}  // namespace
}  // namespace sturz::test
