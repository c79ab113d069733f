// SPDX-License-Identifier: Apache-2.0
#include "ensemble/app/report_page.hpp"

#include "io/text_files.hpp"
#include "reports/report.hpp"

#include <algorithm>

namespace sturz::app {

void write_page(const OutputFolder& folder, const Manifest& manifest, const Scenario& scenario,
                const PageContent& content) {
  ReportInput input;
  input.title = scenario.title.empty() ? folder.root.filename().string() : scenario.title;
  input.scenario_yaml = read_text(folder.scenario());
  input.manifest = manifest.lines();
  input.elevation = content.elevation;
  input.hazard = content.hazard;
  input.peaks = content.peaks;
  input.members.assign(content.members.begin(), content.members.end());
  if (content.design && !content.design->keys.empty())
    input.samples = sampled_values(*content.design, content.members);
  input.convergence.assign(content.convergence.begin(), content.convergence.end());
  input.warnings = manifest.warnings;
  input.notes = manifest.notes;
  input.description = manifest.description;
  double members_s = 0;
  for (const MemberSummary& m : content.members) members_s += m.scalars.wall_s;
  input.timings.emplace_back("members, all cores together", members_s);
  input.elapsed_s = manifest.compute_s;
  const bool particles =
      std::any_of(content.members.begin(), content.members.end(),
                  [](const MemberSummary& m) { return m.formulation != "depth_averaged"; });
  input.resolved_thickness_m = particles ? 0.5 * manifest.spacing_m : 0;
  write_text_atomic(folder.report(), make_report(input));
}

}  // namespace sturz::app
