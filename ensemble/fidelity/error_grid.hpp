// SPDX-License-Identifier: Apache-2.0
/// What the models of error of members and of maps sum over: orders, their prior, and sums whose
/// weights are known as logarithms.
#pragma once

#include "ensemble/fidelity/error_model.hpp"

#include <Eigen/Core>

#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace sturz {

/// Orders: normal about one, the order of a front that is one particle thick; none is below a half
/// or above two.
inline constexpr std::array orders{0.5,  0.625, 0.75, 0.875, 1.0, 1.125,
                                   1.25, 1.375, 1.5,  1.75,  2.0};
inline constexpr std::array scatter_orders{0.5, 0.75, 1.0, 1.25, 1.5};
/// Logarithm, up to a constant.
double order_prior(double order);

/// What is asked about, as a weight of the bias, and the place of its spacing among those computed.
struct Target {
  double lift = 0;           ///< x^p of the spacing, less that of the finer one
  Eigen::Index level = -1;   ///< -1: was not computed
  double at = 0, finer = 0;  ///< variances of a number of unit deviation at both; 0: the limit
};
std::vector<Target> targets_of(std::span<const double> spacings,
                               std::span<const ErrorQuestion> questions, double p, double q);

/// Sums with weights that are known as logarithms only.
class Weighted {
 public:
  explicit Weighted(std::size_t n) : sums_(n, 0.0) {}
  /// \param add(sums, weight) adds what is to be averaged
  template <class Add>
  void take(double log_weight, Add&& add) {
    if (log_weight > most_) {
      const double shrink = std::exp(most_ - log_weight);
      for (double& s : sums_) s *= shrink;
      weight_ *= shrink;
      most_ = log_weight;
    }
    if (is_nothing(log_weight)) return;
    const double w = std::exp(log_weight - most_);
    add(sums_, w);
    weight_ += w;
  }
  /// Less than a billionth of the heaviest so far.
  bool is_nothing(double log_weight) const { return log_weight < most_ - 20.7; }
  double average(std::size_t i) const { return sums_[i] / weight_; }

 private:
  std::vector<double> sums_;
  double weight_ = 0, most_ = -1e300;
};

}  // namespace sturz
