// SPDX-License-Identifier: Apache-2.0
/// Draws from a density on the unit cube by several Markov chains.
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace sturz {

struct ChainLengths {
  int chains = 4;
  int burn_in = 500;      ///< steps of each that are thrown away; the step length adapts to them
  int kept = 1500;        ///< steps of each
  int first_look = 2048;  ///< points of the prior that tell where to start and how wide to step
};

/// Above this the chains tell different things.
inline constexpr double most_r_hat = 1.05;

struct ChainSample {
  std::vector<std::vector<double>> points;  ///< [chains * kept][n_dims], chain after chain
  std::vector<double> r_hat;       ///< of each coordinate, over halves of chains (Gelman and others
                                   ///< 2013, 11.4); 1 is best
  std::vector<double> acceptance;  ///< share of steps taken, of each chain
  double effective_size = 0;       ///< independent draws that are worth as much, of the coordinate
                                   ///< that is worst (Geyer's initial positive sequence, 1992)
};

/// Random walk with normal steps (Metropolis and others 1953; by OpenTURNS, whose generator is
/// seeded here for each chain: the same call gives the same bits).
/// \param log_density of a point [n_dims] in the open unit cube, up to a constant; -infinity where
///   it is impossible
/// \param starts [chains][n_dims], where the density is not 0
/// \param covariance [n_dims][n_dims] of the density, roughly: steps are 2.38 / sqrt(n_dims) of it
ChainSample sample_chains(const std::function<double(std::span<const double>)>& log_density,
                          const std::vector<std::vector<double>>& starts,
                          const Eigen::MatrixXd& covariance, const ChainLengths& lengths,
                          std::uint64_t seed);

}  // namespace sturz
