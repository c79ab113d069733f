// SPDX-License-Identifier: Apache-2.0
// Ensembles with an inflow and gauges: tables, page, and the same bits after a stop and in shards.
#include "ensemble/workflow/results/merge.hpp"
#include "io/members/member_file.hpp"
#include "tests/workflow/workflow_fixture.hpp"

#include <cmath>

namespace sturz::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class FlowWorkflow : public Workflow {
 protected:
  FlowWorkflow() { write("flood.csv", "time_s,discharge_m3_s\n0,0\n1,30\n3,0\n"); }

  workflow::EnsembleRequest flooded(const std::string& results) const {
    workflow::EnsembleRequest r = request(results);
    r.scene.overrides = {
        "formulation=depth_averaged",
        "inflow=[{name: gully, hydrograph: flood.csv, line_m: [[-45, -6], [-45, 6]], "
        "discharge_factor: {uniform: [0.5, 2]}}]",
        "gauges.points=[{name: house, at_m: [-20, 0]}, {name: hill, at_m: [-20, 22]}]",
        "gauges.lines=[{name: road, points_m: [[-30, -20], [-30, 20]]}]",
        "gauges.interval_s=0.25",
        "numerics.end_time_s=4"};
    return r;
  }
};

TEST_F(FlowWorkflow, TablesAndPageHoldTheGauges) {
  Recorder heard;
  whole(flooded("out"), heard);
  const std::string table = read("out/gauges.csv");
  EXPECT_THAT(table, HasSubstr("gauge,quantity,units,members,reached,unknown,q05,q50,q95\n"));
  EXPECT_THAT(table, HasSubstr("house,arrival,s,6,"));
  EXPECT_THAT(table, HasSubstr("road,volume,m3,6,"));
  EXPECT_THAT(table, Not(HasSubstr("nan")));
  EXPECT_THAT(read("out/gauge_series.csv"), HasSubstr("road,discharge,m3 s-1,0.25,6,"));
  EXPECT_THAT(read("out/report.html"), HasSubstr("<section id=\"gauges\">"));
  EXPECT_THAT(read("out/members.csv"), HasSubstr("inflow[0].discharge_factor"));
  for (int k = 0; k < n_tiny; ++k) {
    const MemberResult m = read_member(path("out/members") / member_file_name(k));
    ASSERT_EQ(m.gauges.lines.size(), 1u) << k;
    ASSERT_EQ(m.gauges.points.size(), 2u) << k;
    EXPECT_EQ(m.gauges.points[1].name, "hill");
    EXPECT_EQ(m.gauges.lines[0].volume_m3.size(), m.gauges.time_s.size());
    EXPECT_GT(m.scalars.inflow_volume_m3, 0.5 * 45 - 1e-9);
    EXPECT_LE(m.scalars.inflow_volume_m3, 2 * 45 + 1e-9);
  }
}

TEST_F(FlowWorkflow, ACancelledRunGoesOnToTheSameTables) {
  Recorder quiet, first, second;
  const std::string hash = whole(flooded("whole"), quiet).hazard_hash;
  first.cancel_after = 2;
  EXPECT_TRUE(run(flooded("out"), first).interrupted);
  EXPECT_EQ(whole(flooded("out"), second).hazard_hash, hash);
  EXPECT_EQ(read("out/gauges.csv"), read("whole/gauges.csv"));
  EXPECT_EQ(read("out/gauge_series.csv"), read("whole/gauge_series.csv"));
}

TEST_F(FlowWorkflow, ShardsGiveTheTablesOfOneRun) {
  Recorder quiet;
  const std::string hash = whole(flooded("whole"), quiet).hazard_hash;
  for (const int k : {2, 1}) {
    workflow::EnsembleRequest part = flooded("out");
    part.shard = {k, 2};
    Recorder silent;
    run(part, silent);
  }
  Recorder silent;
  EXPECT_EQ(workflow::merge_members({path("out")}, silent).hazard_hash, hash);
  EXPECT_EQ(read("out/gauges.csv"), read("whole/gauges.csv"));
}

TEST_F(FlowWorkflow, AnotherHydrographIsAnotherScene) {
  Recorder quiet, heard;
  run(flooded("out"), quiet);
  write("flood.csv", "time_s,discharge_m3_s\n0,0\n1,31\n3,0\n");
  EXPECT_THROW(run(flooded("out"), heard), SetupError);
}

TEST_F(FlowWorkflow, OtherScenesHaveNoGauges) {
  Recorder heard;
  whole(request("out"), heard);
  EXPECT_FALSE(exists("out/gauges.csv"));
  EXPECT_THAT(read("out/report.html"), Not(HasSubstr("<section id=\"gauges\">")));
  EXPECT_TRUE(read_member(path("out/members") / member_file_name(0)).gauges.empty());
}

}  // namespace
}  // namespace sturz::test
