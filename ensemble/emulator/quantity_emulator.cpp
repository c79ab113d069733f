// SPDX-License-Identifier: Apache-2.0
#include "ensemble/emulator/quantity_emulator.hpp"

#include "engine/core/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace sturz {
namespace {

using Points = std::vector<std::vector<double>>;

double normal_below(double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); }

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
  const double above = normal_below(-a);
  return std::exp(-0.5 * a * a) / std::sqrt(2 * std::numbers::pi) / above;
}

double expected_above(double bound, const GaussianPrediction& p) {
  const double sd = std::sqrt(p.variance + p.noise);
  if (!(sd > 0)) return bound;
  return std::max(bound, p.mean + sd * mean_above((bound - p.mean) / sd));
}

/// Bounds that contradict what the exact members say, the last ones first: see teaching_members.
/// \param above only bounds above it
void add_bounds(Lesson& lesson, EmulatorReport& report, const SmoothPart& part, const Points& cube,
                std::span<const Observation> simulated, std::size_t most, double above) {
  for (std::size_t i = cube.size(); i-- > 0 && lesson.values.size() < most;) {
    if (!is_bound(simulated[i]) || !(simulated[i].value > above)) continue;
    const double bound = simulated[i].value;
    const GaussianPrediction p = part.at(cube[i]);
    if (p.mean >= bound) continue;
    lesson.add(cube[i], expected_above(bound, p));
    ++report.n_bounds_used;
    report.lowest_bound_used = std::min(report.lowest_bound_used, bound);
  }
}

void check(const Lesson& lesson, const std::string& quantity, std::size_t n_dims,
           const EmulatorReport& report) {
  require(lesson.values.size() >= n_dims + points_over_dims,
          fmt::format("{}: {} members say its value, of {} only a lower bound is known and {} say "
                      "nothing of it (an emulator over {} uncertain values needs {} at least). "
                      "Compute more members, or on a larger terrain and to rest, or leave the "
                      "quantity out.",
                      quantity, lesson.values.size(), report.n_at_least, report.n_not_known, n_dims,
                      n_dims + points_over_dims));
  const auto [least, most] = std::minmax_element(lesson.values.begin(), lesson.values.end());
  require(
      *least < *most,
      fmt::format("{}: {} in every member (it does not depend on the uncertain values and tells "
                  "nothing of them). Leave it out, or widen the distributions.",
                  quantity, *least));
}

/// \param side the process of 0 below and 1 above
double share_above(const GaussianPrediction& side) {
  return normal_below((side.mean - 0.5) / std::sqrt(side.variance + side.noise));
}

/// The members of a lesson on the two sides of a step.
struct Sides {
  Lesson below, above, which;  ///< which: 0 below, 1 above
};

Sides sides_of(const Lesson& lesson, const ValueStep& step) {
  Sides sides;
  for (std::size_t i = 0; i < lesson.values.size(); ++i) {
    const bool is_above = lesson.values[i] > step.middle();
    (is_above ? sides.above : sides.below).add(lesson.points[i], lesson.values[i]);
    sides.which.add(lesson.points[i], is_above ? 1 : 0);
  }
  return sides;
}

/// What the others tell of each exact member: its side, and the mean over both.
void judge(EmulatorReport& report, const Sides& sides, const SmoothPart& below,
           const SmoothPart& above, const GaussianProcess& which, std::size_t n_exact) {
  double mean = 0, squares = 0, errors = 0, told = 0;
  for (const Lesson* side : {&sides.below, &sides.above})
    for (const double v : side->values) mean += v / static_cast<double>(n_exact);
  std::size_t n_below = 0, n_above = 0;
  for (std::size_t i = 0; i < n_exact; ++i) {
    const bool is_above = sides.which.values[i] > 0.5;
    const double share = std::clamp(which.leave_one_out().predicted[i], 0.0, 1.0);
    const std::size_t place = is_above ? n_above++ : n_below++;
    const double value = (is_above ? sides.above : sides.below).values[place];
    const auto& own = (is_above ? above : below).leave_one_out().predicted;
    const auto& u = sides.which.points[i];
    const double other = is_above ? std::min(below.mean_at(u), report.step->below)
                                  : std::max(above.mean_at(u), report.step->above);
    const double expected = is_above ? share * own[place] + (1 - share) * other
                                     : (1 - share) * own[place] + share * other;
    squares += (value - mean) * (value - mean);
    errors += (value - expected) * (value - expected);
    told += (share > 0.5) == is_above;
  }
  const auto n_a = static_cast<double>(n_above), n_b = static_cast<double>(n_below);
  report.q2 = 1 - errors / squares;
  report.coverage95 =
      (n_b * below.leave_one_out().coverage95 + n_a * above.leave_one_out().coverage95) /
      (n_a + n_b);
  report.inflation = std::max(below.leave_one_out().inflation, above.leave_one_out().inflation);
  const auto& u = sides.which.points.front();
  report.noise_sd = std::sqrt(std::max(below.at(u).noise, above.at(u).noise));
  report.step->told = told / static_cast<double>(n_exact);
}

