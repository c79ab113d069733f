// SPDX-License-Identifier: Apache-2.0
// Designs whose members belong together in sets.
#include "scenarios/catalogue.hpp"
#include "scenarios/checks/validate.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sturz {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::vector<std::string> messages(const Scenario& s) {
  std::vector<std::string> texts;
  for (const auto& problem : validate(s)) texts.push_back(problem.message);
  return texts;
}

Uncertain uniform(double min, double max) {
  Uncertain u;
  u.distribution.emplace();
  u.distribution->kind = Distribution::Kind::uniform;
  u.distribution->min = min;
  u.distribution->max = max;
  return u;
}

TEST(DesignSets, DesignsOfSetsWantWholeSetsOfIndependentValues) {
  Scenario s = pile();
  s.basal.friction_coefficient = uniform(0.3, 0.6);
  s.basal.pore_pressure_ratio = uniform(0, 0.5);
  s.ensemble.members = 10;
  s.ensemble.design = Design::morris;
  EXPECT_THAT(messages(s), ElementsAre(HasSubstr("takes sets of 3 members for 2 uncertain values). "
                                                 "Use 12.")));
  s.ensemble.design = Design::saltelli;
  EXPECT_THAT(messages(s), ElementsAre(HasSubstr("sets of 4 members for 2 uncertain values). Use "
                                                 "12.")));
  s.ensemble.members = 8;
  EXPECT_THAT(messages(s), IsEmpty());
  s.ensemble.correlation = {{"basal.friction_coefficient/basal.pore_pressure_ratio", -0.3}};
  EXPECT_THAT(messages(s), ElementsAre(HasSubstr("(design is saltelli, which moves one value at a "
                                                 "time")));
  s.basal.friction_coefficient = 0.4;  // a member of it
  s.basal.pore_pressure_ratio = 0.1;
  s.ensemble.members = 9;
  EXPECT_THAT(messages(s), IsEmpty());
}

}  // namespace
}  // namespace sturz
