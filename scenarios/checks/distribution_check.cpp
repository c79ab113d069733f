// SPDX-License-Identifier: Apache-2.0
#include "scenarios/checks/distribution_check.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace sturz {
namespace {

using Clauses = std::vector<std::string>;
constexpr double infinite = std::numeric_limits<double>::infinity();

/// Share of a normal variable that truncation leaves.
double kept_share(double mean, double sd, double low, double high) {
  const auto below = [&](double x) { return 0.5 * std::erfc(-(x - mean) / (sd * std::sqrt(2.0))); };
  // On the upper side the differences of tails keep their digits.
  if (low > mean) return below(2 * mean - low) - below(2 * mean - high);
  return below(high) - below(low);
}

void check_bounds(const Distribution& d, bool needed, Clauses& wrong) {
  if (needed && (!d.min || !d.max)) wrong.emplace_back("min and max are needed");
  if (d.min && d.max && !(*d.min < *d.max)) wrong.emplace_back("max must be above min");
}

void check_kept(double share, Clauses& wrong) {
  if (wrong.empty() && !(share > 1e-6))
    wrong.emplace_back("min and max cut away all but a millionth of it");
}

void check_normal(const Distribution& d, Clauses& wrong) {
  if (!(d.sd > 0)) wrong.emplace_back("sd must be > 0");
  check_bounds(d, false, wrong);
  if (wrong.empty())
    check_kept(kept_share(d.mean, d.sd, d.min.value_or(-infinite), d.max.value_or(infinite)),
               wrong);
}

void check_lognormal(const Distribution& d, Clauses& wrong) {
  if (!(d.median > 0)) wrong.emplace_back("median must be > 0");
  if (!(d.sigma_ln > 0)) wrong.emplace_back("sigma_ln must be > 0");
  if (d.min && !(*d.min >= 0)) wrong.emplace_back("min must be >= 0");
  if (d.max && !(*d.max > 0)) wrong.emplace_back("max must be > 0");
  check_bounds(d, false, wrong);
  if (wrong.empty())
    check_kept(kept_share(std::log(d.median), d.sigma_ln, std::log(d.min.value_or(0)),
                          std::log(d.max.value_or(infinite))),
               wrong);
}

void check_discrete(const Distribution& d, Clauses& wrong) {
  if (d.values.empty()) wrong.emplace_back("values must hold at least one number");
  if (!d.weights.empty() && d.weights.size() != d.values.size())
    wrong.emplace_back("weights must be as many as values");
  if (std::any_of(d.weights.begin(), d.weights.end(), [](double w) { return !(w >= 0); }))
    wrong.emplace_back("weights must be >= 0");
  else if (!d.weights.empty()) {
    const double sum = std::accumulate(d.weights.begin(), d.weights.end(), 0.0);
    if (!(sum > 0)) wrong.emplace_back("one weight at least must be > 0");
    if (!std::isfinite(sum)) wrong.emplace_back("the sum of the weights must be finite");
  }
}

void check_table(const Distribution& d, Clauses& wrong) {
  if (d.values.size() < 2) wrong.emplace_back("a table needs at least two observations");
  if (!std::is_sorted(d.values.begin(), d.values.end()))
    wrong.emplace_back("the observations must rise");
}

bool all_finite(const Distribution& d) {
  const auto finite = [](double v) { return std::isfinite(v); };
  return finite(d.min.value_or(0)) && finite(d.max.value_or(0)) && finite(d.mean) && finite(d.sd) &&
         finite(d.median) && finite(d.sigma_ln) && finite(d.mode) && finite(d.alpha) &&
         finite(d.beta) && std::all_of(d.values.begin(), d.values.end(), finite) &&
         std::all_of(d.weights.begin(), d.weights.end(), finite);
}

}  // namespace

std::pair<double, double> support(const Distribution& d) {
  using enum Distribution::Kind;
  if (d.kind == discrete || d.kind == table) {
    if (d.values.empty()) return {0, 0};
    const auto [low, high] = std::minmax_element(d.values.begin(), d.values.end());
    return {*low, *high};
  }
  const double lowest = d.kind == lognormal ? 0 : -infinite;
  return {d.min.value_or(lowest), d.max.value_or(infinite)};
}

std::pair<double, double> support(const Uncertain& u) {
  return u.distribution ? support(*u.distribution) : std::pair(u.value, u.value);
}

std::vector<std::string> parameter_problems(const Distribution& d) {
  using enum Distribution::Kind;
  Clauses wrong;
  if (!all_finite(d)) return {"every number must be finite"};
  switch (d.kind) {
    case uniform:
      check_bounds(d, true, wrong);
      break;
    case log_uniform:
      check_bounds(d, true, wrong);
      if (d.min && !(*d.min > 0)) wrong.emplace_back("min must be > 0");
      break;
    case normal:
      check_normal(d, wrong);
      break;
    case lognormal:
      check_lognormal(d, wrong);
      break;
    case triangular:
      check_bounds(d, true, wrong);
      if (d.min && d.max && !(*d.min <= d.mode && d.mode <= *d.max))
        wrong.emplace_back("the mode must lie between min and max");
      break;
    case beta:
      if (!(d.alpha > 0 && d.beta > 0)) wrong.emplace_back("alpha and beta must be > 0");
      check_bounds(d, true, wrong);
      break;
    case discrete:
      check_discrete(d, wrong);
      break;
    case table:
      check_table(d, wrong);
      break;
  }
  return wrong;
}

}  // namespace sturz
