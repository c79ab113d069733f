// SPDX-License-Identifier: Apache-2.0
#include "ensemble/sampling/copula.hpp"

#include "engine/core/error.hpp"
#include "ensemble/sampling/unit_cube.hpp"

#include <Eigen/Cholesky>
#include <fmt/format.h>
#include <openturns/DistFunc.hxx>

#include <algorithm>
#include <cmath>

namespace sturz {
namespace {

/// Smallest pivot of the Cholesky factor that still leaves a coordinate some freedom.
constexpr double least_pivot = 1e-6;

std::string known_keys(std::span<const std::string> keys) {
  return keys.empty() ? "none" : fmt::format("{}", fmt::join(keys, ", "));
}

std::size_t place_of(std::span<const std::string> keys, const std::string& key,
                     const std::string& pair) {
  const auto found = std::find(keys.begin(), keys.end(), key);
  require(found != keys.end(),
          fmt::format("ensemble.correlation: '{}' in '{}' is not an uncertain key (those are: {}). "
                      "Write key/key with keys that have a distribution.",
                      key, pair, known_keys(keys)));
  return static_cast<std::size_t>(found - keys.begin());
}

Eigen::MatrixXd correlation_matrix(std::span<const std::string> keys,
                                   const std::map<std::string, double>& correlation) {
  const auto n = static_cast<Eigen::Index>(keys.size());
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Identity(n, n);
  for (const auto& [pair, value] : correlation) {
    const auto slash = pair.find('/');
    require(slash != std::string::npos,
            fmt::format("ensemble.correlation: '{}' names no pair (two keys with a slash between "
                        "them are needed). Write key/key.",
                        pair));
    const auto i = static_cast<Eigen::Index>(place_of(keys, pair.substr(0, slash), pair));
    const auto j = static_cast<Eigen::Index>(place_of(keys, pair.substr(slash + 1), pair));
    require(i != j, fmt::format("ensemble.correlation: '{}' pairs a key with itself (that "
                                "correlation is 1). Remove it.",
                                pair));
    require(value > -1 && value < 1,
            fmt::format("ensemble.correlation: '{}' = {} (must lie between -1 and 1, both "
                        "excluded). Make one key fixed if the two are the same thing.",
                        pair, value));
    require(matrix(i, j) == 0,
            fmt::format("ensemble.correlation: '{}' is given twice (a/b and b/a are the same "
                        "pair). Remove one.",
                        pair));
    matrix(i, j) = matrix(j, i) = value;
  }
  return matrix;
}

}  // namespace

Copula::Copula(std::span<const std::string> keys, const std::map<std::string, double>& correlation)
    : n_(keys.size()) {
  const Eigen::MatrixXd matrix = correlation_matrix(keys, correlation);
  if (matrix.isIdentity(0)) return;
  const Eigen::LLT<Eigen::MatrixXd> cholesky(matrix);
  const Eigen::MatrixXd factor = cholesky.matrixL();
  require(cholesky.info() == Eigen::Success && factor.diagonal().minCoeff() > least_pivot,
          "ensemble.correlation: these correlations cannot hold together (their matrix is not "
          "positive definite). Bring the strongest ones nearer to 0.");
  lower_.resize(n_ * n_);
  for (std::size_t i = 0; i < n_; ++i)
    for (std::size_t j = 0; j < n_; ++j)
      lower_[i * n_ + j] = factor(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
}

std::vector<double> Copula::apply(std::span<const double> independent) const {
  expect(independent.size() == n_, "a copula gets one coordinate per key");
  std::vector<double> result(independent.begin(), independent.end());
  if (lower_.empty()) return result;
  std::vector<double> score(n_);
  for (std::size_t i = 0; i < n_; ++i) score[i] = OT::DistFunc::qNormal(independent[i]);
  for (std::size_t i = 0; i < n_; ++i) {
    const double* row = &lower_[i * n_];
    if (std::all_of(row, row + i, [](double v) { return v == 0; })) continue;
    double z = 0;
    for (std::size_t j = 0; j <= i; ++j) z += row[j] * score[j];
    result[i] = inside_unit(OT::DistFunc::pNormal(z));
  }
  return result;
}

}  // namespace sturz
