// SPDX-License-Identifier: Apache-2.0
#include "engine/simulation/stop_rule.hpp"

#include "engine/core/constants.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

namespace sturz {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();

StopSettings field_scale() {
  return {.end_time_s = 100,
          .stop_at_rest = true,
          .spacing_m = 2,
          .release_height_m = 10,
          .available_energy_j = 1e9};
}

/// Feeds the rule every 20 ms. \return the time at which it says rest, or `never` [s]
double stop_time(const StopSettings& settings, const std::function<MotionSummary(double)>& motion,
                 double until = 60) {
  StopRule rule(settings);
  for (int n = 0; n * 0.02 <= until; ++n) {
    MotionSummary now = motion(n * 0.02);
    now.time_s = n * 0.02;
    if (rule.at_rest(now)) return now.time_s;
  }
  return never;
}

double window(double spacing) { return std::max(1.0, 5 * std::sqrt(spacing / standard_gravity)); }

/// A slide that reaches its peak at 5 s, then loses energy and speed exponentially.
MotionSummary slide(double t) {
  const double e = t < 5 ? 1e8 * t * t / 25 : 1e8 * std::exp(-(t - 5) / 0.5);
  const double front = t < 5 ? 4 * t * t : 100 + 40 * (1 - std::exp(-(t - 5)));
  return {t, e, front, 0.8 * front};
}

TEST(StopRule, NeverStopsBeforeItIsArmed) {
  // Nothing has moved yet: a mass may need time to start, so 5 sqrt(H/g) must pass.
  const double armed = 5 * std::sqrt(10 / standard_gravity);
  const auto still = [](double) { return MotionSummary{}; };
  const double t = stop_time(field_scale(), still);
  EXPECT_GT(t, armed + window(2) - 0.03);
  EXPECT_LT(t, armed + window(2) + 0.1);
}

TEST(StopRule, AMassThatNeverMovesSettles) {
  EXPECT_LT(stop_time(field_scale(),
                      [](double) {
                        return MotionSummary{0, 1e-3, 1e-4, 1e-5};
                      }),
            20);
}

TEST(StopRule, AFastStartArmsItEarly) {
  StopSettings s = field_scale();
  s.release_height_m = 1000;  // 50 s until the clock alone would arm it
  const auto hop = [](double t) {
    return MotionSummary{t, t < 1 ? 2e5 : 1.0, t < 1 ? 5 * t : 5, t < 1 ? 2 * t : 2};
  };
  const double t = stop_time(s, hop);
  EXPECT_GT(t, 1 + window(2) - 0.03);
  EXPECT_LT(t, 1 + window(2) + 0.1);
  const auto faint = [&](double at) {
    MotionSummary m = hop(at);
    m.kinetic_energy_j *= 0.1;  // stays under 1e-4 of the available energy
    return m;
  };
  EXPECT_GT(stop_time(s, faint), 50);
}

TEST(StopRule, StopsAfterASlideHasComeToRest) {
  const double t = stop_time(field_scale(), slide);
  EXPECT_GT(t, 5 + 0.5 * std::log(1e2) + window(2) - 0.05);  // energy at 1e-2 of its peak
  EXPECT_LT(t,
            5 + std::log(40 / (0.1 * 2 / window(2))) + 2 * window(2) + 0.1);  // front slow enough
}

TEST(StopRule, KineticEnergyAboveAHundredthOfThePeakKeepsItOpen) {
  const auto swinging = [](double t) { return MotionSummary{t, t < 2 ? 1e8 : 1.01e6, 50, 30}; };
  EXPECT_EQ(stop_time(field_scale(), swinging), never);
  const auto calm_end = [](double t) { return MotionSummary{t, t < 2 ? 1e8 : 0.99e6, 50, 30}; };
  EXPECT_LT(stop_time(field_scale(), calm_end), 10);
}

TEST(StopRule, CreepOfTheFrontKeepsItOpen) {
  const double limit = 0.1 * 2 / window(2);  // dx/10 within a window [m/s]
  const auto creeping = [&](double speed) {
    return [speed](double t) { return MotionSummary{t, t < 2 ? 1e8 : 10, 100 + speed * t, 50}; };
  };
  EXPECT_EQ(stop_time(field_scale(), creeping(1.2 * limit)), never);
  EXPECT_LT(stop_time(field_scale(), creeping(0.8 * limit)), 20);
}

TEST(StopRule, CreepOfTheCentreOfMassKeepsItOpen) {
  const double limit = 0.1 * 2 / window(2);  // or a 400th of its travel, 0.05 of dx here
  const auto creeping = [&](double speed) {
    return [speed](double t) { return MotionSummary{t, t < 2 ? 1e8 : 10, 100, 50 + speed * t}; };
  };
  EXPECT_EQ(stop_time(field_scale(), creeping(1.2 * limit)), never);
  EXPECT_LT(stop_time(field_scale(), creeping(0.8 * limit)), 20);
}

TEST(StopRule, AStandstillInBetweenIsNotTheEnd) {
  // At rest for half a window, then a second surge.
  const double pause = 0.5 * window(2);
  const auto surges = [&](double t) {
    const bool moving = t < 3 || (t > 3 + pause && t < 8);
    return MotionSummary{t, moving ? 1e8 : 10, t < 3 ? 20 * t : t < 3 + pause ? 60 : 60 + t, 30};
  };
  EXPECT_GT(stop_time(field_scale(),
                      [&](double t) {
                        return t < 8 ? surges(t) : MotionSummary{t, 10, 68, 30};
                      }),
            8);
}

TEST(StopRule, WindowsShrinkWithTheScale) {
  StopSettings flume = field_scale();
  flume.spacing_m = 0.015;
  flume.release_height_m = 0.3;
  flume.available_energy_j = 100;
  const auto still = [](double) { return MotionSummary{}; };
  const double armed = 5 * std::sqrt(0.3 / standard_gravity);
  EXPECT_LT(stop_time(flume, still), armed + 5 * std::sqrt(0.015 / standard_gravity) + 0.1);
}

/// Front at rest after 10 s; a tail of mass share `tail` drains at `speed` for ever.
MotionSummary draining(double t, double tail, double speed) {
  const double v = t < 10 ? 20 : 0;
  const double energy = 1e8 * ((1 - tail) * v * v + tail * speed * speed) / 400;
  const double front = 20 * std::min(t, 10.0);
  return {t, energy, front, (1 - tail) * front + tail * speed * t};
}

TEST(StopRule, DoesNotWaitForATailBehindAFrontThatStands) {
  const double waits = 10 + window(2);
  EXPECT_NEAR(stop_time(field_scale(), [](double t) { return draining(t, 0.1, 1.5); }), waits, 0.1);
  EXPECT_NEAR(stop_time(field_scale(), [](double t) { return draining(t, 0.02, 4); }), waits, 0.1);
}

TEST(StopRule, WaitsForAMainMassBehindABoulderThatStopped) {
  // 0.8 % of the peak energy, but all of it in a mass that moves as a whole.
  EXPECT_EQ(stop_time(field_scale(), [](double t) { return draining(t, 0.9, 1.9); }), never);
}

TEST(StopRule, TheShareOfEnergyCanBeChosen) {
  StopSettings strict = field_scale();
  strict.energy_fraction = 1e-3;
  EXPECT_EQ(stop_time(strict, [](double t) { return draining(t, 0.05, 3); }), never);
  EXPECT_LT(stop_time(field_scale(), [](double t) { return draining(t, 0.05, 3); }), 40);
}

TEST(StopRule, KnowsRestWhetherItEndsTheRunOrNot) {
  StopSettings s = field_scale();
  const auto still = [](double) { return MotionSummary{}; };
  EXPECT_TRUE(StopRule(s).stops_at_rest());
  const double with = stop_time(s, still);
  s.stop_at_rest = false;
  EXPECT_EQ(stop_time(s, still), with);
  const StopRule rule(s);
  EXPECT_FALSE(rule.stops_at_rest());
  EXPECT_FALSE(rule.out_of_time(99.999));
  EXPECT_TRUE(rule.out_of_time(100));
  EXPECT_EQ(rule.end_time_s(), 100);
}

/// Mass that is still to enter keeps everything from being at rest, and the window begins anew.
TEST(StopRule, WaitsForWhatIsStillToEnter) {
  const double alone = stop_time(field_scale(), slide);
  const auto waiting = [](double t) {
    MotionSummary now = slide(t);
    now.waits = t < 30;
    return now;
  };
  ASSERT_LT(alone, 30);
  EXPECT_NEAR(stop_time(field_scale(), waiting), 30 + window(2), 0.05);
}

}  // namespace
}  // namespace sturz
