// SPDX-License-Identifier: Apache-2.0
// Multilevel ensembles from the pilot to the last round, many times over, on levels whose truth is
// known: bounds hold although levels, numbers and end are chosen from the members they are of.
#include "ensemble/workflow/multilevel/decision.hpp"
#include "tests/ensemble/fidelity/multilevel/normal_draws.hpp"
#include "tests/support/front_members.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace sturz::test {
namespace {

using workflow::LevelMembers;
using workflow::PlanRound;

/// Member k of a level. \param stream of random numbers, another in each repeat
using MakeMember =
    std::function<MemberResult(std::size_t level, std::uint64_t stream, std::int64_t k)>;

/// One multilevel ensemble, as `sturz ensemble` decides it.
class Procedure {
 public:
  Procedure(MakeMember make, const std::vector<double>& costs, const Grid& grid,
            std::uint64_t stream)
      : make_(std::move(make)), costs_(costs), stream_(stream), counts_(costs.size(), 0) {
    for (std::size_t p = 0; p < costs.size(); ++p)
      stores_.push_back(std::make_unique<MemoryMembers>(grid));
  }

  /// \return the levels that are used
  std::vector<std::size_t> run(const TargetSpec& target) {
    compute(std::vector<std::int64_t>(costs_.size(), 16));
    std::vector<PlanRound> rounds;
    while (auto round = workflow::next_round(members(), rounds, target, costs_, {})) {
      compute(round->members);
      rounds.push_back(std::move(*round));
    }
    return rounds.back().plan.levels;
  }

  LevelMembers members() const {
    LevelMembers all;
    for (std::size_t p = 0; p < stores_.size(); ++p) {
      all.members.push_back(stores_[p].get());
      all.parts.push_back({std::to_string(p), "full_stress", 6.0 * static_cast<double>(p + 1)});
    }
    all.counts = counts_;
    return all;
  }

 private:
  void compute(const std::vector<std::int64_t>& counts) {
    for (std::size_t p = 0; p < counts.size(); ++p)
      for (; counts_[p] < counts[p]; ++counts_[p]) stores_[p]->add(make_(p, stream_, counts_[p]));
  }

