// SPDX-License-Identifier: Apache-2.0
/// Order of members, shards, tile size: nothing of it may show in a single bit of the map.
#include "engine/core/error.hpp"
#include "ensemble/hazard/convergence.hpp"
#include "ensemble/hazard/hazard_map.hpp"
#include "ensemble/hazard/member_tiles.hpp"
#include "ensemble/hazard/stack_hash.hpp"
#include "tests/support/memory_members.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

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
                       std::size_t memory_limit_bytes) {
  MemoryMembers source(grid);
  for (const MemberResult& r : results) source.add(r);
  return hash_of(
      make_hazard_map(source, {}, {.memory_limit_bytes = memory_limit_bytes, .attributes = {}}));
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

TEST(HazardMapBits, DoNotDependOnTheSizeOfTiles) {
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

TEST(MemberTiles, CoverTheTouchedCellsOnceWithinTheMemory) {
  const Grid grid = small_grid(11, 17);
  MemoryMembers source(grid);
  for (const MemberResult& r : members(grid)) source.add(r);
  for (const std::size_t limit : {1U, 1000U, 6000U, 1000000U}) {
    const MemberTiles tiles(source, limit, 3);
    std::vector<int> covered(grid.n_cells(), 0);
    for (const Window& t : tiles.tiles()) {
      EXPECT_TRUE(t.n_cells() == 1 || t.n_cells() * tiles.n_members() * 3 * 4 <= limit);
      for (int row = t.row0; row < t.row0 + t.n_rows; ++row)
        for (int col = t.col0; col < t.col0 + t.n_cols; ++col) ++covered[grid.index(row, col)];
    }
    const Window& w = tiles.touched();
    for (int row = 0; row < grid.n_rows; ++row)
      for (int col = 0; col < grid.n_cols; ++col) {
        const bool inside =
            row >= w.row0 && row < w.row0 + w.n_rows && col >= w.col0 && col < w.col0 + w.n_cols;
        EXPECT_EQ(covered[grid.index(row, col)], inside ? 1 : 0);
      }
  }
}

TEST(MemberTiles, RefuseAMemberThatOccursTwice) {
  const Grid grid = small_grid(4, 4);
  std::mt19937 random(1);
  MemoryMembers source(grid);
  source.add(random_member(3, grid, random));
  source.add(random_member(3, grid, random));
  EXPECT_THROW(MemberTiles(source, 1000, 1), SetupError);
}

}  // namespace
}  // namespace sturz
