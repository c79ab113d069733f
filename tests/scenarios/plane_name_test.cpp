// SPDX-License-Identifier: Apache-2.0
#include "scenarios/layers/plane_name.hpp"

#include <gtest/gtest.h>

namespace sturz {
namespace {

Layer layer(std::string name, Statistic statistic, std::string units, LayerAxis axis) {
  Layer l;
  l.name = std::move(name);
  l.meaning.statistic = statistic;
  l.units = std::move(units);
  l.axis = std::move(axis);
  return l;
}

TEST(PlaneName, SaysValueAndUnit) {
  const LayerAxis metres{"thickness_threshold", "", "m", {0.1, 2}},
      pressures{"pressure_threshold", "", "kPa", {30}}, levels{"quantile", "", "1", {0.05, 0.5}};
  EXPECT_EQ(plane_name(layer("thickness_exceedance", Statistic::probability, "1", metres), 0),
            "thickness_exceedance_0.1_m");
  const LayerAxis close{"thickness_threshold", "", "m", {0.1, 0.10000001}};
  EXPECT_EQ(plane_name(layer("thickness_exceedance", Statistic::probability, "1", close), 1),
            "thickness_exceedance_0.10000001_m")
      << "two thresholds, two files";
  EXPECT_EQ(plane_name(layer("thickness_exceedance_lower", Statistic::lower_bound, "1", metres), 1),
            "thickness_exceedance_2_m_lower");
  EXPECT_EQ(
      plane_name(layer("pressure_exceedance_upper", Statistic::upper_bound, "1", pressures), 0),
      "pressure_exceedance_30_kpa_upper");
  EXPECT_EQ(plane_name(layer("speed_quantile", Statistic::quantile, "m s-1", levels), 0),
            "speed_p5_m_s");
  EXPECT_EQ(plane_name(layer("energy_quantile", Statistic::quantile, "kJ m-2", levels), 1),
            "energy_p50_kj_m2");
  EXPECT_EQ(plane_name(layer("deposit_mean", Statistic::mean, "m", {}), 0), "deposit_mean_m");
  EXPECT_EQ(plane_name(layer("probability_of_reach", Statistic::probability, "1", {}), 0),
            "probability_of_reach");
}

}  // namespace
}  // namespace sturz
