// SPDX-License-Identifier: Apache-2.0
// How much room grains take in the liquid, and the divergence of their flux past it.
#include "engine/effects/fields.hpp"
#include "tests/engine/effects/coupling/coupled_sets.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

namespace sturz::test {
namespace {

/// Grains within a liquid that reaches further up and down.
std::array<Lattice, 2> drowned(int n, double jitter, double solids = 0.5) {
  auto sets = full_pores(n, jitter, solids);
  sets[1].n[2] = n + 8;
  sets[1].corner.z() = -4;
  return sets;
}

/// Volume of the grains as the liquid has it, over its true one.
double room(CoupledSets& made, double density = 1000) {
  const MovingSet& liquid = made.liquid();
  double volume = 0, grains = 0;
  for (std::size_t j = 0; j < liquid.size(); ++j)
    volume += liquid.scalar(fields::grain_share)[j] * liquid.mass[j] / density;
  for (const double m : made.grains().mass) grains += m / 2600;
  return volume / grains;
}

TEST(GrainShare, HoldsTheGrainsVolumeToRounding) {
  for (const double jitter : {0.0, 0.3})
    for (const double solids : {0.02, 0.3, 0.6}) {
      const auto sets = drowned(10, jitter, solids);
      CoupledSets made = coupled_sets(sets[0], sets[1], periodic_box(10), {});
      made.step.apply(made.state, 1e-6);
      EXPECT_NEAR(room(made), 1, 1e-13) << jitter << " " << solids;
    }
}

TEST(GrainShare, IsThatOfTheMixtureInside) {
  for (const double jitter : {0.0, 0.2})
    for (const double solids : {0.1, 0.5, 0.62}) {
      const auto sets = full_pores(12, jitter, solids);
      CoupledSets made = coupled_sets(sets[0], sets[1], periodic_box(12), {});
      made.step.apply(made.state, 1e-6);
      double sum = 0, sum2 = 0, n = 0;
      for (std::size_t j = 0; j < made.liquid().size(); ++j) {
        if (std::abs(made.liquid().z[j] - 6) > 1) continue;
        const double off = made.liquid().scalar(fields::grain_share)[j] * (1 - solids) / solids - 1;
        sum += off, sum2 += off * off, n += 1;
      }
      RecordProperty("scatter", std::to_string(std::sqrt(sum2 / n)));
      std::printf("share, jitter %.1f: mean off by %.5f, scatter %.5f\n", jitter, sum / n,
                  std::sqrt(sum2 / n));
      EXPECT_LT(std::sqrt(sum2 / n), jitter > 0 ? 0.1 : 1e-6) << jitter << " " << solids;
      EXPECT_LT(std::abs(sum / n), 0.01);
    }
}

/// A liquid that fills half the pores has half the density there, and as much room.
TEST(GrainShare, CountsTheAirInPoresAsRoom) {
  auto sets = full_pores(12, 0);
  sets[1].bulk *= 0.5;
  CoupledSets made = coupled_sets(sets[0], sets[1], periodic_box(12), {});
  made.liquid().add(fields::density_change);
  made.liquid().scalar(fields::density_change).assign(made.liquid().size(), -0.5);
  made.step.apply(made.state, 1e-6);
  for (std::size_t j = 0; j < made.liquid().size(); ++j)
    if (std::abs(made.liquid().z[j] - 6) < 1) {
      EXPECT_NEAR(made.liquid().scalar(fields::grain_share)[j], 1, 1e-6);
    }
}

TEST(GrainShare, LeavesATenthForTheLiquid) {
  auto sets = full_pores(8, 0.2);
  sets[1].bulk *= 0.02;  // a film on the grains
  CoupledSets made = coupled_sets(sets[0], sets[1], periodic_box(8), {});
  made.liquid().ax.assign(made.liquid().size(), 3.0f);
  const Vec3 before = made.momentum();
  made.step.apply(made.state, 0.02);
  double pushed = 0;
  for (std::size_t j = 0; j < made.liquid().size(); ++j) {
    const double share = made.liquid().scalar(fields::grain_share)[j];
    EXPECT_LE(share, 9);
    pushed += made.liquid().mass[j] * (1 + share) * 3 * 0.01;
  }
  EXPECT_NEAR(made.momentum().x() - before.x(), pushed, 1e-12 * pushed)
      << "what it hands over is what its room says";
}

/// v_p = A x in still liquid: div(alpha_p v_p) = alpha_p tr A.
TEST(SlipDivergence, IsExactForALinearFieldOnALattice) {
  const auto sets = full_pores(14, 0);
  CoupledSets made = coupled_sets(sets[0], sets[1], {}, {});
  MovingSet& p = made.grains();
  for (std::size_t i = 0; i < p.size(); ++i)
    p.vx[i] = 0.2 * p.x[i] + 0.1 * p.z[i], p.vy[i] = -0.05 * p.y[i], p.vz[i] = 0.1 * p.x[i];
  made.step.apply(made.state, 1e-9);
  const MovingSet& l = made.liquid();
  for (std::size_t j = 0; j < l.size(); ++j)
    if ((Vec3(l.x[j], l.y[j], l.z[j]) - Vec3(7, 7, 7)).cwiseAbs().maxCoeff() < 3) {
      EXPECT_NEAR(l.scalar(fields::slip_divergence)[j], 0.5 * 0.15, 1e-4 * 0.5 * 0.15);
    }
}

/// Where the two sets lie out of step the flux of a uniform slip has a divergence from place to
/// place, in units of alpha_p u/dx: what the smoothing sees of the grains' places. Its sum is
/// nothing.
TEST(SlipDivergence, OfAUniformSlipScattersWithTheDisorder) {
  for (const double jitter : {0.0, 0.1, 0.2}) {
    auto sets = full_pores(12, jitter);
    sets[0].velocity = {0, 0.6, 0.8};
    sets[1].corner = {0.3, 0.4, -3.8};
    sets[1].n[2] = 20;
    CoupledSets made = coupled_sets(sets[0], sets[1], periodic_box(12), {});
    made.step.apply(made.state, 1e-9);
    double sum = 0, sum2 = 0, n = 0;
    const MovingSet& l = made.liquid();
    const auto& slip = l.scalar(fields::slip_divergence);
    for (std::size_t j = 0; j < l.size(); ++j)
      if (std::abs(l.z[j] - 6) < 2) sum2 += slip[j] * slip[j], n += 1;
    for (const double d : slip) sum += d;
    const double scatter = std::sqrt(sum2 / n) / 0.5;
    std::printf("uniform slip, jitter %.1f: scatter %.4f alpha u/dx\n", jitter, scatter);
    RecordProperty("scatter_" + std::to_string(jitter), std::to_string(scatter));
    EXPECT_LT(scatter, 0.3) << jitter;
    EXPECT_LT(std::abs(sum) / static_cast<double>(slip.size()), 0.03 * scatter + 0.01);
  }
}

/// Grains that close in on still liquid squeeze it.
TEST(SlipDivergence, IsNegativeWhereGrainsCloseIn) {
  const auto sets = full_pores(10, 0);
  CoupledSets made = coupled_sets(sets[0], sets[1], {}, {});
  MovingSet& p = made.grains();
  for (std::size_t i = 0; i < p.size(); ++i) p.vx[i] = 5 - p.x[i];
  made.step.apply(made.state, 1e-9);
  for (std::size_t j = 0; j < made.liquid().size(); ++j)
    if (std::abs(made.liquid().x[j] - 5) < 2 && std::abs(made.liquid().y[j] - 5) < 2 &&
        std::abs(made.liquid().z[j] - 5) < 2) {
      EXPECT_LT(made.liquid().scalar(fields::slip_divergence)[j], -0.4);
    }
}

/// Root mean square error in a sine of one wave along a period, of its own amplitude.
double sine_error(int n) {
  auto sets = full_pores(12, 0);
  const double length = 12, dx = length / n;
  for (Lattice& l : sets) l.n = {n, 6, 14}, l.spacing = dx;
  Domain box;
  box.x = {true, 0, length, 0};
  box.y = {true, 0, 6 * dx, 0};
  CouplingSettings settings;
  settings.smoothing_length = 1.3 * dx, settings.spacing = dx;
  CoupledSets made = coupled_sets(sets[0], sets[1], box, settings);
  const double wave = 2 * std::numbers::pi / length;
  for (std::size_t i = 0; i < made.grains().size(); ++i)
    made.grains().vx[i] = std::sin(wave * made.grains().x[i]);
  made.step.apply(made.state, 1e-9);
  double sum = 0, n_inside = 0;
  const MovingSet& l = made.liquid();
  for (std::size_t j = 0; j < l.size(); ++j) {
    if (std::abs(l.z[j] - 7 * dx) > 2 * dx) continue;
    const double exact = 0.5 * wave * std::cos(wave * l.x[j]);
    sum += std::pow(l.scalar(fields::slip_divergence)[j] - exact, 2), n_inside += 1;
  }
  return std::sqrt(2 * sum / n_inside) / (0.5 * wave);
}

TEST(SlipDivergence, ConvergesWithTheSpacing) {
  const double coarse = sine_error(8), middle = sine_error(16), fine = sine_error(32);
  std::printf("sine of slip at 8, 16, 32 a wave: %.4f %.4f %.4f\n", coarse, middle, fine);
  RecordProperty("order", std::to_string(std::log2(coarse / middle)));
  EXPECT_GT(std::log2(coarse / middle), 1.5);
  EXPECT_GT(std::log2(middle / fine), 1.5);
}

}  // namespace
}  // namespace sturz::test
