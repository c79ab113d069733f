// SPDX-License-Identifier: Apache-2.0
/// What every run of grains in a liquid must keep, and means over its layers.
#pragma once

#include "engine/effects/fields.hpp"
#include "tests/physics/verification.hpp"
#include "tests/support/liquid/immersed_grains.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace sturz::test {

/// V20 and S4 for both sets together: every mass to rounding, nothing under the ground, numbers
/// finite, energy accounted for within 1 % of what was set free, numerical work between its bounds.
/// The liquid's pair forces are those of the mixture, so no set has a balance of its own.
inline void expect_coupled_books(const std::string& name, const State& s) {
  for (const MovingSet& p : s.sets) {
    double mass = 0;
    for (std::size_t i = 0; i < p.size(); ++i) {
      mass += p.mass[i];
      ASSERT_TRUE(std::isfinite(p.x[i] + p.y[i] + p.z[i] + p.vx[i] + p.vy[i] + p.vz[i])) << name;
    }
    EXPECT_LE(std::abs(mass + p.ledger.lost_mass - p.ledger.released_mass),
              1e-13 * p.ledger.released_mass)
        << name << " " << p.name;
    EXPECT_EQ(p.ledger.leaked_mass, 0) << name << " " << p.name;
  }
  const Ledger both = s.ledger();
  const double released = both.released_energy();
  EXPECT_LE(std::abs(both.residual()), 0.01 * released) << name;
  const double numerical = both.numerical() / released;
  expect_within({name + ", numerical", "work / released", numerical, 0, numerical,
                 numerical < 0 ? -least_numerical : largest_numerical});
}

/// -tr(sigma)/3 of particle i [Pa].
inline double pressure_of(const ParticleSet& p, std::size_t i) {
  const auto& t = p.components(fields::stress);
  return -(t[0][i] + t[1][i] + t[2][i]) / 3;
}

/// Runs to `end` [s].
inline void advance_to(HandMade& made, double end) {
  while (made.state.time < end) made.advance();
}

}  // namespace sturz::test