  MakeMember make_;
  std::vector<double> costs_;
  std::uint64_t stream_;
  std::vector<std::int64_t> counts_;
  std::vector<std::unique_ptr<MemoryMembers>> stores_;
};

double noise(std::uint64_t stream, std::size_t which, std::int64_t k) {
  return normal(stream + 1 + which, static_cast<std::uint64_t>(k));
}
double shared(std::uint64_t stream, std::int64_t k) {
  return normal(stream, static_cast<std::uint64_t>(k));
}

struct Family {
  const char* name;
  double truth;
  double (*value)(std::size_t level, std::uint64_t stream, std::int64_t k);
};

const Family families[] = {
    {"normal", 10,
     [](std::size_t l, std::uint64_t s, std::int64_t k) {
       static const double own[] = {0.3, 0.2, 0.6};
       const auto at = static_cast<double>(l);
       return 10 + 5 * at + (1 + at) * (2 * shared(s, k) + own[l] * noise(s, l, k));
     }},
    {"lognormal", std::exp((0.25 + 0.01) / 2),
     [](std::size_t l, std::uint64_t s, std::int64_t k) {
       static const double own[] = {0.1, 0.07, 0.2};
       return (1 + 0.5 * static_cast<double>(l)) *
              std::exp(0.5 * shared(s, k) + own[l] * noise(s, l, k));
     }},
    // What no cheaper level tells is lognormal by itself.
    {"skewed remainder", 10 + std::exp(0.5),
     [](std::size_t l, std::uint64_t s, std::int64_t k) {
       const double x = 10 + 3 * shared(s, k);
       return l == 0 ? x + std::exp(noise(s, 0, k))
                     : 1.5 * x + 0.6 * static_cast<double>(l) * noise(s, l, k);
     }},
    {"exponential, bent", 2, [](std::size_t l, std::uint64_t s, std::int64_t k) {
       const double y = -std::log(normal_share(shared(s, k)));
       if (l == 0) return 1 + y * std::exp(0.15 * noise(s, 0, k) - 0.15 * 0.15 / 2);
       return 2 * std::pow(y, 0.8) * std::exp(0.2 * noise(s, l, k));
     }}};

TEST(MultilevelBounds, OfMeansHoldThroughTheWholeProcedure) {
  constexpr int repeats = 400;
  const Grid grid = small_grid(2, 2);
  for (const Family& family : families) {
    double covered = 0, bias = 0, squares = 0;
    for (int r = 0; r < repeats; ++r) {
      const auto stream = 1000 + 100 * static_cast<std::uint64_t>(r);
      Procedure ensemble(
          [&](std::size_t level, std::uint64_t s, std::int64_t k) {
            MemberResult m;
            m.member = k;
            m.outcome = Outcome::settled;
            m.grid = grid;
            m.scalars.runout_m = family.value(level, s, k);
            return m;
          },
          {10, 1, 0.03}, grid, stream);
      const std::vector<std::size_t> levels = ensemble.run({0.1, 0, 0});
      const MultilevelMean mean = scalar_of(ensemble.members(), levels, "runout_m").mean;
      const Interval bounds = mean.bounds_90();
      covered += bounds.low <= family.truth && family.truth <= bounds.high ? 1.0 / repeats : 0;
      bias += (mean.mean - family.truth) / repeats;
      squares += std::pow(mean.mean - family.truth, 2) / repeats;
    }
    RecordProperty(family.name, std::to_string(covered));
    EXPECT_GE(covered, 0.85) << family.name;
    // Asked for are +- 10 %, that is an error of 6 %: it is reached in the mean square as well.
    EXPECT_LT(std::sqrt(squares), 0.1 / 1.645 * family.truth) << family.name;
    EXPECT_LT(std::abs(bias), 0.3 * std::sqrt(squares)) << family.name;
  }
}

/// Fronts at 250 + 60 z + 8 e, and at 350 + 80 z + 8 e at the cheap level.
TEST(MultilevelBounds, OfMapsHoldThroughTheWholeProcedure) {
  constexpr int repeats = 60;
  const Grid grid = small_grid(1, 60);
  double covered = 0, cells = 0, squares = 0, rare_covered = 0, rare = 0;
  double untold = 0, untold_truth = 0;
  for (int r = 0; r < repeats; ++r) {
    Procedure ensemble(
        [&](std::size_t level, std::uint64_t s, std::int64_t k) {
          const double z = shared(s, k), own = 8 * noise(s, level, k);
          return front_member(k, level == 0 ? 250 + 60 * z + own : 350 + 80 * z + own, grid);
        },
        {10, 0.1}, grid, 9000 + 100 * static_cast<std::uint64_t>(r));
    const std::vector<std::size_t> levels = ensemble.run({0, 0.04, 0});
    ASSERT_EQ(levels.size(), 2U);
    const MultilevelMap map = map_of(ensemble.members(), levels, {}, {});
    for (int col = 0; col < map.extent.n_cols; ++col) {
      const double x = 10 * (col + map.extent.col0) + 5;
      const double truth = normal_share((250 - x) / std::hypot(60, 8));
      const std::size_t i = map.probability.grid.index(0, col);
      const bool holds = map.low.values[i] <= truth && truth <= map.high.values[i];
      if (map.told.values[i] == 0) untold += 1, untold_truth = std::max(untold_truth, truth);
      if (truth > 0.05 && truth < 0.95) {
        cells += 1;
        covered += holds ? 1 : 0;
        squares += std::pow(map.probability.values[i] - truth, 2);
      } else if (truth > 0.002 && truth < 0.998) {
        rare += 1;
        rare_covered += holds ? 1 : 0;
      }
    }
  }
  RecordProperty("covered", std::to_string(covered / cells));
  RecordProperty("covered_rare", std::to_string(rare_covered / rare));
  EXPECT_GE(covered / cells, 0.85);
  EXPECT_GE(rare_covered / rare, 0.85);
  EXPECT_LT(std::sqrt(squares / cells), 1.1 * 0.04);
  // What is not told is told in words: it is below the share that so many draws leave.
  RecordProperty("largest_untold", std::to_string(untold_truth));
  EXPECT_GT(untold, 0);
  EXPECT_LT(untold_truth, unseen_share(40));
}

/// Fronts at 250 + 60 z, and a branch that one dear member in twelve takes and no cheap one ever:
/// it covers one cell at `branch_m`.
struct Branch {
  static constexpr double truth = 1.0 / 12;
  MemoryMembers dear{small_grid(1, 60)}, cheap{small_grid(1, 60)};
  MapLevels levels;
  std::size_t cell;

