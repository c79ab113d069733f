// SPDX-License-Identifier: Apache-2.0
#include "ensemble/calibration/identifiability.hpp"

#include "engine/core/error.hpp"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace sturz {
namespace {

using Eigen::Index;

constexpr double prior_variance = 1.0 / 12;
constexpr double ridge_correlation = 0.6;

std::vector<Direction> directions_of(const Eigen::MatrixXd& covariance) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(covariance);
  std::vector<Direction> directions;
  for (Index k = 0; k < covariance.rows(); ++k) {
    Eigen::VectorXd along = solver.eigenvectors().col(k);
    Index largest = 0;
    along.cwiseAbs().maxCoeff(&largest);
    if (along(largest) < 0) along = -along;
    directions.push_back({std::max(0.0, solver.eigenvalues()(k)) / prior_variance,
                          {along.data(), along.data() + along.size()}});
  }
  return directions;
}

}  // namespace

Identifiability identifiability_of(const Posterior& posterior) {
  expect(!posterior.cube.empty(), "a posterior has points");
  const std::size_t n_dims = posterior.cube.front().size();
  const auto n = static_cast<Index>(n_dims);
  Eigen::VectorXd mean = Eigen::VectorXd::Zero(n);
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(n, n);
  const auto at = [&](std::size_t i) {
    return Eigen::Map<const Eigen::VectorXd>(posterior.cube[i].data(), n);
  };
  for (std::size_t i = 0; i < posterior.cube.size(); ++i) mean += posterior.weights[i] * at(i);
  for (std::size_t i = 0; i < posterior.cube.size(); ++i)
    covariance += posterior.weights[i] * (at(i) - mean) * (at(i) - mean).transpose();
  Identifiability found;
  found.correlation.assign(n_dims, std::vector<double>(n_dims, 0));
  for (std::size_t a = 0; a < n_dims; ++a) {
    const auto i = static_cast<Index>(a);
    found.mean.push_back(mean(i));
    found.sd.push_back(std::sqrt(covariance(i, i)));
    found.variance_removed.push_back(std::max(0.0, 1 - covariance(i, i) / prior_variance));
    for (std::size_t b = 0; b < n_dims; ++b) {
      const auto j = static_cast<Index>(b);
      const double scale = std::sqrt(covariance(i, i) * covariance(j, j));
      found.correlation[a][b] = a == b ? 1 : scale > 0 ? covariance(i, j) / scale : 0;
      if (b < a && std::abs(found.correlation[a][b]) >= ridge_correlation)
        found.ridges.push_back({b, a, found.correlation[a][b]});
    }
  }
  std::stable_sort(found.ridges.begin(), found.ridges.end(), [](const Ridge& a, const Ridge& b) {
    return std::abs(a.correlation) > std::abs(b.correlation);
  });
  found.directions = directions_of(covariance);
  return found;
}

}  // namespace sturz
