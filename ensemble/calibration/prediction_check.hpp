// SPDX-License-Identifier: Apache-2.0
/// Does the posterior give what was observed, and what it was not shown?
#pragma once

#include "ensemble/calibration/posterior.hpp"

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace sturz {

/// What is predicted for a new observation: simulation, discrepancy and measurement together.
struct PredictedQuantity {
  std::string name, unit;
  double observed = 0;
  double median = 0, lower = 0, upper = 0;  ///< 5 % and 95 %
  double below = 0;                         ///< predicted probability of less than was observed
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

struct HeldOut {
  std::vector<HeldOutQuantity> quantities;
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

}  // namespace sturz
