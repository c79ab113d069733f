// SPDX-License-Identifier: Apache-2.0
#include "io/risk/risk_file.hpp"

#include "engine/core/error.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sturz {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr const char* two =
    "scenarios:\n"
    "  - {folder: out/small, frequency_per_year: 0.01}\n"
    "  - {folder: out/large, frequency_per_year: 1e-3}\n";

std::string problem(const std::string& text) {
  try {
    parse_risk(text, "risk.yaml");
  } catch (const SetupError& error) {
    return error.what();
  }
  return {};
}

TEST(RiskFile, HasSwissDefaults) {
  const RiskSpec spec = parse_risk(two, "risk.yaml");
  ASSERT_EQ(spec.scenarios.size(), 2U);
  EXPECT_EQ(spec.scenarios[1].folder, "out/large");
  EXPECT_EQ(spec.scenarios[1].frequency_per_year, 0.001);
  EXPECT_THAT(spec.return_periods_years, ElementsAre(30, 100, 300));
  EXPECT_EQ(spec.strong_thickness_m, 1);
  EXPECT_EQ(spec.strong_speed_m_s, 1);
}

TEST(RiskFile, TakesOtherPeriodsAndThresholds) {
  const RiskSpec spec = parse_risk(std::string(two) +
                                       "return_periods_years: [10, 50]\nstrong_thickness_m: 2\n"
                                       "strong_speed_m_s: 1.5\n"
                                       "probability_classes_years: [20, 50, 100]\n",
                                   "risk.yaml");
  EXPECT_THAT(spec.return_periods_years, ElementsAre(10, 50));
  EXPECT_EQ(spec.strong_thickness_m, 2);
  EXPECT_THAT(spec.probability_classes_years, ElementsAre(20, 50, 100));
}

TEST(RiskFile, ProblemsComeTogetherWithTheirPlace) {
  EXPECT_THAT(problem(""), HasSubstr("risk.yaml: names no scenario. Add"));
  EXPECT_THAT(problem("scenarios: [{folder: a, frequency_per_year: 0}]\nperiods: 3\n"),
              AllOf(HasSubstr("risk.yaml:1:45: scenarios[0].frequency_per_year = 0 (must be > 0"),
                    HasSubstr("risk.yaml:2:1: risk.periods (unknown key)")));
  EXPECT_THAT(problem("scenarios: [{folder: a}]\n"),
              HasSubstr("scenarios[0] (frequency_per_year is missing). Add it."));
  EXPECT_THAT(problem("scenarios: [{frequency_per_year: 1}]\n"), HasSubstr("folder is missing"));
  EXPECT_THAT(problem("scenarios: [{folder: a, frequency: 1}]\n"), HasSubstr("unknown key"));
  EXPECT_THAT(problem("scenarios: [{folder: a, frequency_per_year: 1}, "
                      "{folder: a, frequency_per_year: 2}]\n"),
              HasSubstr("scenarios[1].folder = a (is named twice). Add its frequencies up."));
  EXPECT_THAT(problem(std::string(two) + "return_periods_years: [100, 30]\n"),
              HasSubstr("return_periods_years = [100, 30] (must be 1 to 20 rising numbers"));
  EXPECT_THAT(problem(std::string(two) + "strong_speed_m_s: 0\n"), HasSubstr("(must be > 0)"));
  EXPECT_THAT(problem(std::string(two) + "probability_classes_years: [1, 2]\n"),
              HasSubstr("must be three numbers"));
}

}  // namespace
}  // namespace sturz
