// SPDX-License-Identifier: Apache-2.0
#include "ensemble/scores/event_scorer.hpp"

#include "ensemble/members/members_table.hpp"
#include "ensemble/scores/score_table.hpp"
#include "tests/support/memory_members.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace sturz {
namespace {

using ::testing::HasSubstr;

/// 20 x 40 cells of 10 m.
Grid maps() { return test::small_grid(20, 40, 10); }

double west(int col) { return maps().west_m + 10 * col; }
double north(int row) { return maps().north_m - 10 * row; }

/// Rows and columns [from, to) of the maps as a mapped area.
ObservedArea area(int row0, int row1, int col0, int col1, double sd_m) {
  ObservedArea a;
  a.cover = Raster<double>(grid_of({row0, col0, row1 - row0, col1 - col0}, maps()), 1.0);
  a.outer = {{{west(col0), north(row0)},
              {west(col1), north(row0)},
              {west(col1), north(row1)},
              {west(col0), north(row1)},
              {west(col0), north(row0)}}};
  a.sd_m = sd_m;
  return a;
}

/// A member whose flow passes rows 8 .. 11 of columns 2 .. end, one second a column, and leaves a
/// deposit of 2 m in the last five columns.
MemberResult slide(std::int64_t number, int end, Censoring censoring = Censoring::none) {
  MemberResult r;
  r.member = number;
  r.grid = maps();
  r.outcome = censoring == Censoring::none           ? Outcome::settled
              : censoring == Censoring::still_moving ? Outcome::out_of_time
                                                     : Outcome::left_terrain;
  r.censoring = censoring;
  r.formulation = "depth_averaged";
  r.window = {8, 2, 4, end - 2};
  for (int k = 0; k < n_peak_layers; ++k)
    r.layers[static_cast<std::size_t>(k)].assign(r.window.n_cells(),
                                                 info(static_cast<PeakLayer>(k)).untouched);
  for (int row = 0; row < 4; ++row)
    for (int col = 0; col < end - 2; ++col) {
      const auto k = static_cast<std::size_t>(row) * static_cast<std::size_t>(end - 2) +
                     static_cast<std::size_t>(col);
      r.layer(PeakLayer::thickness)[k] = 3;
      r.layer(PeakLayer::speed)[k] = 12;
      r.layer(PeakLayer::arrival)[k] = static_cast<float>(col);
      if (col >= end - 7) r.layer(PeakLayer::deposit)[k] = 2;
    }
  r.scalars.end_time_s = 60;
  r.scalars.crown_to_toe_length_m = 10.0 * (end - 2);
  r.scalars.crown_to_toe_ratio = 0.4;
  r.scalars.eroded_volume_m3 = nan_d;
  return r;
}

std::shared_ptr<ObservedEvent> event() {
  auto e = std::make_shared<ObservedEvent>();
  e->origin = Vec2(west(2), north(10));
  return e;
}

Observation simulated(const ScoreTable& t, const std::string& quantity, std::size_t row = 0) {
  const auto& all = t.comparison.observed;
  for (std::size_t q = 0; q < all.size(); ++q)
    if (all[q].name == quantity) return t.comparison.simulated.values.at(row).at(q);
  ADD_FAILURE() << "nothing observed: " << quantity;
  return {};
}

Observation score(const ScoreTable& t, const std::string& name, std::size_t row = 0) {
  const auto k = t.column(name);
  if (!k) {
    ADD_FAILURE() << "no score " << name;
    return {};
  }
  return t.rows.at(row).at(*k);
}

TEST(EventScorer, OutlineIsComparedWithWhatWasPassedOver) {
  auto e = event();
  e->outline = area(8, 12, 2, 22, 5);
  const ScoreTable hit = score_result(slide(0, 22), e);
  EXPECT_DOUBLE_EQ(score(hit, "outline_iou").value, 1);
  EXPECT_DOUBLE_EQ(score(hit, "outline_hss").value, 1);
  EXPECT_NEAR(score(hit, "outline_distance_m").value, 0, 1e-9);
  EXPECT_NEAR(score(hit, "misfit").value, 0, 1e-9);
  const ScoreTable longer = score_result(slide(0, 32), e);  // half as far again
  EXPECT_DOUBLE_EQ(score(longer, "outline_iou").value, 2.0 / 3);
  EXPECT_DOUBLE_EQ(score(longer, "outline_hit_rate").value, 1);
  EXPECT_DOUBLE_EQ(score(longer, "outline_false_alarm_ratio").value, 1.0 / 3);
  EXPECT_DOUBLE_EQ(score(longer, "outline_false_m2").value, 4000);
  EXPECT_NEAR(score(longer, "outline_hausdorff_m").value, 100, 1e-9);
  ASSERT_EQ(longer.comparison.observed.size(), 1U);
  EXPECT_EQ(longer.comparison.observed[0].name, "outline_distance_m");
  EXPECT_EQ(longer.comparison.observed[0].value, 0);
  EXPECT_EQ(longer.comparison.observed[0].sd, 5);
  EXPECT_EQ(longer.comparison.simulated.values[0][0].value,
            score(longer, "outline_distance_m").value);
}

TEST(EventScorer, DepositIsComparedWithWhatLiesAtRest) {
  auto e = event();
  e->deposit = area(8, 12, 17, 22, 5);
  EXPECT_DOUBLE_EQ(score(score_result(slide(0, 22), e), "deposit_iou").value, 1);
  EXPECT_EQ(score(score_result(slide(0, 32), e), "deposit_iou").value, 0);
}

TEST(EventScorer, OnlyWhatIsThickerThanTheThresholdCounts) {
  auto e = event();
  e->outline = area(8, 12, 2, 22, 5);
  MemberResult thin = slide(0, 32);
  for (int row = 0; row < 4; ++row)
    for (int col = 20; col < 30; ++col)
      thin.layer(PeakLayer::thickness)[static_cast<std::size_t>(row) * 30 +
                                       static_cast<std::size_t>(col)] = 0.3F;
  EXPECT_DOUBLE_EQ(score(score_result(thin, e), "outline_iou").value, 2.0 / 3);
  e->threshold_m = 0.5, e->threshold_given = true;
  EXPECT_DOUBLE_EQ(score(score_result(thin, e), "outline_iou").value, 1);
  // Full stress without a given threshold: a tenth of the spacing.
  e->threshold_m = 0.1, e->threshold_given = false, e->spacing_m = 4;
  thin.formulation = "full_stress";
  EXPECT_DOUBLE_EQ(score(score_result(thin, e), "outline_iou").value, 1);
  thin.formulation = "depth_averaged";
  EXPECT_DOUBLE_EQ(score(score_result(thin, e), "outline_iou").value, 2.0 / 3);
}

TEST(EventScorer, CellsThatOnlyTheSpreadTailTouchedAreNotPassedOver) {
  auto e = event();
  e->area_m2 = Measured{8000, 500};
  MemberResult r = slide(0, 22);
  r.layer(PeakLayer::arrival)[0] = nan_f;  // thick enough, but not covered by half
  const ScoreTable t = score_result(r, e);
  EXPECT_DOUBLE_EQ(score(t, "area_error_m2").value, -100);
  EXPECT_DOUBLE_EQ(score(t, "area_relative_error").value, -100.0 / 8000);
  EXPECT_DOUBLE_EQ(score(t, "misfit").value, 0.2);
}

TEST(EventScorer, ThicknessAgainstARaster) {
  auto e = event();
  ObservedThickness thickness;
  thickness.value = Raster<double>(grid_of({8, 15, 4, 10}, maps()), 0.0);
  for (int row = 0; row < 4; ++row)
    for (int col = 2; col < 10; ++col) thickness.value.at(row, col) = col < 7 ? 2.5 : nan_d;
  thickness.sd_m = 0.5;
  e->thickness = thickness;
  const ScoreTable t = score_result(slide(0, 22), e);  // 2 m in columns 17 .. 21
  EXPECT_DOUBLE_EQ(score(t, "thickness_iou").value, 1);
  EXPECT_DOUBLE_EQ(score(t, "thickness_rmse_m").value, 0.5);
  EXPECT_DOUBLE_EQ(score(t, "thickness_bias_m").value, -0.5);
  EXPECT_DOUBLE_EQ(score(t, "thickness_within_2sd").value, 1);
  EXPECT_DOUBLE_EQ(score(t, "thickness_volume_ratio").value, 0.8);
  EXPECT_DOUBLE_EQ(score(t, "misfit").value, 1);
  // Three of five columns, and two that nothing was found in; beyond the raster nothing is known.
  const ScoreTable shorter = score_result(slide(0, 20), e);
  EXPECT_DOUBLE_EQ(score(shorter, "thickness_iou").value, 3.0 / 7);
  EXPECT_DOUBLE_EQ(score(shorter, "thickness_false_alarm_ratio").value, 2.0 / 5);
  // No cell of the raster is free of both.
  EXPECT_DOUBLE_EQ(score(shorter, "thickness_hss").value, 2.0 * (0 - 2 * 2) / (5 * 2 + 5 * 2));
}

TEST(EventScorer, NetChangeIsComparedWithDepositLessErosion) {
  auto e = event();
  ObservedThickness thickness;
  thickness.value = Raster<double>(grid_of({8, 2, 4, 20}, maps()), -1.0);
  thickness.sd_m = 0.5;
  thickness.net_change = true;
  e->thickness = thickness;
  MemberResult r = slide(0, 22);
  r.scalars.eroded_volume_m3 = 1;
  r.layer(PeakLayer::eroded).assign(r.window.n_cells(), 1);
  // - 1 m where nothing came to rest, 2 - 1 m in the last five of twenty columns.
  EXPECT_DOUBLE_EQ(score(score_result(r, e), "thickness_bias_m").value, 2 * 5.0 / 20);
}

TEST(EventScorer, LengthsFrontsAndSpeeds) {
  auto e = event();
  e->runout_m = Measured{180, 10};
  e->h_over_l = Measured{0.5, 0.05};
  e->farthest = Vec2(west(2) + 190, north(10));
  e->farthest_sd_m = 20;
  e->volume_m3 = Measured{4200, 100};
  e->speeds = {{{west(5) + 1, north(9) - 1}, {10, 2}}, {{west(39), north(9) - 1}, {10, 2}}};
  e->fronts = {{8, 80.0, Vec2::Zero(), 5.0, {}},
               {30, {}, Vec2(west(2) + 100, north(10)), {}, 4.0},
               {50, 900.0, Vec2::Zero(), {}, 4.0}};
  const ScoreTable t = score_result(slide(0, 22), e);
  EXPECT_DOUBLE_EQ(score(t, "runout_error_m").value, 20);
  EXPECT_DOUBLE_EQ(score(t, "runout_relative_error").value, 20.0 / 180);
  EXPECT_NEAR(score(t, "h_over_l_error").value, -0.1, 1e-12);
  EXPECT_DOUBLE_EQ(score(t, "volume_error_m3").value, 4 * 5 * 200 - 4200);
  EXPECT_NEAR(score(t, "farthest_error_m").value, 195 - 190, 1.2);  // of a cell's centre
  EXPECT_DOUBLE_EQ(score(t, "speed_1_error_m_s").value, 2);
  EXPECT_DOUBLE_EQ(score(t, "speed_2_error_m_s").value, -10);  // it never came there
  // After 8 s columns 2 .. 10 are reached, whose last centre lies 85 m away.
  EXPECT_NEAR(score(t, "front_1_error_m").value, 5, 1.5);
  // 100 m away, the eleventh column, is reached after 10 s; 900 m never, so after the end.
  EXPECT_DOUBLE_EQ(score(t, "front_2_error_s").value, -20);
  EXPECT_EQ(score(t, "front_2_error_s").known, Known::exactly);
  EXPECT_DOUBLE_EQ(score(t, "front_3_error_s").value, 60 - 50);
  EXPECT_EQ(score(t, "front_3_error_s").known, Known::at_least);
  // It lies at rest and will never come: that counts as ten standard deviations late.
  const Observation never = simulated(t, "front_3_s");
  EXPECT_DOUBLE_EQ(never.value, 50 + 10 * 4.0);
  EXPECT_EQ(never.known, Known::at_least);
  const Observation moving =
      simulated(score_result(slide(0, 22, Censoring::still_moving), e), "front_3_s");
  EXPECT_DOUBLE_EQ(moving.value, 60) << "it may come any time";
  EXPECT_EQ(moving.known, Known::at_least);
}

TEST(EventScorer, WhoLeavesNothingAboveTheThresholdIsFartherThanAnybody) {
  auto e = event();
  e->deposit = area(8, 12, 15, 20, 5);
  e->threshold_m = 3;  // the deposit is 2 m thick
  const Observation none = simulated(score_result(slide(0, 22), e), "deposit_distance_m");
  EXPECT_EQ(none.known, Known::at_least);
  EXPECT_GT(none.value, 100);
  e->threshold_m = 1;
  EXPECT_LT(simulated(score_result(slide(0, 22), e), "deposit_distance_m").value, 30);
}

TEST(EventScorer, ThalwegGivesDistancesAndProfiles) {
  auto e = event();
  e->outline = area(8, 12, 2, 22, 5);
  e->thalweg = {{west(2), north(10)}, {west(39), north(10)}};
  e->farthest = Vec2(west(22), north(11));
  e->farthest_sd_m = 10;
  const ScoreTable t = score_result(slide(0, 32), e);
  EXPECT_NEAR(score(t, "outline_thalweg_runout_error_m").value, 100, 1e-6);
  // 15 bands of 20 m: 40 m wide in both for ten of them, in the member alone for five.
  EXPECT_NEAR(score(t, "outline_thalweg_width_rmse_m").value, std::sqrt(5 * 1600.0 / 15), 1e-6);
  EXPECT_NEAR(score(t, "farthest_along_error_m").value, 295 - 200, 1e-6);
}

TEST(EventScorer, WhatIsCutOffSaysSo) {
  auto e = event();
  e->outline = area(8, 12, 2, 30, 5);
  e->deposit = area(8, 12, 25, 30, 5);
  e->runout_m = Measured{280, 10};
  e->com_travel_m = Measured{200, 10};
  const ScoreTable left = score_result(slide(0, 22, Censoring::left_terrain), e);
  EXPECT_EQ(score(left, "outline_hit_rate").known, Known::at_least);
  EXPECT_EQ(score(left, "outline_iou").known, Known::not_at_all);
  EXPECT_EQ(score(left, "runout_error_m").known, Known::at_least);
  EXPECT_EQ(score(left, "com_travel_error_m").known, Known::not_at_all);
  EXPECT_EQ(score(left, "deposit_hit_rate").known, Known::at_least);
  const ScoreTable moving = score_result(slide(0, 22, Censoring::still_moving), e);
  EXPECT_EQ(score(moving, "deposit_hit_rate").known, Known::not_at_all);
  EXPECT_EQ(score(moving, "runout_error_m").known, Known::not_at_all);
  EXPECT_EQ(score(moving, "misfit").known, Known::not_at_all);
  EXPECT_THAT(bounds_text(left, 0), HasSubstr("at least: "));
  EXPECT_THAT(bounds_text(left, 0), HasSubstr("not known: "));
  EXPECT_EQ(bounds_text(score_result(slide(0, 22), e), 0), "");
}

TEST(Misfit, IsABoundOnlyWhereItCanOnlyGrow) {
  const std::vector<ObservedQuantity> observed = {{"a", 10, 1, "m"}, {"b", 5, 2, "m"}};
  const auto of = [&](Observation a, Observation b) { return misfit(observed, {a, b}); };
  EXPECT_DOUBLE_EQ(of({13, Known::exactly}, {5, Known::exactly}).value, std::sqrt(4.5));
  EXPECT_EQ(of({13, Known::at_least}, {5, Known::exactly}).known, Known::at_least);
  // Below what was observed it may still come nearer.
  EXPECT_EQ(of({8, Known::at_least}, {5, Known::exactly}).known, Known::not_at_all);
  EXPECT_EQ(of({8, Known::at_least}, {5, Known::exactly}).value, 0);
  EXPECT_TRUE(std::isnan(of({nan_d, Known::not_at_all}, {1, Known::not_at_all}).value));
}

class ScoredMembers : public ::testing::Test {
 protected:
  ScoredMembers() : members(maps()), observed(event()) {
    observed->outline = area(8, 12, 2, 22, 5);
    members.add(slide(0, 32));
    members.add(slide(3, 20));
    MemberResult failed = slide(4, 20);
    failed.outcome = Outcome::diverged;
    members.add(failed);
    members.add(slide(5, 22, Censoring::left_terrain));
    members.add(slide(9, 22));
  }
  test::MemoryMembers members;
  std::shared_ptr<ObservedEvent> observed;
};

TEST_F(ScoredMembers, EachHasTheScoresThatItHasAlone) {
  const ScoreTable all = score_members(members, observed);
  ASSERT_EQ(all.rows.size(), 5U);
  EXPECT_TRUE(all.rows[2].empty());
  EXPECT_THAT(all.comparison.simulated.members, ::testing::ElementsAre(0, 3, 5, 9));
  const ScoreTable alone = score_result(slide(3, 20), observed);
  ASSERT_EQ(all.rows[1].size(), alone.rows[0].size());
  for (std::size_t k = 0; k < alone.columns.size(); ++k) {
    EXPECT_EQ(all.rows[1][k].value, alone.rows[0][k].value) << alone.columns[k].name;
    EXPECT_EQ(all.columns[k].name, alone.columns[k].name);
  }
}

TEST_F(ScoredMembers, TheBestIsTheNearestWhoseEndWasSeen) {
  const ScoreTable all = score_members(members, observed);
  EXPECT_THAT(best_rows(all), ::testing::ElementsAre(4U, 1U, 0U, 3U));
  const Raster<std::uint8_t> cells = shown_cells(members, 4, observed);
  EXPECT_EQ(std::count(cells.values.begin(), cells.values.end(), 1), 4 * 20);
}

TEST_F(ScoredMembers, TheTableHasAColumnForEachScore) {
  const ScoreTable all = score_members(members, observed);
  DesignTable design;
  design.values.assign(10, {});
  const std::string plain = members_csv(design, members.members());
  const std::string scored = members_csv(design, members.members(), &all);
  EXPECT_THAT(plain, ::testing::Not(HasSubstr("score_")));
  EXPECT_THAT(scored, HasSubstr(",score_misfit,score_outline_hit_m2,"));
  EXPECT_THAT(scored, HasSubstr(",score_bounds,binding_limit,"));
  EXPECT_THAT(scored, HasSubstr(",\"at least: outline_hit_m2, outline_false_m2, outline_hit_rate; "
                                "not known: misfit, "));
  const auto commas = [](const std::string& line) {
    return std::count(line.begin(), line.end(), ',');
  };
  const std::string head = scored.substr(0, scored.find('\n'));
  const std::size_t at = scored.find("\n4,diverged");  // no scores, but all its cells
  const std::string row = scored.substr(at + 1, scored.find('\n', at + 1) - at - 1);
  EXPECT_EQ(commas(row), commas(head));
}

}  // namespace
}  // namespace sturz
