// SPDX-License-Identifier: Apache-2.0
/// The mean of a result at the dearest level from few draws there and more at cheaper ones.
///
/// g_0(k) is the result of draw k, g_l(k) for l > 0 what the levels l, l+1, ... tell of it: a
/// prediction. Level l has N_l draws, the first of those of the cheaper levels. The estimate
///   sum over l of mean_{k < N_l} (g_l(k) - g_{l+1}(k)),   g_L = 0,
/// is unbiased whatever the predictions are, where that of a draw was not fitted to its own result
/// (multilevel Monte Carlo: Giles 2015, Acta Numerica 24, 259-328; predictions as controls:
/// Sarndal, Swensson and Wretman 1992, ch. 6; cross-fitting: Chernozhukov and others 2018,
/// Econometrics J. 21, C1-C68). Linear predictions make it multifidelity Monte Carlo
/// (Peherstorfer, Willcox and Gunzburger 2016).
#pragma once

#include "ensemble/fidelity/refinement.hpp"

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace sturz {

inline constexpr std::size_t most_levels = 4;

struct MultilevelMean {
  double mean = nan_d, standard_error = nan_d;
  double degrees = nan_d;  ///< of freedom of the standard error (Welch and Satterthwaite)
  double skewness = 0;     ///< of the estimate's error: third moment over the standard error cubed
  /// By Student's t of a cubic transformation that takes the skewness off (Hall 1992, J. R.
  /// Statist. Soc. B 54, 221-228): farther on the side where few draws weigh much.
  Interval bounds_90() const;
  Interval even_bounds_90() const;  ///< without it
};

/// Half width of an interval, in standard errors. \param share within it, such as 0.9
double student_width(double share, double degrees);

/// Sums over draws. Those of several parts are the sums of the parts' draws in order.
class IncrementMoments {
 public:
  explicit IncrementMoments(std::size_t n_levels) : n_levels_(n_levels) {}
  /// \param told [n_levels - from] g of the levels `from`, the dearest that this draw has, and on
  void add(std::size_t from, std::span<const double> told);

  /// NaN while a level has fewer than two draws. \param least of the dearest levels on: variances
  /// that their increments have at least; few indicators may all come as foretold
  MultilevelMean estimate(std::span<const double> least = {}) const;
  double mean() const;
  /// Of one level's increments over its draws.
  double variance(std::size_t level) const;
  /// Of the increments of the levels from `first` on, as they add to the estimate's.
  double variance_of_mean(std::size_t first) const;
  double increment(std::size_t level) const;  ///< their mean
  double draws(std::size_t level) const { return n_[level]; }
  std::size_t n_levels() const { return n_levels_; }

 private:
  double covariance(std::size_t dear, std::size_t cheap) const;
  double third_moment(std::size_t level) const;  ///< central

  std::size_t n_levels_;
  std::array<double, most_levels> n_{};
  /// Over the draws of level i: of the increments of level j >= i, and of their products with those
  /// of level i.
  std::array<std::array<double, most_levels>, most_levels> sum_{}, product_{};
  std::array<double, most_levels> cube_{};  ///< of the level's own increments
};

/// How many draws each level needs.
struct Allocation {
  std::vector<double> draws;  ///< [n_levels], not rounded; never fewer than at a dearer level
  double variance = 0;        ///< of the estimate
  double cost = 0;            ///< of all draws together
};
/// Least cost for a variance: N_l proportional to sqrt(V_l / C_l) (Giles 2015, eq. 1.3); levels
/// that would have fewer draws than a dearer one share its number.
/// \param variances V_l of the increments \param costs C_l of a draw at level l alone
Allocation allocate_for_variance(std::span<const double> variances, std::span<const double> costs,
                                 double variance);
/// Least variance for a cost.
Allocation allocate_for_cost(std::span<const double> variances, std::span<const double> costs,
                             double cost);

}  // namespace sturz
