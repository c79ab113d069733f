// SPDX-License-Identifier: Apache-2.0
/// What leaves the ground or sinks under it: accounted once, and no other account changes.
#include "tests/support/hand_made.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace sturz {
namespace {

using test::block;
using test::even_ground;

double total(const std::vector<double>& v) { return std::accumulate(v.begin(), v.end(), 0.0); }

/// d(kinetic) that the accounted works do not explain, see Ledger [J].
double unexplained(const Ledger& ledger) {
  return ledger.kinetic - ledger.kinetic_0 - ledger.gravity_work - ledger.stress_work -
         ledger.contact_work + ledger.friction + ledger.rest_damping + ledger.lost_energy;
}

TEST(Losses, MassThatLeavesIsAccountedForExactly) {
  auto made = test::grains_on(even_ground(16), block({6, 5, 3}, {1, -2, 0}), {9, 0, 0});
  for (int n = 0; n < 600 && made.state.grains().size() > 0; ++n) {
    made.advance();
    const Ledger& ledger = made.state.grains().ledger;
    ASSERT_EQ(total(made.state.grains().mass) + ledger.lost_mass, ledger.released_mass);
  }
  EXPECT_GT(made.state.grains().ledger.lost_mass, 0);
  EXPECT_EQ(made.state.grains().ledger.leaked_mass, 0);
  EXPECT_GE(made.state.grains().ax.size(), made.state.grains().size());
}

TEST(Losses, AccelerationsFollowTheirParticles) {
  // Works are accounted after the removal: each with the acceleration of its particle.
  auto made = test::particles_on(even_ground(16), {{20, 0, 5}, {0, 0, 5}, {30, 0, 5}, {3, 0, 5}},
                                 {0, 0, 0});
  made.state.grains().ax = {1, 2, 3, 4};
  made.advance();
  EXPECT_EQ(made.state.grains().id, (std::vector<std::uint32_t>{1, 3}));
  EXPECT_EQ(made.state.grains().ax, (std::vector<float>{2, 4}));
}

TEST(Losses, KineticEnergyChangesOnlyByAccountedWorks) {
  auto made = test::grains_on(even_ground(16), block({6, 5, 3}, {1, -2, 0}), {9, 0, 0});
  double worst = 0;
  for (int n = 0; n < 600 && made.state.grains().size() > 0; ++n) {
    made.advance();
    worst = std::max(worst, std::abs(unexplained(made.state.grains().ledger)));
  }
  EXPECT_GT(made.state.grains().ledger.lost_mass, 0);
  EXPECT_LT(worst, 1e-3 * made.state.grains().ledger.kinetic_0);
}

TEST(Losses, StoredAndKineticEnergyLeaveWithTheirParticle) {
  // Thrown over the domain boundary, never touching: what the ledger loses is what the particles
  // had.
  auto made = test::grains_on(even_ground(16), block({2, 2, 2}, {7, 0, 30}), {20, 0, 0});
  Ledger& ledger = made.state.grains().ledger;
  double kinetic = 0, elastic = 0;
  for (int n = 0; n < 200 && ledger.lost_mass == 0; ++n) {
    kinetic = ledger.kinetic;
    elastic = ledger.elastic;
    made.advance();
  }
  ASSERT_GT(ledger.lost_mass, 0);
  const double gone = kinetic - ledger.kinetic + elastic - ledger.elastic;
  EXPECT_NEAR(ledger.lost_energy, gone, 0.01 * gone);
}

TEST(Losses, ElasticEnergyIsAccountedForWhenItsParticleLeaves) {
  auto made = test::grains_on(even_ground(16), {{20, 0, 5}, {0, 0, 5}}, {0, 0, 0});
  Ledger& ledger = made.state.grains().ledger;
  const double each = 0.5 * ledger.elastic_0;  // both start under the load of half a metre
  ASSERT_GT(each, 0);
  made.advance();
  ASSERT_EQ(made.state.grains().size(), 1u);
  EXPECT_NEAR(ledger.lost_energy, each, 1e-6 * each);
  EXPECT_NEAR(ledger.elastic, each, 1e-6 * each);
}

TEST(Losses, WhatSinksUnderTheGroundIsRemovedOnceWhateverTheBoundary) {
  for (NodataRule rule : {NodataRule::outflow, NodataRule::wall}) {
    auto positions = block({2, 2, 1});
    positions.emplace_back(-3, -3, -2.5);  // two and a half spacings under the ground
    auto made = test::particles_on(even_ground(16, 0, rule), positions, {0, 0, 0});
    for (int n = 0; n < 20; ++n) made.advance();
    EXPECT_EQ(made.state.grains().size(), 4u);
    EXPECT_EQ(made.state.grains().ledger.leaked_mass, 1560);
    EXPECT_EQ(made.state.grains().ledger.lost_mass, 1560);
  }
}

TEST(Losses, AWalledBoundaryHoldsTheMass) {
  auto made = test::grains_on(even_ground(16, 0, NodataRule::wall), block({6, 5, 3}, {1, -2, 0}),
                              {9, 2, 0});
  for (int n = 0; n < 300; ++n) made.advance();
  EXPECT_EQ(made.state.grains().size(), 90u);
  EXPECT_EQ(made.state.grains().ledger.lost_mass, 0);
  EXPECT_GT(made.state.grains().ledger.lost_energy, 0);
  for (double x : made.state.grains().x) EXPECT_LE(x, 7.5);
  EXPECT_LT(std::abs(unexplained(made.state.grains().ledger)),
            5e-3 * made.state.grains().ledger.kinetic_0);
}

TEST(Losses, AnEmptyGroundStaysQuiet) {
  auto made = test::particles_on(even_ground(16), {{7, 0, 0.5}}, {20, 0, 0});
  for (int n = 0; n < 50; ++n) made.step.apply(made.state, 0.01);
  EXPECT_EQ(made.state.grains().size(), 0u);
  EXPECT_EQ(made.state.grains().motion.max_speed, 0);
  EXPECT_TRUE(made.state.grains().motion.finite);
}

}  // namespace
}  // namespace sturz
