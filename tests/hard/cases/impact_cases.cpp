// SPDX-License-Identifier: Apache-2.0
// I11: a block meets a steep face at 100 m/s. Ground must hold it, and must not throw it back
// faster than it came.
#include "scenarios/catalogue.hpp"
#include "tests/hard/cases/cases.hpp"
#include "tests/hard/survival.hpp"
#include "tests/physics/verification.hpp"

#include <cmath>
#include <utility>

namespace sturz::test {
namespace {

/// 12 x 12 x 6 particles, lifted 30 m above the middle of the face, fall at 100 m/s.
CaseReport drop(double face_deg, States states) {
  Scenario s = cliff(1);
  s.terrain.synthetic->parameters = {{"drop_m", 60},
                                     {"face_deg", face_deg},
                                     {"slope_deg", 0},
                                     {"length_m", 400},
                                     {"width_m", 200}};
  const double middle = 30 / std::tan(face_deg * degree);
  s.release.box = ReleaseBox{{middle - 6, middle + 6}, {-6, 6}};
  s.release.thickness_m = Uncertain(6);
  s.release.velocity_m_s = {0, 0, -100};
  s.numerics.end_time_s = 3;
  Simulation simulation = build(with_states(std::move(s), states));
  for (double& z : simulation.parts().state.grains().z) z += 30;
  simulation.parts().facts.release.top_m += 30;
  const Survival survived = survive(std::move(simulation), 100, 0);
  return {checks_of(survived, true), survived.particles, survived.seconds};
}

}  // namespace

CaseReport drop_on_60_degrees(States states) { return drop(60, states); }

CaseReport drop_on_80_degrees(States states) { return drop(80, states); }

}  // namespace sturz::test
