// SPDX-License-Identifier: Apache-2.0
#include "ensemble/calibration/identifiability.hpp"

#include "engine/core/error.hpp"
#include "ensemble/sampling/unit_cube.hpp"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>

namespace sturz {
namespace {

using Eigen::Index;
using Points = std::vector<std::vector<double>>;

constexpr double prior_variance = 1.0 / 12;
constexpr double ridge_correlation = 0.6;
/// So much stronger than in the prior is a correlation that the observations made.
constexpr double more_than_prior = 0.1;
/// Points that tell the covariance of a prior with correlations.
constexpr std::size_t n_prior = 4096;

struct Moments {
  Eigen::VectorXd mean;
  Eigen::MatrixXd covariance;
};

/// Of weighted points, free of the bias that few of them have: NaN where one holds all the weight.
Moments moments_of(const Points& points, const std::vector<double>& weights) {
  const auto n = static_cast<Index>(points.front().size());
  Moments m{Eigen::VectorXd::Zero(n), Eigen::MatrixXd::Zero(n, n)};
  const auto at = [&](std::size_t i) {
    return Eigen::Map<const Eigen::VectorXd>(points[i].data(), n);
  };
  double squares = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    m.mean += weights[i] * at(i);
    squares += weights[i] * weights[i];
  }
  for (std::size_t i = 0; i < points.size(); ++i)
    m.covariance += weights[i] * (at(i) - m.mean) * (at(i) - m.mean).transpose();
  const double free = 1 - squares;
  if (free < 1e-9)
    m.covariance.setConstant(std::numeric_limits<double>::quiet_NaN());
  else
    m.covariance /= free;
  return m;
}

Points of_keys(const Points& cube, const Copula* copula) {
  if (copula == nullptr) return cube;
  Points points;
  points.reserve(cube.size());
  for (const auto& u : cube) points.push_back(copula->apply(u));
  return points;
}

/// Covariance of the keys before anything was observed.
Eigen::MatrixXd prior_covariance(std::size_t n_dims, const Copula* copula) {
  const auto n = static_cast<Index>(n_dims);
  if (copula == nullptr) return prior_variance * Eigen::MatrixXd::Identity(n, n);
  const Points points = of_keys(draw_unit_cube(Design::sobol, n_prior, n_dims, 1), copula);
  return moments_of(points, std::vector<double>(n_prior, 1.0 / n_prior)).covariance;
}

double correlation_in(const Eigen::MatrixXd& covariance, Index i, Index j) {
  if (i == j) return 1;
  const double scale = std::sqrt(covariance(i, i) * covariance(j, j));
  return scale == 0 ? 0 : covariance(i, j) / scale;  // NaN stays NaN
}

std::vector<Direction> directions_of(const Eigen::MatrixXd& covariance,
                                     const Eigen::MatrixXd& prior) {
  std::vector<Direction> directions;
  const Index n = covariance.rows();
  if (!covariance.allFinite()) {
    for (Index k = 0; k < n; ++k) {
      const Eigen::VectorXd unit = Eigen::VectorXd::Unit(n, k);
      directions.push_back(
          {std::numeric_limits<double>::quiet_NaN(), {unit.data(), unit.data() + n}});
    }
    return directions;
  }
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(covariance, prior);
  for (Index k = 0; k < n; ++k) {
    Eigen::VectorXd along = solver.eigenvectors().col(k).normalized();
    Index largest = 0;
    along.cwiseAbs().maxCoeff(&largest);
    if (along(largest) < 0) along = -along;
    directions.push_back(
        {std::max(0.0, solver.eigenvalues()(k)), {along.data(), along.data() + along.size()}});
  }
  return directions;
}

bool is_ridge(double correlation, double before) {
  return std::abs(correlation) >= ridge_correlation &&
         std::abs(correlation - before) >= more_than_prior &&
         (std::abs(correlation) > std::abs(before) || correlation * before < 0);
}

}  // namespace

Identifiability identifiability_of(const Posterior& posterior, const Copula* copula) {
  expect(!posterior.cube.empty(), "a posterior has points");
  const std::size_t n_dims = posterior.cube.front().size();
  const Moments m = moments_of(of_keys(posterior.cube, copula), posterior.weights);
  const Eigen::MatrixXd prior = prior_covariance(n_dims, copula);
  Identifiability found;
  found.correlation.assign(n_dims, std::vector<double>(n_dims, 0));
  for (std::size_t a = 0; a < n_dims; ++a) {
    const auto i = static_cast<Index>(a);
    const double variance = m.covariance(i, i), removed = 1 - variance / prior_variance;
    found.mean.push_back(m.mean(i));
    found.sd.push_back(std::sqrt(variance));
    found.variance_removed.push_back(std::isnan(removed) ? removed : std::max(0.0, removed));
    for (std::size_t b = 0; b < n_dims; ++b) {
      const auto j = static_cast<Index>(b);
      found.correlation[a][b] = correlation_in(m.covariance, i, j);
      if (b < a && is_ridge(found.correlation[a][b], correlation_in(prior, i, j)))
        found.ridges.push_back({b, a, found.correlation[a][b]});
    }
  }
  std::stable_sort(found.ridges.begin(), found.ridges.end(), [](const Ridge& a, const Ridge& b) {
    return std::abs(a.correlation) > std::abs(b.correlation);
  });
  found.directions = directions_of(m.covariance, prior);
  return found;
}

}  // namespace sturz
