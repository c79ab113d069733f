// SPDX-License-Identifier: Apache-2.0
#include "ensemble/sensitivity/index_maps.hpp"

#include "ensemble/sampling/structured_cube.hpp"
#include "ensemble/sensitivity/sobol_indices.hpp"
#include "tests/support/memory_members.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

namespace sturz {
namespace {

using test::MemoryMembers;
using test::small_grid;
using Cube = std::vector<std::vector<double>>;

std::vector<Exceeds> rows_of(const Cube& cube,
                             const std::function<bool(const std::vector<double>&)>& hit) {
  std::vector<Exceeds> rows;
  for (const auto& u : cube) rows.push_back(hit(u) ? Exceeds::yes : Exceeds::no);
  return rows;
}

bool friction_decides(const std::vector<double>& u) { return u[0] > 0.5; }
bool only_together(const std::vector<double>& u) { return (u[0] > 0.5) != (u[1] > 0.5); }
bool mostly_friction(const std::vector<double>& u) { return u[0] + 0.3 * u[1] > 0.7; }

TEST(CellIndices, OfAValueThatDecidesAloneAreOne) {
  const Cube cube = saltelli_cube(1024, 2, 5);
  const CellIndices found = cell_indices(rows_of(cube, friction_decides), 2);
  EXPECT_EQ(found.n_sets, 256);
  EXPECT_NEAR(found.first[0].value, 1, 1e-12);
  EXPECT_NEAR(found.total[1].value, 0, 1e-12);
  EXPECT_NEAR(found.total[0].value, 1, 0.15);
  EXPECT_NEAR(found.first[1].value, 0, 0.15);
  // All sets agree, and are too few to say so for ever.
  EXPECT_GT(found.first[0].lower, 0.95);
  EXPECT_LT(found.first[0].lower, 0.992);
  EXPECT_EQ(found.first[0].upper, 1);
  EXPECT_GT(found.total[1].upper, 0.008);
}

/// Three sets of two hundred hit, all by friction: they agree, and that says next to nothing.
TEST(CellIndices, OfCellsThatAFewSetsReachAreNotKnown) {
  const auto of_hits = [](std::size_t hits) {
    std::vector<Exceeds> rows(800, Exceeds::no);
    for (std::size_t set = 0; set < hits; ++set)
      rows[4 * set + 1] = rows[4 * set + 2] = Exceeds::yes;  // b, and the mixed one of value 0
    return cell_indices(rows, 2);
  };
  EXPECT_TRUE(std::isnan(of_hits(3).first[0].value));
  EXPECT_TRUE(std::isnan(of_hits(3).first[0].lower));
  EXPECT_TRUE(std::isnan(of_hits(7).first[0].value));
  EXPECT_EQ(of_hits(8).first[0].value, 1);
  EXPECT_LT(of_hits(8).first[0].lower, of_hits(100).first[0].lower);
  EXPECT_TRUE(std::isnan(of_hits(193).first[0].value)) << "seven sets that say no";
}

TEST(CellIndices, OfValuesThatDecideTogetherAreJoint) {
  const Cube cube = saltelli_cube(2048, 2, 5);
  const CellIndices found = cell_indices(rows_of(cube, only_together), 2);
  for (int k = 0; k < 2; ++k) {
    EXPECT_NEAR(found.first[k].value, 0, 0.1);
    EXPECT_NEAR(found.total[k].value, 1, 0.1);
    EXPECT_LT(found.first[k].lower, 0);
    EXPECT_GT(found.total[k].upper, 1);
  }
}

TEST(CellIndices, AreMartinezEstimates) {
  const Cube cube = saltelli_cube(1200, 2, 9);
  const auto rows = rows_of(cube, mostly_friction);
  std::vector<Observation> results;
  for (const Exceeds e : rows) results.push_back({e == Exceeds::yes ? 1.0 : 0.0, Known::exactly});
  const auto expected = sobol_indices(cube, results);
  ASSERT_TRUE(expected.has_value());
  const CellIndices found = cell_indices(rows, 2);
  for (int k = 0; k < 2; ++k) {
    EXPECT_NEAR(found.first[k].value, expected->first[k].value, 1e-9);
    EXPECT_NEAR(found.total[k].value, expected->total[k].value, 1e-9);
    const double z = std::atanh(found.first[k].value), wide = 1.959963984540054 / std::sqrt(297.0);
    EXPECT_NEAR(found.first[k].lower, std::tanh(z - wide), 1e-12);
    EXPECT_NEAR(found.first[k].upper, std::tanh(z + wide), 1e-12);
  }
}

TEST(CellIndices, LeaveOutSetsThatAreNotKnownAndSayNothingOfFew) {
  const Cube cube = saltelli_cube(163, 2, 9);  // 40 sets of four, and one that is not whole
  auto rows = rows_of(cube, mostly_friction);
  rows[30] = rows[44] = Exceeds::not_known;
  EXPECT_EQ(cell_indices(rows, 2).n_sets, 38);
  const CellIndices few = cell_indices(std::span(rows).first(28), 2);
  EXPECT_EQ(few.n_sets, 7);
  EXPECT_TRUE(std::isnan(few.first[0].value));
  const std::vector<Exceeds> always(160, Exceeds::yes);
  EXPECT_TRUE(std::isnan(cell_indices(always, 2).total[0].value));
}

TEST(IndexMaps, HoldTheIndicesOfEachCell) {
  const Cube cube = saltelli_cube(256, 2, 5);
  MemoryMembers members(small_grid(1, 3));
  for (std::size_t i = 0; i < cube.size(); ++i) {
    MemberResult m;
    m.member = static_cast<std::int64_t>(i);
    m.outcome = i == 9 ? Outcome::failed : Outcome::settled;
    m.grid = members.grid();
    m.window = {0, 0, 1, 3};
    for (int k = 0; k < n_peak_layers; ++k)
      m.layers[k].assign(3, info(static_cast<PeakLayer>(k)).untouched);
    const bool hits[] = {friction_decides(cube[i]), only_together(cube[i]), true};
    for (int cell = 0; cell < 3; ++cell)
      if (hits[cell]) m.layer(PeakLayer::arrival)[cell] = 5;
    m.layer(PeakLayer::thickness)[0] = hits[1] ? 2.0F : 0.5F;
    members.add(m);
  }
  IndexMapRequest request;
  request.keys = {"basal.friction_coefficient", "basal.zones[0].xi_m_s2"};
  request.n_rows = static_cast<std::int64_t>(cube.size());
  request.thickness_m = {1, 3};
  StackSink sink;
  make_index_maps(members, request, sink);
  const auto at = [&](const std::string& name, std::size_t cell, std::size_t plane = 0) {
    const Layer* layer = sink.stack.find(name);
    EXPECT_NE(layer, nullptr) << name;
    return layer == nullptr ? nan_f : layer->values[plane * 3 + cell];
  };
  EXPECT_EQ(at("sobol_sets_of_reach", 0), 63);  // one set has the failed member
  EXPECT_FLOAT_EQ(at("sobol_first_basal_friction_coefficient_of_reach", 0), 1);
  EXPECT_NEAR(at("sobol_total_basal_zones_0__xi_m_s2_of_reach", 0), 0, 1e-6);
  EXPECT_NEAR(at("sobol_total_basal_zones_0__xi_m_s2_of_reach", 1), 1, 0.3);
  EXPECT_TRUE(std::isnan(at("sobol_first_basal_friction_coefficient_of_reach", 2)));
  // Thickness above 1 m in the first cell is the joint one; nothing exceeds 3 m.
  EXPECT_FLOAT_EQ(at("sobol_total_basal_friction_coefficient_of_thickness_exceedance", 0, 0),
                  at("sobol_total_basal_friction_coefficient_of_reach", 1));
  EXPECT_TRUE(
      std::isnan(at("sobol_total_basal_friction_coefficient_of_thickness_exceedance", 0, 1)));
}

}  // namespace
}  // namespace sturz
