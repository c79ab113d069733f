// SPDX-License-Identifier: Apache-2.0
#include "reports/page/headline.hpp"

#include "ensemble/hazard/wilson.hpp"
#include "reports/figures/legend.hpp"

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

/// Area of cells with P(reached) >= 0.5, and of those whose interval lies above or touches it.
Estimate likely_area(const LayerStack& maps, int n_valid) {
  for (const Layer& layer : maps.layers) {
    const LayerMeaning& m = layer.meaning;
    if (m.quantity != Quantity::reached || m.statistic != Statistic::probability) continue;
    const double cell_area = maps.grid.cell_m * maps.grid.cell_m;
    Estimate area{0, 0, 0};
    for (const float p : layer.values) {
      if (!(p > 0)) continue;
      const auto hits = static_cast<std::int64_t>(std::lround(p * static_cast<double>(n_valid)));
      const ProbabilityBounds interval = wilson_interval(hits, n_valid);
      if (p >= 0.5) area.value += cell_area;
      if (interval.lower >= 0.5) area.lower += cell_area;
      if (interval.upper >= 0.5) area.upper += cell_area;
    }
    return area;
  }
  return {};
}

}  // namespace

Estimate median_estimate(std::vector<double> sample, double confidence) {
  std::erase_if(sample, [](double v) { return !std::isfinite(v); });
  if (sample.empty()) return {};
  std::sort(sample.begin(), sample.end());
  const std::size_t n = sample.size();
  Estimate e{n % 2 == 1 ? sample[n / 2] : (sample[n / 2 - 1] + sample[n / 2]) / 2, nan_d, nan_d};
  // Number of values below the true median is binomial (n, 1/2): drop from each side as many as
  // still leave the wished confidence between.
  const double tail = (1 - confidence) / 2, log_half_n = static_cast<double>(n) * std::log(0.5);
  double below = 0, log_choose = 0;
  std::size_t drop = 0;
  while (drop < n / 2) {
    below += std::exp(log_choose + log_half_n);
    if (below > tail) break;
    log_choose += std::log(static_cast<double>(n - drop) / static_cast<double>(drop + 1));
    ++drop;
  }
  if (drop > 0) e.lower = sample[drop - 1], e.upper = sample[n - drop];
  return e;
}

Headline headline(const ReportInput& input) {
  Headline h;
  h.n_members = static_cast<int>(input.members.size());
  h.outcomes = count_outcomes(input.members);
  std::vector<double> runouts, areas;
  const auto keep_larger = [](double& a, double b) {
    const bool larger = !(a >= b);
    if (larger) a = b;
    return larger;
  };
  for (const MemberSummary& m : input.members) {
    h.member_seconds += m.scalars.wall_s;
    if (!is_valid(m.outcome)) continue;
    ++h.n_valid;
    runouts.push_back(m.scalars.runout_m);
    areas.push_back(m.scalars.reached_area_m2);
    if (keep_larger(h.max_energy_j_m2, m.scalars.max_energy_j_m2)) h.max_energy_member = m.member;
    keep_larger(h.max_speed_m_s, m.scalars.max_speed_m_s);
    keep_larger(h.max_thickness_m, m.scalars.max_thickness_m);
  }
  h.runout_m = median_estimate(runouts);
  h.reached_area_m2 = median_estimate(areas).value;
  if (input.hazard != nullptr && h.n_valid > 0)
    h.likely_area_m2 = likely_area(*input.hazard, h.n_valid);
  if (input.elapsed_s > 0) h.members_per_hour = 3600.0 * h.n_members / input.elapsed_s;
  return h;
}

}  // namespace sturz
