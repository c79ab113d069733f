// SPDX-License-Identifier: Apache-2.0
// The nearest members beside what was observed, on the page.
#include "reports/page/report.hpp"
#include "tests/reports/made_up_results.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <string_view>

namespace sturz {
namespace {

/// Plain bool, so that a failure does not print a page of a megabyte.
bool holds(std::string_view page, std::string_view text) {
  return page.find(text) != std::string_view::npos;
}

std::size_t count(std::string_view text, std::string_view part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string_view::npos; at = text.find(part, at + 1))
    ++n;
  return n;
}

/// What the page's script would read.
nlohmann::json data_of(const std::string& page) {
  const std::string start = "id=\"sturz-data\">";
  const std::size_t from = page.find(start) + start.size();
  return nlohmann::json::parse(page.substr(from, page.find("</script>", from) - from));
}

/// Every member scored against an outline and a length, the later ones the nearer.
ScoreTable made_up_scores(const std::vector<MemberSummary>& members) {
  ScoreTable scores;
  scores.columns = {{"misfit", "1", "root mean square", Better::smaller},
                    {"outline_iou", "1", "intersection over union", Better::larger},
                    {"outline_hit_m2", "m2", "hits", Better::larger}};
  scores.comparison.observed = {{"outline_distance_m", 0, 12, "m"},
                                {"speed_1_m_s", 14, 2, "m s-1"}};
  for (const MemberSummary& m : members) {
    if (!is_valid(m.outcome)) {
      scores.rows.emplace_back();
      continue;
    }
    const auto number = static_cast<double>(m.member);
    scores.rows.push_back(
        {{100 - number, Known::exactly}, {0.25, Known::exactly}, {7, Known::exactly}});
    scores.comparison.simulated.members.push_back(m.member);
    scores.comparison.simulated.values.push_back({{33, Known::exactly}, {9.5, Known::at_least}});
  }
  return scores;
}

TEST(Report, ShowsTheNearestMembersBesideWhatWasObserved) {
  const auto results = testing::make_up_results();
  ReportInput input = results.ensemble_input();
  EXPECT_EQ(count(make_report(input), "id=\"observed\""), 0U);
  const ScoreTable scores = made_up_scores(input.members);
  Raster<std::uint8_t> nearest(grid_of({10, 10, 4, 6}, results.hazard.grid), 1);
  input.scores = &scores;
  input.nearest = &nearest;
  input.nearest_member = 30;
  const std::string page = make_report(input);
  EXPECT_EQ(count(page, "<section id=\"observed\">"), 1U);
  EXPECT_EQ(count(page, "<a href=\"#observed\">Observed</a>"), 1U);
  const std::string table = page.substr(page.find("id=\"observed-table\""));
  EXPECT_TRUE(holds(table, "<td class=\"n\">14 \u00B1 2</td>"));
  EXPECT_TRUE(holds(table, "title=\"at least: the member is cut off\">\u2265\u00A09.5</td>"));
  EXPECT_EQ(count(table.substr(0, table.find("</table>")), "<tr"), 1U + 1 + 10);  // head, observed
  const std::string first = table.substr(table.find("<th scope=\"row\" data-v=\""));
  const std::int64_t last = scores.comparison.simulated.members.back();
  EXPECT_TRUE(first.starts_with("<th scope=\"row\" data-v=\"" + std::to_string(last) + "\""));
  EXPECT_GT(count(page, "covered by member 30, the nearest to what was observed</li>"), 0U);
  EXPECT_GT(count(page, "stroke=\"#7b1fa2\""), 0U);
  EXPECT_TRUE(holds(page.substr(page.find("id=\"member-table\"")), "outline iou"));
  if (!report_has_script()) return;
  EXPECT_EQ(data_of(page)["maps"]["nearest"]["lines"].size(), 4U);
}

}  // namespace
}  // namespace sturz