QuantityEmulator beside_a_step(const Lesson& lesson, EmulatorReport report, const Points& cube,
                               std::span<const Observation> simulated) {
  const ValueStep& step = *report.step;
  Sides sides = sides_of(lesson, step);
  const std::size_t n_exact = lesson.values.size(), n_above = sides.above.values.size();
  const SmoothPart below(sides.below.points, sides.below.values);
  SmoothPart above(sides.above.points, sides.above.values);
  add_bounds(sides.above, report, above, cube, simulated,
             most_emulated_members - sides.below.values.size(), step.below);
  for (std::size_t i = n_above; i < sides.above.values.size(); ++i)
    sides.which.add(sides.above.points[i], 1);
  if (report.n_bounds_used > 0) above = SmoothPart(sides.above.points, sides.above.values);
  GaussianProcess which = GaussianProcess::fitted(sides.which.points, sides.which.values);
  report.n_used = static_cast<std::int64_t>(sides.which.values.size());
  judge(report, sides, below, above, which, n_exact);
  return {below, std::move(above), std::move(which), std::move(report)};
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
  report.step = step_of(lesson.values);
  if (report.step) return beside_a_step(lesson, std::move(report), cube, simulated);
  SmoothPart whole(lesson.points, lesson.values);
  add_bounds(lesson, report, whole, cube, simulated, most_emulated_members,
             -std::numeric_limits<double>::infinity());
  report.n_used = static_cast<std::int64_t>(lesson.values.size());
  if (report.n_bounds_used > 0) whole = SmoothPart(lesson.points, lesson.values);
  const LeaveOneOut& out = whole.leave_one_out();
  report.q2 = out.q2;
  report.coverage95 = out.coverage95;
  report.inflation = out.inflation;
  report.noise_sd = std::sqrt(whole.at(cube.front()).noise);
  return {std::move(whole), std::move(report)};
}

EmulatedValue QuantityEmulator::at(std::span<const double> point) const {
  EmulatedValue value;
  value.likely = below_.at(point);
  if (!side_) {
    value.variance = value.likely.variance;
    value.noise = value.likely.noise;
    return value;
  }
  // Each side goes on as far as its members do: what its process says beyond lies in the gap.
  value.other = above_->at(point);
  value.likely.mean = std::min(value.likely.mean, report_.step->below);
  value.other.mean = std::max(value.other.mean, report_.step->above);
  const GaussianPrediction side = side_->at(point);
  value.other_share = share_above(side);
  if (value.other_share > 0.5) {
    std::swap(value.likely, value.other);
    value.other_share = 1 - value.other_share;
  }
  const double s = value.other_share, apart = value.likely.mean - value.other.mean;
  const double of_side = s * (1 - s) * apart * apart;
  const double unknown = side.variance / (side.variance + side.noise);
  value.variance = (1 - s) * value.likely.variance + s * value.other.variance + unknown * of_side;
  value.noise = (1 - s) * value.likely.noise + s * value.other.noise + (1 - unknown) * of_side;
  return value;
}

double QuantityEmulator::mean_at(std::span<const double> point) const {
  return side_ ? at(point).mean() : below_.mean_at(point);
}

QuantityEmulator QuantityEmulator::with_point(std::span<const double> point) const {
  if (!side_) return {below_.with_point(point), report_};
  const bool is_above = share_above(side_->at(point)) > 0.5;
  return {is_above ? below_ : below_.with_point(point),
          is_above ? above_->with_point(point) : *above_, side_->with_point(point), report_};
}

std::optional<QuantityEmulator> QuantityEmulator::of_others(const Points& points,
                                                            std::span<const double> values) const {
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  if (points.size() < 3 || *least == *most) return std::nullopt;
  if (!side_) return QuantityEmulator(SmoothPart(points, values, below_), report_);
  const Sides sides = sides_of({points, {values.begin(), values.end()}}, *report_.step);
  if (sides.below.values.empty() || sides.above.values.empty()) return std::nullopt;
  return QuantityEmulator(SmoothPart(sides.below.points, sides.below.values, below_),
                          SmoothPart(sides.above.points, sides.above.values, *above_),
                          {sides.which.points, sides.which.values, side_->scales()}, report_);
}

}  // namespace sturz
