// SPDX-License-Identifier: Apache-2.0
// Maps of several sources against sums over members, cell by cell.
#include "ensemble/region/region_maps.hpp"

#include "ensemble/hazard/stack_hash.hpp"
#include "ensemble/hazard/wilson.hpp"
#include "tests/support/memory_members.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace sturz::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// Members of some sources, each with a member of every row; some failed, one source has none.
struct MadeUp {
  explicit MadeUp(const Grid& grid) : members(grid) {}

  void add_source(const std::string& name, const std::vector<MemberResult>& results) {
    const auto source = static_cast<std::uint32_t>(sources.size());
    RegionSource s{name, n_rows, 0, {}};
    for (std::size_t row = 0; row < results.size(); ++row) {
      MemberResult r = results[row];
      r.member = static_cast<std::int64_t>(members.members().size());
      members.add(r);
      source_of.push_back(source);
      if (!is_valid(r.outcome)) continue;
      ++s.valid;
      s.touched = s.touched.n_cells() == 0  ? r.window
                  : r.window.n_cells() == 0 ? s.touched
                                            : joined(s.touched, r.window);
      source_of_valid.push_back(source);
      row_of_valid.push_back(static_cast<std::int64_t>(row));
    }
    sources.push_back(s);
  }
  RegionMembers region() const { return {members, sources, source_of_valid, row_of_valid, n_rows}; }
  LayerStack maps(SourceLists* lists = nullptr, std::size_t memory = std::size_t{1} << 20) const {
    StackSink sink;
    RegionContext context;
    context.memory_bytes = memory;
    const std::vector<double> quantiles{0.1, 0.5, 1};
    SourceLists made = make_region_maps(region(), quantiles, context, sink);
    if (lists != nullptr) *lists = std::move(made);
    return std::move(sink.stack);
  }

  std::int64_t n_rows = 4;
  MemoryMembers members;
  std::vector<RegionSource> sources;
  std::vector<std::uint32_t> source_of, source_of_valid;
  std::vector<std::int64_t> row_of_valid;
};

MadeUp random_region(const Grid& grid, int n_sources) {
  std::mt19937 random(7);
  MadeUp made(grid);
  for (int s = 0; s < n_sources; ++s) {
    std::vector<MemberResult> results;
    for (int k = 0; k < made.n_rows; ++k) {
      results.push_back(random_member(k, grid, random));
      // Some cells hold a tail of thickness where nothing arrived.
      for (std::size_t c = 0; c < results.back().window.n_cells(); c += 5)
        results.back().layer(PeakLayer::arrival)[c] = nan_f;
      if (s == 2 || (s == 1 && k == 3)) results.back().outcome = Outcome::diverged;
    }
    made.add_source("source " + std::to_string(s), results);
  }
  return made;
}

/// What the rules say of one cell, member by member.
struct Naive {
  double highest = 0, none = 1, expected = 0, rows = 0;
  double not_lower = 1, not_upper = 1;  // of any hit
  ProbabilityBounds any, any_rows;
  int number = 0;
  std::vector<SourceHit> hits;
  double peak[3] = {};  // quantiles 0.1, 0.5, 1 of energy [kJ m-2]

