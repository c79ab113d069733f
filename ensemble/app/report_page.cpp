// SPDX-License-Identifier: Apache-2.0
#include "ensemble/app/report_page.hpp"

#include "io/text_files.hpp"
#include "reports/report.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <map>

namespace sturz::app {
namespace {

/// Warnings that members gave, each once with the number of members.
std::vector<std::string> member_warnings(std::span<const MemberSummary> members) {
  std::map<std::string, int> count;
  for (const MemberSummary& m : members) {
    std::size_t begin = 0;
    while (begin < m.warnings.size()) {
      const std::size_t end = std::min(m.warnings.find("; ", begin), m.warnings.size());
      ++count[m.warnings.substr(begin, end - begin)];
      begin = end + 2;
    }
  }
  std::vector<std::string> lines;
  for (const auto& [text, n] : count)
    lines.push_back(members.size() == 1 ? text : fmt::format("{} ({} members)", text, n));
  return lines;
}

}  // namespace

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
  for (std::string& line : member_warnings(content.members))
    if (std::find(input.warnings.begin(), input.warnings.end(), line) == input.warnings.end())
      input.warnings.push_back(std::move(line));
  input.notes = manifest.notes;
  input.description = manifest.description;
  double members_s = 0;
  for (const MemberSummary& m : content.members) members_s += m.scalars.wall_s;
  input.timings.emplace_back("members, all cores together", members_s);
  input.elapsed_s = manifest.compute_s;
  input.resolved_thickness_m = 0.5 * manifest.spacing_m;
  write_text_atomic(folder.report(), make_report(input));
}

}  // namespace sturz::app
