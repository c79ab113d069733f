// SPDX-License-Identifier: Apache-2.0
#include "reports/page/headline.hpp"

#include "ensemble/censoring/scalar_censoring.hpp"
#include "ensemble/hazard/wilson.hpp"

#include <algorithm>
#include <cmath>

namespace sturz {
namespace {

/// How often each outcome occurs, those that never do left out.
std::vector<std::pair<Outcome, int>> count_outcomes(const std::vector<MemberSummary>& members) {
  std::vector<std::pair<Outcome, int>> counts;
  for (const Outcome o : {Outcome::settled, Outcome::out_of_time, Outcome::left_terrain,
                          Outcome::diverged, Outcome::failed, Outcome::cancelled}) {
    const auto n = std::count_if(members.begin(), members.end(),
                                 [o](const MemberSummary& m) { return m.outcome == o; });
    if (n > 0) counts.emplace_back(o, static_cast<int>(n));
  }
  return counts;
}

/// The same of weighted maps, which have no convergence; joined cells would be too many. A page's
/// maps come without bounds, so these are made as those of the files are.
Estimate weighted_area(const LayerStack& hazard, double effective_members) {
  const auto reached =
      std::find_if(hazard.layers.begin(), hazard.layers.end(), [](const Layer& layer) {
        return layer.meaning.quantity == Quantity::reached &&
               layer.meaning.statistic == Statistic::probability;
      });
  if (hazard.joined > 1 || reached == hazard.layers.end()) return {};
  double likely = 0, surely = 0, possibly = 0;
  for (const float p : reached->values) {
    if (!(p > 0)) continue;
    const ProbabilityBounds bounds =
        wilson_interval_of_share(static_cast<double>(std::min(p, 1.0F)), effective_members);
    likely += p >= 0.5F;
    surely += bounds.lower >= 0.5;
    possibly += bounds.upper >= 0.5;
  }
  const double cell = hazard.grid.cell_m * hazard.grid.cell_m;
  return {likely * cell, surely * cell, possibly * cell};
}

/// Area of cells with P(reached) >= 0.5, and of those whose interval lies above or touches it. From
/// the convergence, which knows every cell: those of the page's maps may be joined ones.
Estimate likely_area(const ReportInput& input, int n_valid) {
  if (!input.weights.empty()) return weighted_area(*input.hazard, input.effective_members);
  if (input.convergence.empty() || input.convergence.back().n_members != n_valid) return {};
  const ConvergencePoint& all = input.convergence.back();
  return {all.area_likely_m2, all.area_likely_lower_m2, all.area_likely_upper_m2};
}

}  // namespace

Headline headline(const ReportInput& input) {
  Headline h;
  h.n_members = static_cast<int>(input.members.size());
  h.outcomes = count_outcomes(input.members);
  h.censoring = censoring_report(input.members, input.max_censored_fraction);
  h.censoring.where = input.where_mass_left;
  h.n_valid = static_cast<int>(h.censoring.valid);
  const auto keep_larger = [](double& a, double b) {
    const bool larger = !(a >= b);
    if (larger) a = b;
    return larger;
  };
  for (const MemberSummary& m : input.members) {
    h.member_seconds += m.scalars.wall_s;
    h.cpu_seconds += m.scalars.cpu_s;
    if (!is_valid(m.outcome)) continue;
    if (keep_larger(h.max_energy_j_m2, m.scalars.max_energy_j_m2)) h.max_energy_member = m.member;
    keep_larger(h.max_speed_m_s, m.scalars.max_speed_m_s);
    keep_larger(h.max_thickness_m, m.scalars.max_thickness_m);
  }
  const auto median = [&](double MemberScalars::*field) {
    const auto seen = observations(input.members, field);
    if (input.weights.empty()) return censored_quantile(seen, 0.5, interval_confidence);
    return weighted_censored_quantile(seen, input.weights, 0.5, interval_confidence);
  };
  h.runout_m = median(&MemberScalars::runout_m);
  h.solid_runout_m = median(&MemberScalars::solid_runout_m);
  h.liquid_runout_m = median(&MemberScalars::liquid_runout_m);
  h.reached_area_m2 = median(&MemberScalars::reached_area_m2);
  h.crown_to_toe_length_m = median(&MemberScalars::crown_to_toe_length_m);
  h.crown_to_toe_drop_m = median(&MemberScalars::crown_to_toe_drop_m);
  h.crown_to_toe_ratio = median(&MemberScalars::crown_to_toe_ratio);
  h.com_travel_m = median(&MemberScalars::com_travel_m);
  if (input.hazard != nullptr && h.n_valid > 0) h.likely_area_m2 = likely_area(input, h.n_valid);
  if (input.elapsed_s > 0) h.members_per_hour = 3600.0 * h.n_members / input.elapsed_s;
  return h;
}

}  // namespace sturz
