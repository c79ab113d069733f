// SPDX-License-Identifier: Apache-2.0
/// Quantile functions of the scenario's distributions, by OpenTURNS.
#pragma once

#include "scenarios/uncertain.hpp"

#include <functional>
#include <string>

namespace sturz {

/// One distribution made ready for drawing. Copies share nothing mutable; safe to read from
/// several threads.
class Marginal {
 public:
  /// \param path the scenario key, named in errors
  /// \throws SetupError when the parameters make no distribution, by the rules of
  ///         scenarios/checks/distribution_check.hpp
  explicit Marginal(const Distribution& distribution, const std::string& path = "");

  /// Value below which the fraction u of the draws lies. u is taken inside the open interval by
  /// unit_margin, so the result is finite; it never leaves [lower(), upper()].
  ///   discrete   the smallest value whose cumulated weight reaches u
  ///   table      order statistics x_0 .. x_{n-1} at u = i / (n - 1), straight lines in between
  double quantile(double u) const;
  double median() const { return quantile(0.5); }
  double lower() const { return lower_; }  ///< end of the support; -infinity for a normal
  double upper() const { return upper_; }

 private:
  std::function<double(double)> quantile_;
  double lower_ = 0, upper_ = 0;
};

}  // namespace sturz
