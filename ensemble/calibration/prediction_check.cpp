// SPDX-License-Identifier: Apache-2.0
#include "ensemble/calibration/prediction_check.hpp"

#include "ensemble/hazard/weighting/weighted_sample.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sturz {
namespace {

/// So many equal rows stand for the posterior: a quantile needs no more.
constexpr std::size_t n_rows = 200;

std::vector<const SimulatedRow*> rows_of(const Posterior& posterior) {
  std::vector<const SimulatedRow*> rows;
  for (const std::size_t i : resampled(posterior.weights, n_rows))
    rows.push_back(&posterior.simulated[i]);
  return rows;
}

/// Quantile of a distribution that is given as a rising function: halved until it is close.
double quantile_of(const std::function<double(double)>& below, double fraction, double start,
                   double width) {
  double least = start - width, most = start + width;
  for (int i = 0; i < 60 && below(least) > fraction; ++i) least -= width * std::exp2(i);
  for (int i = 0; i < 60 && below(most) < fraction; ++i) most += width * std::exp2(i);
  while (most - least > 1e-4 * width) {
    const double middle = (least + most) / 2;
    if (!(middle > least && middle < most)) break;
    (below(middle) < fraction ? least : most) = middle;
  }
  return (least + most) / 2;
}

PredictedQuantity predicted(const Likelihood& likelihood, const Posterior& posterior, std::size_t q,
                            std::span<const std::size_t> left_out) {
  const std::vector<const SimulatedRow*> rows = rows_of(posterior);
  const auto below = [&](double level) {
    double sum = 0;
    for (const SimulatedRow* row : rows) sum += likelihood.below(*row, q, level, left_out);
    return sum / static_cast<double>(rows.size());
  };
  const ObservedQuantity& o = likelihood.observed()[q];
  const double start = (*rows[rows.size() / 2])[q].value;
  const double first = std::isfinite(start) ? start : o.value, width = likelihood.spread(q);
  const auto quantile = [&](double level) {
    return std::max(o.least, quantile_of(below, level, first, width));
  };
  const double lower = quantile(0.05);
  return {o.name, o.unit,         o.value,        quantile(0.5),
          lower,  quantile(0.95), below(o.value), lower == o.least};
}

/// log of the weighted mean of exp(logs).
double log_mean(const std::vector<double>& logs, const std::vector<double>& weights) {
  const double most = *std::max_element(logs.begin(), logs.end());
  if (!std::isfinite(most)) return -std::numeric_limits<double>::infinity();
  double sum = 0;
  for (std::size_t i = 0; i < logs.size(); ++i) sum += weights[i] * std::exp(logs[i] - most);
  return most + std::log(sum);
}

/// p(observed of these | the others) = mean over their posterior of p(all | point) / p(others |
/// point).
double log_score(const Likelihood& likelihood, const Posterior& others,
                 std::span<const std::size_t> left_out) {
  std::vector<double> logs;
  for (const SimulatedRow& row : others.simulated)
    logs.push_back(likelihood.log_of(row) - likelihood.log_without(row, left_out));
  return log_mean(logs, others.weights);
}

double even_log_mean(const std::vector<double>& logs) {
  return log_mean(logs, std::vector<double>(logs.size(), 1.0 / static_cast<double>(logs.size())));
}

double prior_log_score(const Likelihood& likelihood, const std::vector<SimulatedRow>& prior,
                       std::size_t q) {
  std::vector<double> logs;
  for (const SimulatedRow& row : prior) logs.push_back(likelihood.log_of_one(row, q));
  return even_log_mean(logs);
}

/// Of some quantities together.
double prior_log_score(const Likelihood& likelihood, const std::vector<SimulatedRow>& prior,
                       const std::vector<std::size_t>& of) {
  std::vector<std::size_t> others;
  for (std::size_t q = 0; q < likelihood.n_quantities(); ++q)
    if (std::find(of.begin(), of.end(), q) == of.end()) others.push_back(q);
  std::vector<double> logs;
  for (const SimulatedRow& row : prior) logs.push_back(likelihood.log_without(row, others));
  return even_log_mean(logs);
}

void sum_up(HeldOut& held) {
  const auto n = static_cast<double>(held.quantities.size());
  const auto inside = [&](double probability) {
    const double tail = (1 - probability) / 2;
    return static_cast<double>(std::count_if(held.quantities.begin(), held.quantities.end(),
                                             [&](const HeldOutQuantity& h) {
                                               return h.predicted.below >= tail &&
                                                      h.predicted.below <= 1 - tail;
                                             })) /
           n;
  };
  for (const HeldOutQuantity& h : held.quantities) {
    held.mean_log_score += h.log_score / n;
    held.prior_mean_log_score += h.prior_log_score / n;
  }
  held.coverage50 = inside(0.5);
  held.coverage90 = inside(0.9);
  for (int k = 1; k <= 9; ++k) held.reliability.emplace_back(0.1 * k, inside(0.1 * k));
}

}  // namespace

std::vector<PredictedQuantity> predictive_check(const Likelihood& likelihood,
                                                const Posterior& posterior) {
  std::vector<PredictedQuantity> all;
  for (std::size_t q = 0; q < likelihood.n_quantities(); ++q)
    all.push_back(predicted(likelihood, posterior, q, {}));
  return all;
}

HeldOut held_out(const Likelihood& likelihood,
                 const std::function<Posterior(std::size_t q)>& without,
                 const std::vector<SimulatedRow>& prior) {
  HeldOut held;
  if (likelihood.n_quantities() < 2) return held;
  for (std::size_t q = 0; q < likelihood.n_quantities(); ++q) {
    const Posterior others = without(q);
    held.quantities.push_back({predicted(likelihood, others, q, std::span(&q, 1)),
                               log_score(likelihood, others, std::span(&q, 1)),
                               prior_log_score(likelihood, prior, q), others.effective_size});
  }
  sum_up(held);
  return held;
}

std::vector<EventQuantities> events_of(const Likelihood& likelihood) {
  std::vector<EventQuantities> events;
  for (std::size_t q = 0; q < likelihood.n_quantities(); ++q) {
    const std::string event = event_of_quantity(likelihood.observed()[q].name);
    auto found = std::find_if(events.begin(), events.end(),
                              [&](const EventQuantities& e) { return e.event == event; });
    if (found == events.end()) found = events.insert(events.end(), {event, {}});
    found->quantities.push_back(q);
  }
  if (events.size() < 2) events.clear();
  return events;
}

std::vector<HeldOutEvent> held_out_events(
    const Likelihood& likelihood,
    const std::function<Posterior(std::span<const std::size_t>)>& without,
    const std::vector<SimulatedRow>& prior) {
  std::vector<HeldOutEvent> held;
  for (const auto& [event, quantities] : events_of(likelihood)) {
    const Posterior others = without(quantities);
    HeldOutEvent one;
    one.event = event;
    one.log_score = log_score(likelihood, others, quantities);
    one.prior_log_score = prior_log_score(likelihood, prior, quantities);
    one.effective_size = others.effective_size;
    for (const std::size_t q : quantities) {
      one.quantities.push_back(predicted(likelihood, others, q, quantities));
      const double below = one.quantities.back().below;
      one.n_inside90 += below >= 0.05 && below <= 0.95;
    }
    held.push_back(std::move(one));
  }
  return held;
}

}  // namespace sturz
