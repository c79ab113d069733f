// SPDX-License-Identifier: Apache-2.0
// A ladder of made-up members whose results follow known laws of spacing and seconds.
#include "ensemble/fidelity/ladder.hpp"

#include "engine/core/random.hpp"
#include "ensemble/fidelity/choice.hpp"
#include "ensemble/fidelity/level_values.hpp"
#include "tests/support/memory_members.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace sturz::test {
namespace {

constexpr std::size_t n_members = 12;
const std::vector<double> spacings{8, 6, 4};
const std::vector<std::string> both{"runout_m", "reached_area_m2"};

/// Run-out 1000 (1 + draw / 5) + 10 d, area 5000 + 3 d^2, seconds 100 d^-3; flow over the first
/// 10 + d / 2 columns of one row, half a metre thick.
MemberResult member(std::size_t k, double d, double displaced = 0) {
  MemberResult r;
  r.member = static_cast<std::int64_t>(k);
  r.outcome = Outcome::settled;
  r.grid = small_grid(1, 40);
  r.window = whole_of(r.grid);
  const double draw = unit_random(5, k) - 0.5;
  r.scalars.runout_m = 1000 * (1 + draw / 5) + 10 * d + displaced * (k % 2 == 0 ? 1 : -1);
  r.scalars.reached_area_m2 = 5000 + 3 * d * d;
  r.scalars.cpu_s = 100 * std::pow(d, -3);
  for (int layer = 0; layer < n_peak_layers; ++layer)
    r.layers[layer].assign(r.window.n_cells(), info(static_cast<PeakLayer>(layer)).untouched);
  for (int col = 0; col < 10 + static_cast<int>(d / 2); ++col)
    r.layer(PeakLayer::thickness)[static_cast<std::size_t>(col)] = 0.5F;
  return r;
}

MemoryMembers rung_of(double d, double displaced = 0) {
  MemoryMembers members(small_grid(1, 40));
  for (std::size_t k = 0; k < n_members; ++k) members.add(member(k, d, displaced));
  return members;
}

struct Made {
  std::vector<MemoryMembers> rungs;
  MemoryMembers displaced = rung_of(8, 2);
  LadderAccuracy accuracy;

