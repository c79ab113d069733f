// SPDX-License-Identifier: Apache-2.0
// The list of known misses excuses what it names, as far as it names it, and nothing else.
#include "tests/physics/results/known_misses.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace sturz::test {
namespace {

using testing::HasSubstr;

const char* const head = "name,quantity,measured,error,asked,since,why\n";
const std::vector<KnownMiss> one{{"V0 a, b", "m", 1.2, 0.2, 0.1, "2026-11-30", "reason"}};

TEST(KnownMisses, AreReadWithCommasInTheirNames) {
  const auto read = read_misses(std::string(head) +
                                "\"V0 a, b\",\"m\",1.2,-0.2,0.1,\"2026-11-30\",\"a, reason\"\n");
  ASSERT_EQ(read.size(), 1);
  EXPECT_EQ(read[0].name, "V0 a, b");
  EXPECT_EQ(read[0].error, -0.2);
  EXPECT_EQ(read[0].why, "a, reason");
}

TEST(KnownMisses, LinesThatSayTooLittleAreRefused) {
  for (const char* line : {"\"a\",\"m\",1,2,3,\"2026-11-30\"\n", "\"a\",\"m\",1,x,3,\"d\",\"w\"\n",
                           "\"a\",\"m\",1,2,3,\"d\",\"\"\n",
                           "\"a\",\"m\",1,2,3,\"d\",\"w\"\n\"a\",\"m\",1,2,3,\"d\",\"w\"\n"})
    EXPECT_THROW(read_misses(std::string(head) + line), std::runtime_error) << line;
}

TEST(KnownMisses, TheListItselfCanBeRead) {
  for (const KnownMiss& m : known_misses())
    EXPECT_GT(std::abs(m.error), m.asked) << m.name << " is no miss";
}

TEST(KnownMisses, OnlyWhatIsListedIsExcused) {
  EXPECT_EQ(objection(one, "V0 other", 0.1, 0.1), "");
  EXPECT_THAT(objection(one, "V0 other", -0.11, 0.1), HasSubstr("does not list it"));
  EXPECT_EQ(objection(one, "V0 a, b", 0.2, 0.1), "");
  EXPECT_EQ(objection(one, "V0 a, b", 0.29, 0.1), "");
}

TEST(KnownMisses, WhatIsMetAgainOrGetsWorseIsSaid) {
  EXPECT_THAT(objection(one, "V0 a, b", 0.1, 0.1), HasSubstr("no longer missed"));
  EXPECT_THAT(objection(one, "V0 a, b", 0.31, 0.1), HasSubstr("has become"));
  EXPECT_THAT(objection(one, "V0 a, b", -0.2, 0.1), HasSubstr("has become"));
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(objection(one, "V0 a, b", nan, 0.1), "");
  EXPECT_NE(objection(one, "V0 other", nan, 0.1), "");
}

}  // namespace
}  // namespace sturz::test
