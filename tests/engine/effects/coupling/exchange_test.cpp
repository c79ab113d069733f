// SPDX-License-Identifier: Apache-2.0
// Buoyancy and drag between two sets: closed forms, momentum, energy, dry fronts.
#include "engine/effects/fields.hpp"
#include "engine/laws/drag.hpp"
#include "tests/engine/effects/coupling/coupled_sets.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace sturz::test {
namespace {

/// A column of full pores so high that what happens at its ends does not reach its middle in five
/// steps. The grains' own volumes a little over theirs: then every grain meets all liquid of its
/// cell, and weights on the lattice are exact.
CoupledSets long_column(const CouplingSettings& settings, const Vec3& slip) {
  auto sets = full_pores(6, 0);
  sets[0].n[2] = 60, sets[1].n[2] = 68;
  sets[1].corner.z() = -4;
  sets[0].fraction = 0.49;
  sets[0].velocity = slip;
  return coupled_sets(sets[0], sets[1], periodic_box(6), settings);
}

Vec3 slip_inside(CoupledSets& made) {
  for (std::size_t i = 0; i < made.grains().size(); ++i)
    for (std::size_t j = 0; j < made.liquid().size(); ++j)
      if (std::abs(made.grains().z[i] - 30) < 0.6 && std::abs(made.liquid().z[j] - 30) < 0.6) {
        const MovingSet &p = made.grains(), &l = made.liquid();
        return {p.vx[i] - l.vx[j], p.vy[i] - l.vy[j], p.vz[i] - l.vz[j]};
      }
  return {0, 0, 0};
}

/// V16 with frozen weights: beta = 1e4 kg/(m^3 s).
TEST(Exchange, AUniformSlipDecaysExactly) {
  CouplingSettings settings;
  settings.viscosity = 1;
  settings.drag_multiplier = 1e4 / GranularDrag{0.01, 1000, 1}.exchange(0.5, 0);
  const double tau = 1 / (1e4 * (1 / (0.5 * 2600) + 1 / (0.5 * 1000)));
  EXPECT_NEAR(tau, .036111, 1e-6);
  for (const double step : {0.1, 1.0, 10.0}) {
    const Vec3 slip(1e-10, 0, 2e-10);  // so slow that the law is linear
    CoupledSets made = long_column(settings, slip);
    double time = 0;
    for (int n = 0; n < 5; ++n) {
      made.step.apply(made.state, step * tau);
      time += (n == 0 ? 0.5 : 1) * step;                      // the first kick is half a step
      const double left = std::exp(-time), rounding = 2e-14;  // of the velocities
      EXPECT_LT((slip_inside(made) - left * slip).norm(),
                (1e-9 * left * time + rounding) * slip.norm())
          << step << " " << n;
    }
  }
}

/// The slip under a steady difference of accelerations is the law's at any step.
TEST(Exchange, ASteadySlipIsTheLawsWhateverTheStep) {
  CouplingSettings settings;
  settings.buoyancy = false;  // accelerations are given
  const GranularDrag law{0.01, 1000, 0.001};
  const double apart = 4;  // m/s^2
  const double reduced = 1 / (1 / 1300.0 + 1 / 500.0);
  double slip = 0.1;
  for (int n = 0; n < 200; ++n) slip = 0.5 * (slip + reduced * apart / law.exchange(0.5, slip));
  const double tau = reduced / law.exchange(0.5, slip);
  for (const double step : {3.0, 10.0, 1e3}) {
    CoupledSets made = long_column(settings, {0, 0, 0});
    // The middle of both stays where it is.
    made.grains().az.assign(made.grains().size(), -static_cast<float>(apart * 500 / 1800));
    made.liquid().az.assign(made.liquid().size(), static_cast<float>(apart * 1300 / 1800));
    const std::vector<double> places[] = {made.grains().z, made.liquid().z};
    for (int n = 0; n < 6; ++n) {
      made.step.apply(made.state, step * tau);
      made.grains().z = places[0], made.liquid().z = places[1];  // weights stay as they are
    }
    const double error = -slip_inside(made).z() / slip - 1;
    std::printf("steady slip at dt/tau = %g: off by %.2e\n", step, error);
    EXPECT_LT(std::abs(error), 1e-3) << step;
  }
}

/// Random velocities and a uniform slip.
CoupledSets box_in_motion(const CouplingSettings& settings, double jitter, double random_part) {
  auto sets = full_pores(12, jitter);
  sets[0].velocity = {0, 0, 1};
  CoupledSets made = coupled_sets(sets[0], sets[1], periodic_box(12), settings);
  std::mt19937 random(5);
  std::normal_distribution<double> normal(0, random_part);
  for (MovingSet& p : made.state.sets)
    for (std::size_t i = 0; i < p.size(); ++i)
      p.vx[i] += normal(random), p.vy[i] += normal(random), p.vz[i] += normal(random);
  for (MovingSet& p : made.state.sets) {
    double kinetic = 0;
    for (std::size_t i = 0; i < p.size(); ++i)
      kinetic += 0.5 * p.mass[i] * Vec3(p.vx[i], p.vy[i], p.vz[i]).squaredNorm();
    p.ledger.kinetic = p.ledger.kinetic_0 = kinetic;
  }
  return made;
}

double momentum_scale(const CoupledSets& made) {
  double sum = 0;
  for (const MovingSet& p : made.state.sets)
    for (std::size_t i = 0; i < p.size(); ++i)
      sum += p.mass[i] * Vec3(p.vx[i], p.vy[i], p.vz[i]).norm();
  return sum;
}

/// V16: grains of 0.1 mm, whose slip decays within 5e-5 s.
TEST(Exchange, StiffDragKeepsMomentumAndNeverAddsEnergy) {
  CouplingSettings settings;
  settings.drag_diameter = 1e-4;
  const GranularDrag law{1e-4, 1000, 0.001};
  const double tau = 1 / (law.exchange(0.5, 0) * (1 / 1300.0 + 1 / 500.0));
  EXPECT_LT(tau, 1e-4);
  for (const double step : {1.0, 100.0, 1e4})
    for (const double random_part : {0.0, 0.3}) {
      CoupledSets made = box_in_motion(settings, 0.25, random_part);
      const Vec3 momentum = made.momentum();
      const double scale = momentum_scale(made), start = made.kinetic();
      double kinetic = start;
      for (int n = 0; n < 12; ++n) {
        made.step.apply(made.state, step * tau);
        EXPECT_LE(made.kinetic(), kinetic * (1 + 1e-14)) << step << " " << n;
        kinetic = made.kinetic();
        EXPECT_LT((made.momentum() - momentum).norm(), 1e-12 * scale) << step << " " << n;
      }
      const Ledger both = made.state.ledger();
      EXPECT_NEAR(both.drag_loss, start - kinetic, 1e-11 * start);
      EXPECT_GT(both.drag_loss, 0.2 * start);
      EXPECT_LT(std::abs(both.residual()), 1e-11 * start);
    }
}

/// How far splitting and disorder take the decay from the closed form, whose rate is that of the
/// mean share of grains: reported, see AUniformSlipDecaysExactly for the scheme itself.
TEST(Exchange, AJitteredBoxDecaysNearly) {
  CouplingSettings settings;
  settings.viscosity = 1;
  settings.drag_multiplier = 1e4 / GranularDrag{0.01, 1000, 1}.exchange(0.5, 0);
  const double tau = 1 / (1e4 * (1 / 1300.0 + 1 / 500.0));
  for (const int steps : {1, 3, 30}) {
    auto sets = full_pores(12, 0.25);
    sets[0].velocity = {0, 0, 1e-10};
    CoupledSets made = coupled_sets(sets[0], sets[1], periodic_box(12), settings);
    for (int n = 0; n < steps; ++n) made.step.apply(made.state, 3 * tau / (steps - 0.5));
    double mean[2] = {0, 0};
    for (const int k : {0, 1}) {
      const MovingSet& p = made.state.sets[k];
      double n_inside = 0;
      for (std::size_t i = 0; i < p.size(); ++i)
        if (std::abs(p.z[i] - 6) < 2) mean[k] += p.vz[i], n_inside += 1;
      mean[k] /= n_inside;
    }
    const double left = (mean[0] - mean[1]) / 1e-10;
    std::printf("jittered box after 3 tau in %d steps: %.5f of the slip, exact %.5f\n", steps, left,
                std::exp(-3.0));
    RecordProperty("left_after_" + std::to_string(steps), std::to_string(left));
    EXPECT_GT(left, 0) << steps;
    EXPECT_LT(left, 2 * std::exp(-3.0)) << steps;
  }
}

TEST(Exchange, EachGrainTakesItsShareOfThePush) {
  CouplingSettings settings;
  settings.drag_multiplier = 0;
  auto sets = full_pores(10, 0.25);
  CoupledSets made = coupled_sets(sets[0], sets[1], periodic_box(10), settings);
  MovingSet &p = made.grains(), &l = made.liquid();
  l.az.assign(l.size(), 9.81f);  // water at rest
  made.step.apply(made.state, 0.01);
  const double gained = 1000.0 / 2600 * 9.81f * 0.005;
  for (std::size_t i = 0; i < p.size(); ++i)
    if (std::abs(p.z[i] - 5) < 4.5) {
      EXPECT_NEAR(p.vz[i], gained, 1e-12 * gained) << p.z[i];
    }
  made.step.apply(made.state, 0.01);  // the second kick is a whole one
  for (std::size_t i = 0; i < p.size(); ++i)
    if (std::abs(p.z[i] - 5) < 4) {
      EXPECT_NEAR(p.vz[i], 3 * gained, 1e-9 * gained);
    }
}

TEST(Exchange, TheMixtureGetsTheWholePush) {
  CouplingSettings settings;
  settings.drag_diameter = 1e-3;
  CoupledSets made = box_in_motion(settings, 0.25, 0.3);
  MovingSet& l = made.liquid();
  std::mt19937 random(9);
  std::normal_distribution<float> normal(0, 20);
  for (auto* a : {&l.ax, &l.ay, &l.az})
    for (float& value : *a) value = normal(random);
  Vec3 expected = made.momentum();
  const double scale = momentum_scale(made), dt = 1e-3;
  made.step.apply(made.state, 1e-12);  // the first kick is half a step, which works do not know
  for (int n = 0; n < 5; ++n) {
    made.step.apply(made.state, dt);
    for (std::size_t j = 0; j < l.size(); ++j)
      expected +=
          l.mass[j] * (1 + l.scalar(fields::grain_share)[j]) * dt * Vec3(l.ax[j], l.ay[j], l.az[j]);
    EXPECT_LT((made.momentum() - expected).norm(), 1e-12 * scale) << n;
  }
  const Ledger both = made.state.ledger();
  EXPECT_NE(both.exchange_work, 0);
  EXPECT_GT(both.drag_loss, 0);
  EXPECT_LT(std::abs(both.residual()), 1e-10 * both.kinetic_0);
  for (const MovingSet& p : made.state.sets)
    EXPECT_LT(std::abs(p.ledger.residual()), 1e-10 * both.kinetic_0) << p.name;
}

TEST(Exchange, WithoutBuoyancyGrainsTakeRoomAndNoPush) {
  CouplingSettings settings;
  settings.buoyancy = false;
  settings.drag_multiplier = 0;
  const auto sets = full_pores(8, 0.2);
  CoupledSets made = coupled_sets(sets[0], sets[1], periodic_box(8), settings);
  made.liquid().az.assign(made.liquid().size(), 9.81f);
  for (int n = 0; n < 3; ++n) made.step.apply(made.state, 0.01);
  for (const double v : made.grains().vz) EXPECT_EQ(v, 0);
  for (const double x : made.liquid().scalar(fields::grain_share)) EXPECT_GT(x, 0);
}

/// Pores half full: drag on half of the grain.
TEST(Exchange, DragIsInTheShareThatIsWet) {
  CouplingSettings settings;
  settings.viscosity = 1;
  double gained[2];
  for (const int half : {0, 1}) {
    CoupledSets made = long_column(settings, {1e-6, 0, 0});
    made.liquid().add(fields::density_change);
    made.liquid().scalar(fields::density_change).assign(made.liquid().size(), half ? -0.5 : 0);
    for (double& m : made.liquid().mass) m *= half ? 0.5 : 1;
    made.step.apply(made.state, 1e-9);
    gained[half] = slip_inside(made).x() - 1e-6;
  }
  // The liquid's own inertia is half, too: what the grains lose is what counts.
  const double grains_share[2] = {500.0 / 1800, 250.0 / 1550};
  EXPECT_NEAR(gained[1] * grains_share[1] / (gained[0] * grains_share[0]), 0.5, 1e-3);
}

TEST(DryFront, GrainsWithoutLiquidAroundFeelNothing) {
  auto sets = full_pores(8, 0.2);
  sets[0].n[0] = 24;  // liquid reaches a third of the way
  sets[0].velocity = {0, 0, 2};
  CouplingSettings settings;
  settings.drag_diameter = 1e-4;
  CoupledSets made = coupled_sets(sets[0], sets[1], {}, settings);
  made.liquid().ax.assign(made.liquid().size(), -50.0f);
  double push = 0;
  for (int n = 0; n < 4; ++n) {
    made.step.apply(made.state, 1e-3);
    push += (n == 0 ? 0.5e-3 : 1e-3) * 50;
    const MovingSet& p = made.grains();
    for (std::size_t i = 0; i < p.size(); ++i) {
      const Vec3 v(p.vx[i], p.vy[i], p.vz[i]);
      ASSERT_TRUE(v.allFinite());
      EXPECT_LT((v - Vec3(0, 0, 2)).norm(), 2 + push) << "no more than meeting the liquid gives";
      if (p.x[i] > 8 + 2.8) {
        EXPECT_EQ(v, Vec3(0, 0, 2)) << p.x[i];
      }
    }
    for (const double x : made.liquid().scalar(fields::grain_share)) ASSERT_TRUE(std::isfinite(x));
    for (const double v : made.liquid().vz) ASSERT_TRUE(std::isfinite(v));
  }
}

/// What a grain and a liquid particle do to each other fades to nothing as they part.
TEST(DryFront, OneFarNeighbourGivesNoSpike) {
  double last = 1e300;
  for (const double gap : {0.3, 0.1, 0.03, 0.01, 1e-3, 1e-5}) {  // of the support
    Lattice grain, drop;
    grain.n = drop.n = {1, 1, 1};
    grain.bulk = 1560, grain.fraction = 0.6;
    drop.bulk = 1000;
    drop.corner = {2.6 * (1 - gap), 0, 0};
    drop.velocity = {0, 5, 0};
    CouplingSettings settings;
    settings.drag_diameter = 1e-4;
    CoupledSets made = coupled_sets(grain, drop, {}, settings);
    made.liquid().az.assign(1, 100.0f);
    made.step.apply(made.state, 0.02);
    const MovingSet &p = made.grains(), &l = made.liquid();
    const double gained = Vec3(p.vx[0], p.vy[0], p.vz[0]).norm();
    EXPECT_LT(gained, last) << gap;
    EXPECT_LT(gained, 20 * gap * gap) << gap;
    EXPECT_LT(std::abs(l.vy[0] - 5), 20 * gap * gap) << gap;
    EXPECT_TRUE(std::isfinite(l.scalar(fields::slip_divergence)[0]));
    last = gained;
  }
}

TEST(DryFront, AScreeWithoutLiquidAndALakeWithoutGrains) {
  for (const int empty : {0, 1}) {
    auto sets = full_pores(6, 0.1);
    sets[empty].n = {0, 0, 0};
    sets[0].velocity = {1, 0, 0};
    CoupledSets made = coupled_sets(sets[0], sets[1], {}, {});
    for (int n = 0; n < 3; ++n) made.step.apply(made.state, 1e-2);
    for (const double v : made.grains().vx) EXPECT_EQ(v, 1);
    for (const double x : made.liquid().scalar(fields::grain_share)) EXPECT_EQ(x, 0);
  }
}

}  // namespace
}  // namespace sturz::test
