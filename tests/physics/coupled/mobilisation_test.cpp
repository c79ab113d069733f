// SPDX-License-Identifier: Apache-2.0
// V24: saturated sand on 31 degrees lets go or is held, by its solid fraction alone (Iverson et al.
// 2000, Science 290: 513). Loose, it tightens as it shears, its water takes over the load and it
// runs; dense, it loosens, and suction holds it. Here a sheet without ends, as thick as that prism.
#include "engine/effects/fields.hpp"
#include "tests/physics/coupled/coupled_books.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace sturz::test {
namespace {

constexpr double slope_deg = 31, thickness = 0.65, spacing = 0.1;  // along the normal [m]

Scenario sheet(double solid_fraction) {
  const double side = 6 * spacing;
  Scenario s;
  s.title = "Saturated sand on an even slope";
  s.terrain.synthetic = SyntheticTerrain{
      "plane", spacing, {{"slope_deg", slope_deg}, {"length_m", side}, {"width_m", side}}};
  s.release.box = ReleaseBox{{-side / 2, side / 2}, {-side / 2, side / 2}};
  s.release.thickness_m = Uncertain(thickness / std::cos(slope_deg * degree));
  s.grains.emplace();
  s.grains->density_kg_m3 = 2700;
  s.grains->diameter_m = 0.001;
  s.grains->solid_fraction = solid_fraction;
  s.grains->friction_angle_deg = Uncertain(40.7);
  s.fluid.emplace();
  s.fluid->viscosity_pa_s = Uncertain(0.001);
  s.fluid->bed = FluidBed::film;
  s.coupling.emplace();
  s.coupling->drag_diameter_m = Uncertain(0.000235);  // permeability 1e-10 m^2 at 0.56
  s.coupling->critical_solid_fraction = Uncertain(0.56);
  s.coupling->dilatancy_slope = 1;
  s.basal.friction_coefficient = 2;  // rougher than the grains: it gives way inside
  s.formulation = Formulation::full_stress;
  s.domain.periodic = {"x", "y"};
  s.numerics.spacing_m = spacing;
  s.numerics.end_time_s = 1;
  s.numerics.stop_at_rest = false;
  return s;
}

/// Excess over still water in the layer on the bed [Pa].
double excess(const State& s) {
  const MovingSet& p = s.sets[1];
  const double fall = std::tan(slope_deg * degree), upright = std::cos(slope_deg * degree);
  double sum = 0, n = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double height = (p.z[i] + fall * p.x[i]) * upright;
    if (height > spacing) continue;
    sum += pressure_of(p, i) - 1000 * gravity_m_s2 * upright * (thickness - height);
    ++n;
  }
  return sum / n;
}

struct Outcome24 {
  double speed = 0;     ///< of the centre of mass after a second [m/s]
  double pressure = 0;  ///< excess at the bed, mean over that second [Pa]
};

Outcome24 let_go(const std::string& name, double solid_fraction) {
  double pressure = 0, n = 0;
  const Finished f = run(sheet(solid_fraction), {0.05, [&](double time, const SimulationParts& p) {
                                                   if (time > 0) pressure += excess(p.state), ++n;
                                                 }});
  const State& s = f.simulation.parts().state;
  const Ledger both = s.ledger();
  EXPECT_LE(std::abs(both.residual()), 0.01 * both.released_energy()) << name;
  EXPECT_TRUE(s.sets[0].motion.finite && s.sets[1].motion.finite) << name;
  const MeanMotion m = mean_motion(s.grains());
  const Outcome24 out{std::hypot(m.vx, m.vz), pressure / n};
  record({"V24 " + name + ", speed after 1 s", "m/s", out.speed, 0, 0}, f);
  record({"V24 " + name + ", excess pore pressure at the bed", "Pa", out.pressure, 0, 0}, f);
  return out;
}

TEST(Mobilisation, LooseSandLiquefiesAndRunsDenseSandIsHeld) {
  const Outcome24 loose = let_go("loose, 0.48", 0.48), dense = let_go("dense, 0.59", 0.59);
  EXPECT_GT(loose.pressure, 0);
  EXPECT_LT(dense.pressure, 0);
  EXPECT_GT(loose.speed, 1);  // as published, within a second
  EXPECT_LT(dense.speed, 0.1 * loose.speed);
}

}  // namespace
}  // namespace sturz::test
