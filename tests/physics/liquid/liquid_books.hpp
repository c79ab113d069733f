// SPDX-License-Identifier: Apache-2.0
/// What every run of a liquid must keep, and how fine it is asked for.
#pragma once

#include "engine/effects/fields.hpp"
#include "engine/simulation/parts.hpp"
#include "tests/physics/verification.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <initializer_list>
#include <string>
#include <vector>

namespace sturz::test {

/// V20 and S4: a named outcome, mass to rounding, nothing under the ground, energy accounted for
/// within 1 %, numerical work bounded. Pair forces without net impulse along `free_axes`, those
/// that no wall's normal has a part in: walls push back in the pair loop itself.
inline void expect_liquid_books(const std::string& name, const Finished& f,
                                std::initializer_list<int> free_axes) {
  const Ledger ledger = f.simulation.parts().state.ledger();
  EXPECT_TRUE(is_valid(f.result.outcome)) << to_string(f.result.outcome) << f.result.reason;
  EXPECT_LE(std::abs(f.result.scalars.mass_error), 1e-13) << name;
  EXPECT_EQ(ledger.leaked_mass, 0) << name;
  EXPECT_LE(std::abs(f.result.scalars.energy_residual), 0.01) << name;
  for (const int axis : free_axes)
    EXPECT_LE(std::abs(ledger.stress_impulse[axis]), 1e-6 * ledger.stress_impulse_scale) << name;
  expect_numerical_bounded(name, f);
}

/// -tr(sigma)/3 of particle i [Pa].
inline double pressure_of(const ParticleSet& p, std::size_t i) {
  const auto& t = p.components(fields::stress);
  return -(t[0][i] + t[1][i] + t[2][i]) / 3;
}

/// The resolutions of a case; with STURZ_LIQUID_FINE set those of docs/studies/liquid.md, too.
inline std::vector<int> resolutions(std::vector<int> usual, std::initializer_list<int> finer) {
  if (std::getenv("STURZ_LIQUID_FINE")) usual.insert(usual.end(), finer);
  return usual;
}

}  // namespace sturz::test
