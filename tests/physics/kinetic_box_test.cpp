// SPDX-License-Identifier: Apache-2.0
// V10 and V11 as flows of particles: colliding grains in a box without gravity.
#include "engine/effects/bed/effect.hpp"
#include "engine/effects/dense/effect.hpp"
#include "engine/effects/fields.hpp"
#include "engine/effects/kinetic/effect.hpp"
#include "engine/effects/motion/accounts.hpp"
#include "engine/effects/motion/effect.hpp"
#include "engine/effects/motion/gravity.hpp"
#include "tests/physics/verification.hpp"
#include "tests/support/hand_made.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace sturz::test {
namespace {

constexpr double density = 1560, dx = 1, h = 1.3, reference_fraction = 0.6;

/// A cloud of `n` x `n` x `layers` grains at solid fraction `fraction`, periodic in x and y, far
/// above the ground, between two smooth walls where `walls` says so.
struct Cloud {
  KineticTheory law{2600, 0.1, 0.9, 0.63};
  double fraction = 0.2;
  double theta = 0.01;  ///< at the start [m^2/s^2]
  int n = 8, layers = 12;
  double jitter = 0.1;
  bool walls = true;

  double spacing() const { return dx * std::cbrt(reference_fraction / fraction); }
  double bottom() const { return 40; }
  double top() const { return bottom() + layers * spacing(); }
};

GrainStressSettings settings_of(const Cloud& c) {
  GrainStressSettings g;
  g.smoothing_length = h;
  g.reference_density = density;
  g.sound_speed = 40;
  g.instruction_set = best_instruction_set();
  g.states = GrainStatesSettings{};
  g.states->reference_fraction = reference_fraction;
  g.states->dilute = c.law;
  return g;
}

Domain box_of(const Cloud& c) {
  Domain d;
  const double half = 0.5 * c.n * c.spacing();
  d.x = {true, -half, half, 0};
  d.y = {true, -half, half, 0};
  if (!c.walls) return d;
  for (const double side : {1.0, -1.0}) {
    Wall wall;
    wall.point = {0, 0, side > 0 ? c.bottom() : c.top()};
    wall.normal = {0, 0, side};
    d.walls.push_back(wall);
  }
  return d;
}

void place(const Cloud& c, ParticleSet& p) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> shift(-c.jitter, c.jitter);
  p.grow(static_cast<std::size_t>(c.n) * c.n * c.layers);
  const double half = 0.5 * c.n * c.spacing();
  std::size_t i = 0;
  for (int a = 0; a < c.n; ++a)
    for (int b = 0; b < c.n; ++b)
      for (int k = 0; k < c.layers; ++k, ++i) {
        p.x[i] = (a + 0.5 + shift(random)) * c.spacing() - half;
        p.y[i] = (b + 0.5 + shift(random)) * c.spacing() - half;
        p.z[i] = (k + 0.5 + shift(random)) * c.spacing() + c.bottom();
        p.mass[i] = density * dx * dx * dx;
      }
}

void warm_up(const Cloud& c, State& s) {
  for (double& e : s.grains().scalar(fields::density_change))
    e = c.fraction / reference_fraction - 1;
  for (auto& component : s.grains().components(fields::stress))
    std::fill(component.begin(), component.end(), 0.0);
  for (double& theta : s.grains().scalar(fields::granular_temperature)) theta = c.theta;
  s.grains().ledger.elastic = s.grains().ledger.elastic_0 = 0;
}

/// Stress, contact and, where grains shall move, motion.
HandMade cloud_of(const Cloud& c, bool moving) {
  HandMade made{State(even_ground(64), box_of(c)), {}};
  State& s = made.state;
  s.gravity = 0;
  place(c, s.grains());
  for (double m : s.grains().mass) s.grains().ledger.released_mass += m;
  const auto stress =
      add_grain_stress(made.step, s, 0, settings_of(c), std::vector<double>(s.grains().size(), 0));
  add_kinetic_theory(made.step, s, stress);
  add_grain_states(made.step, s, stress);
  warm_up(c, s);
  if (moving) add_gravity(made.step, s, 0);
  ContactSettings contact;
  contact.reference_density = density;
  contact.stiffness = 4000;
  add_terrain_contact(made.step, 0, contact);
  if (!s.domain.walls.empty()) add_wall_contact(made.step, 0, contact);
  if (moving) add_motion(made.step, 0, {dx, h});
  refresh_motion(s, s.grains(), 0);
  return made;
}

double total_granular_energy(const State& s) {
  double sum = 0;
  const auto& theta = s.grains().scalar(fields::granular_temperature);
  for (std::size_t i = 0; i < theta.size(); ++i) sum += 1.5 * s.grains().mass[i] * theta[i];
  return sum;
}

