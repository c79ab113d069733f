// SPDX-License-Identifier: Apache-2.0
// Depth-averaged members from the corners of the scenario on ground that wants to break them. No
// NaN, no column lost but over the domain boundary, the ledger closed, no speed from nowhere.
// STURZ_HARD_MEMBERS=500 runs as many; the usual number is for every change.
#include "engine/core/constants.hpp"
#include "engine/effects/fields.hpp"
#include "engine/simulation/parts.hpp"
#include "scenarios/assembly/assemble.hpp"
#include "tests/hard/steep_ground.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

namespace sturz::test {
namespace {

/// Height that the mass can have fallen, with what its own thickness and start speed add [m].
double head(const Scenario& s, const SimulationParts& parts, const Raster<double>& ground) {
  const auto [low, high] = std::minmax_element(ground.values.begin(), ground.values.end());
  double thickest = 0;
  for (double h : parts.state.grains().scalar(fields::thickness)) thickest = std::max(thickest, h);
  const auto& v = s.release.velocity_m_s;
  return *high - *low + thickest + (v[0] * v[0] + v[1] * v[1]) / 19.62;
}

bool is_finite(const ParticleSet& p) {
  for (std::size_t i = 0; i < p.size(); ++i)
    if (!std::isfinite(p.x[i] + p.y[i] + p.z[i] + p.vx[i] + p.vy[i] + p.vz[i])) return false;
  return true;
}

TEST(SteepGround, ColumnsSurviveEveryCorner) {
  const int n = hard_members(60);
  std::map<std::string, int> outcomes;
  double worst_residual = 0, worst_mass = 0, worst_speed = 0, worst_dt = 1e300, seconds = 0;
  for (int k = 0; k < n; ++k) {
    SCOPED_TRACE(fmt::format("member {}", k));
    const HardMember m = hard_member(static_cast<std::uint64_t>(k));
    Simulation simulation = assemble(m.scenario, m.inputs, k, 1);
    const double most =
        std::sqrt(2 * standard_gravity * head(m.scenario, simulation.parts(), *m.inputs.elevation));
    const MemberResult r = simulation.run();
    ++outcomes[std::string(to_string(r.outcome))];
    const MemberScalars& s = r.scalars;
    const Ledger& ledger = simulation.parts().state.grains().ledger;
    EXPECT_TRUE(is_valid(r.outcome)) << to_string(r.outcome) << ": " << r.reason;
    EXPECT_TRUE(is_finite(simulation.parts().state.grains()));
    EXPECT_LE(std::abs(s.mass_error), 1e-12);
    EXPECT_EQ(ledger.leaked_mass, 0);
    if (m.scenario.terrain.nodata == TerrainEdge::wall) {
      EXPECT_EQ(ledger.lost_mass, 0);
    }
    EXPECT_LE(std::abs(s.energy_residual), 0.01);
    EXPECT_LE(s.max_speed_m_s, most);
    EXPECT_GT(s.mean_dt_s, 1e-3 * std::sqrt(m.scenario.numerics.spacing_m / standard_gravity));
    worst_residual = std::max(worst_residual, std::abs(s.energy_residual));
    worst_mass = std::max(worst_mass, std::abs(s.mass_error));
    worst_speed = std::max(worst_speed, s.max_speed_m_s / most);
    worst_dt = std::min(worst_dt,
                        s.mean_dt_s / std::sqrt(m.scenario.numerics.spacing_m / standard_gravity));
    seconds += s.wall_s;
  }
  std::string text;
  for (const auto& [name, count] : outcomes) text += fmt::format(" {} {},", name, count);
  fmt::print(
      "{} members in {:.0f} s:{} energy residual <= {:.1e}, mass error <= {:.1e}, speed <= "
      "{:.2f} of free fall, mean step >= {:.3f} sqrt(dx/g)\n",
      n, seconds, text, worst_residual, worst_mass, worst_speed, worst_dt);
}

}  // namespace
}  // namespace sturz::test
