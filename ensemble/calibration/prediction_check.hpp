// SPDX-License-Identifier: Apache-2.0
/// Does the posterior give what was observed, and what it was not shown?
#pragma once

#include "ensemble/calibration/posterior.hpp"

#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace sturz {

/// What is predicted for a new observation: simulation, discrepancy and measurement together. The
/// errors are normal and go below the least that a quantity can be, such as 0 for a distance: what
/// lies there stands at the least in quantiles, and where it lay in `below`.
struct PredictedQuantity {
  std::string name, unit;
  double observed = 0;
  double median = 0, lower = 0, upper = 0;  ///< 5 % and 95 %
  double below = 0;                         ///< predicted probability of less than was observed
  bool ends_at_least = false;               ///< the lower one was below the least of its quantity
};

/// Each quantity under the posterior that knows it: what falls outside is not explained at all.
std::vector<PredictedQuantity> predictive_check(const Likelihood&, const Posterior&);

/// Each quantity under the posterior of all others.
struct HeldOutQuantity {
  PredictedQuantity predicted;
  double log_score = 0;        ///< logarithm of the predicted density at the observation
  double prior_log_score = 0;  ///< the same under the prior; the difference is what was learned
  double effective_size = 0;   ///< of that posterior
};

/// All quantities of one event under the posterior of the other events.
struct HeldOutEvent {
  std::string event;
  std::vector<PredictedQuantity> quantities;
  double log_score = 0;        ///< of all its quantities together
  double prior_log_score = 0;  ///< the same under the prior
  double effective_size = 0;   ///< of the others' posterior
  std::size_t n_inside90 = 0;  ///< of its quantities, inside their central 90 %
};

struct HeldOut {
  std::vector<HeldOutQuantity> quantities;
  std::vector<HeldOutEvent> events;  ///< where there are several
  double mean_log_score = 0, prior_mean_log_score = 0;
  double coverage50 = 0, coverage90 = 0;  ///< share of quantities inside the central intervals
  /// Reliability: nominal probability of a central interval and the share of held-out quantities
  /// inside, at 0.1, 0.2, ..., 0.9.
  std::vector<std::pair<double, double>> reliability;
};

/// Leaves out one quantity after the other. With one quantity there is nothing to learn from, and
/// the list is empty.
/// \param without the posterior without quantity q
/// \param prior the likelihood's own sample of the prior, [n][n_quantities]
HeldOut held_out(const Likelihood&, const std::function<Posterior(std::size_t q)>& without,
                 const std::vector<SimulatedRow>& prior);

/// The quantities of each event, by the first part of their names; empty unless there are several
/// events.
struct EventQuantities {
  std::string event;
  std::vector<std::size_t> quantities;
};
std::vector<EventQuantities> events_of(const Likelihood&);

/// Leaves out one event after the other. Discrepancies are shared by kind: what the others say of
/// them widens or narrows what is predicted.
/// \param without the posterior without those quantities \param prior as for held_out()
std::vector<HeldOutEvent> held_out_events(
    const Likelihood&, const std::function<Posterior(std::span<const std::size_t>)>& without,
    const std::vector<SimulatedRow>& prior);

}  // namespace sturz
