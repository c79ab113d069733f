// SPDX-License-Identifier: Apache-2.0
#include "scenarios/checks/distribution_check.hpp"

#include "tests/support/distributions.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace sturz {
namespace {

using test::bounded;
using test::normal;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using Kind = Distribution::Kind;

constexpr double infinite = std::numeric_limits<double>::infinity();

TEST(DistributionCheck, SupportIsWhereValuesCanFall) {
  EXPECT_EQ(support(bounded(Kind::uniform, 1, 2)), std::pair(1.0, 2.0));
  EXPECT_EQ(support(normal(0, 1)), std::pair(-infinite, infinite));
  Distribution lognormal;
  lognormal.kind = Kind::lognormal;
  lognormal.max = 3;
  EXPECT_EQ(support(lognormal), std::pair(0.0, 3.0));
  Distribution discrete;
  discrete.kind = Kind::discrete;
  discrete.values = {5, 2, 9};
  EXPECT_EQ(support(discrete), std::pair(2.0, 9.0));
  EXPECT_EQ(support(Uncertain(4)), std::pair(4.0, 4.0));
}

TEST(DistributionCheck, GoodParametersPass) {
  EXPECT_THAT(parameter_problems(bounded(Kind::uniform, 1, 2)), IsEmpty());
  EXPECT_THAT(parameter_problems(normal(0.3, 0.1)), IsEmpty());
  Distribution triangular = bounded(Kind::triangular, 1, 2);
  triangular.mode = 1;
  EXPECT_THAT(parameter_problems(triangular), IsEmpty());
}

TEST(DistributionCheck, NamesEveryBadParameter) {
  EXPECT_THAT(parameter_problems(bounded(Kind::uniform, 2, 2)),
              ElementsAre("max must be above min"));
  EXPECT_THAT(parameter_problems(bounded(Kind::log_uniform, 0, 2)), ElementsAre("min must be > 0"));
  EXPECT_THAT(parameter_problems(normal(0, 0)), ElementsAre("sd must be > 0"));
  Distribution beta = bounded(Kind::beta, 1, 0);
  EXPECT_THAT(parameter_problems(beta),
              ElementsAre("alpha and beta must be > 0", "max must be above min"));
  Distribution triangular = bounded(Kind::triangular, 1, 2);
  triangular.mode = 3;
  EXPECT_THAT(parameter_problems(triangular), ElementsAre("the mode must lie between min and max"));
  Distribution discrete;
  discrete.kind = Kind::discrete;
  discrete.values = {1, 2};
  discrete.weights = {1};
  EXPECT_THAT(parameter_problems(discrete), ElementsAre("weights must be as many as values"));
  discrete.weights = {0, 0};
  EXPECT_THAT(parameter_problems(discrete), ElementsAre("one weight at least must be > 0"));
  discrete.weights = {1.5e308, 1.5e308};
  EXPECT_THAT(parameter_problems(discrete), ElementsAre("the sum of the weights must be finite"));
  Distribution table;
  table.kind = Kind::table;
  table.values = {2, 1};
  EXPECT_THAT(parameter_problems(table), ElementsAre("the observations must rise"));
  EXPECT_THAT(parameter_problems(normal(std::numeric_limits<double>::quiet_NaN(), 1)),
              ElementsAre("every number must be finite"));
}

TEST(DistributionCheck, TruncationMustLeaveSomething) {
  Distribution far = normal(0.3, 0.01);
  far.min = 0.5;
  far.max = 0.9;
  EXPECT_THAT(parameter_problems(far),
              ElementsAre("min and max cut away all but a millionth of it"));
  Distribution tail = normal(0, 1);  // 4 sd out: 3e-5 is left
  tail.min = 4;
  EXPECT_THAT(parameter_problems(tail), IsEmpty());
  tail.min.reset();
  tail.max = -4;
  EXPECT_THAT(parameter_problems(tail), IsEmpty());
}

}  // namespace
}  // namespace sturz
