// SPDX-License-Identifier: Apache-2.0
// V7: a slab of mu(I) grains flows steadily down an even slope with Bagnold's profile; on a flatter
// one it stops, on a steeper one it accelerates.
#include "engine/effects/fields.hpp"
#include "engine/effects/motion/accounts.hpp"
#include "scenarios/catalogue.hpp"
#include "tests/physics/verification.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace sturz::test {
namespace {

constexpr double slope_deg = 24;
constexpr double height_m = 0.1;
const double tan_slope = std::tan(slope_deg * degree);
/// u(z) = 2/3 (I/d) sqrt(phi g cos) [h^3/2 - (h-z)^3/2] with mu(I) = tan(slope), zero at the
/// ground; sqrt(phi) because I holds the grains' density and the pressure that of the bulk.
double solution_m_s(double z) {
  static const double scale = [] {
    const GrainsSpec grains = *bagnold_slab(slope_deg).grains;
    const FrictionLaw law = grains.friction.value();
    const double inertial = law.inertial_number_scale.value *
                            (tan_slope - law.static_coefficient.value) /
                            (law.dynamic_coefficient.value - tan_slope);
    return 2.0 / 3 * inertial / grains.diameter_m.value *
           std::sqrt(grains.solid_fraction.value * gravity_m_s2 * std::cos(slope_deg * degree));
  }();
  const double below_surface = height_m - std::clamp(z, 0.0, height_m);
  return scale * (std::pow(height_m, 1.5) - std::pow(below_surface, 1.5));
}

/// Directions down the slope and up from it.
class Frame {
 public:
  explicit Frame(const SimulationParts& parts) {
    const Terrain& ground = parts.state.terrain;
    const double rise = (ground.height(0.01, 0) - ground.height(-0.01, 0)) / 0.02;
    const double length = std::hypot(1, rise);
    nx_ = -rise / length, nz_ = 1 / length;
    downhill_ = rise < 0 ? 1 : -1;
  }
  double above(const ParticleSet& p, std::size_t i) const { return p.x[i] * nx_ + p.z[i] * nz_; }
  double along(double x, double z) const { return downhill_ * (x * nz_ - z * nx_); }
  void set_speed(ParticleSet& p, std::size_t i, double u) const {
    auto& before = p.components(fields::velocity_before);
    p.vx[i] = before[0][i] = downhill_ * u * nz_;
    p.vz[i] = before[2][i] = -downhill_ * u * nx_;
  }
  /// Shear stress and pressure on a plane along the slope.
  std::pair<double, double> traction(const ParticleSet& p, std::size_t i) const {
    const auto& s = p.components(fields::stress);
    const double tx = s[0][i] * nx_ + s[5][i] * nz_, tz = s[5][i] * nx_ + s[2][i] * nz_;
    return {along(tx, tz), -(tx * nx_ + tz * nz_)};
  }

 private:
  double nx_ = 0, nz_ = 1, downhill_ = 1;
};

/// The scene with the solution's velocities, those for 24 degrees whatever its own slope.
Simulation start(const Scenario& s) {
  Simulation simulation = build(s);
  State& state = simulation.parts().state;
  const Frame frame(simulation.parts());
  for (std::size_t i = 0; i < state.grains().size(); ++i)
    frame.set_speed(state.grains(), i, solution_m_s(frame.above(state.grains(), i)));
  refresh_motion(state, state.grains(), 0);
  state.grains().ledger.kinetic_0 = state.grains().ledger.kinetic;
  return simulation;
}

struct Flow {
  double l2 = 0;      ///< of the particles' speeds against the solution where they are, relative
  double mean = 0;    ///< speed [m/s]
  double lowest = 0;  ///< speed of the lowest layer [m/s]
  std::vector<double> friction;  ///< layers' mean shear stress / mean pressure, one spacing each
};

Flow examine(const SimulationParts& parts) {
  const ParticleSet& p = parts.state.grains();
  const Frame frame(parts);
  const auto n = static_cast<std::size_t>(std::lround(height_m / parts.facts.spacing_m));
  std::vector<double> shear(n), pressure(n);
  double off = 0, all = 0, in_lowest = 0;
  Flow f;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double z = frame.above(p, i), u = frame.along(p.vx[i], p.vz[i]);
    const double expected = solution_m_s(z);
    off += (u - expected) * (u - expected);
    all += expected * expected;
    f.mean += u / p.size();
    const std::size_t k = std::min(n - 1, static_cast<std::size_t>(z / parts.facts.spacing_m));
    const auto [s, normal] = frame.traction(p, i);
    shear[k] += s;
    pressure[k] += normal;
    if (k == 0) f.lowest += u, in_lowest += 1;
  }
  f.l2 = std::sqrt(off / all);
  f.lowest /= in_lowest;
  for (std::size_t k = 0; k < n; ++k) f.friction.push_back(shear[k] / pressure[k]);
  return f;
}

