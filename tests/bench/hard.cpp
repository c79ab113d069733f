// SPDX-License-Identifier: Apache-2.0
// Every hard case and every random member of tests/hard, with the margin to each bound.
#include "tests/bench/commands.hpp"
#include "tests/bench/hard_members.hpp"
#include "tests/bench/measure/clocks.hpp"
#include "tests/bench/measure/machine.hpp"
#include "tests/hard/hard_case.hpp"
#include "tests/hard/priors.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <numeric>
#include <string>
#include <vector>

namespace sturz::bench {
namespace {

Table cases_table() {
  return {"cases",
          "Hard cases",
          {{"instability", "B.13"},
           {"states", "states"},
           {"case", "case"},
           {"figure", "figure"},
           {"measured", "measured"},
           {"bound", "bound"},
           {"used", "bound used"},
           {"holds", "holds"},
           {"particles", "particles"},
           {"seconds", "seconds"}}};
}

/// \return whether all bounds hold
bool add_case(const test::HardCase& hard, test::States states, Table& table) {
  const double begin = wall_seconds();
  const test::CaseReport report = hard.run(states);
  const double seconds = wall_seconds() - begin;
  for (const test::Check& c : report.checks)
    table.add(
        {cell(hard.instability),
         cell(std::string(to_string(states))),
         cell(hard.name),
         cell(c.quantity),
         {fmt::format("{:.3g}", c.measured), c.measured},
         {fmt::format("{} {:.3g}", c.sense == test::Check::Sense::at_most ? "<=" : ">=", c.bound),
          c.bound},
         {fmt::format("{:.0f} %", 100 * c.used()), c.used()},
         yes_no(c.holds()),
         cell(report.particles, 0),
         cell(seconds, 1)});
  return report.holds();
}

std::vector<test::States> states_of(const Options& options) {
  using enum test::States;
  if (options.states == "dense") return {dense_only};
  if (options.states == "all") return {all};
  return {dense_only, all};
}

struct MemberTables {
  Table members = members_table(), violations = violations_table(), influence = influence_table();
  std::size_t n_violations = 0;

  void add(const test::RandomMembers& ground, bool full, int workers) {
    auto numbers = [](int first, int last) {
      std::vector<int> out(static_cast<std::size_t>(last - first));
      std::iota(out.begin(), out.end(), first);
      return out;
    };
    auto run = [&](const char* set, const std::vector<int>& which) {
      const auto runs = run_hard_members(ground, which, workers);
      add_members(ground, set, runs, members);
      n_violations += add_violations(ground, runs, violations);
      return runs;
    };
    if (!full) {
      run("spread", test::spread(10));
      return;
    }
    run("corners", numbers(0, test::n_corners));
    add_influence(ground, run("random", numbers(test::n_corners, test::n_points)), influence);
  }
};

}  // namespace

Report hard(const Options& options) {
  Report report;
  report.title = "Hard cases";
  report.summary =
      "Scenes that want to blow up, each figure beside its bound, and random members from the "
      "corners and the inside of the priors. Every line is asserted by `tests/hard`, of the "
      "members "
      "a part, but banks of 0.9 of their critical height, and with all states that of 1.2 in plane "
      "strain.";
  Table cases = cases_table();
  for (const test::HardCase& hard : test::hard_cases())
    for (const test::States states : states_of(options))
      if (states == test::States::all || !hard.needs_states)
        report.failed |= !add_case(hard, states, cases);
  report.tables.push_back(std::move(cases));

  const int workers = options.threads > 0 ? options.threads : available_cores();
  MemberTables members;
  const std::string folder = STURZ_SHARED_DIR "/data/marsicano_tinitaly";
  const bool mountain = std::filesystem::exists(folder + "/marsicano_10m.tif");
  for (const test::States states : states_of(options)) {
    members.add(test::RandomMembers::on_steep_ground(states), options.full, workers);
    if (mountain)
      members.add(test::RandomMembers::on_marsicano(folder, states), options.full, workers);
  }
  if (!mountain) report.notes.push_back("Monte Marsicano was left out: its terrain is not there.");
  report.failed |= members.n_violations > 0;
  report.tables.push_back(std::move(members.members));
  report.tables.push_back(std::move(members.violations));
  if (options.full) report.tables.push_back(std::move(members.influence));
  report.notes.push_back(fmt::format(
      "{} figures of members are beyond their bound. A member's number reproduces it: rows 0..{} "
      "of the design are corners, the others random points.",
      members.n_violations, test::n_corners - 1));
  report.notes.push_back(
      "Bounds of members: valid outcome, no NaN, mass error 1e-12, nothing leaked, energy residual "
      "and energy created 0.01, lowest centre -0.1 dx, speed 1.05 of free fall, mean step 0.05 of "
      "the estimate, late dilation_ratio of the kinetic energy 0.01 of its peak.");
  return report;
}

}  // namespace sturz::bench
