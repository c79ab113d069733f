// SPDX-License-Identifier: Apache-2.0
#include "ensemble/emulator/gaussian_process.hpp"

#include "engine/core/error.hpp"
#include "ensemble/emulator/bounded_minimum.hpp"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <utility>

namespace sturz {
namespace {

using Points = std::vector<std::vector<double>>;
using Eigen::Index;

double matern(double r) {
  const double a = std::sqrt(5.0) * r;
  return (1 + a + a * a / 3) * std::exp(-a);
}

/// The searched numbers lie in [0, 1]: logarithms of lengths between a twentieth of the cube and
/// twenty cubes (straight lines, for all we see), and of the noise's share.
constexpr double least_length = 0.05, most_length = 20;
constexpr double least_noise = 1e-6, most_noise = 10;

double between(double t, double least, double most) { return least * std::pow(most / least, t); }

GaussianProcess::Scales scales_at(std::span<const double> t) {
  GaussianProcess::Scales scales;
  for (std::size_t d = 0; d + 1 < t.size(); ++d)
    scales.length.push_back(between(t[d], least_length, most_length));
  scales.noise_ratio = between(t.back(), least_noise, most_noise);
  return scales;
}

/// A weak prior about one cube: with few points the likelihood is flat, and its top may lie at the
/// end of the range without meaning anything.
double scale_prior(const GaussianProcess::Scales& scales) {
  double sum = 0;
  for (const double length : scales.length) sum -= std::pow(std::log(length) / 1.5, 2) / 2;
  return sum;
}

}  // namespace

GaussianProcess GaussianProcess::fitted(const Points& points, std::span<const double> values) {
  expect(!points.empty() && points.size() >= points.front().size() + 3,
         "a Gaussian process is fitted to a few more points than it has coordinates");
  const auto badness = [&](std::span<const double> t) {
    const GaussianProcess process(points, values, scales_at(t), NotLookedAt{});
    return -process.log_likelihood() - scale_prior(process.scales());
  };
  const std::size_t n = points.front().size() + 1;
  const int evaluations = 30 + 25 * static_cast<int>(n);
  Minimum best;
  for (const auto& [length, noise] : {std::pair{0.45, 0.3}, std::pair{0.65, 0.7}}) {
    std::vector<double> start(n, length);
    start.back() = noise;
    Minimum found = bounded_minimum(badness, std::move(start), evaluations);
    if (best.at.empty() || found.value < best.value) best = std::move(found);
  }
  return {points, values, scales_at(best.at)};
}

GaussianProcess::GaussianProcess(const Points& points, std::span<const double> values,
                                 Scales scales)
    : GaussianProcess(points, values, std::move(scales), NotLookedAt{}) {
  look_left_out();
}

GaussianProcess::GaussianProcess(const Points& points, std::span<const double> values,
                                 Scales scales, NotLookedAt /*unused*/)
    : scales_(std::move(scales)), points_(points) {
  expect(points.size() == values.size() && points.size() > 1, "one value per point");
  values_ = Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Index>(values.size()));
  shift_ = values_.mean();
  values_.array() -= shift_;
  divide_ = std::sqrt(values_.squaredNorm() / static_cast<double>(values.size()));
  expect(divide_ > 0 && std::isfinite(divide_), "values are finite and not all equal");
  values_ /= divide_;
  linear_ = scales_.linear.value_or(points_.size() >= 4 * (n_dims() + 1));
  scales_.linear = linear_;
  solve();
}

Eigen::VectorXd GaussianProcess::trend(std::span<const double> point) const {
  Eigen::VectorXd f(linear_ ? static_cast<Index>(n_dims()) + 1 : 1);
  f(0) = 1;
  for (Index d = 1; d < f.size(); ++d) f(d) = point[static_cast<std::size_t>(d - 1)] - 0.5;
  return f;
}

Eigen::VectorXd GaussianProcess::covariances(std::span<const double> point) const {
  Eigen::VectorXd at(static_cast<Index>(n_dims()));
  for (std::size_t d = 0; d < n_dims(); ++d)
    at(static_cast<Index>(d)) = point[d] / scales_.length[d];
  const Eigen::VectorXd r = (scaled_.colwise() - at).colwise().norm();
  return r.unaryExpr([](double x) { return matern(x); });
}

