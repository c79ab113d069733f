// SPDX-License-Identifier: Apache-2.0
/// The few numbers that a reader wants first, each with its sampling uncertainty.
#pragma once

#include "reports/page/report_input.hpp"

#include <string>
#include <utility>
#include <vector>

namespace sturz {

/// Level of every interval in the page; that of ensemble/hazard/wilson.hpp.
inline constexpr double interval_confidence = 0.95;

/// An estimate with the ends of its interval; NaN where it cannot be told.
struct Estimate {
  double value = nan_d, lower = nan_d, upper = nan_d;
};

/// Median of a sample with the distribution-free interval between two order statistics (binomial);
/// the ends stay NaN where the sample is too small for `confidence`.
Estimate median_estimate(std::vector<double> sample, double confidence = interval_confidence);

struct Headline {
  int n_members = 0, n_valid = 0;
  std::vector<std::pair<Outcome, int>> outcomes;  ///< those that occur, in the enum's order
  Estimate runout_m;                              ///< median of the valid members
  Estimate likely_area_m2;                        ///< cells with P(reached) >= 0.5
  double reached_area_m2 = nan_d;                 ///< median of the valid members
  double max_energy_j_m2 = nan_d, max_speed_m_s = nan_d, max_thickness_m = nan_d;
  std::int64_t max_energy_member = -1;
  double member_seconds = 0;  ///< computing time summed over members
  double members_per_hour = nan_d;
};
Headline headline(const ReportInput& input);

}  // namespace sturz