/// Means over the last fifth of the run.
struct Steady {
  Finished finished;
  Flow flow = {};
  double drift = 0;  ///< of the error, over that time
  /// Largest deviation of shear stress / pressure from tan(slope), relative, farther from ground
  /// and surface than the support (2.6 spacings).
  double friction_error = 0;
};

Steady flow_steadily(const Scenario& s) {
  const double end = s.numerics.end_time_s.value();
  std::vector<Flow> seen;
  Steady out{run(start(s), {0.02 * end, [&](double t, const SimulationParts& p) {
                              if (t > 0.8 * end) seen.push_back(examine(p));
                            }})};
  std::vector<double> friction(seen.front().friction.size());
  for (const Flow& f : seen) {
    out.flow.l2 += f.l2 / seen.size();
    out.flow.mean += f.mean / seen.size();
    out.flow.lowest += f.lowest / seen.size();
    for (std::size_t k = 0; k < friction.size(); ++k) friction[k] += f.friction[k] / seen.size();
  }
  out.drift = seen.back().l2 - seen.front().l2;
  for (std::size_t k = 3; k + 3 < friction.size(); ++k)
    out.friction_error = std::max(out.friction_error, std::abs(friction[k] / tan_slope - 1));
  return out;
}

Scenario slab(double degrees, int layers, double viscosity = 0.1) {
  Scenario s = bagnold_slab(degrees, layers);
  s.numerics.artificial_viscosity = viscosity;
  return s;
}

/// Mean speeds of the same law in one dimension, from the solution for 24 degrees on: rho du/dt =
/// rho g sin - d(tau)/dz with tau = mu(I) p, at rest on the ground, by explicit steps.
class OneDimension {
 public:
  explicit OneDimension(double degrees) : slope_(degrees * degree) {
    const GrainsSpec grains = *bagnold_slab(degrees).grains;
    law_ = grains.friction.value();
    // I = rate d / sqrt(p / rho_p), with p = phi rho_p g cos depth.
    diameter_ = grains.diameter_m.value, fraction_ = grains.solid_fraction.value;
    for (int k = 0; k < n; ++k) u_.push_back(solution_m_s((k + 0.5) * dz));
  }
  /// Least-squares slope of the mean speed between the two times [m/s2].
  double acceleration(double from_s, double to_s) {
    std::vector<double> times, speeds;
    for (int step = 0; step * dt < to_s; ++step) {
      advance();
      if (step * dt < from_s) continue;
      double mean = 0;
      for (const double u : u_) mean += u / n;
      times.push_back(step * dt), speeds.push_back(mean);
    }
    return slope_of(times, speeds);
  }

 private:
  static constexpr int n = 100;
  static constexpr double dz = height_m / n, dt = 2e-5;

  void advance() {
    std::vector<double> shear(n + 1, 0.0);  // tau / rho on the faces; none on the surface
    for (int k = 0; k < n; ++k) {
      const double rate = k == 0 ? u_[0] / (0.5 * dz) : (u_[k] - u_[k - 1]) / dz;
      const double pressure = gravity_m_s2 * std::cos(slope_) * (height_m - k * dz);  // over rho
      const double inertial = std::abs(rate) * diameter_ / std::sqrt(fraction_ * pressure);
      const double mu = law_.static_coefficient.value +
                        (law_.dynamic_coefficient.value - law_.static_coefficient.value) /
                            (law_.inertial_number_scale.value / std::max(inertial, 1e-12) + 1);
      shear[k] = std::copysign(mu * pressure, rate);
    }
    for (int k = 0; k < n; ++k)
      u_[k] += dt * (gravity_m_s2 * std::sin(slope_) - (shear[k] - shear[k + 1]) / dz);
  }

  double slope_, diameter_ = 0, fraction_ = 0;
  FrictionLaw law_;
  std::vector<double> u_;
};

