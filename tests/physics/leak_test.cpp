// SPDX-License-Identifier: Apache-2.0
// I3: nothing gets through the ground, over a cliff or into a steep face at 40 m/s.
#include "scenarios/catalogue.hpp"
#include "tests/physics/verification.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace sturz::test {
namespace {

/// Smallest distance of a particle to the ground [dx].
double lowest(const SimulationParts& parts) {
  const ParticleSet& p = parts.state.grains();
  const Terrain& ground = parts.state.terrain;
  double least = 1e300;
  for (std::size_t i = 0; i < p.size(); ++i)
    if (ground.inside(p.x[i], p.y[i]))
      least = std::min(
          least, ground.distance({p.x[i], p.y[i], p.z[i]}, 0.5 * parts.facts.spacing_m).distance);
  return least / parts.facts.spacing_m;
}

void expect_tight(const std::string& name, const Scenario& s) {
  double least = 1e300;
  const Finished f = run(
      s, {0.005, [&](double, const SimulationParts& p) { least = std::min(least, lowest(p)); }});
  const double below = std::max(0.0, -least);
  expect_within({name, "lowest centre, dx above ground", least, 0, below, 0.1}, f);
  EXPECT_EQ(f.simulation.parts().state.grains().ledger.leaked_mass, 0);
  expect_conserved(name, f);
}

TEST(Leak, NoneOverACliffOf60Degrees) { expect_tight("I3 cliff 60 deg", cliff(1)); }

class Impact : public testing::TestWithParam<double> {};

INSTANTIATE_TEST_SUITE_P(Faces, Impact, testing::Values(60, 80),
                         [](const auto& i) { return fmt::format("Face{:.0f}Deg", i.param); });

/// A box of grains on level ground meets a face one cell away from it at 40 m/s.
TEST_P(Impact, NoneThroughASteepFace) {
  Scenario s = cliff(1);
  s.terrain.synthetic = SyntheticTerrain{"step",
                                         1,
                                         {{"drop_m", 40},
                                          {"face_deg", GetParam()},
                                          {"slope_deg", 0},
                                          {"length_m", 120},
                                          {"width_m", 60},
                                          {"azimuth_deg", 270}}};
  s.release.box = ReleaseBox{{-42, -30}, {-6, 6}};
  s.release.velocity_m_s = {40, 0, 0};
  s.numerics.end_time_s = 4;
  expect_tight(fmt::format("I3 impact of 40 m/s on {} deg", GetParam()), s);
}

}  // namespace
}  // namespace sturz::test
