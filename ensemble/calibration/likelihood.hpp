// SPDX-License-Identifier: Apache-2.0
/// How well a member explains what was observed, when neither measurement nor model is perfect.
///
///   observed_q = simulated_q + discrepancy_q + error_q
///   error_q        normal, 0, sd_q: the measurement
///   discrepancy_q  normal, 0, t_k scale_q: what the model cannot do, whatever its parameters
///   t_k            half-normal with scale `relative_sd`, one for each kind k of quantity
///
/// t_k is marginalised by a fixed sum over nodes: one number per member, no random number, and
/// weights and chains share it (Kennedy and O'Hagan 2001; Brynjarsdottir and O'Hagan 2014 for why a
/// calibration without it is falsely sure). scale_q is |observed|; where that is 0 (a distance
/// between outlines) it is the least value that any member reaches over the default relative_sd: no
/// model here is known to do better.
///
/// A simulated value of which only a lower bound c is known may be anything from c to c + range,
/// all alike: the density is then Phi((observed - c) / s) / range, which falls like the normal's
/// tail where the bound lies above the observation and stays small and even where it lies below.
/// One that is not known at all has 1 / range. One that an emulator sees beside a step is a mixture
/// of its two sides.
#pragma once

#include "ensemble/scores/comparison.hpp"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace sturz {

/// Discrepancy of a model of landslides over the observed value: runouts of calibrated models miss
/// others of their kind by a tenth (docs/decisions/0034).
inline constexpr double default_discrepancy = 0.1;

/// One value as the likelihood sees it.
struct SimulatedValue {
  double value = 0;
  double variance = 0;  ///< of an emulator; 0: a member's own
  Known known = Known::exactly;
  double other_share = 0;  ///< probability of the other side of a step, 0..0.5
  double other_value = 0, other_variance = 0;
};
using SimulatedRow = std::vector<SimulatedValue>;  ///< [n_quantities]

class Likelihood {
 public:
  /// \param observed at least one; each sd > 0
  /// \param members [n][n_quantities], for scales and ranges
  /// \param relative_sd of the discrepancy; 0: none
  /// \throws SetupError naming the quantity
  Likelihood(std::vector<ObservedQuantity> observed,
             std::span<const std::vector<Observation>> members, double relative_sd);

  std::size_t n_quantities() const { return observed_.size(); }
  const std::vector<ObservedQuantity>& observed() const { return observed_; }

  /// Logarithm of the density of all observations. \param simulated [n_quantities]
  double log_of(std::span<const SimulatedValue> simulated) const;
  /// Of all but one, and of all but some.
  double log_without(std::span<const SimulatedValue> simulated, std::size_t left_out) const;
  double log_without(std::span<const SimulatedValue> simulated,
                     std::span<const std::size_t> left_out) const;
  /// Of one alone.
  double log_of_one(std::span<const SimulatedValue> simulated, std::size_t which) const;

  /// Probability that a new observation of quantity q lies below `level`, given the simulated
  /// values and what the other observations of its kind say of the discrepancy.
  /// \param with_itself its own observation has a say too
  double below(std::span<const SimulatedValue> simulated, std::size_t q, double level,
               bool with_itself) const;
  /// The same when some observations have no say.
  double below(std::span<const SimulatedValue> simulated, std::size_t q, double level,
               std::span<const std::size_t> left_out) const;

  /// The kinds of quantities and their discrepancies.
  struct Kind {
    std::string name;
    std::vector<std::size_t> quantities;
  };
  const std::vector<Kind>& kinds() const { return kinds_; }
  /// Nodes of t_k, rising, and the probability of each given these simulated values.
  const std::vector<double>& nodes() const { return nodes_; }
  std::vector<double> node_probabilities(std::size_t kind,
                                         std::span<const SimulatedValue> simulated) const;
  /// Standard deviation of the discrepancy of quantity q at t [unit of the quantity].
  double discrepancy_sd(std::size_t q, double t) const { return t * scale_[q]; }
  /// Standard deviation of measurement and expected discrepancy together.
  double spread(std::size_t q) const;

 private:
  double log_density(const SimulatedValue& simulated, std::size_t q, double t) const;
  /// Standard deviation of an observation about a simulated value, whose own variance is given.
  double sd_about(double variance, std::size_t q, double t) const;
  /// log of sum over nodes of weight times product over the quantities that `counts`.
  template <class Counts>
  double log_sum(std::span<const SimulatedValue> simulated, const Kind& kind, Counts counts) const;
  template <class Counts>
  std::vector<double> log_nodes(std::span<const SimulatedValue> simulated, const Kind& kind,
                                Counts counts) const;
  const Kind& kind_of(std::size_t q) const;

  std::vector<ObservedQuantity> observed_;
  std::vector<double> scale_, range_;  ///< [n_quantities]
  std::vector<Kind> kinds_;
  std::vector<double> nodes_, log_weights_;
  double relative_sd_ = 0;
};

/// "event 1/speed_3_m_s" -> "speed_m_s": quantities that differ by event or number are of one kind.
std::string kind_of_quantity(const std::string& name);

/// "event 1/speed_3_m_s" -> "event 1"; empty where a name tells no event.
std::string event_of_quantity(const std::string& name);

/// A member's values.
SimulatedRow exact_row(std::span<const Observation> member);

}  // namespace sturz