void GaussianProcess::solve() {
  const auto n = static_cast<Index>(points_.size());
  scaled_.resize(static_cast<Index>(n_dims()), n);
  Eigen::MatrixXd trends(n, trend(points_.front()).size());
  for (Index i = 0; i < n; ++i) {
    const auto& point = points_[static_cast<std::size_t>(i)];
    for (std::size_t d = 0; d < n_dims(); ++d)
      scaled_(static_cast<Index>(d), i) = point[d] / scales_.length[d];
    trends.row(i) = trend(point).transpose();
  }
  Eigen::MatrixXd covariance(n, n);
  for (Index j = 0; j < n; ++j)
    for (Index i = j; i < n; ++i)
      covariance(i, j) = matern((scaled_.col(i) - scaled_.col(j)).norm());
  covariance.diagonal().array() += scales_.noise_ratio;
  const Eigen::LLT<Eigen::MatrixXd> cholesky(covariance);
  expect(cholesky.info() == Eigen::Success, "noise keeps the covariance positive definite");
  factor_ = cholesky.matrixL();
  const auto lower = factor_.triangularView<Eigen::Lower>();
  whitened_trend_ = lower.solve(trends);
  const Eigen::VectorXd white = lower.solve(values_);
  const Eigen::LLT<Eigen::MatrixXd> of_trend(whitened_trend_.transpose() * whitened_trend_);
  expect(of_trend.info() == Eigen::Success, "points span the trend");
  trend_factor_ = of_trend.matrixL();
  coefficients_ = of_trend.solve(whitened_trend_.transpose() * white);
  const Eigen::VectorXd rest = white - whitened_trend_ * coefficients_;
  weights_ = factor_.transpose().triangularView<Eigen::Upper>().solve(rest);
  const auto free = static_cast<double>(n - trends.cols());
  // Values on a straight line leave nothing: a speck keeps the logarithm finite.
  signal_ = fixed_signal_ > 0 ? fixed_signal_ : std::max(rest.squaredNorm() / free, 1e-12);
  log_likelihood_ = -0.5 * free * std::log(signal_) - factor_.diagonal().array().log().sum() -
                    trend_factor_.diagonal().array().log().sum();
}

/// Errors of the point that is left out in closed form: e = (Q y)_i / Q_ii, variance s^2 / Q_ii,
/// with Q = K^-1 - K^-1 F (F^T K^-1 F)^-1 F^T K^-1 (Dubrule 1983). Q y = K^-1 (y - F beta).
void GaussianProcess::look_left_out() {
  const auto n = static_cast<Index>(points_.size());
  const Eigen::MatrixXd inverse_factor =
      factor_.triangularView<Eigen::Lower>().solve(Eigen::MatrixXd::Identity(n, n));
  const Eigen::MatrixXd part = trend_factor_.triangularView<Eigen::Lower>().solve(
      whitened_trend_.transpose() * inverse_factor);
  const Eigen::VectorXd diagonal =
      inverse_factor.colwise().squaredNorm().transpose() - part.colwise().squaredNorm().transpose();
  const Eigen::VectorXd errors = weights_.cwiseQuotient(diagonal);
  const Eigen::VectorXd ratio =  // squared, over the predicted variance
      errors.array().square() * diagonal.array() / signal_;
  left_out_.q2 = 1 - errors.squaredNorm() / values_.squaredNorm();
  left_out_.inflation = std::max(1.0, ratio.mean());
  const double limit = 1.959963984540054 * 1.959963984540054 * left_out_.inflation;
  left_out_.coverage95 =
      static_cast<double>((ratio.array() <= limit).count()) / static_cast<double>(ratio.size());
  for (Index i = 0; i < n; ++i)
    left_out_.predicted.push_back(shift_ + divide_ * (values_(i) - errors(i)));
}

double GaussianProcess::mean_at(std::span<const double> point) const {
  return shift_ + divide_ * (trend(point).dot(coefficients_) + covariances(point).dot(weights_));
}

GaussianPrediction GaussianProcess::at(std::span<const double> point) const {
  const Eigen::VectorXd k = covariances(point), f = trend(point);
  const Eigen::VectorXd white = factor_.triangularView<Eigen::Lower>().solve(k);
  const Eigen::VectorXd of_trend =
      trend_factor_.triangularView<Eigen::Lower>().solve(f - whitened_trend_.transpose() * white);
  const double scale =
      signal_ * divide_ * divide_ * (fixed_inflation_ > 0 ? fixed_inflation_ : left_out_.inflation);
  return {shift_ + divide_ * (f.dot(coefficients_) + k.dot(weights_)),
          scale * std::max(0.0, 1 - white.squaredNorm() + of_trend.squaredNorm()),
          scale * scales_.noise_ratio};
}

GaussianProcess GaussianProcess::with_point(std::span<const double> point) const {
  GaussianProcess more = *this;
  const double expected = (mean_at(point) - shift_) / divide_;
  more.points_.emplace_back(point.begin(), point.end());
  more.values_.conservativeResize(values_.size() + 1);
  more.values_(values_.size()) = expected;  // the last of one more
  more.fixed_signal_ = signal_;
  more.fixed_inflation_ = left_out_.inflation;
  more.solve();
  return more;
}

}  // namespace sturz
