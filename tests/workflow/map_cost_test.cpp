// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/machine/map_cost.hpp"

#include "tests/workflow/workflow_fixture.hpp"

namespace sturz::test {
namespace {

class MapCosts : public Workflow {};

TEST_F(MapCosts, GrowWithWhatIsTouchedAndNotWithAnythingElse) {
  const workflow::MapSpeed speed{1e-3, 1e-7, 5e-3, 1e-8, 1e-4};
  const workflow::MapWork work{100, 1e4, 5e4, 68};
  // 100 members opened twice, 1e6 touches, 68 planes, 3.4e6 cells of planes.
  EXPECT_NEAR(predict_map_cost(work, speed).seconds, 0.2 + 0.1 + 0.34 + 0.034, 1e-12);
  workflow::MapWork many = work;
  many.members = 4000;
  many.cells_per_member =
      1e5;  // 4e8 touches do not fit: more passes, each of which opens every file
  EXPECT_GT(predict_map_cost(many, speed).seconds, 4000 * 1e-3 * 10 + 40);
  many = work;
  many.members = 100000;  // in packs: opened once, and 1e9 touches
  const workflow::MapCost cost = predict_map_cost(many, speed);
  EXPECT_NEAR(cost.seconds, 2e5 * 1e-4 + 100 + 0.34 + 0.034, 1e-9);
  EXPECT_LT(cost.memory_bytes, 1.5e9) << "records take up to 1 GiB (decision 0052)";
}

TEST_F(MapCosts, KnowHowManyMapsASceneAsksFor) {
  HazardSpec spec;
  spec.thickness_m = {0.5, 1};
  spec.speed_m_s = spec.energy_kj_m2 = spec.pressure_kpa = {};
  spec.quantiles = {0.5, 0.95};
  // Reach and two thresholds with bounds; a mean and two quantiles of five quantities; two
  // quantiles of arrival; two intensities.
  EXPECT_EQ(workflow::map_planes(spec), 3 + 6 + 5 * 3 + 2 + 2);
  spec.eroded_depth_m = {0.2};
  EXPECT_EQ(workflow::map_planes(spec, true), 28 + 3 + 3) << "and those of the eroded depth";
  EXPECT_EQ(workflow::map_planes(spec, false, true), 28 + 2 * (3 + 2) + 2 * (6 + 4 * 3) + 2)
      << "reach, arrival and four quantities of each material, and the share of liquid";
}

TEST_F(MapCosts, AreMeasuredOnceAMachine) {
  const workflow::SpeedCache cache{path("cache/speed.json")};
  const workflow::MapSpeed first = workflow::map_speed(cache);
  EXPECT_GT(first.seconds_per_member, 0);
  EXPECT_GT(first.seconds_per_touch, 0);
  EXPECT_TRUE(exists("cache/map_speed.json"));
  EXPECT_EQ(workflow::map_speed(cache).seconds_per_plane, first.seconds_per_plane);
}

}  // namespace
}  // namespace sturz::test