  Naive(const MadeUp& made, int row, int col) {
    std::set<std::int64_t> hit_rows, valid_rows;
    bool all_come = true;
    for (std::size_t s = 0; s < made.sources.size(); ++s) {
      int n = 0, hits_here = 0;
      std::vector<double> energy;
      for (std::size_t i = 0, of = 0; i < made.source_of.size(); ++i) {
        of = i > 0 && made.source_of[i] == made.source_of[i - 1] ? of + 1 : 0;
        if (made.source_of[i] != s || !is_valid(made.members.members()[i].outcome)) continue;
        ++n;
        valid_rows.insert(static_cast<std::int64_t>(of));
        energy.push_back(made.members.value(i, PeakLayer::energy, row, col));
        if (std::isnan(made.members.value(i, PeakLayer::arrival, row, col))) continue;
        ++hits_here;
        hit_rows.insert(static_cast<std::int64_t>(of));
      }
      if (n == 0) continue;
      const double p = static_cast<double>(hits_here) / n;
      highest = std::max(highest, p);
      none *= 1 - p;
      expected += p;
      number += hits_here > 0;
      const ProbabilityBounds bounds = wilson_interval(hits_here, n, z_90);
      if (p > 0) not_lower *= 1 - bounds.lower, not_upper *= 1 - bounds.upper;
      all_come &= p > 0;
      if (p > 0) hits.push_back({static_cast<std::uint32_t>(s), static_cast<float>(p)});
      std::sort(energy.begin(), energy.end());
      const double levels[] = {0.1, 0.5, 1};
      for (int q = 0; q < 3; ++q) {
        const double place = levels[q] * (n - 1);
        const auto below = static_cast<std::size_t>(place);
        const auto above = std::min<std::size_t>(below + 1, energy.size() - 1);
        peak[q] = std::max(peak[q], 1e-3 * (energy[below] + (place - static_cast<double>(below)) *
                                                                (energy[above] - energy[below])));
      }
    }
    rows = static_cast<double>(hit_rows.size()) / static_cast<double>(valid_rows.size());
    const auto n_rows = static_cast<std::int64_t>(valid_rows.size());
    if (!all_come) not_upper *= 1 - wilson_interval(0, n_rows, z_90).upper;
    any = {1 - not_lower, 1 - not_upper};
    any_rows = wilson_interval(static_cast<std::int64_t>(hit_rows.size()), n_rows, z_90);
  }
};

float value(const LayerStack& maps, const char* name, int row, int col, std::size_t plane = 0) {
  const Layer* layer = maps.find(name);
  EXPECT_NE(layer, nullptr) << name;
  return layer == nullptr ? nan_f
                          : layer->values[plane * maps.grid.n_cells() + maps.grid.index(row, col)];
}

TEST(RegionMaps, AreSumsOverSources) {
  const MadeUp made = random_region(small_grid(23, 31), 12);
  SourceLists lists;
  const LayerStack maps = made.maps(&lists);
  ASSERT_EQ(maps.grid.n_cells(), 23u * 31u) << "random windows reach all sides";
  int touched = 0, tied = 0;
  for (int row = 0; row < 23; ++row)
    for (int col = 0; col < 31; ++col) {
      const Naive naive(made, row, col);
      SCOPED_TRACE(testing::Message() << row << ", " << col);
      EXPECT_EQ(value(maps, "highest_probability_of_a_hit", row, col), float(naive.highest));
      EXPECT_EQ(value(maps, "probability_of_any_hit", row, col), float(1 - naive.none));
      EXPECT_EQ(value(maps, "probability_of_any_hit_shared_values", row, col), float(naive.rows));
      const std::string any = "probability_of_any_hit", rows = any + "_shared_values";
      EXPECT_NEAR(value(maps, (any + "_lower").c_str(), row, col), naive.any.lower, 1e-6);
      EXPECT_NEAR(value(maps, (any + "_upper").c_str(), row, col), naive.any.upper, 1e-6);
      EXPECT_NEAR(value(maps, (rows + "_lower").c_str(), row, col), naive.any_rows.lower, 1e-6);
      EXPECT_NEAR(value(maps, (rows + "_upper").c_str(), row, col), naive.any_rows.upper, 1e-6);
      EXPECT_EQ(value(maps, "expected_number_of_sources", row, col), float(naive.expected));
      EXPECT_EQ(value(maps, "number_of_sources", row, col), float(naive.number));
      for (std::size_t q = 0; q < 3; ++q)
        EXPECT_NEAR(value(maps, "energy_largest_quantile", row, col, q), naive.peak[q],
                    1e-6 * naive.peak[q]);
      const auto hits = lists.at(row * 31 + col);
      EXPECT_EQ(std::vector<SourceHit>(hits.begin(), hits.end()), naive.hits);
      const auto best = static_cast<std::size_t>(value(maps, "most_likely_source", row, col));
      ASSERT_EQ(best == 0, naive.hits.empty());
      if (best == 0) continue;
      ++touched;
      const auto of_best = std::find_if(hits.begin(), hits.end(),
                                        [&](const SourceHit& h) { return h.source == best - 1; });
      ASSERT_NE(of_best, hits.end());
      EXPECT_EQ(of_best->probability, float(naive.highest));
      tied += std::count_if(hits.begin(), hits.end(), [&](const SourceHit& h) {
                return h.probability == of_best->probability;
              }) > 1;
    }
  EXPECT_GT(touched, 300);
  EXPECT_GT(tied, 20) << "ties are looked at too";
  EXPECT_EQ(lists.sources.size(), 12u);
  EXPECT_TRUE(std::is_sorted(lists.cells.begin(), lists.cells.end()));
}

