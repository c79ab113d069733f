// SPDX-License-Identifier: Apache-2.0
// Grains and liquid as two sets of columns: drag (T8), still water, a dam break of liquid alone,
// accounts, and corners where one phase is thin, fast or not there.
#include "engine/effects/fields.hpp"
#include "tests/support/two_phases.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

namespace sturz::test {
namespace {

Domain periodic(double half) {
  Domain d;
  d.x = {true, -half, half, 0};
  d.y = d.x;
  return d;
}

PhaseColumns lattice(int n, double thickness, const Vec3& velocity = {0, 0, 0}) {
  const auto at = block({n, n, 1}, {-0.5 * n, -0.5 * n, 0});
  return {at, std::vector<double>(at.size(), thickness), velocity};
}

/// V16: equal volumes, 2600 and 1000 kg/m3, 1e4 kg/(m3 s): slip dies out in 0.036111 s.
constexpr double tau = 0.036111111111111;
TwoPhaseSettings drag_box() {
  TwoPhaseSettings s = frictionless_phases();
  s.drag.reference_fraction = 0.5;
  s.drag.permeability = s.drag.fluid_viscosity * 0.25 / 1e4;
  return s;
}

class DragBox : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(StepsOverTau, DragBox, testing::Values(0.01, 0.1, 1.0, 3.0, 100.0),
                         [](const auto& i) {
                           return "Percent" + std::to_string(int(100 * i.param));
                         });

TEST_P(DragBox, SlipDecaysExactlyAndMomentumStays) {  // T8
  HandMade made = phases_on(even_ground(24), lattice(12, 0.5, {1, 0.5, 0}),
                            lattice(12, 0.5, {-1, 0, 0}), drag_box(), periodic(6));
  State& s = made.state;
  s.gravity = 0;
  const Vec3 whole = momentum_of(s.sets[0]) + momentum_of(s.sets[1]);
  const double dt = GetParam() * tau, scale = mass_of(s.sets[0]);
  for (int n = 0; n < 20; ++n) {
    made.step.apply(s, dt);
    const double left = std::exp(-(s.time - 0.5 * dt) / tau);  // velocities lag by half a step
    for (std::size_t i : {0, 37, 143}) {
      ASSERT_NEAR(s.sets[0].vx[i] - s.sets[1].vx[i], 2 * left, 1e-12) << n;
      ASSERT_NEAR(s.sets[0].vy[i] - s.sets[1].vy[i], 0.5 * left, 1e-12) << n;
    }
    const Vec3 now = momentum_of(s.sets[0]) + momentum_of(s.sets[1]);
    ASSERT_LT((now - whole).norm(), 1e-12 * scale) << n;
  }
  const Ledger ledger = s.ledger();
  const double lost = ledger.kinetic_0 - energy_of(s.sets[0]) - energy_of(s.sets[1]);
  EXPECT_NEAR(ledger.drag_loss, lost, 1e-12 * ledger.kinetic_0);
  EXPECT_NEAR(ledger.residual(), 0, 1e-12 * ledger.kinetic_0);
  EXPECT_EQ(ledger.drag_raised, 0);
}

TEST_P(DragBox, OfScatteredColumnsKeepsMomentumAndNeverGainsEnergy) {
  PhaseColumns grains = lattice(12, 0.5), liquid = lattice(12, 0.5);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> jitter(-0.4, 0.4);
  for (auto* phase : {&grains, &liquid})
    for (Vec3& at : phase->at) at += Vec3(jitter(random), jitter(random), 0);
  HandMade made = phases_on(even_ground(24), grains, liquid, drag_box(), periodic(6));
  State& s = made.state;
  s.gravity = 0;
  for (MovingSet& p : s.sets)
    for (std::size_t i = 0; i < p.size(); ++i) {
      p.vx[i] = (&p == &s.sets[0] ? 1 : -1) + jitter(random);
      p.vy[i] = jitter(random);
    }
  const Vec3 whole = momentum_of(s.sets[0]) + momentum_of(s.sets[1]);
  const double start = energy_of(s.sets[0]) + energy_of(s.sets[1]);
  double energy = start;
  for (int n = 0; n < 20; ++n) {
    // Pressure has no say without gravity, viscosity none without waves.
    made.step.apply(s, GetParam() * tau);
    const double now = energy_of(s.sets[0]) + energy_of(s.sets[1]);
    ASSERT_LE(now, energy * (1 + 1e-14)) << n;
    energy = now;
    const Vec3 there = momentum_of(s.sets[0]) + momentum_of(s.sets[1]);
    ASSERT_LT((there - whole).norm(), 1e-12 * mass_of(s.sets[0])) << n;
  }
  EXPECT_NEAR(s.ledger().drag_loss, start - energy, 1e-11 * start);
  if (GetParam() < 1) return;
  const double slip = momentum_of(s.sets[0]).x() / mass_of(s.sets[0]) -
                      momentum_of(s.sets[1]).x() / mass_of(s.sets[1]);
  EXPECT_LT(std::abs(slip), 0.02) << "of 2 m/s";
}

/// Where both phases flow alike drag does nothing, however curved the flow.
TEST(Phases, DragLeavesACommonFlowAlone) {
  TwoPhaseSettings settings = drag_box();
  settings.drag.permeability = 1e-12;
  HandMade made =
      phases_on(even_ground(24), lattice(12, 0.5), lattice(12, 0.5), settings, periodic(6));
  State& s = made.state;
  s.gravity = 0;
  const auto shear = [](double y) { return std::sin(2 * std::numbers::pi * y / 12); };
  for (MovingSet& p : s.sets)
    for (std::size_t i = 0; i < p.size(); ++i) p.vx[i] = shear(p.y[i]);
  for (int n = 0; n < 50; ++n) made.step.apply(s, 0.05);
  for (MovingSet& p : s.sets)
    for (std::size_t i = 0; i < p.size(); ++i) ASSERT_NEAR(p.vx[i], shear(p.y[i]), 1e-12);
}

/// Two metres of water over a wavy bed, grains on the ground: nothing moves but by the error of the
/// smoothed thickness. \return fastest [m/s]
double stirred(int cells_per_wave, double grains_m, double& farthest) {
  const int n = cells_per_wave;
  const int m = n + 8;  // columns drift a little beyond their period
  Raster<double> z(Grid{m, m, -0.5 * m, 0.5 * m, 1, ""});
  const auto bed = [n](double x, double y) {
    return 0.2 * std::sin(2 * std::numbers::pi * x / n) * std::cos(2 * std::numbers::pi * y / n);
  };
  for (int r = 0; r < m; ++r)
    for (int c = 0; c < m; ++c) z.at(r, c) = bed(z.grid.x_center(c), z.grid.y_center(r));
  PhaseColumns grains = lattice(n, grains_m), liquid = lattice(n, 0);
  for (std::size_t i = 0; i < liquid.at.size(); ++i)
    liquid.thickness[i] = 2 - grains_m - bed(liquid.at[i].x(), liquid.at[i].y());
  TwoPhaseSettings settings = frictionless_phases();
  settings.drag.permeability = 1e-9;
  settings.grains.bed[0].friction_coefficient = 0.6;
  HandMade made =
      phases_on(Terrain(std::make_shared<Raster<double>>(std::move(z)), NodataRule::outflow),
                grains, liquid, settings, periodic(0.5 * n));
  State& s = made.state;
  double fastest = 0;
  while (s.time < 20) {
    made.advance();
    for (const MovingSet& p : s.sets) fastest = std::max(fastest, p.motion.max_speed);
  }
  farthest = 0;
  const MovingSet& p = s.sets[0];
  for (std::size_t i = 0; i < p.size(); ++i)
    farthest = std::max(farthest, std::hypot(p.x[i] - p.start_x[p.id[i]] + p.wrapped_x[p.id[i]],
                                             p.y[i] - p.start_y[p.id[i]] + p.wrapped_y[p.id[i]]));
  return fastest;
}

TEST(Phases, StillWaterOverGrainsAtRestStaysStill) {
  double moved24 = 0, moved48 = 0;
  const double coarse = stirred(24, 0.3, moved24), fine = stirred(48, 0.3, moved48);
  const double wave = std::sqrt(9.81 * 2);
  std::printf(
      "still water: fastest %.4f and %.4f m/s of waves of %.2f m/s, grains moved %.2g %.2g m\n",
      coarse, fine, wave, moved24, moved48);
  EXPECT_LT(coarse, 0.02 * wave);
  EXPECT_LT(fine, 0.5 * coarse) << "an error of the smoothing falls with the wave's resolution";
  EXPECT_LT(moved24, 0.01);
  EXPECT_LT(moved48, 0.01);
}

/// One metre of water behind a dam at x = 0.
PhaseColumns dammed(double spacing) {
  PhaseColumns water;
  for (double x = -60 + spacing / 2; x < 0; x += spacing)
    for (double y = -6 + spacing / 2; y < 6; y += spacing) {
      water.at.emplace_back(x, y, 0);
      water.thickness.push_back(1);
    }
  return water;
}

Domain strip() {
  Domain domain;
  domain.y = {true, -6, 6, 0};
  return domain;
}

/// Mean error of the thickness from 40 m behind the dam to the front, against Ritter (1892).
double ritter_error(double spacing) {
  TwoPhaseSettings settings = frictionless_phases();
  settings.grains.spacing = settings.liquid.spacing = spacing;
  HandMade made = phases_on(even_ground(160), {}, dammed(spacing), settings, strip());
  State& s = made.state;
  const double end = 5, c = std::sqrt(9.80665);
  while (s.time < end) made.step.apply(s, std::min(made.step.limit(s).dt, end - s.time));
  const MovingSet& p = s.sets[1];
  const auto& h = p.scalar(fields::thickness);
  double sum = 0, n = 0, at_dam = 0, n_dam = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double x = p.x[i], inside = (2 * c - x / end) / (3 * c);
    if (std::abs(x) < 1) at_dam += h[i], ++n_dam;
    if (x < -40) continue;
    sum += std::abs(h[i] - (x < -c * end ? 1 : inside * inside)), ++n;
  }
  std::printf("Ritter, spacing %.2f m: mean error %.4f m, at the dam %.4f of %.4f m\n", spacing,
              sum / n, at_dam / n_dam, 4.0 / 9);
  EXPECT_NEAR(at_dam / n_dam, 4.0 / 9, 0.02 * spacing);
  return sum / n;
}

TEST(Phases, LiquidAloneBreaksItsDamAsRitterHasIt) {
  const double coarse = ritter_error(1), fine = ritter_error(0.5);
  EXPECT_LT(coarse, 0.015);
  EXPECT_LT(fine, 0.75 * coarse) << "order one half: the tip is where columns are few";
}

/// What is alone is a flow of one phase, to the bit.
TEST(Phases, APhaseAloneIsAFlowOfOnePhase) {
  TwoPhaseSettings settings = frictionless_phases();
  settings.grains.bed[0].friction_coefficient = 0.2;
  const PhaseColumns mass = dammed(1);
  HandMade grains = phases_on(even_ground(160), mass, {}, settings, strip());
  HandMade dry = columns_on(even_ground(160), mass.at, 1, {0, 0, 0}, strip(), settings.grains);
  for (int n = 0; n < 100; ++n) grains.advance(), dry.advance();
  EXPECT_EQ(grains.state.time, dry.state.time);
  EXPECT_EQ(grains.state.sets[0].x, dry.state.grains().x);
  EXPECT_EQ(grains.state.sets[0].vx, dry.state.grains().vx);
}

/// A saturated mass on a slope that ends on level ground. \param permeability [m2]
HandMade slide(double permeability, double slope, int threads = 1, double liquid = 0.4,
               const Vec3& velocity = {0, 0, 0}) {
  PhaseColumns grains, water;
  for (const Vec3& at : block({12, 8, 1}, {-36, -4, 0})) {
    grains.at.push_back(at), grains.thickness.push_back(0.6);
    water.at.push_back(at), water.thickness.push_back(liquid);
  }
  grains.velocity = velocity;
  TwoPhaseSettings settings = frictionless_phases();
  settings.drag.permeability = permeability;
  settings.grains.bed[0].friction_coefficient = 0.5;
  settings.liquid.bed[0].viscosity_pa_s = 0.005;
  settings.liquid.bed[0].turbulent_coefficient = 500;
  return phases_on(even_ground(600, slope), grains, water, settings, {}, threads);
}

/// Nothing is lost but over the edge, nothing is not a number, works explain all of the energy.
void expect_sound(const State& s) {
  for (const MovingSet& p : s.sets) {
    ASSERT_TRUE(p.motion.finite);
    const double mass = mass_of(p) + p.ledger.lost_mass;
    ASSERT_NEAR(mass, p.ledger.released_mass, 1e-13 * p.ledger.released_mass);
    for (const double h : p.scalar(fields::thickness)) ASSERT_GT(h, 0);
  }
}

TEST(Phases, ALedgerOfBothCloses) {
  for (const double k : {1e-10, 1e-7, 1e-5}) {
    HandMade made = slide(k, 0.4);
    State& s = made.state;
    for (int n = 0; n < 400 && s.n_particles() > 0; ++n) {
      made.advance();
      expect_sound(s);
      const Ledger l = s.ledger();
      const double works = l.kinetic_0 + l.gravity_work + l.stress_work + l.contact_work -
                           l.friction - l.lost_energy - l.drag_loss;
      ASSERT_NEAR(l.kinetic, works, 1e-9 * std::max(1.0, l.gravity_work)) << n;
    }
    const Ledger l = s.ledger();
    EXPECT_LT(std::abs(l.residual()), 0.01 * l.available_energy()) << k;
    EXPECT_GT(l.drag_loss, 0) << k;
    std::printf("k = %.0e: drag took %.2f %%, residual %.2g %%, raised %.2g of mass and time\n", k,
                100 * l.drag_loss / l.available_energy(), 100 * l.residual() / l.available_energy(),
                l.drag_raised / (l.brought_mass() * s.time));
  }
}

/// Centre of mass [m].
double middle(const MovingSet& p) {
  return std::inner_product(p.x.begin(), p.x.end(), p.mass.begin(), 0.0) / mass_of(p);
}

TEST(Phases, LiquidRunsAheadWhereItCanAndNotWhereItIsHeld) {
  double lead[2];
  for (int k : {0, 1}) {
    HandMade made = slide(k == 0 ? 1e-10 : 1e-5, 0.45);
    while (made.state.time < 5) made.advance();
    lead[k] = middle(made.state.sets[1]) - middle(made.state.sets[0]);
  }
  std::printf("lead of the liquid: %.3f m held, %.2f m free\n", lead[0], lead[1]);
  EXPECT_LT(std::abs(lead[0]), 0.05);
  EXPECT_GT(lead[1], 3);
}

/// Friction holds the grains, and drag the liquid in their pores: a saturated deposit does not
/// bleed faster than Darcy lets it.
TEST(Phases, ADepositAtRestHoldsItsWater) {
  const double slope = 0.1;
  Domain domain = periodic(6);
  domain.x.rise = -12 * slope;
  for (const double k : {1e-10, 1e-7}) {
    TwoPhaseSettings settings = frictionless_phases();
    settings.drag.permeability = k;
    settings.grains.bed[0].friction_coefficient = 0.6;
    HandMade made =
        phases_on(even_ground(24, slope), lattice(12, 0.6), lattice(12, 0.4), settings, domain);
    while (made.state.time < 5) made.advance();
    EXPECT_LT(made.state.sets[0].motion.max_speed, 1e-9);
    // a_f rho_f g sin = mu a_f^2 u / k
    const double darcy = 1000 * 9.80665 * slope / std::sqrt(1 + slope * slope) / (0.005 * 0.4 / k);
    const MovingSet& p = made.state.sets[1];
    // Liquid that has gone a quarter of the lattice stands in its unevenness (0.2 % of g).
    EXPECT_NEAR(momentum_of(p).x() / mass_of(p) * std::sqrt(1 + slope * slope), darcy,
                (k > 1e-9 ? 0.05 : 0.01) * darcy);
  }
}

struct Corner {
  const char* name;
  double permeability, slope, liquid;
  Vec3 grains_velocity;
};
class Corners : public testing::TestWithParam<Corner> {};
INSTANTIATE_TEST_SUITE_P(Phases, Corners,
                         testing::Values(Corner{"NoDrag", 1e3, 0.6, 0.4, {0, 0, 0}},
                                         Corner{"HugeDrag", 1e-18, 0.6, 0.4, {0, 0, 0}},
                                         Corner{"AFilmOfLiquid", 1e-7, 0.6, 1e-3, {0, 0, 0}},
                                         Corner{"DeepWater", 1e-7, 0.6, 6, {0, 0, 0}},
                                         Corner{
                                             "GrainsShotThroughWater", 1e-5, 0.3, 1, {30, 0, -9}},
                                         Corner{"GrainsShotUphill", 1e-7, 0.6, 1, {-20, 5, 12}}),
                         [](const auto& i) { return i.param.name; });

TEST_P(Corners, StaySound) {
  const Corner& c = GetParam();
  HandMade made = slide(c.permeability, c.slope, 1, c.liquid, c.grains_velocity);
  State& s = made.state;
  int n = 0;
  for (; s.time < 8 && s.n_particles() > 0 && n < 4000; ++n) {
    made.advance();
    expect_sound(s);
  }
  const Ledger l = s.ledger();
  EXPECT_LT(n, 4000) << "steps do not collapse";
  EXPECT_LT(std::abs(l.residual()), 0.02 * l.available_energy());
  EXPECT_LT(s.max_speed(), 60);
}

TEST(Phases, GiveTheSameBitsOnTwoThreads) {
  HandMade one = slide(1e-7, 0.5, 1), two = slide(1e-7, 0.5, 2);
  for (int n = 0; n < 100; ++n) one.advance(), two.advance();
  for (std::size_t k : {0, 1}) {
    EXPECT_EQ(one.state.sets[k].x, two.state.sets[k].x);
    EXPECT_EQ(one.state.sets[k].vy, two.state.sets[k].vy);
    EXPECT_EQ(one.state.sets[k].ledger.drag_loss, two.state.sets[k].ledger.drag_loss);
  }
}

}  // namespace
}  // namespace sturz::test