/// Largest deviation of the cloud's granular energy from Haff's law theta_0/(1 + t/tau)^2 within 3
/// tau.
struct Cooling {
  double worst = 0;
  double stirred = 0;  ///< kinetic energy at the end over the granular energy at the start
};
Cooling cool(const Cloud& c) {
  HandMade made = cloud_of(c, true);
  const double g0 = 1 / (1 - std::cbrt(c.fraction / c.law.max_fraction));
  const double e = c.law.restitution;
  const double tau = c.law.grain_diameter * std::sqrt(std::numbers::pi) /
                     (4 * (1 - e * e) * c.fraction * g0 * std::sqrt(c.theta));
  const double granular_energy = total_granular_energy(made.state);
  Cooling out;
  while (made.state.time < 3 * tau) {
    made.state.grains().motion.max_speed = 10;  // theta is bounded by the speed of the scene
    made.advance();
    const double expected = granular_energy / std::pow(1 + made.state.time / tau, 2);
    out.worst = std::max(out.worst, std::abs(total_granular_energy(made.state) / expected - 1));
  }
  out.stirred = made.state.grains().ledger.kinetic / granular_energy;
  EXPECT_LT(std::abs(made.state.grains().ledger.conducted), 1e-5 * granular_energy);
  EXPECT_EQ(made.state.grains().n_listed, made.state.grains().size());
  fmt::print(
      "V10 box, jitter {}: {} steps to 3 tau = {:.2f} s, worst error {:.3f} %, stirred "
      "{:.2f} % of the granular energy\n",
      c.jitter, made.state.n_steps, made.state.time, 100 * out.worst, 100 * out.stirred);
  return out;
}

/// V10 with particles that are free to move: the cloud's pressure stands against its walls while
/// it cools.
TEST(KineticBox, AnEvenCloudCoolsByHaffsLaw) {
  Cloud c;
  c.jitter = 0;
  EXPECT_LT(cool(c).worst, 0.01);
}

/// An uneven one stirs itself; grains that crowd together cool faster.
TEST(KineticBox, AnUnevenCloudIsReported) {
  const Cooling found = cool({});
  RecordProperty("worst_error", fmt::format("{:.5f}", found.worst));
  EXPECT_LT(found.stirred, 0.02);
}

/// Means over the inner half of the cloud.
struct Inner {
  double theta = 0, pressure = 0, shear = 0;
  double fraction = 0;  ///< of solids
};
Inner inner_of(const Cloud& c, const State& s) {
  const auto& theta = s.grains().scalar(fields::granular_temperature);
  const auto& stress = s.grains().components(fields::kinetic_stress);
  Inner sum;
  double n = 0;
  for (std::size_t i = 0; i < theta.size(); ++i) {
    const double z = (s.grains().z[i] - c.bottom()) / (c.top() - c.bottom());
    if (z < 0.25 || z > 0.75) continue;
    ++n;
    sum.theta += theta[i];
    sum.pressure -= (stress[0][i] + stress[1][i] + stress[2][i]) / 3;
    sum.shear += stress[5][i];
    sum.fraction += reference_fraction * (1 + s.grains().scalar(fields::density_change)[i]);
  }
  return {sum.theta / n, sum.pressure / n, sum.shear / n, sum.fraction / n};
}

/// Slope of the velocity over the height, by least squares over the inner half [1/s].
double inner_rate_of(const Cloud& c, const State& s) {
  std::vector<double> z, vx;
  for (std::size_t i = 0; i < s.grains().size(); ++i) {
    const double height = (s.grains().z[i] - c.bottom()) / (c.top() - c.bottom());
    if (height < 0.25 || height > 0.75) continue;
    z.push_back(s.grains().z[i]), vx.push_back(s.grains().vx[i]);
  }
  return slope_of(z, vx);
}

struct Shear {
  double fraction, theta, pressure, ratio;  ///< theta*, P*, tau/P of docs/physics.md V11
};

class UniformShear : public testing::TestWithParam<Shear> {};
INSTANTIATE_TEST_SUITE_P(
    Fractions, UniformShear,
    testing::Values(Shear{0.1, 3.4827, 0.6369, 0.286}, Shear{0.2, 1.3969, 0.9475, 0.282},
                    Shear{0.3, 1.0492, 1.9525, 0.291}, Shear{0.4, 0.93119, 4.4018, 0.299}),
    [](const auto& i) { return fmt::format("{:.0f}Percent", 100 * i.param.fraction); });

