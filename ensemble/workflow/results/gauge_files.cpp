// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/results/gauge_files.hpp"

#include "io/files/text_files.hpp"

namespace sturz::workflow {

GaugeFindings find_gauges(const MemberStore& store, const Scenario& scenario, CancelFlag cancel) {
  GaugeStatistics statistics;
  if (!scenario.gauges) return statistics.findings({});
  const auto& members = store.members();
  for (std::size_t k = 0; k < members.size(); ++k) {
    cancel.check();
    if (is_valid(members[k].outcome)) statistics.add(store.gauges(k), members[k].censoring);
  }
  return statistics.findings(scenario.hazard.quantiles);
}

GaugeFindings find_gauges(const MemberResult& result) {
  GaugeStatistics statistics;
  statistics.add(result.gauges, result.censoring);
  return statistics.findings({0.5}, true);
}

void write_gauge_files(const OutputFolder& folder, const GaugeFindings& findings) {
  if (findings.empty()) return;
  write_text_atomic(folder.gauges_csv(), gauges_csv(findings));
  write_text_atomic(folder.gauge_series_csv(), gauge_series_csv(findings));
}

}  // namespace sturz::workflow
