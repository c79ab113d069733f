// SPDX-License-Identifier: Apache-2.0
// V19 and V20 far from any ground: parcels fly parabolas, pair forces do not move the whole.
#include "scenarios/catalogue.hpp"
#include "tests/physics/verification.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace sturz::test {
namespace {

Scenario parcels(double dx) {
  Scenario s;
  s.terrain.synthetic = SyntheticTerrain{"plane", 1, {{"slope_deg", 0}, {"length_m", 100}, {"width_m", 20}}};
  s.release.box = ReleaseBox{{-40, -40 + dx}, {-2 * dx, 2 * dx}};
  s.release.thickness_m = Uncertain(dx);
  s.release.velocity_m_s = {20 * std::cos(45 * degree), 0, 20 * std::sin(45 * degree)};
  s.grains.emplace().friction_angle_deg = Uncertain(30);
  s.numerics.spacing_m = dx;
  s.numerics.end_time_s = 4;
  s.numerics.stop_at_rest = false;
  return s;
}

TEST(FreeFlight, Probe) {
  for (double dx : {1.0, 0.5, 0.2, 0.1})
    for (int lift = 0; lift < 2; ++lift) {
      Simulation sim = build(parcels(dx));
      ParticleSet& p = sim.parts().state.grains;
      // Apart, so that no two are neighbours, and clear of the ground's support.
      for (std::size_t i = 0; i < p.size(); ++i) { p.y[i] = -8 + 5.0 * p.id[i]; if (lift) p.z[i] += 10; }
      std::vector<double> x0 = p.x, z0 = p.z;
      double worst = 0, x = 0;
      std::vector<double> px(p.size()), pz(p.size()), range(p.size(), 0); double tm=0,pt=0;
      for (int n = 0; n < 100000; ++n) {
        for (std::size_t i = 0; i < p.size(); ++i) px[p.id[i]] = p.x[i], pz[p.id[i]] = p.z[i];
        pt = sim.parts().state.time;
        sim.step(); tm = sim.parts().state.time;
        bool all = true;
        for (std::size_t i = 0; i < p.size(); ++i) { auto k = p.id[i]; if (!range[k] && p.z[i] < z0[k] && n > 10) range[k] = px[k] + (p.x[i] - px[k]) * (pz[k] - z0[k]) / (pz[k] - p.z[i]) - x0[k]; all &= range[k] > 0; }
        if (all) break;
      }
      for (double r : range) worst = std::max(worst, std::abs(r / (400 / gravity_m_s2) - 1)), x = r;
      fmt::print("dx {} lift {} n {} dt {:.2e} t {:.3f} range {:.5f} ref {:.5f} err {:.2e}\n", dx, lift, p.size(), tm-pt, tm, x, 400 / gravity_m_s2, worst);
    }
}

TEST(FreeFlight, Momentum) {
  // A cohesive block that spins and shears in free space.
  Scenario s = block_on_plane();
  s.grains->cohesion_pa = 1e5;
  s.numerics.end_time_s = 2; s.numerics.stop_at_rest = false;
  Simulation sim = build(s);
  State& st = sim.parts().state; st.gravity = 0;
  for (auto& z : st.grains.z) z += 60;
  auto m = mean_motion(st.grains);
  for (size_t i = 0; i < st.grains.size(); ++i) { double y = st.grains.y[i] - m.y, z = st.grains.z[i] - m.z; st.grains.vy[i] = -.5 * z; st.grains.vz[i] = .5 * y; st.grains.vx[i] = 3 + .1 * y; }
  auto* before = st.grains.find_field("velocity_before"); before->component[0] = st.grains.vx; before->component[1] = st.grains.vy; before->component[2] = st.grains.vz;
  auto a = mean_motion(st.grains);
  Finished f = run(std::move(sim));
  auto b = mean_motion(f.simulation.parts().state.grains);
  const auto& bk = f.simulation.parts().state.ledger;
  fmt::print("drift {:.2e} {:.2e} {:.2e} of {:.3f}; impulse {:.2e} {:.2e} {:.2e} / {:.2e}  resid {:.4e} kin {} {} el {}\n", b.vx - a.vx, b.vy - a.vy, b.vz - a.vz, a.speed, bk.stress_impulse[0] / bk.stress_impulse_scale, bk.stress_impulse[1] / bk.stress_impulse_scale, bk.stress_impulse[2] / bk.stress_impulse_scale, bk.stress_impulse_scale, f.result.scalars.energy_residual, bk.kinetic_0, bk.kinetic, bk.elastic);
}

}  // namespace
}  // namespace sturz::test
