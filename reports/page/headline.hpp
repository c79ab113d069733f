// SPDX-License-Identifier: Apache-2.0
/// The few numbers that a reader wants first, each with its sampling uncertainty.
#pragma once

#include "ensemble/censoring/censored_quantile.hpp"
#include "ensemble/censoring/censoring_report.hpp"
#include "reports/page/report_input.hpp"

#include <string>
#include <utility>
#include <vector>

namespace sturz {

/// Level of every interval in the page; that of ensemble/hazard/wilson.hpp.
inline constexpr double interval_confidence = 0.95;

/// A number counted from the maps with the ends of its interval; NaN where it cannot be told.
struct Estimate {
  double value = nan_d, lower = nan_d, upper = nan_d;
};

struct Headline {
  int n_members = 0, n_valid = 0;
  std::vector<std::pair<Outcome, int>> outcomes;  ///< those that occur, in the enum's order
  CensoringReport censoring;
  CensoredEstimate runout_m;                         ///< medians of the valid members, from here on
  CensoredEstimate solid_runout_m, liquid_runout_m;  ///< where grains and liquid are told apart
  CensoredEstimate reached_area_m2;
  CensoredEstimate crown_to_toe_length_m;  ///< L, H, H / L
  CensoredEstimate crown_to_toe_drop_m;
  CensoredEstimate crown_to_toe_ratio;
  CensoredEstimate com_travel_m;
  Estimate
      likely_area_m2;  ///< cells with P(reached) >= 0.5; a lower bound where members are cut off
  double max_energy_j_m2 = nan_d, max_speed_m_s = nan_d, max_thickness_m = nan_d;
  std::int64_t max_energy_member = -1;
  double member_seconds = 0;  ///< computing time summed over members
  double cpu_seconds = 0;     ///< of all their threads
  double members_per_hour = nan_d;
};
Headline headline(const ReportInput& input);

}  // namespace sturz
