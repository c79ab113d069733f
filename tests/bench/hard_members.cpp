// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/hard_members.hpp"

#include "ensemble/members/runner.hpp"
#include "tests/hard/priors.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

namespace sturz::bench {
namespace {

using test::Check;
using test::Survival;

/// Largest, or smallest, value of a figure over members.
template <class Figure>
double most(const std::vector<HardRun>& runs, Figure&& figure) {
  double out = 0;
  for (const HardRun& r : runs) out = std::max(out, figure(r.survival));
  return out;
}
template <class Figure>
double least(const std::vector<HardRun>& runs, Figure&& figure) {
  double out = 1e300;
  for (const HardRun& r : runs) out = std::min(out, figure(r.survival));
  return out;
}

std::string numbers_of(int row) {
  const DesignTable& points = test::hard_points();
  std::string text;
  for (std::size_t k = 0; k < points.keys.size(); ++k)
    text +=
        fmt::format("{}{} {:.4g}", k ? ", " : "",
                    points.keys[k].substr(points.keys[k].rfind('.') + 1), points.values[row][k]);
  return text;
}

std::vector<double> ranks(const std::vector<double>& v) {
  std::vector<std::size_t> order(v.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](auto a, auto b) { return v[a] < v[b]; });
  std::vector<double> rank(v.size());
  for (std::size_t i = 0; i < order.size();) {  // ties share their mean rank
    std::size_t j = i;
    while (j < order.size() && v[order[j]] == v[order[i]]) ++j;
    for (std::size_t k = i; k < j; ++k) rank[order[k]] = 0.5 * static_cast<double>(i + j - 1);
    i = j;
  }
  return rank;
}

double correlation(const std::vector<double>& a, const std::vector<double>& b) {
  const double n = static_cast<double>(a.size());
  const double ma = std::accumulate(a.begin(), a.end(), 0.0) / n;
  const double mb = std::accumulate(b.begin(), b.end(), 0.0) / n;
  double ab = 0, aa = 0, bb = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    ab += (a[i] - ma) * (b[i] - mb), aa += (a[i] - ma) * (a[i] - ma),
        bb += (b[i] - mb) * (b[i] - mb);
  return ab / std::sqrt(aa * bb);
}

Cell small(double value) { return {fmt::format("{:.1e}", value), value}; }

}  // namespace

std::vector<HardRun> run_hard_members(const test::RandomMembers& members,
                                      const std::vector<int>& numbers, int workers) {
  std::vector<HardRun> runs(numbers.size());
  RunPlan plan;
  for (std::size_t k = 0; k < numbers.size(); ++k) plan.members.push_back(static_cast<int>(k));
  plan.workers = workers;
  RunCallbacks callbacks;
  callbacks.run_member = [&](std::int64_t k, const std::atomic<bool>&) {
    HardRun& run = runs[static_cast<std::size_t>(k)];
    run.number = numbers[static_cast<std::size_t>(k)];
    try {
      run.survival = members.run(run.number);
    } catch (const std::exception& error) {
      run.survival.outcome = Outcome::failed;
      run.survival.reason = error.what();
    }
    MemberResult result;
    result.member = k;
    result.outcome = run.survival.outcome;
    return result;
  };
  callbacks.store = [](const MemberResult&) {};
  callbacks.on_progress = [&, next = std::size_t{50}](const RunnerProgress& p) mutable {
    if (static_cast<std::size_t>(p.n_done) < next) return;
    next += 50;
    fmt::print(stderr, "{}: {} of {} members, {:.0f} s\n", members.ground(), p.n_done, p.n_total,
               p.elapsed_s);
  };
  run_members(plan, callbacks, std::atomic<bool>{false});
  return runs;
}

Table members_table() {
  return {"members",
          "Random members: outcomes, and the worst of each figure",
          {{"ground", "ground"},
           {"states", "states"},
           {"set", "set"},
           {"members", "members"},
           {"settled", "settled"},
           {"out_of_time", "out of time"},
           {"left_terrain", "left terrain"},
           {"other", "other outcome"},
           {"with_nan", "with NaN"},
           {"mass_error", "mass error"},
           {"leaked_share", "leaked"},
           {"energy_residual", "energy residual"},
           {"reported_residual", "as reported"},
           {"created_energy", "energy created"},
           {"numerical", "numerical, least"},
           {"under_ground_dx", "lowest centre, dx"},
           {"speed_ratio", "speed / free fall"},
           {"late_growth", "late dilation_ratio"},
           {"mean_dt_ratio", "mean step / estimate"},
           {"least_dt_ratio", "least step / estimate"},
           {"particles", "particles"},
           {"seconds", "seconds"},
           {"slowest_s", "slowest"}}};
}