MemberResult one_cell(std::size_t cell, float thickness) {
  MemberResult r;
  r.outcome = Outcome::settled;
  r.grid = small_grid(4, 4);
  r.window = whole_of(r.grid);
  for (int k = 0; k < n_peak_layers; ++k)
    r.layers[k].assign(16, info(static_cast<PeakLayer>(k)).untouched);
  r.layer(PeakLayer::arrival)[cell] = 1;
  r.layer(PeakLayer::thickness)[cell] = thickness;
  return r;
}

TEST(RegionMaps, OfEquallyProbableSourcesTheThickerThenTheFirstIsTheLikeliest) {
  MadeUp made(small_grid(4, 4));
  made.n_rows = 1;
  made.add_source("a", {one_cell(5, 1)});
  made.add_source("b", {one_cell(5, 2)});
  made.add_source("c", {one_cell(5, 2)});
  const LayerStack maps = made.maps();
  EXPECT_EQ(value(maps, "most_likely_source", 1, 1), 2);
  EXPECT_EQ(value(maps, "most_likely_source", 0, 0), 0);
}

TEST(RegionMaps, SharedRowsCountOnceAndIndependentOnesDoNot) {
  MadeUp made(small_grid(4, 4));
  made.n_rows = 2;
  made.add_source("a", {one_cell(5, 1), one_cell(0, 1)});  // row 0 hits cell 5
  made.add_source("b", {one_cell(5, 1), one_cell(0, 1)});  // so does it here
  made.add_source("c", {one_cell(0, 1), one_cell(5, 1)});
  const LayerStack maps = made.maps();
  EXPECT_EQ(value(maps, "probability_of_any_hit", 1, 1), 0.875F) << "1 - 0.5^3";
  EXPECT_EQ(value(maps, "probability_of_any_hit_shared_values", 1, 1), 1) << "each row has a hit";
  EXPECT_EQ(value(maps, "probability_of_any_hit_shared_values", 0, 0), 1);
}

TEST(RegionMaps, MemoryLeavesNoTrace) {
  const MadeUp made = random_region(small_grid(150, 140), 4);
  SourceLists much, little;
  const std::uint64_t hash = hash_of(made.maps(&much));
  EXPECT_EQ(hash_of(made.maps(&little, 4096)), hash);
  EXPECT_EQ(much.cells, little.cells);
  EXPECT_EQ(much.hits, little.hits);
  EXPECT_EQ(much.begin, little.begin);
}

TEST(RegionMaps, BlocksThatNoSourceTouchedAreMissing) {
  const Grid grid = small_grid(600, 600);
  const auto far = [&](int row, int col) {
    MemberResult r = one_cell(5, 1);
    r.grid = grid;
    r.window = {row, col, 4, 4};
    return r;
  };
  MadeUp made(grid);
  made.n_rows = 1;
  made.add_source("north-west", {far(10, 10)});
  made.add_source("south-east", {far(580, 580)});
  const LayerStack maps = made.maps();
  EXPECT_EQ(value(maps, "number_of_sources", 0, 0), 0) << "a cell near a source, not reached";
  EXPECT_TRUE(std::isnan(value(maps, "number_of_sources", 300, 300)));
}

TEST(RegionMaps, SayWhoseTheyAre) {
  const MadeUp made = random_region(small_grid(9, 9), 3);
  const LayerStack maps = made.maps();
  const Layer* likeliest = maps.find("most_likely_source");
  ASSERT_NE(likeliest, nullptr);
  EXPECT_THAT(likeliest->classes, ElementsAre(LayerClass{1, "source 0"}, LayerClass{2, "source 1"},
                                              LayerClass{3, "source 2"}));
  std::string attributes;
  for (const auto& [name, text] : maps.attributes) attributes += name + "=" + text + "\n";
  EXPECT_THAT(attributes, HasSubstr("number_of_sources_without_valid_members=1"));
  EXPECT_THAT(attributes, HasSubstr("hold if the sources release"));
}

}  // namespace
}  // namespace sturz::test
