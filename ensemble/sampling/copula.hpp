// SPDX-License-Identifier: Apache-2.0
/// Gaussian copula: makes the coordinates of a unit-cube point depend on one another.
#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

namespace sturz {

/// The correlations are those of the normal scores z = Phi^-1(u), so they do not depend on the
/// marginals; z_dependent = L z with L L^T the correlation matrix (Cholesky). A coordinate that
/// depends on no earlier one passes through unchanged, bit by bit.
class Copula {
 public:
  /// \param keys        names of the coordinates, in order
  /// \param correlation "key/key" -> correlation in the open interval (-1, 1); others are 0
  /// \throws SetupError on an unknown key, a pair given twice, or correlations that no set of
  ///         variables can have together (the matrix is not positive definite)
  Copula(std::span<const std::string> keys, const std::map<std::string, double>& correlation);

  /// \param independent [n_keys], each in (0, 1)
  /// \return [n_keys], each in (0, 1) and uniform when the input is
  std::vector<double> apply(std::span<const double> independent) const;

 private:
  std::size_t n_ = 0;
  std::vector<double> lower_;  ///< L, [n][n] row by row; empty: independent
};

}  // namespace sturz
