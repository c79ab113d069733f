// SPDX-License-Identifier: Apache-2.0
// A film of mixture: both beds that hold a liquid brake it alike.
#include "engine/effects/fields.hpp"
#include "tests/support/liquid/liquid_scene.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

namespace sturz::test {
namespace {

constexpr double depth = 5e-4, slope = 0.2, pull = 1e-4, viscosity = 1e-3;  // of water

/// A film that runs down a slope without end.
LiquidBox film_on(LiquidBed bed) {
  constexpr int layers = 4, period = 6;
  LiquidBox b;
  const double dx = depth / layers, cosine = 1 / std::hypot(1, slope), sine = slope * cosine;
  b.spacing = dx;
  b.n = {period, period, layers};
  b.slope = slope;
  b.along_slope = true;
  b.gravity = pull / sine;
  b.half_width = 20 * dx;
  b.settings.law = {0, viscosity, 1};
  b.settings.sound_speed = 0.15;
  b.bed = bed;
  b.domain.x = {true, 0, period * dx * cosine, -period * dx * sine};
  b.domain.y = {true, 0, period * dx, 0};
  return b;
}

/// Mean speed down the slope once it is steady, over that of a film of water: pull H^2/(3 nu).
/// Grains take `share` times the liquid's volume all the while, and move with it.
double steady_speed(LiquidBed bed, double share) {
  HandMade made = liquid_of(film_on(bed));
  MovingSet& p = made.state.sets[0];
  p.add(fields::grain_share);
  p.scalar(fields::grain_share).assign(p.size(), share);
  for (double& m : p.mass) m /= 1 + share;
  while (made.state.time < 0.5 * (1 + share)) made.advance();
  double sum = 0;
  for (std::size_t i = 0; i < p.size(); ++i) sum += (p.vx[i] - slope * p.vz[i]);
  const double mean = sum / std::hypot(1, slope) / static_cast<double>(p.size());
  return mean / (pull * depth * depth * 1000 / (3 * viscosity));
}

/// The liquid's shear stress acts on its share 1/(1 + X) of every face. A layer of depth H whose
/// stress ends at the bed then has tau_b = 3 mu v/((1 + X) H), and the liquid, which keeps its
/// share of the stress's divergence, runs at (1 + X) pull H^2/(3 nu).
TEST(MixedFilm, IsBrakedByTheLiquidsShareOfTheBed) {
  for (const double share : {0.0, 1.0}) {
    const double film = steady_speed(LiquidBed::film, share) / (1 + share);
    const double held = steady_speed(LiquidBed::no_slip, share) / (1 + share);
    std::printf("X = %g: film %.3f, no slip %.3f of the closed form\n", share, film, held);
    EXPECT_NEAR(film, 1, 0.1) << share;
    EXPECT_NEAR(held, 1, 0.1) << share;
  }
}

}  // namespace
}  // namespace sturz::test
