// SPDX-License-Identifier: Apache-2.0
/// The figures of a hard case as expectations of the running test.
#pragma once

#include "tests/hard/hard_case.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

namespace sturz::test {

inline void expect_holds(const std::vector<Check>& checks) {
  for (const Check& c : checks)
    EXPECT_TRUE(c.holds()) << fmt::format(
        "{}: {:.4g}, bound {}{:.4g}", c.quantity, c.measured,
        c.sense == Check::Sense::at_least ? ">= " : "<= ", c.bound);
}

/// Prints every figure beside its bound, too.
inline void expect_holds(const CaseReport& report) {
  for (const Check& c : report.checks)
    fmt::print("{:<60} {:>10.4g} of {:<8.4g} ({:.0f} particles, {:.1f} s)\n", c.quantity,
               c.measured, c.bound, report.particles, report.seconds);
  expect_holds(report.checks);
}

}  // namespace sturz::test
