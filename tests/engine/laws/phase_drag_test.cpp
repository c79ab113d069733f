// SPDX-License-Identifier: Apache-2.0
#include "engine/laws/phase_drag.hpp"

#include "engine/core/constants.hpp"

#include <gtest/gtest.h>

namespace sturz {
namespace {

TEST(PhaseDrag, SettlingSpeedsOfNaturalGrains) {
  // Ferguson and Church by hand: R = 1.65, nu = 1e-6.
  EXPECT_NEAR(settling_speed(1e-3, 2650, 1000, 1e-3, 9.81), 0.126278, 1e-6);
  EXPECT_NEAR(settling_speed(1e-4, 2650, 1000, 1e-3, 9.81), 0.00753413, 1e-8);
  // A boulder: only the turbulent part is left, sqrt(R g d / 0.75).
  EXPECT_NEAR(settling_speed(1, 2650, 1000, 1e-3, 9.81), std::sqrt(16.1865 / 0.75), 1e-3);
}

TEST(PhaseDrag, OfPermeabilityIsDarcys) {
  PhaseDrag drag;
  drag.permeability = 1e-9, drag.reference_fraction = 0.6;
  // mu a_f^2/k over the mass of grains in a volume.
  EXPECT_NEAR(drag.rate(0.6, 9.81), 0.005 * 0.16 / 1e-9 / (0.6 * 2600), 1e-6);
  EXPECT_NEAR(drag.rate(0.56, 9.81) / (0.44 * 0.44 / 0.56),
              drag.rate(0.6, 9.81) / (0.16 / 0.6) / std::exp(1), 1e-6)
      << "k grows by e for every 0.04 of loosening";
  EXPECT_EQ(drag.rate(0.05, 9.81), drag.rate(0.3, 9.81)) << "no packing is looser";
}

TEST(PhaseDrag, OfSettlingLetsALoneGrainFallAtItsSpeed) {
  PhaseDrag drag;
  drag.settling = 0.5, drag.grain_diameter = 0.01;
  // In balance with its buoyant weight (1 - g) G: slip U.
  const double slip = (1 - drag.density_ratio()) * 9.81 / drag.rate(0.01, 9.81);
  EXPECT_NEAR(slip, 0.5, 0.02);
  EXPECT_GT(drag.rate(0.6, 9.81), 0);
}

TEST(PhaseDrag, LargestSlipIsPelantis) {
  PhaseDrag drag;
  // 2 sqrt((1 - 0.5)(1 - 1/2.6)/2) sqrt(9.81 * 2)
  EXPECT_NEAR(drag.largest_slip(0.5, 9.81 * 2), 2 * std::sqrt(0.5 * (1.6 / 2.6) / 2) * 4.429447,
              1e-5);
  EXPECT_EQ(drag.largest_slip(1, 10), 0);
  EXPECT_TRUE(std::isinf(drag.largest_slip(0.5, 0)));
}

SlippingPair pair(double rate) {
  SlippingPair p;
  p.grains = 1300, p.liquid = 500, p.rate = rate;
  p.slip_before = p.slip = Vec3(2, 0, 0);
  p.largest_slip = 100;
  return p;
}

TEST(PhaseDrag, AnEvenSlipDecaysExactly) {
  const double reduced = 1300.0 * 500 / 1800;
  for (const double steps : {1e-7, 1e-3, 1.0, 50.0}) {
    const double rate = steps * reduced / 1300;  // over one second
    const DragImpulse i = drag_impulse(pair(rate), 1);
    EXPECT_NEAR(i.on_liquid.x() / (reduced * 2), -std::expm1(-steps), 1e-15);
    EXPECT_FALSE(i.raised);
  }
}

/// Driven evenly, a slip tends to drive times relaxation time at any length of step.
TEST(PhaseDrag, ADrivenSlipFindsItsBalance) {
  const double reduced = 1300.0 * 500 / 1800, drive = 3;
  for (const double dt : {0.01, 1.0, 30.0}) {
    SlippingPair p = pair(0.7 * reduced / 1300);
    p.slip_before = Vec3(0, 0, 0);
    for (int n = 0; n < 4000; ++n) {
      p.slip = p.slip_before + dt * Vec3(drive, 0, 0);
      p.slip_before = p.slip - drag_impulse(p, dt).on_liquid / reduced;
    }
    EXPECT_NEAR(p.slip_before.x(), drive / 0.7, 1e-9) << dt;
  }
}

TEST(PhaseDrag, IsRaisedWhereTheSlipIsTooLarge) {
  SlippingPair p = pair(1e-3);
  p.largest_slip = 0.5;
  const double reduced = 1300.0 * 500 / 1800;
  const DragImpulse i = drag_impulse(p, 1);
  EXPECT_TRUE(i.raised);
  EXPECT_NEAR(2 - i.on_liquid.x() / reduced, 0.5, 1e-12);
}

TEST(PhaseDrag, OnHeldGrainsBrakesTheLiquidAsTheBedWould) {
  SlippingPair p = pair(1e6);
  p.spare = 2000;  // more than the liquid's 1000 N s
  EXPECT_NEAR(drag_impulse(p, 1).on_liquid.x(), 1000, 1e-6);
  p.spare = 400;  // then grains are torn along: what is left over is shared
  EXPECT_NEAR(drag_impulse(p, 1).on_liquid.x(), 400 + 1300.0 * 500 / 1800 * (2 - 0.8), 1e-6);
  p.spare = 0;
  EXPECT_NEAR(drag_impulse(p, 1).on_liquid.x(), 1300.0 * 500 / 1800 * 2, 1e-6);
}

}  // namespace
}  // namespace sturz
