// SPDX-License-Identifier: Apache-2.0
#include "ensemble/hazard/hazard_map.hpp"

#include "engine/core/error.hpp"
#include "ensemble/hazard/wilson.hpp"
#include "tests/support/memory_members.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace sturz {
namespace {

using test::MemoryMembers;
using test::random_member;
using test::small_grid;
using testing::HasSubstr;

/// An ensemble of random members with every kind of outcome among them.
class HazardMapOfRandomMembers : public testing::Test {
 protected:
  HazardMapOfRandomMembers() : source_(small_grid(9, 13)) {
    std::mt19937 random(31);
    const Outcome outcomes[] = {Outcome::settled,  Outcome::out_of_time, Outcome::left_terrain,
                                Outcome::diverged, Outcome::failed,      Outcome::settled};
    for (int m = 0; m < 30; ++m) {
      MemberResult r = random_member(m, source_.grid(), random);
      r.outcome = outcomes[m % 6];
      r.censoring = censoring_of(r.outcome == Outcome::left_terrain || m == 6,
                                 r.outcome == Outcome::out_of_time || m == 8);
      source_.add(r);
      if (is_valid(r.outcome)) valid_.push_back(r);
    }
    HazardContext context;
    context.spacing_m = 3;
    context.n_planned = 32;
    map_ = make_hazard_map(source_, spec_, context);
  }

  /// The slow way: values of all valid members in one cell.
  std::vector<double> values(PeakLayer layer, int row, int col) const {
    std::vector<double> result;
    for (const MemberResult& r : valid_) result.push_back(MemoryMembers::value(r, layer, row, col));
    return result;
  }

  float at(const std::string& name, int row, int col, std::size_t plane = 0) const {
    const Layer* layer = map_.find(name);
    if (!layer) {
      ADD_FAILURE() << "no layer " << name;
      return nan_f;
    }
    return layer->values[plane * map_.grid.n_cells() + map_.grid.index(row, col)];
  }

  template <class Check>
  void for_cells(Check check) const {
    for (int row = 0; row < map_.grid.n_rows; ++row)
      for (int col = 0; col < map_.grid.n_cols; ++col) check(row, col);
  }

  void expect_probability(const std::string& name, int row, int col, std::size_t plane, int hits) {
    const int n = static_cast<int>(valid_.size());
    const ProbabilityBounds bounds = wilson_interval(hits, n);
    EXPECT_EQ(at(name, row, col, plane), static_cast<float>(static_cast<double>(hits) / n));
    EXPECT_EQ(at(name + "_lower", row, col, plane), static_cast<float>(bounds.lower));
    EXPECT_EQ(at(name + "_upper", row, col, plane), static_cast<float>(bounds.upper));
  }

  static double quantile(std::vector<double> x, double q) {
    std::sort(x.begin(), x.end());
    const double place = q * static_cast<double>(x.size() - 1);
    const auto i = static_cast<std::size_t>(place);
    return i + 1 < x.size() ? x[i] + (place - static_cast<double>(i)) * (x[i + 1] - x[i]) : x[i];
  }

