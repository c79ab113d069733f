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

double lowest(const SimulationParts& p) {
  double d = 1e9; const auto& g = p.state.grains;
  for (size_t i = 0; i < g.size(); ++i) if (p.state.terrain.inside(g.x[i], g.y[i])) d = std::min(d, p.state.terrain.distance(Vec3(g.x[i], g.y[i], g.z[i]), .5 * p.spacing_m).distance);
  return d / p.spacing_m;
}

TEST(Leak, Probe) {
  for (double dx : {1.0, 0.8}) {
    double low = 1e9;
    Finished f = run(cliff(dx), {.01, [&](double, const SimulationParts& p) { low = std::min(low, lowest(p)); }});
    const auto& m = f.result.scalars;
    fmt::print("cliff dx {} n {} wall {:.2f} low {:.4f} dx leaked {} lost {} vmax {:.2f} mach {:.3f} resid {:.4f} {}\n", dx, m.n_particles, m.wall_s, low, f.simulation.parts().state.ledger.leaked_mass, m.lost_mass_kg, m.max_speed_m_s, m.max_mach, m.energy_residual, to_string(f.result.outcome));
  }
  for (double face : {45., 60., 70., 80.}) for (double dx : {1.0}) {
    Scenario s = cliff(dx);
    s.terrain.synthetic = SyntheticTerrain{"step", 1, {{"drop_m", 40}, {"face_deg", face}, {"slope_deg", 0}, {"length_m", 120}, {"width_m", 60}, {"azimuth_deg", 270}}};
    s.release.box = ReleaseBox{{-42, -30}, {-6, 6}};
    s.release.thickness_m = Uncertain(5);
    s.release.velocity_m_s = {40, 0, 0};
    s.numerics.end_time_s = 4;
    double low = 1e9;
    Simulation sim=build(s);
    Finished f = run(std::move(sim), {.005, [&](double, const SimulationParts& p) { low = std::min(low, lowest(p)); }});
    const auto& m = f.result.scalars; const auto&b=f.simulation.parts().state.ledger; double E=b.released_energy();
    fmt::print("impact face {} dx {} n {} wall {:.2f} low {:.4f} dx leaked {} lost {} vmax {:.2f} mach {:.3f} derr {:.3f} resid {:.4f} {} E {:.3g} fric {:.3f} damp {:.3f} num {:.3f} plast {:.3f} diff {:.4f}\n", face, dx, m.n_particles, m.wall_s, low, b.leaked_mass, m.lost_mass_kg, m.max_speed_m_s, m.max_mach, m.max_density_error, m.energy_residual, to_string(f.result.outcome),E,b.friction/E,b.damping()/E,b.numerical()/E,b.plastic/E,b.diffusion/E);
  }
}

}  // namespace
}  // namespace sturz::test
