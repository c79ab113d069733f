// SPDX-License-Identifier: Apache-2.0
/// Numbers that may be uncertain: distributions as plain data. Drawing them is ensemble's work.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace sturz {

/// A marginal distribution as the scenario file wrote it; all parameters in the key's own unit.
///   uniform         min, max
///   log_uniform     min, max (both > 0)
///   normal          mean, sd; optional min, max truncate it
///   lognormal       median, sigma_ln; optional min, max truncate it
///   triangular      min, mode, max
///   beta            alpha, beta, min, max
///   discrete        values with weights (equal when omitted)
///   table           sorted observations: the empirical quantile function, linear in between
struct Distribution {
  enum class Kind { uniform, log_uniform, normal, lognormal, triangular, beta, discrete, table };
  Kind kind = Kind::uniform;
  std::optional<double> min, max;       ///< support or truncation
  double mean = 0, sd = 0;              ///< normal
  double median = 0, sigma_ln = 0;      ///< lognormal
  double mode = 0;                      ///< triangular
  double alpha = 0, beta = 0;           ///< beta
  std::vector<double> values, weights;  ///< discrete, table

  bool operator==(const Distribution&) const = default;
};

/// A fixed number, or a distribution in its place (then `value` is unused until sampled).
struct Uncertain {
  double value = 0;
  std::optional<Distribution> distribution;

  Uncertain() = default;
  Uncertain(double v) : value(v) {}  // NOLINT: a plain number is the common case
  bool is_fixed() const { return !distribution; }
  bool operator==(const Uncertain&) const = default;
};

}  // namespace sturz
