// SPDX-License-Identifier: Apache-2.0
/// The random members of the hard suite, run side by side and summed up.
#pragma once

#include "tests/bench/measure/table.hpp"
#include "tests/hard/random_members.hpp"

#include <vector>

namespace sturz::bench {

/// A member of one ground that has run.
struct HardRun {
  int number = 0;
  test::Survival survival;
};

/// Runs members by the runner that `sturz ensemble` uses. What a member throws is its outcome.
/// \return in the order of `numbers`
std::vector<HardRun> run_hard_members(const test::RandomMembers&, const std::vector<int>& numbers,
                                      int workers);

/// One row a set of members: outcomes, and the worst of each figure.
Table members_table();
void add_members(const test::RandomMembers&, const std::string& set, const std::vector<HardRun>&,
                 Table&);

/// One row for each figure of a member beyond its bound, with the member's numbers.
Table violations_table();
/// \return how many rows it added
std::size_t add_violations(const test::RandomMembers&, const std::vector<HardRun>&, Table&);

/// Spearman's rank correlation of each sampled number with the travel of the front.
Table influence_table();
void add_influence(const test::RandomMembers&, const std::vector<HardRun>&, Table&);

}  // namespace sturz::bench
