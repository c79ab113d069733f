// SPDX-License-Identifier: Apache-2.0
/// The figures of a hard case as expectations of the running test, but for what is on the list of
/// known misses (tests/physics/results/known_misses.hpp).
#pragma once

#include "tests/hard/hard_case.hpp"
#include "tests/physics/results/known_misses.hpp"
#include "tests/physics/verification.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace sturz::test {

/// Misses, and what is listed as one, are lines "hard: <name>, <quantity>" of the results; their
/// error is the share of the bound that is used.
inline void expect_holds(const std::string& name, const std::vector<Check>& checks) {
  for (const Check& c : checks) {
    const std::string key = fmt::format("hard: {}, {}", name, c.quantity);
    if (c.holds() && !listed(known_misses(), key)) continue;
    const std::string bound =
        fmt::format("{} {:.4g}", c.sense == Check::Sense::at_least ? ">=" : "<=", c.bound);
    const double used = std::clamp(c.used(), 0.0, 1e9);  // of a bound of zero: without end
    expect_within({key, "share of the bound " + bound, c.measured, c.bound,
                   c.holds() ? std::min(used, 1.0) : used, 1});
  }
}

/// Prints every figure beside its bound, too. The name is the running test's.
inline void expect_holds(const CaseReport& report) {
  for (const Check& c : report.checks)
    fmt::print("{:<60} {:>10.4g} of {:<8.4g} ({:.0f} particles, {:.1f} s)\n", c.quantity,
               c.measured, c.bound, report.particles, report.seconds);
  expect_holds(testing::UnitTest::GetInstance()->current_test_info()->name(), report.checks);
}

}  // namespace sturz::test
