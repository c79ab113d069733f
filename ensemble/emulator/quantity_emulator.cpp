// SPDX-License-Identifier: Apache-2.0
#include "ensemble/emulator/quantity_emulator.hpp"

#include "engine/core/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sturz {
namespace {

using Points = std::vector<std::vector<double>>;

struct Lesson {
  Points points;
  std::vector<double> values;
  void add(const std::vector<double>& point, double value) {
    points.push_back(point);
    values.push_back(value);
  }
};

bool is_exact(const Observation& o) { return o.known == Known::exactly && std::isfinite(o.value); }
bool is_bound(const Observation& o) { return o.known == Known::at_least && std::isfinite(o.value); }

Lesson exact_members(const Points& cube, std::span<const Observation> simulated) {
  Lesson lesson;
  for (const std::size_t i : teaching_members(simulated)) lesson.add(cube[i], simulated[i].value);
  return lesson;
}

/// Mean of a standard normal above a: phi(a) / (1 - Phi(a)).
double mean_above(double a) {
  if (a > 30) return a + 1 / a;  // the tail's first terms, before both underflow
  const double above = 0.5 * std::erfc(a / std::numbers::sqrt2);
  return std::exp(-0.5 * a * a) / std::sqrt(2 * std::numbers::pi) / above;
}

double expected_above(double bound, const GaussianPrediction& p) {
  const double sd = std::sqrt(p.variance + p.noise);
  if (!(sd > 0)) return bound;
  return std::max(bound, p.mean + sd * mean_above((bound - p.mean) / sd));
}

/// Bounds that contradict what the exact members say, the last ones first: see teaching_members.
void add_bounds(Lesson& lesson, EmulatorReport& report, const GaussianProcess& process,
                const Points& cube, std::span<const Observation> simulated) {
  for (std::size_t i = cube.size(); i-- > 0 && lesson.values.size() < most_emulated_members;) {
    if (!is_bound(simulated[i])) continue;
    const double bound = simulated[i].value;
    const GaussianPrediction p = process.at(cube[i]);
    if (p.mean >= bound) continue;
    lesson.add(cube[i], expected_above(bound, p));
    ++report.n_bounds_used;
    report.lowest_bound_used = std::min(report.lowest_bound_used, bound);
  }
}

void check(const Lesson& lesson, const std::string& quantity, std::size_t n_dims,
           const EmulatorReport& report) {
  require(lesson.values.size() >= n_dims + 5,
          fmt::format("{}: {} members say its value, of {} only a lower bound is known and {} say "
                      "nothing of it (an emulator over {} uncertain values needs {} at least). "
                      "Compute more members, or on a larger terrain and to rest, or leave the "
                      "quantity out.",
                      quantity, lesson.values.size(), report.n_at_least, report.n_not_known, n_dims,
                      n_dims + 5));
  const auto [least, most] = std::minmax_element(lesson.values.begin(), lesson.values.end());
  require(
      *least < *most,
      fmt::format("{}: {} in every member (it does not depend on the uncertain values and tells "
                  "nothing of them). Leave it out, or widen the distributions.",
                  quantity, *least));
}

}  // namespace

std::vector<std::size_t> teaching_members(std::span<const Observation> simulated) {
  std::vector<std::size_t> places;
  for (std::size_t i = simulated.size(); i-- > 0 && places.size() < most_emulated_members;)
    if (is_exact(simulated[i])) places.push_back(i);
  std::reverse(places.begin(), places.end());
  return places;
}

QuantityEmulator emulate(const std::string& quantity, const Points& cube,
                         std::span<const Observation> simulated) {
  expect(cube.size() == simulated.size(), "one value per member");
  require(!cube.empty() && !cube.front().empty(),
          fmt::format("{}: no member with an uncertain value (there is nothing to emulate). Give a "
                      "key a distribution and compute members.",
                      quantity));
  EmulatorReport report;
  report.quantity = quantity;
  report.n_at_least = std::count_if(simulated.begin(), simulated.end(), is_bound);
  report.n_exact = std::count_if(simulated.begin(), simulated.end(), is_exact);
  report.n_not_known =
      static_cast<std::int64_t>(simulated.size()) - report.n_exact - report.n_at_least;
  Lesson lesson = exact_members(cube, simulated);
  check(lesson, quantity, cube.front().size(), report);
  GaussianProcess process = GaussianProcess::fitted(lesson.points, lesson.values);
  add_bounds(lesson, report, process, cube, simulated);
  report.n_used = static_cast<std::int64_t>(lesson.values.size());
  if (report.n_bounds_used > 0) process = GaussianProcess::fitted(lesson.points, lesson.values);
  const LeaveOneOut& out = process.leave_one_out();
  report.q2 = out.q2;
  report.coverage95 = out.coverage95;
  report.inflation = out.inflation;
  report.noise_sd = std::sqrt(process.at(cube.front()).noise);
  return {std::move(process), std::move(report)};
}

}  // namespace sturz
