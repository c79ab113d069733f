// SPDX-License-Identifier: Apache-2.0
/// The part of a run's page that follows it through time.
#include "reports/figures/motion_charts.hpp"
#include "reports/page/report.hpp"
#include "reports/page/sections/sections.hpp"
#include "tests/reports/made_up_results.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string_view>

namespace sturz {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;

bool holds(std::string_view page, std::string_view text) {
  return page.find(text) != std::string_view::npos;
}

/// Three rows: all dense, then a quarter loose, then a tenth.
MemberHistory three_rows(bool with_states) {
  MemberHistory h;
  h.has_states = with_states;
  for (const float loose : {0.0F, 0.25F, 0.1F}) {
    HistoryRow row;
    row.time_s = 2 * static_cast<float>(h.rows.size());
    row.front_travel_m = 41 * row.time_s;
    row.max_speed_m_s = 7;
    row.ultradilute = 0.1F * loose, row.dilute = 0.5F * loose, row.transition = 0.4F * loose;
    row.dense = 1 - loose;
    h.rows.push_back(row);
  }
  return h;
}

ReportInput run_input(const MemberHistory& history, const MemberScalars& scalars) {
  ReportInput input;
  input.history = &history;
  input.members.resize(1);
  input.members.front().scalars = scalars;
  return input;
}

TEST(MotionCharts, StackStatesFromLooseToDense) {
  const auto charts = motion_charts(three_rows(true));
  ASSERT_EQ(charts.size(), 3U);
  const MotionChart& states = charts[2];
  ASSERT_TRUE(states.stacked);
  ASSERT_EQ(states.lines.size(), 4U);
  const auto near = [](double v) { return DoubleNear(v, 1e-5); };
  EXPECT_THAT(states.lines[0].values, ElementsAre(near(0), near(2.5), near(1)));
  EXPECT_THAT(states.lines[1].values, ElementsAre(near(0), near(15), near(6)));
  EXPECT_THAT(states.lines[2].values, ElementsAre(near(0), near(25), near(10)));
  EXPECT_THAT(states.lines[3].values, ElementsAre(near(100), near(100), near(100)));
  EXPECT_EQ(states.lines[0].label, "ultradilute: under 0.02");
  EXPECT_EQ(states.lines[1].label, "dilute: 0.02 to 0.50");
  EXPECT_EQ(states.lines[2].label, "transition: 0.50 to 0.60");
  EXPECT_EQ(states.lines[3].label, "dense: solid fraction over 0.60 (the rest)");
  EXPECT_DOUBLE_EQ(states.top, 30);  // 25 % and some room
}

TEST(MotionCharts, ShowTheWholeStackWhereMuchIsLoose) {
  MemberHistory h = three_rows(true);
  h.rows[1].dilute = 0.7F;
  h.rows[1].dense = 0.1875F;
  const auto charts = motion_charts(h);
  EXPECT_EQ(charts[2].top, 100);
  EXPECT_EQ(charts[2].lines[3].label, "dense: solid fraction over 0.60");
}

TEST(MotionCharts, EndTheirAxesAboveTheLargestValue) {
  const auto charts = motion_charts(three_rows(false));
  ASSERT_EQ(charts.size(), 2U);
  EXPECT_EQ(charts[0].top, 200);  // 164 m
  EXPECT_EQ(charts[1].top, 8);    // 7 m/s
  EXPECT_TRUE(motion_charts({}).empty());
  MemberHistory still = three_rows(false);
  for (HistoryRow& row : still.rows) row.front_travel_m = row.max_speed_m_s = 0;
  EXPECT_GT(motion_charts(still)[0].top, 0);
}

TEST(MotionCharts, DrawAPointPerRow) {
  const auto charts = motion_charts(three_rows(true));
  const std::string svg = motion_chart_svg(charts[0], motion_times(three_rows(true)));
  // The frame is 420 x 240 with margins of 44, 8, 10 and 34; 164 of 200 m at the end.
  EXPECT_TRUE(holds(svg, "paint-front\" d=\"M44.0 206.0L228.0 125.6L412.0 45.3\""));
  EXPECT_TRUE(holds(svg, ">time [s]<"));
  EXPECT_TRUE(holds(svg, ">[m]<"));
}

TEST(MotionSection, FollowsARunAndNamesItsStates) {
  const auto results = testing::make_up_results();
  const std::string page = make_report(results.single_input());
  for (const char* text :
       {"<section id=\"motion\">", "href=\"#motion\"", "Motion over time",
        "How far the mass has come", "Share of the mass by state", "class=\"still-chart\"",
        "Of mass and time 89.6\u00A0% were dense, 4.1\u00A0% in transition, 5.4\u00A0% dilute, "
        "0.92\u00A0% ultradilute",
        "solid fraction of 0.58", "12 m\u00B2/s\u00B2, 1.5\u00A0% of the largest speed squared"})
    EXPECT_TRUE(holds(page, text)) << text;
}

TEST(MotionSection, SaysWhatASceneWithoutStatesLeftOut) {
  MemberScalars scalars;
  scalars.parted_fraction = 0.0123;
  const std::string dense = motion_html(run_input(three_rows(false), scalars));
  EXPECT_TRUE(holds(dense,
                    "At most 1.2\u00A0% of the mass and time was looser than 0.98 of its "
                    "packing at release"));
  EXPECT_TRUE(holds(dense, "grains.states was not asked for"));
  EXPECT_FALSE(holds(dense, "Share of the mass by state"));
  scalars.parted_fraction = nan_d;
  EXPECT_TRUE(holds(motion_html(run_input(three_rows(false), scalars)),
                    "Columns (depth_averaged) have no states"));
  EXPECT_TRUE(holds(motion_html(run_input(three_rows(true), scalars)),
                    "grains.states.dilute was not asked for"));
}

TEST(MotionSection, IsLeftOutWithoutAHistoryAndForEnsembles) {
  const auto results = testing::make_up_results();
  EXPECT_EQ(motion_html(results.ensemble_input()), "");
  const MemberHistory none;
  EXPECT_EQ(motion_html(run_input(none, {})), "");
  ReportInput input = results.single_input();
  input.history = nullptr;
  EXPECT_FALSE(holds(make_report(input), "id=\"motion\""));
}

TEST(MotionSection, AnEnsembleTellsWhatItsMembersLeftOut) {
  const auto results = testing::make_up_results();
  const ReportInput input = results.ensemble_input();
  const std::string page = make_report(input);
  EXPECT_TRUE(holds(page, "What was left out"));
  EXPECT_TRUE(holds(page, ">dilated<small>%</small>"));
  EXPECT_FALSE(holds(page, ">ultradilute<small>"));
  std::vector<MemberSummary> three(3);
  for (auto& m : three) m.outcome = Outcome::settled;
  three[0].scalars.parted_fraction = 0.3;
  three[1].scalars.parted_fraction = 0.02;
  three[2].scalars.parted_fraction = 0.004;
  EXPECT_TRUE(holds(left_out_html(three),
                    "at most 2\u00A0% of the mass and time was looser than "
                    "0.98 of its packing at release in the median member, "
                    "30\u00A0% in the worst"));
  three[0].outcome = Outcome::diverged;
  EXPECT_FALSE(holds(left_out_html(three), "30\u00A0%")) << "it is not a valid member";
  for (auto& m : three) m.scalars.parted_fraction = nan_d;
  EXPECT_EQ(left_out_html(three), "");
}

}  // namespace
}  // namespace sturz
