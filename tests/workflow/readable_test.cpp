// SPDX-License-Identifier: Apache-2.0
#include "ensemble/workflow/readable.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace sturz::test {
namespace {

TEST(DurationText, SaysNoMoreThanOneNeeds) {
  EXPECT_EQ(workflow::duration_text(0), "0.0 s");
  EXPECT_EQ(workflow::duration_text(1e-6), "0.001 s");
  EXPECT_EQ(workflow::duration_text(0.004), "0.004 s");
  EXPECT_EQ(workflow::duration_text(0.0414), "0.041 s");
  EXPECT_EQ(workflow::duration_text(0.84), "0.84 s");
  EXPECT_EQ(workflow::duration_text(0.97), "1.0 s");
  EXPECT_EQ(workflow::duration_text(8.44), "8.4 s");
  EXPECT_EQ(workflow::duration_text(59.4), "59 s");
  EXPECT_EQ(workflow::duration_text(59.6), "1 min 00 s");
  EXPECT_EQ(workflow::duration_text(200), "3 min 20 s");
  EXPECT_EQ(workflow::duration_text(3900), "1 h 05 min");
  EXPECT_EQ(workflow::duration_text(-1), "unknown");
  EXPECT_EQ(workflow::duration_text(std::numeric_limits<double>::quiet_NaN()), "unknown");
}

TEST(Readable, SmallScenesKeepTheirDigits) {
  EXPECT_EQ(workflow::measure(1573.31), "1573.3");
  EXPECT_EQ(workflow::measure(9.4), "9.4");
  EXPECT_EQ(workflow::measure(0.08534), "0.0853");
  EXPECT_EQ(workflow::measure(0), "0.0");
  EXPECT_EQ(workflow::measure(31.172, 2), "31.17");
  EXPECT_EQ(workflow::measure(0.08534, 2), "0.0853");
  EXPECT_EQ(workflow::measure(std::nan("")), "nan");
}

TEST(Grouped, SetsThousandsApart) {
  EXPECT_EQ(workflow::grouped(0), "0");
  EXPECT_EQ(workflow::grouped(999), "999");
  EXPECT_EQ(workflow::grouped(491000), "491 000");
  EXPECT_EQ(workflow::grouped(-1234567), "-1 234 567");
  EXPECT_EQ(workflow::grouped(-0.2), "-0.2");
  EXPECT_EQ(workflow::grouped(45.26), "45.3");
  EXPECT_EQ(workflow::grouped(6.912e-5), "6.91e-05") << "a flume's release is no 0 m3";
}

}  // namespace
}  // namespace sturz::test
