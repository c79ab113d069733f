// SPDX-License-Identifier: Apache-2.0
/// A smooth function of a few coordinates, known at some points with noise.
///
///   y(u) = trend(u) + z(u) + noise;   cov(z(u), z(v)) = s^2 M(|| (u - v) / length ||)
///   M(r) = (1 + a + a^2 / 3) exp(-a), a = sqrt(5) r     (Matern, nu = 5/2)
///
/// The trend is linear where there are at least four points per coefficient, a constant otherwise,
/// and its uncertainty counts (universal kriging; Rasmussen and Williams 2006, 2.7). Lengths and
/// the noise's share maximise the restricted likelihood. OpenTURNS 1.20 cannot estimate the noise
/// (a member's runout has some: its start lattice is drawn), so the algebra is here, and OpenTURNS
/// is the reference of its test.
#pragma once

#include <Eigen/Core>

#include <optional>
#include <span>
#include <vector>

namespace sturz {

struct GaussianPrediction {
  double mean = 0;
  double variance = 0;  ///< of the function there, without noise
  double noise = 0;     ///< variance of the noise of one more value
};

/// How well each point is told by the others.
struct LeaveOneOut {
  double q2 = 0;  ///< 1 - sum of squared errors / sum of squares about the mean; 1 is perfect
  double coverage95 = 0;  ///< share of points inside the 95 % interval that the others give
  double inflation = 1;   ///< mean squared error / predicted variance, at least 1: all variances
                          ///< are multiplied by it
  std::vector<double> predicted;  ///< [n] mean at each point that the others give
};

class GaussianProcess {
 public:
  struct Scales {
    std::vector<double> length;    ///< of each coordinate, in the unit of the coordinates
    double noise_ratio = 1e-6;     ///< variance of the noise / variance of z
    std::optional<bool> linear{};  ///< trend; absent: by the number of points
  };

  /// Finds the scales: two local searches, no random number.
  /// \param points [n][n_dims] in the unit cube, n >= n_dims + 3
  /// \param values [n], finite and not all equal
  static GaussianProcess fitted(const std::vector<std::vector<double>>& points,
                                std::span<const double> values);
  GaussianProcess(const std::vector<std::vector<double>>& points, std::span<const double> values,
                  Scales scales);

  GaussianPrediction at(std::span<const double> point) const;
  /// The mean alone, much cheaper.
  double mean_at(std::span<const double> point) const;
  const LeaveOneOut& leave_one_out() const { return left_out_; }
  const Scales& scales() const { return scales_; }
  /// Logarithm of the restricted likelihood, up to a constant of the number of points.
  double log_likelihood() const { return log_likelihood_; }
  /// The same process when one more point is known to have the value it is expected to have: what
  /// is left of the variance does not depend on the value. Lengths and noise stay.
  GaussianProcess with_point(std::span<const double> point) const;

 private:
  struct NotLookedAt {};  ///< without leave_one_out(), for the search
  GaussianProcess(const std::vector<std::vector<double>>& points, std::span<const double> values,
                  Scales scales, NotLookedAt);
  void solve();
  void look_left_out();
  Eigen::VectorXd covariances(std::span<const double> point) const;
  Eigen::VectorXd trend(std::span<const double> point) const;
  std::size_t n_dims() const { return scales_.length.size(); }

  Scales scales_;
  bool linear_ = false;  ///< the trend
  std::vector<std::vector<double>> points_;
  Eigen::VectorXd values_;  ///< [n], shifted and divided
  double shift_ = 0, divide_ = 1;
  Eigen::MatrixXd scaled_;          ///< [n_dims][n], points / length
  Eigen::MatrixXd factor_;          ///< L of K = L L^T, [n][n]
  Eigen::MatrixXd whitened_trend_;  ///< L^-1 F, [n][n_trend]
  Eigen::MatrixXd trend_factor_;    ///< of F^T K^-1 F
  Eigen::VectorXd coefficients_;    ///< of the trend
  Eigen::VectorXd weights_;         ///< K^-1 (y - F beta)
  double signal_ = 1;               ///< s^2 of the divided values
  double fixed_signal_ = 0;         ///< that of the process this one goes on from; 0: none
  double fixed_inflation_ = 0;
  double log_likelihood_ = 0;
  LeaveOneOut left_out_;
};

}  // namespace sturz
