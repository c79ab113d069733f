// SPDX-License-Identifier: Apache-2.0
// V8b
#include "scenarios/catalogue.hpp"
#include "tests/physics/verification.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace sturz::test {
namespace {

TEST(Collapse, Probe) {
  const double ang = getenv("PHI") ? atof(getenv("PHI")) : 27.4;
  const double base = getenv("MB") ? atof(getenv("MB")) : std::tan(27.4 * degree);
  for (double a : getenv("AA") ? std::vector<double>{atof(getenv("AA"))} : std::vector<double>{1.0, 0.5, 2.0}) {
    std::vector<double> dxs, q;
    for (int n : getenv("NN") ? std::vector<int>{atoi(getenv("NN"))} : std::vector<int>{10, 14, 20}) {
      Scenario s = column_collapse(a, n);
      const double dx = s.numerics.spacing_m;
      s.grains->friction.reset(); s.grains->friction_angle_deg = Uncertain(ang);
      if (getenv("MUI")) { s.grains->friction_angle_deg.reset(); s.grains->friction.emplace(); s.grains->friction->static_coefficient = std::tan(ang * degree); s.grains->friction->dynamic_coefficient = std::tan(ang * degree) + .26; }
      s.basal.friction_coefficient = base;
      if (getenv("AV")) s.numerics.artificial_viscosity = atof(getenv("AV"));
      if (getenv("CF")) s.numerics.sound_speed_factor = atof(getenv("CF"));
      const Finished f = run(s);
      const auto& g = f.simulation.parts().state.grains;
      std::vector<double> x(g.x); std::sort(x.begin(), x.end());
      // front: last column with local depth > dx/2 (volume per width)
      std::vector<double> depth(400, 0); const double cell = dx;
      for (size_t i = 0; i < g.size(); ++i) { int k = g.x[i] / cell; if (k >= 0 && k < 400) depth[k] += g.mass[i] / 1560 / (cell * 4 * dx); }
      int last = 0; for (int k = 0; k < 400; ++k) if (depth[k] > std::max(.5 * dx, 0.0)) last = k;
      double hmax = 0; for (int k = 0; k < 400; ++k) hmax = std::max(hmax, depth[k]);
      const auto& m = f.result.scalars;
      const auto& b = f.simulation.parts().state.ledger; double E = b.released_energy();
      fmt::print("a {} n {} N {} wall {:.2f} steps {} t {:.2f} {} | front h>dx/2 {:.3f} q99 {:.3f} max {:.3f} runout {:.3f} com {:.3f} | ref {:.2f} | H0 {:.3f} resid {:.4f} plast {:.3f} fric {:.3f} num {:.3f}\n", a, n, m.n_particles, m.wall_s, m.n_steps, m.end_time_s, to_string(f.result.outcome), (last + 1) * cell - 1, x[x.size() * 99 / 100] - 1, x.back() - 1, m.runout_m, m.com_travel_m, 1.2 * a, hmax, m.energy_residual, b.plastic / E, b.friction / E, b.numerical() / E);
      dxs.push_back(dx); q.push_back(x[x.size() * 99 / 100] - 1);
    }
    if (q.size() < 3) continue; const Convergence c = observed_convergence(dxs, q);
    fmt::print("  order {} limit {} mono {}\n", c.order, c.limit, c.monotonic);
  }
}

}  // namespace
}  // namespace sturz::test
