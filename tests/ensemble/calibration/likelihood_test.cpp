// SPDX-License-Identifier: Apache-2.0
#include "ensemble/calibration/likelihood.hpp"

#include "engine/core/error.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace sturz {
namespace {

using Members = std::vector<std::vector<Observation>>;

double normal_log(double x, double sd) {
  return -0.5 * std::pow(x / sd, 2) - std::log(sd * std::sqrt(2 * std::numbers::pi));
}

const std::vector<ObservedQuantity> one{{"runout_m", 770, 20, "m"}};
const Members spread{{{500}}, {{900}}};

TEST(Likelihood, WithoutDiscrepancyIsTheNormalDensity) {
  const Likelihood likelihood(one, spread, 0);
  const SimulatedRow row{{800}};
  EXPECT_NEAR(likelihood.log_of(row), normal_log(30, 20), 1e-12);
  const SimulatedRow emulated{{800, 15 * 15}};
  EXPECT_NEAR(likelihood.log_of(emulated), normal_log(30, 25), 1e-12);
}

TEST(Likelihood, DiscrepancyIsMarginalisedOverItsHalfNormalPrior) {
  const Likelihood likelihood(one, spread, 0.1);
  for (const double simulated : {770.0, 700.0, 1000.0}) {
    double sum = 0, norm = 0;
    constexpr int n = 20000;
    for (int j = 0; j < n; ++j) {
      const double z = 6 * (j + 0.5) / n, w = std::exp(-0.5 * z * z);
      norm += w;
      sum += w * std::exp(normal_log(simulated - 770, std::hypot(20, 0.1 * z * 770)));
    }
    EXPECT_NEAR(likelihood.log_of(SimulatedRow{{simulated}}), std::log(sum / norm), 0.01);
  }
}

TEST(Likelihood, QuantitiesOfAKindShareTheirDiscrepancy) {
  EXPECT_EQ(kind_of_quantity("north/speed_3_m_s"), "speed_m_s");
  EXPECT_EQ(kind_of_quantity("speed_12_m_s"), "speed_m_s");
  EXPECT_EQ(kind_of_quantity("deposit_area_m2"), "deposit_area_m2");
  const std::vector<ObservedQuantity> alike{{"speed_1_m_s", 20, 0.2, "m/s"},
                                            {"speed_2_m_s", 20, 0.2, "m/s"}};
  const std::vector<ObservedQuantity> unlike{{"speed_m_s", 20, 0.2, "m/s"},
                                             {"travel_m", 20, 0.2, "m"}};
  const Members members{{{15}, {15}}, {{30}, {30}}};
  const Likelihood same(alike, members, 0.1), other(unlike, members, 0.1);
  EXPECT_EQ(same.kinds().size(), 1U);
  EXPECT_EQ(other.kinds().size(), 2U);
  // Two misses of the same size confirm one another's discrepancy: likelier together than apart.
  const SimulatedRow misses{{25}, {25}};
  EXPECT_GT(same.log_of(misses), other.log_of(misses));
  const auto p = same.node_probabilities(0, misses);
  double mean = 0;
  for (std::size_t j = 0; j < p.size(); ++j) mean += p[j] * same.nodes()[j];
  EXPECT_GT(mean, 0.15);  // misses of a quarter
}

TEST(Likelihood, BoundsExcludeFromAboveAndSayLittleFromBelow) {
  const Likelihood likelihood(one, spread, 0);
  const auto bound = [&](double c) {
    return likelihood.log_of(SimulatedRow{{c, 0, Known::at_least}});
  };
  EXPECT_NEAR(bound(400), -std::log(400.0), 1e-9);  // even over what members span
  EXPECT_NEAR(bound(770), -std::log(800.0), 1e-9);  // half of it
  EXPECT_LT(bound(900), bound(770) - 15);           // 6.5 standard deviations too far
  EXPECT_TRUE(std::isfinite(bound(1e6)));
  EXPECT_LT(bound(1e6), bound(1e5));
  EXPECT_NEAR(likelihood.log_of(SimulatedRow{{NAN, 0, Known::not_at_all}}), -std::log(400.0), 1e-9);
  // An exact hit is worth more than any bound, an exact miss less than one that leaves it open.
  EXPECT_GT(likelihood.log_of(SimulatedRow{{770}}), bound(400));
  EXPECT_LT(likelihood.log_of(SimulatedRow{{600}}), bound(600));
}

TEST(Likelihood, PredictsWithWhatTheOthersSay) {
  const Likelihood likelihood(one, spread, 0);
  const SimulatedRow row{{750}};
  EXPECT_NEAR(likelihood.below(row, 0, 750, true), 0.5, 1e-12);
  EXPECT_NEAR(likelihood.below(row, 0, 750 + 1.6448536 * 20, true), 0.95, 1e-6);
  EXPECT_NEAR(likelihood.below(SimulatedRow{{NAN, 0, Known::not_at_all}}, 0, 770, false), 0.5,
              1e-9);
}

TEST(Likelihood, ADistanceOfNoughtIsAsWrongAsTheBestMember) {
  const std::vector<ObservedQuantity> distance{{"outline_distance_m", 0, 5, "m"}};
  const Members members{{{60}}, {{40}}, {{200}}};
  const Likelihood likelihood(distance, members, default_discrepancy);
  EXPECT_NEAR(likelihood.spread(0), std::hypot(5, 40), 1e-9);
}

std::string error_of(const std::vector<ObservedQuantity>& observed, double discrepancy) {
  try {
    const Likelihood likelihood(observed, spread, discrepancy);
  } catch (const SetupError& problem) {
    return problem.what();
  }
  return "no error";
}

TEST(Likelihood, RefusesWhatIsNoMeasurement) {
  using testing::HasSubstr;
  EXPECT_THAT(error_of({}, 0.1), HasSubstr("nothing was observed"));
  EXPECT_THAT(error_of({{"runout_m", 770, 0, "m"}}, 0.1), HasSubstr("runout_m: sd = 0 m"));
  EXPECT_THAT(error_of({{"runout_m", NAN, 1, "m"}}, 0.1), HasSubstr("not a finite number"));
  EXPECT_THAT(error_of(one, -0.1), HasSubstr("discrepancy -0.1"));
}

}  // namespace
}  // namespace sturz