void add_members(const test::RandomMembers& members, const std::string& set,
                 const std::vector<HardRun>& runs, Table& table) {
  std::map<Outcome, int> outcomes;
  int other = 0, nan = 0;
  double particles = 0, seconds = 0;
  for (const HardRun& r : runs) {
    ++outcomes[r.survival.outcome];
    other += !is_valid(r.survival.outcome);
    nan += !r.survival.finite;
    particles += r.survival.particles / static_cast<double>(runs.size());
    seconds += r.survival.seconds;
  }
  table.add({cell(members.ground()),
             cell(std::string(to_string(members.states()))),
             cell(set),
             cell(static_cast<int>(runs.size())),
             cell(outcomes[Outcome::settled]),
             cell(outcomes[Outcome::out_of_time]),
             cell(outcomes[Outcome::left_terrain]),
             cell(other),
             cell(nan),
             small(most(runs, [](const Survival& s) { return s.mass_error; })),
             small(most(runs, [](const Survival& s) { return s.leaked_share; })),
             small(most(runs, [](const Survival& s) { return s.energy_residual; })),
             small(most(runs, [](const Survival& s) { return s.reported_residual; })),
             small(most(runs, [](const Survival& s) { return s.created_energy; })),
             cell(least(runs, [](const Survival& s) { return s.numerical_share; }), 2),
             cell(least(runs, [](const Survival& s) { return s.lowest_dx; }), 2),
             cell(most(runs, [](const Survival& s) { return s.speed_ratio; }), 2),
             small(most(runs, [](const Survival& s) { return s.late_growth; })),
             cell(least(runs, [](const Survival& s) { return s.mean_dt_ratio; }), 2),
             cell(least(runs, [](const Survival& s) { return s.least_dt_ratio; }), 3),
             cell(particles, 0),
             cell(seconds, 0),
             cell(most(runs, [](const Survival& s) { return s.seconds; }), 1)});
}

Table violations_table() {
  return {"violations",
          "Members beyond a bound",
          {{"ground", "ground"},
           {"states", "states"},
           {"member", "member"},
           {"figure", "figure"},
           {"measured", "measured"},
           {"bound", "bound"},
           {"outcome", "outcome"},
           {"numbers", "its numbers"}}};
}

std::size_t add_violations(const test::RandomMembers& members, const std::vector<HardRun>& runs,
                           Table& table) {
  std::size_t n = 0;
  for (const HardRun& r : runs)
    for (const Check& c : checks_of(r.survival)) {
      if (c.holds()) continue;
      ++n;
      const std::string outcome(to_string(r.survival.outcome));
      table.add({cell(members.ground()),
                 cell(std::string(to_string(members.states()))),
                 cell(r.number),
                 cell(c.quantity),
                 {fmt::format("{:.3g}", c.measured), c.measured},
                 {fmt::format("{:.3g}", c.bound), c.bound},
                 cell(r.survival.reason.empty() ? outcome : outcome + ": " + r.survival.reason),
                 cell(numbers_of(r.number))});
    }
  return n;
}

Table influence_table() {
  return {"influence",
          "Rank correlation of the sampled numbers with the travel of the front",
          {{"ground", "ground"},
           {"states", "states"},
           {"number", "number"},
           {"correlation", "correlation"}}};
}

void add_influence(const test::RandomMembers& members, const std::vector<HardRun>& runs,
                   Table& table) {
  const DesignTable& points = test::hard_points();
  std::vector<double> travel;
  for (const HardRun& r : runs) travel.push_back(r.survival.front_travel_m);
  const auto travel_ranks = ranks(travel);
  for (std::size_t k = 0; k < points.keys.size(); ++k) {
    std::vector<double> value;
    for (const HardRun& r : runs) value.push_back(points.values[r.number][k]);
    table.add({cell(members.ground()), cell(std::string(to_string(members.states()))),
               cell(points.keys[k]), cell(correlation(ranks(value), travel_ranks), 2)});
  }
}

}  // namespace sturz::bench
