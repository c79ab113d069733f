// SPDX-License-Identifier: Apache-2.0
// One event predicted by the others, against closed forms.
#include "ensemble/calibration/calibration.hpp"
#include "ensemble/sampling/unit_cube.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace sturz {
namespace {

double normal_log(double x, double sd) {
  return -0.5 * std::pow(x / sd, 2) - std::log(sd * std::sqrt(2 * std::numbers::pi));
}

/// Both events: travel = 10 + 4 u, u even in (0, 1).
CalibrationData two_events(double north, double south, std::size_t n) {
  CalibrationData data;
  data.keys = {"key"};
  data.cube = draw_unit_cube(Design::sobol, n, 1, 3);
  data.n_drawn = n;
  data.comparison.observed = {{"north/travel_m", north, 0.2, "m"},
                              {"south/travel_m", south, 0.2, "m"}};
  for (std::size_t i = 0; i < n; ++i) {
    data.comparison.simulated.members.push_back(static_cast<std::int64_t>(i));
    const double travel = 10 + 4 * data.cube[i][0];
    data.comparison.simulated.values.push_back(
        {{travel, Known::exactly}, {travel, Known::exactly}});
  }
  return data;
}

CalibrationSettings perfect_model(PosteriorMethod method) {
  CalibrationSettings settings;
  settings.method = method;
  settings.discrepancy = 0;
  return settings;
}

TEST(HeldOutEvents, NamesTellTheEvent) {
  EXPECT_EQ(event_of_quantity("north/speed_3_m_s"), "north");
  EXPECT_EQ(event_of_quantity("out/north/travel_m"), "out/north");
  EXPECT_EQ(event_of_quantity("travel_m"), "");
}

TEST(HeldOutEvents, AreScoredAsTheClosedFormSays) {
  const Calibration c =
      calibrate(two_events(12, 12.3, 4096), perfect_model(PosteriorMethod::weights));
  // Together: 4 u = 2.15 with sd 0.2 / sqrt 2.
  EXPECT_NEAR(c.identifiability.mean[0], 2.15 / 4, 0.002);
  EXPECT_NEAR(c.identifiability.sd[0], 0.2 / std::numbers::sqrt2 / 4, 0.002);
  ASSERT_EQ(c.held_out.events.size(), 2u);
  for (const HeldOutEvent& e : c.held_out.events) {
    // The other event's posterior and the measurement: sd of 0.2 sqrt 2 around the other value.
    EXPECT_NEAR(e.log_score, normal_log(0.3, 0.2 * std::numbers::sqrt2), 0.01) << e.event;
    EXPECT_NEAR(e.prior_log_score, std::log(1.0 / 4), 0.01);
    ASSERT_EQ(e.quantities.size(), 1u);
    EXPECT_EQ(e.n_inside90, 1u);
  }
  EXPECT_EQ(c.held_out.events[0].event, "north");
  const PredictedQuantity& north = c.held_out.events[0].quantities[0];
  // 200 rows stand for the posterior: 0.2 / sqrt(200) = 0.014, three of these.
  EXPECT_NEAR(north.median, 12.3, 0.042);
  EXPECT_NEAR(north.upper - north.lower, 2 * 1.6448536 * 0.2 * std::numbers::sqrt2, 0.02);
}

TEST(HeldOutEvents, ByEmulatorAreScoredAlike) {
  const Calibration c =
      calibrate(two_events(12, 12.3, 40), perfect_model(PosteriorMethod::emulator));
  ASSERT_EQ(c.held_out.events.size(), 2u);
  for (const HeldOutEvent& e : c.held_out.events)
    EXPECT_NEAR(e.log_score, normal_log(0.3, 0.2 * std::numbers::sqrt2), 0.15) << e.event;
}

TEST(HeldOutEvents, AnEventThatTheOthersContradictIsOutside) {
  const Calibration c =
      calibrate(two_events(11, 13, 4096), perfect_model(PosteriorMethod::weights));
  for (const HeldOutEvent& e : c.held_out.events) {
    EXPECT_EQ(e.n_inside90, 0u);
    EXPECT_LT(e.log_score, e.prior_log_score);
  }
}

TEST(HeldOutEvents, TheirDiscrepancyIsOneOfTheKind) {
  CalibrationData data = two_events(11, 13, 256);
  const auto& values = data.comparison.simulated.values;
  const Likelihood shared(data.comparison.observed, values, 0.1);
  EXPECT_EQ(shared.kinds().size(), 1u);
  data.comparison.observed[1].name = "south/speed_m_s";
  const Likelihood apart(data.comparison.observed, values, 0.1);
  EXPECT_EQ(apart.kinds().size(), 2u);
  // Without a say of both nothing is left; without one it is the other alone.
  const SimulatedRow row{{11.5}, {12.8}};
  const std::size_t both[] = {0, 1}, first[] = {0};
  EXPECT_NEAR(shared.log_without(row, both), 0, 1e-12);
  EXPECT_NEAR(shared.log_without(row, first), shared.log_of_one(row, 1), 1e-12);
}

TEST(HeldOutEvents, OneEventHasNone) {
  CalibrationData data = two_events(12, 12.3, 64);
  data.comparison.observed[0].name = "travel_m";
  data.comparison.observed[1].name = "speed_m_s";
  EXPECT_TRUE(calibrate(data, perfect_model(PosteriorMethod::weights)).held_out.events.empty());
}

TEST(Calibration, DrawnMembersHaveTheirWeightsByBothMethods) {
  const auto by = [](PosteriorMethod method) {
    return calibrate(two_events(12, 12.3, 40), perfect_model(method)).member_weights;
  };
  const std::vector<double> weights = by(PosteriorMethod::weights);
  ASSERT_EQ(weights.size(), 40u);
  EXPECT_EQ(weights, by(PosteriorMethod::emulator));
}

}  // namespace
}  // namespace sturz