/// V11 with particles held in uniform shear: gradient, production, conduction and stress of the
/// sweep, against the closed form, with a jittered cloud of free top and bottom.
TEST_P(UniformShear, ReachesTheClosedForm) {
  for (const int layers : {10, 14, 20}) {
    Cloud c;
    c.fraction = GetParam().fraction;
    c.theta = 1e-4;
    c.layers = layers;
    c.walls = false;
    c.law.grain_diameter = 0.4;
    HandMade made = cloud_of(c, false);
    State& s = made.state;
    const double rate = 2, scale = rate * c.law.grain_diameter;
    auto& density_change = s.grains().scalar(fields::density_change);
    const double e0 = c.fraction / reference_fraction - 1;
    for (int step = 0; step < 1500; ++step) {
      // The shear is held: grains stay in place and keep the velocities that it gives them.
      for (std::size_t i = 0; i < s.grains().size(); ++i) {
        s.grains().vx[i] = rate * (s.grains().z[i] - c.bottom());
        s.grains().vy[i] = s.grains().vz[i] = 0;
        density_change[i] = e0;
      }
      s.grains().motion.max_speed = 100;
      s.grains().motion.velocity_range[0] = 0;
      made.step.apply(s, 0.02);
    }
    const Inner inner = inner_of(c, s);
    const double unit = 2600 * scale * scale;
    const double theta = inner.theta / (scale * scale), pressure = inner.pressure / unit;
    const double ratio = inner.shear / inner.pressure;
    fmt::print(
        "V11 box, alpha {}, {} layers: theta* {:.4f} ({:+.2f} %), P* {:.4f} ({:+.2f} %), "
        "tau/P {:.4f}\n",
        c.fraction, layers, theta, 100 * (theta / GetParam().theta - 1), pressure,
        100 * (pressure / GetParam().pressure - 1), ratio);
    EXPECT_NEAR(theta / GetParam().theta, 1, 0.03);
    EXPECT_NEAR(pressure / GetParam().pressure, 1, 0.03);
    EXPECT_NEAR(ratio / GetParam().ratio, 1, 0.03);
  }
}

/// V11 at any fraction (docs/physics.md A.4): production equals dissipation.
Shear closed_form(const KineticTheory& law, double fraction) {
  const double e = law.restitution, pi = std::numbers::pi;
  const double g0 = 1 / (1 - std::cbrt(fraction / law.max_fraction));
  const double collisional = 0.8 * fraction * fraction * g0 * (1 + e) / std::sqrt(pi);
  const double bracket = 1 + 0.8 * (1 + e) * g0 * fraction;
  const double kinetic = 10 * std::sqrt(pi) / (96 * (1 + e) * g0) * bracket * bracket;
  const double viscosity = collisional + kinetic;  // of rho_p d sqrt(theta)
  const double theta = viscosity * std::sqrt(pi) / (12 * (1 - e * e) * fraction * fraction * g0);
  const double pressure = fraction * theta * (1 + 2 * (1 + e) * fraction * g0);
  return {fraction, theta, pressure, viscosity * std::sqrt(theta) / pressure};
}

TEST_P(UniformShear, ClosedFormGivesThePrintedNumbers) {
  const Shear found = closed_form(Cloud{}.law, GetParam().fraction);
  EXPECT_NEAR(found.theta / GetParam().theta, 1, 1e-4);
  EXPECT_NEAR(found.pressure / GetParam().pressure, 1, 1e-4);
  EXPECT_NEAR(found.ratio / GetParam().ratio, 1, 2e-3);
}

/// V11 with particles that are free to move: a box that starts in uniform shear and with half of
/// the temperature that belongs to it. Nothing drives it: the smooth walls take no shear, which
/// dies away from them inwards, by 3 m in the time looked at; the inner half is 6 m away. It grows
/// hotter than the edges and expands against them: the closed form is that of its own fraction and
/// shear.
TEST(FreeShear, ReachesTheClosedFormBeforeItsEdgesDo) {
  Cloud c;
  c.fraction = 0.3;
  c.layers = 20;
  c.law.grain_diameter = 0.4;
  const double rate = 2, scale = rate * c.law.grain_diameter;
  c.theta = 0.5 * closed_form(c.law, c.fraction).theta * scale * scale;
  HandMade made = cloud_of(c, true);
  State& s = made.state;
  ParticleSet& p = s.grains();
  const double middle = 0.5 * (c.bottom() + c.top());
  for (std::size_t i = 0; i < p.size(); ++i)
    p.vx[i] = p.components(fields::velocity_before)[0][i] = rate * (p.z[i] - middle);
  refresh_motion(s, s.grains(), 0);
  double n = 0, shear_rate = 0, fraction = 0;
  Inner sum;
  while (s.time < 3) {
    s.grains().motion.max_speed = 30;  // theta is bounded by the speed of the scene
    made.advance();
    if (s.time < 2) continue;
    const Inner now = inner_of(c, s);
    sum.theta += now.theta, sum.pressure += now.pressure, sum.shear += now.shear, n += 1;
    shear_rate += inner_rate_of(c, s), fraction += now.fraction;
  }
  const double own = shear_rate / n * c.law.grain_diameter, unit = 2600 * own * own;
  const auto line = [&](const char* what, double measured, double expected) {
    expect_within(relative(fmt::format("V11 free box, alpha {}, {}", c.fraction, what), "-",
                           measured, expected, 0.03));
  };
  const Shear expected = closed_form(c.law, fraction / n);
  fmt::print("V11 free box: fraction {:.4f}, shear rate {:.4f} of {}\n", fraction / n,
             shear_rate / n, rate);
  line("theta*", sum.theta / n / (own * own), expected.theta);
  line("P*", sum.pressure / n / unit, expected.pressure);
  line("tau/P", sum.shear / sum.pressure, expected.ratio);
}

}  // namespace
}  // namespace sturz::test
