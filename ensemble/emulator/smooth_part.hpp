// SPDX-License-Identifier: Apache-2.0
/// A Gaussian process, or, of too few or equal values, their mean.
#pragma once

#include "ensemble/emulator/gaussian_process.hpp"

#include <optional>
#include <span>
#include <vector>

namespace sturz {

/// A process over n_dims coordinates wants so many points and n_dims.
inline constexpr std::size_t points_over_dims = 5;

class SmoothPart {
 public:
  /// Of fewer than n_dims + 5 points, or equal values: their mean, with the variance of the values
  /// as noise and that of their mean as what is not known.
  /// \param points [n][n_dims], n >= 1 \param values [n], finite
  SmoothPart(const std::vector<std::vector<double>>& points, std::span<const double> values);
  /// With the scales of `like` instead of found ones, which fewer points will do for.
  SmoothPart(const std::vector<std::vector<double>>& points, std::span<const double> values,
             const SmoothPart& like);

  GaussianPrediction at(std::span<const double> point) const;
  double mean_at(std::span<const double> point) const;
  const LeaveOneOut& leave_one_out() const;
  /// See GaussianProcess::with_point.
  SmoothPart with_point(std::span<const double> point) const;
  const std::optional<GaussianProcess>& process() const { return process_; }

 private:
  explicit SmoothPart(GaussianProcess process) : process_(std::move(process)) {}
  void take_mean(std::span<const double> values);

  std::optional<GaussianProcess> process_;
  GaussianPrediction mean_;  ///< without a process: the same everywhere
  LeaveOneOut left_out_;     ///< without a process
};

}  // namespace sturz