  MemoryMembers source_;
  HazardSpec spec_;
  std::vector<MemberResult> valid_;
  LayerStack map_;
};

const struct {
  PeakLayer layer;
  std::string word;
  std::vector<double> HazardSpec::*thresholds;
  double si;
} peaks[] = {{PeakLayer::thickness, "thickness", &HazardSpec::thickness_m, 1},
             {PeakLayer::speed, "speed", &HazardSpec::speed_m_s, 1},
             {PeakLayer::energy, "energy", &HazardSpec::energy_kj_m2, 1000},
             {PeakLayer::pressure, "pressure", &HazardSpec::pressure_kpa, 1000}};

TEST_F(HazardMapOfRandomMembers, CountsExceedanceAsBruteForceDoes) {
  for (const auto& peak : peaks)
    for_cells([&](int row, int col) {
      const std::vector<double> x = values(peak.layer, row, col);
      const std::vector<double>& thresholds = spec_.*peak.thresholds;
      for (std::size_t t = 0; t < thresholds.size(); ++t) {
        const auto hits = std::count_if(x.begin(), x.end(),
                                        [&](double v) { return v > thresholds[t] * peak.si; });
        expect_probability(peak.word + "_exceedance", row, col, t, static_cast<int>(hits));
      }
    });
}

TEST_F(HazardMapOfRandomMembers, CountsReachedCellsByTheirArrival) {
  for_cells([&](int row, int col) {
    const std::vector<double> t = values(PeakLayer::arrival, row, col);
    const auto hits = std::count_if(t.begin(), t.end(), [](double v) { return !std::isnan(v); });
    expect_probability("probability_of_reach", row, col, 0, static_cast<int>(hits));
  });
}

TEST_F(HazardMapOfRandomMembers, TakesMeansAndQuantilesOverAllValidMembers) {
  for (const auto& [layer, name] :
       {std::pair<PeakLayer, std::string>{PeakLayer::deposit, "deposit"},
        {PeakLayer::thickness, "thickness"},
        {PeakLayer::speed, "speed"},
        {PeakLayer::energy, "energy"},
        {PeakLayer::pressure, "pressure"}})
    for_cells([&, &which = layer, &word = name](int row, int col) {
      const std::vector<double> x = values(which, row, col);
      const double unit = which == PeakLayer::energy || which == PeakLayer::pressure ? 1e-3 : 1;
      double sum = 0;
      for (const double v : x) sum += v;
      EXPECT_EQ(at(word + "_mean", row, col),
                static_cast<float>(sum / static_cast<double>(x.size()) * unit));
      for (std::size_t q = 0; q < spec_.quantiles.size(); ++q)
        EXPECT_EQ(at(word + "_quantile", row, col, q),
                  static_cast<float>(quantile(x, spec_.quantiles[q]) * unit));
    });
}

TEST_F(HazardMapOfRandomMembers, TakesArrivalQuantilesOverMembersThatCame) {
  for_cells([&](int row, int col) {
    std::vector<double> t = values(PeakLayer::arrival, row, col);
    std::erase_if(t, [](double v) { return std::isnan(v); });
    for (std::size_t q = 0; q < spec_.quantiles.size(); ++q) {
      const float seen = at("arrival_quantile", row, col, q);
      if (t.empty())
        EXPECT_TRUE(std::isnan(seen));
      else
        EXPECT_EQ(seen, static_cast<float>(quantile(t, spec_.quantiles[q])));
    }
  });
}

TEST_F(HazardMapOfRandomMembers, SharesReachedMembersBetweenTheIntensities) {
  for_cells([&](int row, int col) {
    const auto h = values(PeakLayer::thickness, row, col), v = values(PeakLayer::speed, row, col),
               t = values(PeakLayer::arrival, row, col);
    double high = 0, medium = 0;
    for (std::size_t m = 0; m < h.size(); ++m) {
      const bool is_high = h[m] > 1 && v[m] > 1;
      high += is_high;
      medium += !is_high && !std::isnan(t[m]);
    }
    const auto n = static_cast<double>(h.size());
    EXPECT_EQ(at("probability_of_high_intensity", row, col), static_cast<float>(high / n));
    EXPECT_EQ(at("probability_of_medium_intensity", row, col), static_cast<float>(medium / n));
    EXPECT_FLOAT_EQ(static_cast<float>((high + medium) / n), at("probability_of_reach", row, col));
  });
}

TEST_F(HazardMapOfRandomMembers, CountsValidMembersAndNamesTheOthers) {
  const auto attribute = [&](const std::string& name) -> std::string {
    for (const auto& [key, text] : map_.attributes)
      if (key == name) return text;
    return "absent";
  };
  EXPECT_EQ(at("number_of_members", 0, 0), 20);
  EXPECT_TRUE(map_.find("number_of_members")->is_count());
  EXPECT_EQ(attribute("number_of_planned_members"), "32");
  EXPECT_EQ(attribute("number_of_finished_members"), "30");
  EXPECT_EQ(attribute("number_of_valid_members"), "20");
  EXPECT_EQ(attribute("number_of_failed_members"), "10");
  EXPECT_EQ(attribute("failed_members"), "3,4,9,10,15,16,21,22,27,28");
  // By what is cut off, not by the outcome: that names losses over 1 % only.
  EXPECT_EQ(attribute("out_of_time_members"), "1,7,8,13,19,25");
  EXPECT_EQ(attribute("left_terrain_members"), "2,6,8,14,20,26");
}

TEST_F(HazardMapOfRandomMembers, SaysInEveryLayerWhatMembersMeanWhoseEndWasNotSeen) {
  const auto comment = [&](const char* name) { return map_.find(name)->comment; };
  const std::string unseen = ": the end of 11 of 20 members was not seen";
  for (const char* name : {"probability_of_reach", "energy_exceedance", "thickness_mean",
                           "speed_quantile", "probability_of_high_intensity"})
    EXPECT_THAT(comment(name), HasSubstr("a lower bound" + unseen)) << name;
  EXPECT_THAT(comment("probability_of_reach_upper"), HasSubstr("not an upper bound" + unseen));
  for (const char* name : {"arrival_quantile", "probability_of_medium_intensity"})
    EXPECT_THAT(comment(name), HasSubstr("may become more or less" + unseen)) << name;
  for (const char* name : {"deposit_mean", "deposit_quantile"})
    EXPECT_THAT(comment(name), HasSubstr("too large or too small" + unseen)) << name;
}

TEST_F(HazardMapOfRandomMembers, GivesEveryLayerItsShapeAndUnits) {
  for (const Layer& layer : map_.layers) {
    EXPECT_EQ(layer.values.size(), layer.n_planes() * map_.grid.n_cells()) << layer.name;
    EXPECT_FALSE(layer.units.empty()) << layer.name;
    EXPECT_FALSE(layer.long_name.empty()) << layer.name;
  }
  const Layer* energy = map_.find("energy_exceedance");
  EXPECT_EQ(energy->units, "1");
  EXPECT_EQ(energy->axis.name, "energy_threshold");
  EXPECT_EQ(energy->axis.units, "kJ m-2");
  EXPECT_EQ(map_.find("energy_quantile")->units, "kJ m-2");
  EXPECT_EQ(map_.find("pressure_mean")->cell_methods, "time: maximum realization: mean");
}

TEST_F(HazardMapOfRandomMembers, TellsWhatEveryLayerShows) {
  const auto is = [&](const char* name, Quantity quantity, Statistic statistic,
                      IntensityClass intensity = IntensityClass::none) {
    EXPECT_EQ(map_.find(name)->meaning, (LayerMeaning{quantity, statistic, intensity})) << name;
  };
  is("number_of_members", Quantity::members, Statistic::count);
  is("probability_of_reach", Quantity::reached, Statistic::probability);
  is("probability_of_reach_lower", Quantity::reached, Statistic::lower_bound);
  is("energy_exceedance", Quantity::energy, Statistic::probability);
  is("energy_exceedance_upper", Quantity::energy, Statistic::upper_bound);
  is("pressure_quantile", Quantity::pressure, Statistic::quantile);
  is("arrival_quantile", Quantity::arrival, Statistic::quantile);
  is("deposit_mean", Quantity::deposit, Statistic::mean);
  is("probability_of_high_intensity", Quantity::intensity, Statistic::probability,
     IntensityClass::high);
  for (const Layer& layer : map_.layers) {
    EXPECT_NE(layer.meaning.quantity, Quantity::other) << layer.name;
    EXPECT_NE(layer.meaning.statistic, Statistic::value) << layer.name;
  }
}

TEST_F(HazardMapOfRandomMembers, MarksThresholdsThatTheSpacingCannotResolve) {
  // Spacing 3 m: thresholds of 0.1, 0.5 and 1 m lie below 1.5 m, 2 m does not.
  const std::string comment = map_.find("thickness_exceedance")->comment;
  EXPECT_THAT(comment, HasSubstr("not resolved (below half the particle spacing of 3 m): 0.1 m, "
                                 "0.5 m, 1 m"));
  EXPECT_THAT(comment, testing::Not(HasSubstr("2 m")));
  EXPECT_THAT(map_.find("probability_of_high_intensity")->comment, HasSubstr("not resolved"));
  EXPECT_THAT(map_.find("speed_exceedance")->comment, testing::Not(HasSubstr("not resolved")));
}

TEST(HazardMap, LeavesOutLayersWithoutThresholdsOrQuantiles) {
  std::mt19937 random(1);
  MemoryMembers source(small_grid(3, 3));
  source.add(random_member(0, source.grid(), random));
  HazardSpec spec;
  spec.speed_m_s.clear();
  spec.quantiles.clear();
  const LayerStack map = make_hazard_map(source, spec, {});
  EXPECT_EQ(map.find("speed_exceedance"), nullptr);
  EXPECT_EQ(map.find("speed_quantile"), nullptr);
  EXPECT_EQ(map.find("arrival_quantile"), nullptr);
  EXPECT_NE(map.find("speed_mean"), nullptr);
}

/// Columns' thickness is smoothed: beyond the last one it fades out where nothing arrived.
TEST(HazardMap, NoIntensityWhereAMemberOnlyFadesOut) {
  MemoryMembers source(small_grid(1, 2));
  MemberResult member;
  member.outcome = Outcome::settled;
  member.grid = source.grid();
  member.window = {0, 0, 1, 2};
  for (int k = 0; k < n_peak_layers; ++k)
    member.layers[k].assign(2, info(static_cast<PeakLayer>(k)).untouched);
  const auto set = [&](PeakLayer layer, std::vector<float> values) {
    member.layers[static_cast<int>(layer)] = std::move(values);
  };
  set(PeakLayer::thickness, {3, 2.76F});
  set(PeakLayer::speed, {30, 28.8F});
  set(PeakLayer::arrival, {12, nan_f});
  source.add(member);
  const LayerStack map = make_hazard_map(source, {}, {});
  EXPECT_THAT(map.find("probability_of_reach")->values, testing::ElementsAre(1, 0));
  EXPECT_THAT(map.find("probability_of_high_intensity")->values, testing::ElementsAre(1, 0));
  EXPECT_THAT(map.find("probability_of_medium_intensity")->values, testing::ElementsAre(0, 0));
}

TEST(HazardMap, IsUndefinedWithoutValidMembers) {
  MemoryMembers source(small_grid(2, 2));
  MemberResult failed;
  failed.member = 4;
  failed.outcome = Outcome::failed;
  source.add(failed);
  for (const Layer& layer : make_hazard_map(source, {}, {}).layers)
    for (const float v : layer.values)
      EXPECT_TRUE(layer.is_count() ? v == 0 : std::isnan(v)) << layer.name;
}

TEST(HazardMap, OfMembersThatNeverMovedIsDry) {
  MemoryMembers source(small_grid(2, 2));
  for (int m = 0; m < 20; ++m) {
    MemberResult still;
    still.member = m;
    still.outcome = Outcome::settled;
    source.add(still);
  }
  const LayerStack map = make_hazard_map(source, {}, {});
  for (int cell = 0; cell < 4; ++cell) {
    EXPECT_EQ(map.find("probability_of_reach")->values[cell], 0);
    EXPECT_NEAR(map.find("probability_of_reach_upper")->values[cell], 0.1611, 1e-4);
    EXPECT_EQ(map.find("thickness_mean")->values[cell], 0);
    EXPECT_TRUE(std::isnan(map.find("arrival_quantile")->values[cell]));
  }
}

/// A member that left `value` as its thickness in one cell.
MemberResult one_cell_member(const Grid& grid, int member, int row, int col, float value) {
  MemberResult r;
  r.member = member;
  r.outcome = Outcome::settled;
  r.grid = grid;
  r.window = {row, col, 1, 1};
  for (auto& layer : r.layers) layer = {0.0F};
  r.layer(PeakLayer::thickness)[0] = value;
  r.layer(PeakLayer::energy)[0] = 2500;
  return r;
}

TEST(HazardMap, CoversWhatWasTouchedAndAMarginOnTheMembersGrid) {
  MemoryMembers source(small_grid(1000, 2000, 5));
  source.add(one_cell_member(source.grid(), 0, 500, 700, 1));
  source.add(one_cell_member(source.grid(), 1, 520, 690, 1));
  const LayerStack map = make_hazard_map(source, {}, {});
  EXPECT_EQ(map.grid.n_rows, 21 + 2 * map_margin_cells);
  EXPECT_EQ(map.grid.n_cols, 11 + 2 * map_margin_cells);
  EXPECT_EQ(map.grid.west_m, 500000 + (690 - map_margin_cells) * 5);
  EXPECT_EQ(map.grid.north_m, 4.5e6 - (500 - map_margin_cells) * 5);
  const std::size_t cell = map.grid.index(map_margin_cells, 10 + map_margin_cells);
  EXPECT_EQ(map.find("probability_of_reach")->values[cell], 0.5F);
  EXPECT_EQ(map.find("energy_mean")->values[cell], 1.25F) << "kJ m-2";
  // At the edge of the grid the margin is cut, not moved.
  MemoryMembers corner(small_grid(30, 30));
  corner.add(one_cell_member(corner.grid(), 0, 0, 29, 1));
  const Grid at_corner = make_hazard_map(corner, {}, {}).grid;
  EXPECT_EQ(at_corner.n_rows, 1 + map_margin_cells);
  EXPECT_EQ(at_corner.n_cols, 1 + map_margin_cells);
  EXPECT_EQ(at_corner.north_m, corner.grid().north_m);
}

TEST(HazardMap, IsMissingWhereTheGroundIsNotKnownAndZeroElsewhere) {
  MemoryMembers source(small_grid(40, 40));
  source.add(one_cell_member(source.grid(), 0, 20, 20, 1));
  Raster<double> ground(source.grid(), 100.0);
  ground.at(20, 20) = nan_d;  // a member came all the same
  ground.at(20, 22) = nan_d;
  HazardContext context;
  context.ground = &ground;
  const LayerStack map = make_hazard_map(source, {}, context);
  const auto at = [&](const char* layer, int row, int col) {
    const int row0 = 20 - map_margin_cells, col0 = 20 - map_margin_cells;
    return map.find(layer)->values[map.grid.index(row - row0, col - col0)];
  };
  for (const Layer& layer : map.layers) {
    if (layer.is_count()) continue;
    const bool arrival = layer.meaning.quantity == Quantity::arrival;
    for (std::size_t plane = 0; plane < layer.n_planes(); ++plane) {
      const std::size_t first = plane * map.grid.n_cells();
      const auto value = [&](int row, int col) {
        return layer.values[first + map.grid.index(row - 20 + map_margin_cells,
                                                   col - 20 + map_margin_cells)];
      };
      EXPECT_TRUE(std::isnan(value(20, 22))) << layer.name;
      EXPECT_EQ(std::isnan(value(18, 18)), arrival) << layer.name;
      if (layer.meaning.statistic != Statistic::upper_bound && !arrival) {
        EXPECT_EQ(value(18, 18), 0) << layer.name;
      }
    }
  }
  EXPECT_EQ(at("thickness_mean", 20, 20), 1);
}

TEST(HazardMap, RefusesDataThatCannotBeRight) {
  for (const float wrong : {-1.0F, nan_f}) {
    std::mt19937 random(1);
    MemoryMembers source(small_grid(4, 4));
    MemberResult r = random_member(12, source.grid(), random);
    r.window = {0, 0, 1, 1};
    for (auto& layer : r.layers) layer = {1.0F};
    r.layer(PeakLayer::energy)[0] = wrong;
    source.add(r);
    try {
      make_hazard_map(source, {}, {});
      ADD_FAILURE() << "no error";
    } catch (const SetupError& error) {
      EXPECT_THAT(error.what(), HasSubstr("member 12: peak_energy"));
    }
  }
}

}  // namespace
}  // namespace sturz
