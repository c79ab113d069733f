// SPDX-License-Identifier: Apache-2.0
// I4 and V9: a pile that may stay stays; one that is too steep comes down to its friction angle.
#include "scenarios/catalogue.hpp"
#include "tests/physics/verification.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace sturz::test {
namespace {

struct Track {
  std::vector<double> t;
  std::vector<std::vector<double>> x, y, z;
};

TEST(Pile, Probe) {
  for (double dx : {1.0, 0.7}) {
    Scenario s = pile(dx);
    s.numerics.end_time_s = 20;
    Simulation sim = build(s);
    std::vector<double> x0, y0, z0; double t0 = -1; MeanMotion c0; double r0 = 0;
    Finished f = run(std::move(sim), {2, [&](double t, const SimulationParts& p) {
      const auto& g = p.state.grains; const auto m = mean_motion(g);
      std::vector<double> x(g.size()), y(x), z(x); double rmax = 0;
      for (size_t i = 0; i < g.size(); ++i) x[g.id[i]] = g.x[i], y[g.id[i]] = g.y[i], z[g.id[i]] = g.z[i], rmax = std::max(rmax, std::hypot(g.x[i], g.y[i]));
      if (t0 < 0) x0 = x, y0 = y, z0 = z, t0 = t, c0 = m, r0 = rmax;
      std::vector<double> d; for (size_t i = 0; i < x.size(); ++i) d.push_back(std::hypot(x[i] - x0[i], y[i] - y0[i], z[i] - z0[i]));
      std::sort(d.begin(), d.end());
      fmt::print("dx {} t {:.2f} com ({:.5f} {:.5f}) rmax {:.5f} med {:.5f} q99 {:.5f} max {:.5f} [dx since] fastest {:.2e} mean speed {:.2e}\n", dx, t, std::hypot(m.x - c0.x, m.y - c0.y) / dx, (m.z - c0.z) / dx, (rmax - r0) / dx, d[d.size() / 2] / dx, d[d.size() * 99 / 100] / dx, d.back() / dx, m.fastest, m.speed);
      x0 = x, y0 = y, z0 = z, c0 = m, r0 = rmax;
    }});
    fmt::print("wall {} resid {}\n", f.result.scalars.wall_s, f.result.scalars.energy_residual);
  }
}

TEST(Pile, Steep) {
  for (double phi : {25., 35.})
  for (double dx : {1.0, 0.7}) {
    Scenario s = pile(dx);
    s.release.paraboloid = ReleaseParaboloid{{0, 0}, {8, 8}};
    s.release.thickness_m = Uncertain(8);
    s.grains->friction_angle_deg = Uncertain(phi);
    s.numerics.end_time_s = 20;
    MeanMotion c0; std::vector<double> x0, y0, z0;
    Finished f = run(build(s), {2, [&](double t, const SimulationParts& p) {
      const auto& g = p.state.grains; const auto m = mean_motion(g);
      std::vector<double> top(60, 0); double rmax = 0; std::vector<double> rr;
      for (size_t i = 0; i < g.size(); ++i) { double r = std::hypot(g.x[i], g.y[i]); rmax = std::max(rmax, r); rr.push_back(r); size_t k = r / dx; if (k < 60) top[k] = std::max(top[k], g.z[i] + dx / 2); }
      std::sort(rr.begin(), rr.end());
      std::vector<double> x(g.size()), y(x), z(x);
      for (size_t i = 0; i < g.size(); ++i) x[g.id[i]] = g.x[i], y[g.id[i]] = g.y[i], z[g.id[i]] = g.z[i];
      if (x0.empty()) x0 = x, y0 = y, z0 = z, c0 = m;
      std::vector<double> d; for (size_t i = 0; i < x.size(); ++i) d.push_back(std::hypot(x[i] - x0[i], y[i] - y0[i], z[i] - z0[i]));
      std::sort(d.begin(), d.end());
      fmt::print("phi {} dx {} t {:.1f} zmean {:.3f} dz/dt {:.5f} r99 {:.2f} q50 {:.5f} q99 {:.5f} max {:.5f} dx/s mean v {:.2e} top:", phi, dx, t, m.z, (m.z - c0.z) / dx / 2, rr[rr.size() * 99 / 100], d[d.size() / 2] / dx / 2, d[d.size() * 99 / 100] / dx / 2, d.back() / dx / 2, m.speed);
      x0 = x, y0 = y, z0 = z, c0 = m;
      for (int k = 0; k < 20; ++k) fmt::print(" {:.2f}", top[k]);
      fmt::print("\n");
    }});
    fmt::print("wall {} resid {}\n", f.result.scalars.wall_s, f.result.scalars.energy_residual);
  }
}

}  // namespace
}  // namespace sturz::test