  Made() {
    for (const double d : spacings) rungs.push_back(rung_of(d));
    compare();
  }
  void compare() {
    std::vector<Rung> list;
    for (std::size_t l = 0; l < rungs.size(); ++l) list.push_back({spacings[l], &rungs[l]});
    accuracy = ladder_accuracy("depth_averaged", list, &displaced, 0,
                               {{"runout_m", "reached_area_m2"}, {0.1}, 1});
  }
};

TEST(ALadder, TellsOrdersSecondsSpreadAndNoise) {
  const Made made;
  const LadderAccuracy& a = made.accuracy;
  ASSERT_EQ(a.results.size(), 2U);
  EXPECT_NEAR(a.results[0].refinement.order, 1, 1e-4);
  EXPECT_NEAR(a.results[1].refinement.order, 2, 1e-4);
  EXPECT_NEAR(a.results[1].refinement.limit, 5000, 1e-3);
  EXPECT_NEAR(a.results[0].member_rms[0], 40, 1e-9);
  EXPECT_NEAR(a.results[0].noise, 2 / std::sqrt(2), 1e-9);
  EXPECT_NEAR(a.seconds.exponent, -3, 1e-9);
  EXPECT_GT(a.results[0].spread, 20);
  EXPECT_EQ(a.results[1].spread, 0);
  // Run-out is 10 d off, every member alike: a law and next to no scatter.
  EXPECT_NEAR(a.results[0].mean_errors.at(4), 40, 10);
  EXPECT_NEAR(a.results[0].member_error(8), 80 / a.results[0].scale(), 20 / a.results[0].scale());
}

TEST(ALadder, MeasuresItsMaps) {
  const Made made;
  ASSERT_EQ(made.accuracy.maps.size(), 1U);
  const MapAccuracy& map = made.accuracy.maps.front();
  // 14, 13 and 12 cells of 100 m2.
  EXPECT_NEAR(map.distances[0].area_between_m2, 200, 1e-9);
  EXPECT_NEAR(map.distances[1].area_between_m2, 100, 1e-9);
  EXPECT_NEAR(map.distances[2].area_between_m2, 0, 1e-9);
  EXPECT_NEAR(map.distances[0].mean_area_m2, 1200, 1e-9);
  EXPECT_NEAR(map.distances[0].worst_cell, 1, 1e-9);
  EXPECT_NEAR(map.distances[0].relative(), 1.0 / 6, 1e-12);
  // One cell per two metres of spacing: order 1, so the finest is two cells off too. Three
  // distances tell that to a quarter beside the prior.
  EXPECT_NEAR(map.errors.at(4), 1.0 / 6, 0.25 / 6);
  EXPECT_NEAR(map.errors.at(8), 2.0 / 6, 0.25 * 2 / 6);
  EXPECT_GT(map.distances[0].boundary_m, 0);
}

TEST(ALadder, LeavesMembersOutThatOneSpacingLacks) {
  Made made;
  MemberResult failed = member(3, 6);
  failed.outcome = Outcome::failed;
  MemberResult cut = member(5, 6);
  cut.censoring = Censoring::left_terrain;
  MemoryMembers rung(small_grid(1, 40));
  for (std::size_t k = 0; k < n_members; ++k)
    rung.add(k == 3 ? failed : k == 5 ? cut : member(k, 6));
  made.rungs[1] = rung;
  made.compare();
  EXPECT_EQ(made.accuracy.members.size(), n_members - 1);
  EXPECT_EQ(made.accuracy.results[0].n_members, static_cast<std::int64_t>(n_members - 2));
  EXPECT_EQ(made.accuracy.results[1].n_members, static_cast<std::int64_t>(n_members - 2));
  EXPECT_EQ(made.accuracy.n_asked, static_cast<std::int64_t>(n_members));
}

TEST(ALadder, IsCheckedByASpacingThatItDoesNotKnow) {
  const Made made;
  std::vector<Rung> list;
  for (std::size_t l = 0; l < made.rungs.size(); ++l) list.push_back({spacings[l], &made.rungs[l]});
  const MemoryMembers finer = rung_of(2);
  LadderQuestions questions{both, {0.1}, 1};
  questions.held_out = {2, &finer};
  const LadderAccuracy a = ladder_accuracy("depth_averaged", list, &made.displaced, 0, questions);
  ASSERT_EQ(a.checked.size(), 9U);  // two numbers and a map at three spacings
  EXPECT_EQ(a.results[0].refinement.means, made.accuracy.results[0].refinement.means);
  EXPECT_EQ(a.results[0].member_error(4), made.accuracy.results[0].member_error(4));
  const CheckedError& runout = a.checked[2];
  EXPECT_EQ(runout.spacing_m, 4);
  EXPECT_NEAR(runout.found, 20 / a.results[0].scale(), 1e-9);
  EXPECT_NEAR(runout.found_mean, runout.found, 1e-9);
  EXPECT_TRUE(runout.is_met()) << runout.said << " " << runout.found;
  const CheckedError& map = a.checked.back();
  EXPECT_EQ(map.name, "map");
  EXPECT_NEAR(map.found, 1.0 / 12, 1e-9);  // 12 cells, 11 at 2 m
  EXPECT_TRUE(map.is_met());
}

TEST(TheCheapestSpacing, IsTheCoarsestWithinTheError) {
  const Made made;
  const LadderAccuracy& a = made.accuracy;
  const double wanted = a.results[0].member_error(5);
  const Choice choice = cheapest_for(a, both, wanted);
  EXPECT_NEAR(choice.spacing_m, 5, 0.05);
  EXPECT_LE(choice.spacing_m, 5.0001);
  EXPECT_LE(choice.predicted.error, wanted);
  EXPECT_EQ(choice.predicted.of, "runout_m");
  EXPECT_NEAR(choice.member_cpu_s, 100 * std::pow(choice.spacing_m, -3), 1e-6);
  EXPECT_TRUE(cheapest_for(a, both, 1).coarsest);
  const Choice none = cheapest_for(a, both, a.results[0].member_error(1));
  EXPECT_TRUE(std::isnan(none.spacing_m));
  EXPECT_NEAR(none.finer_spacing_m, 1, 0.03);
  EXPECT_TRUE(std::isnan(cheapest_for(a, both, 1e-9).finer_spacing_m));
}

TEST(TheCheapestSpacing, LooksAtMapsToo) {
  const Made made;
  const std::vector<std::string> all{"runout_m", "map"};
  const Choice choice = cheapest_for(made.accuracy, all, 0.2);
  EXPECT_EQ(choice.predicted.of, "map");
  EXPECT_NEAR(choice.predicted.error, 0.2, 0.005);
  const Choice none = cheapest_for(made.accuracy, all, 0.1);
  EXPECT_TRUE(std::isnan(none.spacing_m));
  EXPECT_NEAR(made.accuracy.maps.front().errors.at(none.finer_spacing_m), 0.1, 0.005);
}

/// Against a search over a fine table of error^2 = (error of the mean)^2 + (s / L)^2 / n, n = T d^3
/// / 100.
TEST(TheBestSplit, BalancesResolutionAndSampling) {
  Made made;
  made.accuracy.results.resize(1);
  const ResultAccuracy& r = made.accuracy.results.front();
  for (const double core_s : {3.0, 30.0, 300.0, 3e5}) {
    double least = INFINITY, where = 0;
    for (double d = 4; d <= 8; d += 1e-3) {
      const double n = core_s * d * d * d / 100;
      if (n < 2) continue;
      const double error = std::hypot(r.mean_error(d), r.spread / r.scale() / std::sqrt(n));
      if (error < least) least = error, where = d;
    }
    const Split split = best_split(made.accuracy, core_s);
    EXPECT_NEAR(split.error, least, 2e-3 * least) << core_s;
    EXPECT_NEAR(split.spacing_m, where, 0.05 * where) << core_s;
    EXPECT_NEAR(split.error, std::hypot(split.resolution, split.sampling), 1e-12);
  }
  EXPECT_TRUE(std::isnan(best_split(made.accuracy, 0.1).error));
}

TEST(LevelValues, LineUpWhatAllLevelsKnow) {
  Made made;
  std::vector<const MemberParts*> levels;
  for (const MemoryMembers& rung : made.rungs) levels.push_back(&rung);
  std::reverse(levels.begin(), levels.end());
  const auto all = level_values(levels, both, 0.1);
  ASSERT_EQ(all.size(), 2U);  // every member covers the same cells: no cell is uncertain
  EXPECT_EQ(all[0].name, "runout_m");
  ASSERT_EQ(all[0].values[0].size(), n_members);
  EXPECT_NEAR(all[0].values[2][4] - all[0].values[0][4], 40, 1e-9);
  EXPECT_NEAR(squared_correlation(all[0], 2), 1, 1e-9);
}

/// Members 0 .. 5 come one cell farther than the others, at every level.
TEST(LevelValues, MapsKeepTheCellsInDoubt) {
  std::vector<MemoryMembers> made;
  std::vector<const MemberParts*> levels;
  for (const double d : {4.0, 8.0}) {
    MemoryMembers& rung = made.emplace_back(small_grid(1, 40));
    for (std::size_t k = 0; k < n_members; ++k) {
      MemberResult m = member(k, d);
      if (k < 6) m.layer(PeakLayer::thickness)[12] = 0.5F;
      rung.add(m);
    }
  }
  for (const MemoryMembers& rung : made) levels.push_back(&rung);
  const auto all = level_values(levels, {}, 0.1);
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].name, "map");
  EXPECT_EQ(all[0].n_cells, 1U);
  EXPECT_EQ(all[0].values[0][2], 1);
  EXPECT_EQ(all[0].values[0][8], 0);
  EXPECT_EQ(all[0].values[1][8], 1);  // 14 cells at 8 m
}

TEST(Changes, ComePairByPair) {
  const MemoryMembers rung = rung_of(8);
  MemoryMembers other(small_grid(1, 40));
  for (std::size_t k = 0; k < n_members; ++k) {
    MemberResult m = member(k, 8);
    m.scalars.runout_m += k % 2 == 0 ? 3 : 5;
    m.scalars.cpu_s *= 1.5;
    other.add(m);
  }
  const std::vector<std::string> results{"runout_m"};
  const std::vector<Change> c = changes(rung, other, results);
  ASSERT_EQ(c.size(), 1U);
  EXPECT_NEAR(c[0].mean, 4, 1e-9);
  EXPECT_NEAR(c[0].standard_error, std::sqrt(12.0 / 11) / std::sqrt(12.0), 1e-9);
  EXPECT_NEAR(seconds_ratio(rung, other), 1.5, 1e-9);
}

}  // namespace
}  // namespace sturz::test
