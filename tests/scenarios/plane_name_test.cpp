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

TEST(PlaneFileName, IsForPeople) {
  const LayerAxis metres{"thickness_threshold", "", "m", {0.1, 0.10000001}},
      pressures{"pressure_threshold", "", "kPa", {30}},
      energies{"energy_threshold", "", "kJ m-2", {100}},
      speeds{"speed_threshold", "", "m s-1", {5}}, levels{"quantile", "", "1", {0.05, 0.5}};
  const auto name = [](const char* of, Statistic statistic, const char* units, LayerAxis axis,
                       std::size_t plane = 0) {
    return plane_file_name(layer(of, statistic, units, std::move(axis)), plane);
  };
  constexpr auto share = Statistic::probability;
  EXPECT_EQ(name("pressure_exceedance", share, "1", pressures), "P_pressure_gt_30kPa");
  EXPECT_EQ(name("energy_exceedance", share, "1", energies), "P_energy_gt_100kJ_m2");
  EXPECT_EQ(name("speed_exceedance", share, "1", speeds), "P_speed_gt_5m_s");
  EXPECT_EQ(name("thickness_exceedance", share, "1", metres, 1), "P_thickness_gt_0.10000001m")
      << "two thresholds, two files";
  EXPECT_EQ(name("thickness_exceedance_lower", Statistic::lower_bound, "1", metres),
            "P_thickness_gt_0.1m_lower");
  EXPECT_EQ(name("probability_of_reach", share, "1", {}), "P_reached");
  EXPECT_EQ(name("probability_of_reach_upper", Statistic::upper_bound, "1", {}), "P_reached_upper");
  EXPECT_EQ(name("probability_of_solid_reach", share, "1", {}), "P_solid_reached");
  EXPECT_EQ(name("probability_of_high_intensity", share, "1", {}), "P_high_intensity");
  EXPECT_EQ(name("probability_of_mass_left", share, "1", {}), "P_mass_left");
  EXPECT_EQ(name("energy_quantile", Statistic::quantile, "kJ m-2", levels, 1), "energy_p50_kJ_m2");
  EXPECT_EQ(name("energy_largest", Statistic::source_quantile, "kJ m-2", levels, 1),
            "energy_largest_p50_kJ_m2");
  EXPECT_EQ(name("deposit_mean", Statistic::mean, "m", {}), "deposit_mean_m");
  EXPECT_EQ(name("thickness_return_level", Statistic::value, "m", {"t", "", "year", {300}}),
            "thickness_return_level_300_year");
  EXPECT_EQ(name("annual_rate", Statistic::value, "year-1", {}), "annual_rate_per_year");
  EXPECT_EQ(name("probability_difference", Statistic::difference, "1", {}),
            "probability_difference");
  EXPECT_EQ(name("thickness_exceedance_difference", Statistic::difference, "1", metres),
            "thickness_exceedance_difference_0.1_m");
}

}  // namespace
}  // namespace sturz
