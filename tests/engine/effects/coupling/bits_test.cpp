// SPDX-License-Identifier: Apache-2.0
// The same bits at any number of threads and in any storage order.
#include "engine/effects/fields.hpp"
#include "tests/engine/effects/coupling/coupled_sets.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace sturz::test {
namespace {

/// Position and velocity of all particles by id, and the liquid's fields.
std::vector<double> by_id(const CoupledSets& made) {
  std::vector<double> out;
  for (const MovingSet& p : made.state.sets) {
    std::vector<double> values(8 * p.size(), 0);
    const Field *share = p.find(fields::grain_share), *slip = p.find(fields::slip_divergence);
    for (std::size_t i = 0; i < p.size(); ++i) {
      double* at = &values[std::size_t{8} * p.id[i]];
      at[0] = p.x[i], at[1] = p.y[i], at[2] = p.z[i];
      at[3] = p.vx[i], at[4] = p.vy[i], at[5] = p.vz[i];
      if (share) at[6] = share->component[0][i], at[7] = slip->component[0][i];
    }
    out.insert(out.end(), values.begin(), values.end());
  }
  return out;
}

std::vector<double> run(int threads, bool shuffled, const Domain& domain) {
  auto sets = full_pores(14, 0.25);
  sets[0].velocity = {3, 1, 0};
  sets[1].n[0] = 10;
  CoupledSets made = coupled_sets(sets[0], sets[1], domain, {}, threads);
  for (MovingSet& p : made.state.sets)
    for (std::size_t i = 0; i < p.size(); ++i) p.vz[i] = std::sin(p.x[i] + 2 * p.y[i]);
  for (int n = 0; n < 8; ++n) {
    if (shuffled && n % 2 == 0)
      for (MovingSet& p : made.state.sets) shuffle(p, 10 + n);
    made.step.apply(made.state, 0.02);
  }
  return by_id(made);
}

TEST(CouplingBits, AreTheSameAtAnyNumberOfThreads) {
  const std::vector<double> one = run(1, false, periodic_box(14));
  EXPECT_EQ(run(2, false, periodic_box(14)), one);
  EXPECT_EQ(run(4, false, periodic_box(14)), one);
}

TEST(CouplingBits, DoNotKnowTheStorageOrder) {
  const std::vector<double> one = run(1, false, {});
  EXPECT_EQ(run(2, true, {}), one);
}

}  // namespace
}  // namespace sturz::test
