// SPDX-License-Identifier: Apache-2.0
/// A scene that wants to blow up, and what it may at most do: figures against bounds.
#pragma once

#include "tests/hard/states.hpp"

#include <span>
#include <string>
#include <vector>

namespace sturz::test {

/// One figure of a hard case against its bound.
struct Check {
  enum class Sense { at_most, at_least };

  std::string quantity;  ///< with its unit
  double measured = 0, bound = 0;
  Sense sense = Sense::at_most;

  bool holds() const;  ///< never with NaN
  /// How much of the bound is used: 0 nothing, 1 all of it, more: it is broken.
  double used() const;
};
Check at_most(std::string quantity, double measured, double bound);
Check at_least(std::string quantity, double measured, double bound);

struct CaseReport {
  std::vector<Check> checks;
  double particles = 0, seconds = 0;

  bool holds() const;
};

/// A case by the number of the instability that it provokes (docs/physics.md B.13).
struct HardCase {
  const char* instability;
  const char* name;
  CaseReport (*run)(States);
  bool needs_states = false;  ///< says nothing with dense grains alone
};
/// All of them, in the order of their numbers.
std::span<const HardCase> hard_cases();

}  // namespace sturz::test
