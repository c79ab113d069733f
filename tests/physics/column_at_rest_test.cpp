// SPDX-License-Identifier: Apache-2.0
// V3: dense grains at rest carry their own weight, between periodic images and between walls.
#include "tests/physics/verification.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace sturz::test {
namespace {

constexpr double height_m = 1;

Scenario column(int layers) {
  Scenario s;
  const double dx = height_m / layers;
  s.terrain.synthetic = SyntheticTerrain{
      "plane", dx, {{"slope_deg", 0}, {"length_m", 10 * dx}, {"width_m", 10 * dx}}};
  s.release.box = ReleaseBox{{-5 * dx, 5 * dx}, {-5 * dx, 5 * dx}};
  s.release.thickness_m = Uncertain(height_m);
  s.grains.emplace().friction_angle_deg = Uncertain(30);
  s.grains->diameter_m = 0.002;
  s.domain.periodic = {"x", "y"};
  s.numerics.spacing_m = dx;
  s.numerics.end_time_s = 5 * std::sqrt(height_m / gravity_m_s2);
  s.numerics.stop_at_rest = false;
  return s;
}

struct Rest {
  double stress_error = 0;   ///< L2 of the vertical stress over that of rho g depth
  double lateral_low = 1e9, lateral_high = 0;
  double kinetic = 0;        ///< kinetic energy / (m g H)
  double mean_shift = 0, largest_shift = 0;  ///< vertical displacement / H
};

Rest look(const Finished& f, const std::vector<double>& start_z) {
  const SimulationParts& parts = f.simulation.parts();
  const ParticleSet& p = parts.state.grains;
  const auto& stress = p.find_field("stress")->component;
  Rest r;
  double off = 0, all = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double depth = height_m - p.z[i];
    const double expected = parts.reference_density * gravity_m_s2 * depth;
    off += (-stress[2][i] - expected) * (-stress[2][i] - expected);
    all += expected * expected;
    const double shift = std::abs(p.z[i] - start_z[p.id[i]]) / height_m;
    r.mean_shift += shift / p.size();
    r.largest_shift = std::max(r.largest_shift, shift);
    if (depth < 1.5 * parts.spacing_m) continue;
    for (int k : {0, 1}) {
      const double ratio = stress[k][i] / stress[2][i];
      r.lateral_low = std::min(r.lateral_low, ratio);
      r.lateral_high = std::max(r.lateral_high, ratio);
    }
  }
  r.stress_error = std::sqrt(off / all);
  r.kinetic = mean_motion(p).energy_height / height_m;
  return r;
}

TEST(ColumnAtRest, Probe) {
  for (int walls = 0; walls < 2; ++walls)
    for (int n : {10, 14, 20}) {
      Scenario s = column(n);
      const double dx = s.numerics.spacing_m;
      if (walls) {
        s.domain.periodic.clear();
        s.terrain.synthetic->parameters["length_m"] = 20 * dx;
        s.terrain.synthetic->parameters["width_m"] = 20 * dx;
        for (double sign : {-1.0, 1.0}) {
          s.domain.walls.push_back({{sign * 5 * dx, 0, 0}, {-sign, 0, 0}, 0, std::nullopt});
          s.domain.walls.push_back({{0, sign * 5 * dx, 0}, {0, -sign, 0}, 0, std::nullopt});
        }
      }
      Simulation sim = build(s);
      const std::vector<double> z = sim.parts().state.grains.z;
      const Finished f = run(std::move(sim));
      const Rest r = look(f, z);
      fmt::print("walls {} n {} wall {:.2f} stress {:.4f} lat {:.3f} {:.3f} ke {:.2e} shift {:.5f} {:.5f} resid {:.4f} dt {:.2e}\n", walls, n, f.result.scalars.wall_s, r.stress_error, r.lateral_low, r.lateral_high, r.kinetic, r.mean_shift, r.largest_shift, f.result.scalars.energy_residual, f.result.scalars.mean_dt_s);
      expect_conserved(f);
    }
}

}  // namespace
}  // namespace sturz::test