  Branch(std::size_t at, std::uint64_t s) : levels{{&dear, &cheap}, {6, 12}, {}}, cell(at) {
    for (std::int64_t k = 0; k < 200; ++k) {
      const double z = shared(s, k);
      if (k < 16) {
        MemberResult m = front_member(k, 250 + 60 * z, dear.grid());
        if (unit_random(s + 7, static_cast<std::uint64_t>(k)) < truth)
          m.layer(PeakLayer::arrival)[cell] = 1;
        dear.add(m);
      }
      cheap.add(front_member(k, 240 + 60 * z, cheap.grid()));
      levels.draws.push_back({k, k < 16 ? 0U : 1U, {}});
    }
  }
};

/// Where all dear members stay away, their number alone says what is possible, and four hundred
/// cheap ones say nothing.
TEST(MultilevelBounds, OfMapsCountNoCheapDrawsAsDearOnes) {
  constexpr int repeats = 200;
  double covered = 0, unseen = 0;
  for (int r = 0; r < repeats; ++r) {
    const Branch all(50, 70000 + 100 * static_cast<std::uint64_t>(r));
    const MultilevelMap map = multilevel_map(all.levels, {});
    const double low = map.low.values[all.cell], high = map.high.values[all.cell];
    covered += low <= Branch::truth && Branch::truth <= high ? 1.0 / repeats : 0;
    if (map.probability.values[all.cell] > 0) {
      EXPECT_EQ(map.told.values[all.cell], 1) << r;
      continue;
    }
    unseen += 1.0 / repeats;
    // Not told, but where a fold's fit foretells a front that far.
    EXPECT_GE(high, unseen_share(16)) << r;
  }
  EXPECT_GE(covered, 0.85);
  EXPECT_GT(unseen, 0.1);
}

/// The same branch where fronts come as well: what they foretell is no word against it.
TEST(MultilevelBounds, OfMapsAllowForABranchAmongFronts) {
  constexpr int repeats = 200;
  for (const std::size_t cell : {26U, 30U, 34U, 38U}) {
    const double front = normal_share((250 - (10.0 * static_cast<double>(cell) + 5)) / 60);
    const double truth = front + (1 - front) * Branch::truth;
    double covered = 0, told = 0;
    for (int r = 0; r < repeats; ++r) {
      const Branch all(cell, 90000 + 100 * static_cast<std::uint64_t>(r));
      const MultilevelMap map = multilevel_map(all.levels, {});
      const std::size_t i = cell - static_cast<std::size_t>(map.extent.col0);
      if (map.told.values[i] == 0) continue;
      told += 1;
      covered += map.low.values[i] <= truth && truth <= map.high.values[i] ? 1 : 0;
    }
    RecordProperty("covered_" + std::to_string(cell), std::to_string(covered / told));
    EXPECT_GE(told, repeats / 2) << cell;
    EXPECT_GE(covered / told, 0.85) << cell << ": " << truth;
  }
}

}  // namespace
}  // namespace sturz::test
