// SPDX-License-Identifier: Apache-2.0
/// Order of members, shards, tile size: nothing of it may show in a single bit of the map.
#include "engine/core/error.hpp"
#include "ensemble/hazard/convergence.hpp"
#include "ensemble/hazard/hazard_map.hpp"
#include "ensemble/hazard/member_cells.hpp"
#include "ensemble/hazard/stack_hash.hpp"
#include "tests/support/memory_members.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>

namespace sturz {
namespace {

using test::MemoryMembers;
using test::random_member;
using test::small_grid;

/// Members with numbers that make floating-point sums depend on their order.
std::vector<MemberResult> members(const Grid& grid) {
  std::mt19937 random(77);
  std::lognormal_distribution<float> factor(0, 3);
  std::vector<MemberResult> result;
  for (int m = 0; m < 25; ++m) {
    result.push_back(random_member(m, grid, random));
    for (auto& layer : result.back().layers)
      for (float& v : layer) v *= factor(random);
    if (m % 8 == 3) result.back().outcome = Outcome::diverged;
  }
  return result;
}

std::uint64_t map_hash(const Grid& grid, const std::vector<MemberResult>& results,
                       std::size_t memory_bytes) {
  MemoryMembers source(grid);
  for (const MemberResult& r : results) source.add(r);
  HazardContext context;
  context.memory_bytes = memory_bytes;
  return hash_of(make_hazard_map(source, {}, context));
}

TEST(HazardMapBits, DoNotDependOnTheOrderOfMembers) {
  const Grid grid = small_grid(11, 17);
  std::vector<MemberResult> results = members(grid);
  const std::uint64_t hash = map_hash(grid, results, 1 << 20);
  std::mt19937 random(5);
  for (int round = 0; round < 10; ++round) {
    std::shuffle(results.begin(), results.end(), random);
    EXPECT_EQ(map_hash(grid, results, 1 << 20), hash);
  }
  results[0].layer(PeakLayer::thickness).assign(results[0].window.n_cells(), 3.5F);
  results[0].outcome = Outcome::settled;
  EXPECT_NE(map_hash(grid, results, 1 << 20), hash) << "the hash sees nothing";
}

TEST(HazardMapBits, DoNotDependOnTheMemory) {
  const Grid grid = small_grid(11, 17);
  const std::vector<MemberResult> results = members(grid);
  const std::uint64_t hash = map_hash(grid, results, std::size_t{1} << 30);
  for (const std::size_t limit : {1U, 300U, 1500U, 4000U, 5000U, 20000U})
    EXPECT_EQ(map_hash(grid, results, limit), hash) << limit << " bytes";
}

TEST(HazardMapBits, DoNotDependOnFailedMembers) {
  const Grid grid = small_grid(11, 17);
  std::vector<MemberResult> results = members(grid);
  const std::uint64_t hash = map_hash(grid, results, 1 << 20);
  std::erase_if(results, [](const MemberResult& r) { return !is_valid(r.outcome); });
  EXPECT_EQ(map_hash(grid, results, 1 << 20), hash);
}

/// Members on 300 x 290 cells: several blocks in both directions.
MemoryMembers many_blocks(int n_members) {
  const Grid grid = small_grid(300, 290);
  MemoryMembers source(grid);
  std::mt19937 random(11);
  for (int m = 0; m < n_members; ++m) {
    MemberResult r = random_member(m, grid, random);
    r.outcome = m % 5 == 4 ? Outcome::failed : Outcome::settled;
    source.add(r);
  }
  return source;
}

TEST(HazardMapBits, DoNotDependOnTheMemoryOverManyBlocks) {
  const MemoryMembers source = many_blocks(12);
  HazardContext context;
  const std::uint64_t hash = hash_of(make_hazard_map(source, {}, context));
  for (const std::size_t limit : {1U << 14, 1U << 17, 1U << 20, 1U << 22}) {
    context.memory_bytes = limit;
    EXPECT_EQ(hash_of(make_hazard_map(source, {}, context)), hash) << limit << " bytes";
  }
}

TEST(MemberCells, HandOutEveryCellOnceWithWhatMembersLeft) {
  const MemoryMembers source = many_blocks(9);
  const MemberCells cells(source);
  ASSERT_EQ(cells.n_members(), 8U);
  const Window extent{1, 2, 298, 285};
  for (const std::size_t limit : {std::size_t{1}, std::size_t{1} << 15, std::size_t{1} << 30}) {
    std::vector<int> seen(source.grid().n_cells(), 0);
    cells.visit(
        extent, {PeakLayer::speed, PeakLayer::arrival}, limit, {}, [&](const CellRows& rows) {
          for (std::size_t i = 0; i < rows.window.n_cells(); ++i) {
            const int row = rows.window.row0 + static_cast<int>(i) / rows.window.n_cols;
            const int col = rows.window.col0 + static_cast<int>(i) % rows.window.n_cols;
            ++seen[source.grid().index(row, col)];
            const auto speeds = rows.of(PeakLayer::speed, i);
            std::vector<float> expected;
            for (std::size_t m = 0; m < source.members().size(); ++m) {
              if (!is_valid(source.members()[m].outcome)) continue;
              const float v = source.value(m, PeakLayer::speed, row, col);
              if (v != 0 || !std::isnan(source.value(m, PeakLayer::arrival, row, col)))
                expected.push_back(v);
            }
            EXPECT_TRUE(std::equal(speeds.begin(), speeds.end(), expected.begin(), expected.end()));
          }
        });
    for (int row = 0; row < source.grid().n_rows; ++row)
      for (int col = 0; col < source.grid().n_cols; ++col)
        EXPECT_EQ(seen[source.grid().index(row, col)],
                  row >= 1 && row < 299 && col >= 2 && col < 287 ? 1 : 0);
  }
}

TEST(MemberCells, OpenEveryMemberOnceWhereMemoryHoldsAll) {
  const MemoryMembers source = many_blocks(10);
  const MemberCells cells(source);
  cells.visit(cells.touched(), {PeakLayer::arrival, PeakLayer::speed}, std::size_t{1} << 30, {},
              [](const CellRows&) {});
  EXPECT_EQ(source.turns(), 8) << "the reader went back to a member it had left";
}

TEST(MemberCells, StopWhenTold) {
  const MemoryMembers source = many_blocks(3);
  const MemberCells cells(source);
  const std::atomic<bool> stop{true};
  EXPECT_THROW(cells.visit(cells.touched(), {PeakLayer::arrival}, 1 << 20, stop,
                           [](const CellRows&) { ADD_FAILURE() << "went on"; }),
               Cancelled);
}

TEST(MemberCells, RefuseAMemberThatOccursTwice) {
  const Grid grid = small_grid(4, 4);
  std::mt19937 random(1);
  MemoryMembers source(grid);
  source.add(random_member(3, grid, random));
  source.add(random_member(3, grid, random));
  EXPECT_THROW(MemberCells{source}, SetupError);
}

}  // namespace
}  // namespace sturz