TEST(Bagnold, OneDimensionStandsStillOnTheSolution) {
  EXPECT_NEAR(OneDimension(slope_deg).acceleration(0.5, 1), 0, 1e-3);
}

/// The friction of the catalogue's bed is 1.1 tan(slope), a tenth more than the slope mobilises:
/// the solution rests on its ground. A bed that is rougher still must change nothing.
TEST(Bagnold, SlabFlowsWithItsProfile) {
  std::vector<double> dx, error;
  for (const int layers : {10, 14, 20}) {
    const Steady r = flow_steadily(slab(slope_deg, layers));
    const Finished& f = r.finished;
    const std::string name = fmt::format("V7 slab, layers {}", layers);
    expect_within({name + ", profile", "L2 of u(z)", r.flow.l2, 0, r.flow.l2, 0.05}, f);
    expect_within({name + ", shear stress / pressure", "largest relative deviation",
                   r.friction_error, 0, r.friction_error, 0.01},
                  f);
    record(relative(name + ", mean speed", "m/s", r.flow.mean, 0.6 * solution_m_s(height_m)), f);
    EXPECT_LT(std::abs(r.flow.lowest), 1e-3) << "the bed lets go";
    EXPECT_LT(std::abs(r.drift), 0.005) << "not steady";
    expect_conserved(name, f);
    dx.push_back(f.simulation.parts().facts.spacing_m);
    error.push_back(r.flow.l2);
  }
  const Convergence c = observed_convergence(dx, error);
  fmt::print("V7 slab: observed order {:.2f}, limit {:.4f}; to zero: {:.2f}, {:.2f}\n", c.order,
             c.limit, std::log(error[0] / error[1]) / std::log(dx[0] / dx[1]),
             std::log(error[1] / error[2]) / std::log(dx[1] / dx[2]));
  RecordProperty("observed_order", fmt::format("{:.3f}", c.order));
}

TEST(Bagnold, ViscosityAndARoughBaseDoNotChangeIt) {
  for (const int layers : {10, 14}) {
    for (const double viscosity : {0.2, 0.005}) {
      const Steady r = flow_steadily(slab(slope_deg, layers, viscosity));
      const std::string name = fmt::format("V7 slab, layers {}, viscosity {}", layers, viscosity);
      expect_within({name, "L2 of u(z)", r.flow.l2, 0, r.flow.l2, 0.05}, r.finished);
      expect_within({name + ", shear stress / pressure", "largest relative deviation",
                     r.friction_error, 0, r.friction_error, 0.01},
                    r.finished);
      expect_conserved(name, r.finished);
    }
    Scenario rough = slab(slope_deg, layers);
    rough.basal.friction_coefficient = 10;
    const Steady r = flow_steadily(rough);
    const std::string name = fmt::format("V7 slab, layers {}, bed friction 10", layers);
    expect_within({name, "L2 of u(z)", r.flow.l2, 0, r.flow.l2, 0.05}, r.finished);
    expect_conserved(name, r.finished);
  }
}

/// mu_s is that of 20.9 degrees.
TEST(Bagnold, SlabStopsAtTwentyDegrees) {
  Scenario s = slab(20, 10);
  s.numerics.end_time_s = 4;
  const Finished f = run(start(s));
  const double fastest = mean_motion(f.simulation.parts().state.grains()).fastest;
  expect_within({"V7 slab at 20 deg", "fastest m/s after 4 s", fastest, 0, fastest, 0.005}, f);
  expect_conserved("V7 slab at 20 deg", f);
}

/// mu_2 is that of 32.8 degrees: whatever the speed, g (sin - mu_2 cos) is left over, 0.25 m/s2.
/// What the shear rate leaves over besides is in the integration of the same law.
TEST(Bagnold, SlabAcceleratesAtThirtyFourDegrees) {
  Scenario s = slab(34, 10);
  s.numerics.end_time_s = 2;
  std::vector<double> t, u;
  const Finished f = run(start(s), {0.05, [&](double time, const SimulationParts& p) {
                                      if (time < 1) return;
                                      t.push_back(time);
                                      u.push_back(examine(p).mean);
                                    }});
  expect_within(relative("V7 slab at 34 deg", "m/s2 from 1 s to 2 s", slope_of(t, u),
                         OneDimension(34).acceleration(1, 2), 0.05),
                f);
  expect_conserved("V7 slab at 34 deg", f);
}

}  // namespace
}  // namespace sturz::test
