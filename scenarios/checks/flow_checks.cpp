// SPDX-License-Identifier: Apache-2.0
// What enters over time and what is followed: inflow, later releases, gauges.
#include "scenarios/checks/combination_checks.hpp"

#include <set>
#include <string>

namespace sturz {
namespace {

using Problems = std::vector<Problem>;

void check_columns(const Scenario& s, const char* path, Problems& problems) {
  if (s.formulation != Formulation::full_stress) return;
  problems.push_back({path, std::string(path) +
                                " (formulation is full_stress, whose particles would need a stress "
                                "and a packing to enter with; only depth_averaged lets mass enter "
                                "during a run). Remove it or set formulation: depth_averaged."});
}

void refuse_periods(const Scenario& s, const char* path, Problems& problems) {
  if (s.domain.periodic.empty()) return;
  problems.push_back({path, std::string(path) +
                                " (domain.periodic: what leaves comes in again on the other side). "
                                "Remove one of the two."});
}

void check_gauges(const GaugesSpec& g, Problems& problems) {
  if (g.points.empty() && g.lines.empty() && g.file.empty())
    problems.push_back(
        {"gauges", "gauges (names no point and no line). Give some of points, lines, file."});
  if (g.file.empty() && !g.layer.empty())
    problems.push_back(
        {"gauges.layer", "gauges.layer (there is no gauges.file). Remove it or name the file."});
  if (g.file.empty() && !g.crs.empty())
    problems.push_back(
        {"gauges.crs", "gauges.crs (there is no gauges.file that it is for). Remove it."});
  std::set<std::string> names;
  for (const auto* list : {&g.points, &g.lines})
    for (const GaugeSpec& gauge : *list)
      if (!gauge.name.empty() && !names.insert(gauge.name).second)
        problems.push_back({list == &g.points ? "gauges.points" : "gauges.lines",
                            "gauges: the name " + gauge.name +
                                " stands there twice (tables could not tell them apart). Rename "
                                "one."});
}

}  // namespace

void check_flow(const Scenario& s, Problems& problems) {
  const ReleaseSpec& r = s.release;
  if (!s.inflow.empty()) {
    check_columns(s, "inflow", problems);
    refuse_periods(s, "inflow", problems);
  }
  if (r.start_time_s) check_columns(s, "release.start_time_s", problems);
  if (!r.start_time_attribute.empty()) {
    check_columns(s, "release.start_time_attribute", problems);
    if (r.polygon.empty())
      problems.push_back({"release.start_time_attribute",
                          "release.start_time_attribute (only release.polygon has fields). Remove "
                          "it or name the polygon file."});
  }
  if (s.gauges) {
    check_gauges(*s.gauges, problems);
    refuse_periods(s, "gauges", problems);
  }
}

}  // namespace sturz
